# Black-box tests: every test_NAME.c here becomes $(B)/tests/api/test_NAME, linked with the library and cmocka and run by
# `make test`. Libraries that only one of them needs: API_LIBS_test_NAME. None includes anything of src/.
API_TESTS := $(patsubst tests/api/%.c,%,$(wildcard tests/api/test_*.c))
TEST_BIN  += $(API_TESTS:%=$(B)/tests/api/%)
TEST_SCRIPT += tests/api/radiance_truth.sh
DEPS_TEST += libcmocka-dev liberfa-dev

$(foreach t,$(filter test_sun% test_moon%,$(API_TESTS)),$(eval API_LIBS_$(t) ?= -lerfa))

$(B)/tests/api/%: tests/api/%.c tests/airs.h tests/check.h $(wildcard tests/api/*.h) $(HEADERS) $(LIB)
	@mkdir -p $(@D)
	$(CC) $(TOOL_FLAGS) -Itests $< $(LIB) -lcmocka $(API_LIBS_$*) -lm -o $@
