# Properties of the core, against the double-precision reference (tools/reference).
PROPERTY_TESTS := $(patsubst tests/property/test_%.c,$(B)/tests/property/test_%,$(wildcard tests/property/test_*.c))
LANES_TESTS := $(foreach n,1 4 16 64,$(B)/tests/property/lanes-$(n))
# It reads atmospheres as files.
ifneq ($(call have,inih),yes)
PROPERTY_TESTS := $(filter-out %/test_all_orders,$(PROPERTY_TESTS))
endif
TEST_BIN += $(PROPERTY_TESTS)
TEST_SCRIPT += tests/property/lanes.sh tests/property/sanitize.sh
test-build: $(LANES_TESTS)

$(B)/tests/property/%.o: tests/property/%.c $(wildcard tests/property/*.h) tests/airs.h tests/check.h $(wildcard tools/reference/*.h) $(HEADERS)
	@mkdir -p $(@D)
	$(CC) $(TOOL_FLAGS) -Isrc -Itests -Itools/reference -c $< -o $@

$(PROPERTY_TESTS): $(B)/tests/property/test_%: $(B)/tests/property/test_%.o $(B)/libreference.a $(CORE_OBJ)
	$(CC) $(TOOL_FLAGS) $(filter %.o,$^) $(filter %.a,$^) $(PROPERTY_LIBS) -lcmocka -lm -o $@

$(B)/tests/property/test_all_orders: $(B)/tools/reference/read_ini.o
$(B)/tests/property/test_all_orders: PROPERTY_LIBS = $$($(PKG_CONFIG) --libs inih)

# Bits do not depend on optimisation: -O1 compiles quickly (and warns of what -O3 sees through).
$(LANES_TESTS): $(B)/tests/property/lanes-%: tests/property/lanes.c $(CORE_SRC) $(HEADERS)
	@mkdir -p $(@D)
	$(CC) $(filter-out -O3,$(CORE_FLAGS)) -O1 -w -DSKV_LANES=$* $(filter %.c,$^) -o $@
TEST_SCRIPT += tests/property/test_path_command.sh tests/property/test_path_data.sh
