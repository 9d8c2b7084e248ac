# skyvert-cockpit without a CAN bus: its parts, and the program on a log. On a real kernel: tests/rig/guest/cockpit*.sh.
include $(wildcard tests/cockpit/sim.mk)
DEPS_TEST += python3 openimageio-tools
COCKPIT_TESTS := $(patsubst tests/cockpit/%.c,$(B)/tests/cockpit/%,$(wildcard tests/cockpit/test_cockpit*.c))
TEST_BIN    += $(COCKPIT_TESTS)
TEST_SCRIPT += tests/cockpit/cockpit.sh
# The GPIO lines are fake ones here.
$(COCKPIT_TESTS): $(B)/tests/cockpit/%: tests/cockpit/%.c tests/check.h $(SKYVERT_COCKPIT_PARTS) $(patsubst %.c,$(B)/%.o,$(SKV_GPIO_PANEL) port/gpiod/fake.c) $(LIB)
	@mkdir -p $(@D)
	$(CC) $(TOOL_FLAGS) -pthread -I. -Itests $< $(filter-out $(filter-out $(SKV_GPIO_PANEL:%.c=$(B)/%.o),$(SKV_GPIO_OBJ)),$(filter %.o %.a,$^)) \
		$(filter-out $(SKV_GPIO_LIBS),$(SKYVERT_COCKPIT_LIBS)) -lcmocka -lm -o $@

# Prints what an image generator finds in the shared memory.
test-build: $(B)/tests/cockpit/reader
$(B)/tests/cockpit/reader: tests/cockpit/reader.c tools/cockpit/vertices.h Makefile
	@mkdir -p $(@D)
	$(CC) $(TOOL_FLAGS) -I. $< -lrt -o $@
include tests/cockpit/sanitize.mk
TEST_SCRIPT += tests/cockpit/sanitize.sh
