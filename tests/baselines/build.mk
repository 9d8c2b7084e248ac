# The published models of tools/baselines: against the reference in double, and their own properties.
BASELINE_TESTS := $(patsubst tests/baselines/test_%.c,$(B)/tests/baselines/test_%,$(wildcard tests/baselines/test_*.c))
TEST_BIN += $(BASELINE_TESTS)

$(B)/tests/baselines/%.o: tests/baselines/%.c $(wildcard tests/baselines/*.h tools/baselines/*.h tools/reference/*.h) tests/airs.h tests/check.h $(HEADERS)
	@mkdir -p $(@D)
	$(CC) $(TOOL_FLAGS) -Itests -Itools/baselines -Itools/reference -c $< -o $@

$(BASELINE_TESTS): $(B)/tests/baselines/test_%: $(B)/tests/baselines/test_%.o $(BASELINES_LIB) $(B)/libreference.a $(LIB)
	$(CC) $(TOOL_FLAGS) -pthread $^ -lcmocka -lm -o $@

# skyvert render --model
DEPS_TEST += openimageio-tools
ifeq ($(call have,OpenEXR)$(call have,libpng),yesyes)
TEST_SCRIPT += tests/baselines/render.sh
endif
