# GPIO without hardware: the pure parts, and the panel on fake lines. On a real kernel: tests/rig/guest/gpio.sh.
GPIO_TESTS := $(patsubst tests/gpio/%.c,$(B)/tests/gpio/%,$(wildcard tests/gpio/test_*.c))
TEST_BIN   += $(GPIO_TESTS)
$(GPIO_TESTS): $(B)/tests/gpio/%: tests/gpio/%.c tests/check.h $(patsubst %.c,$(B)/%.o,$(SKV_GPIO_PANEL) port/gpiod/fake.c)
	@mkdir -p $(@D)
	$(CC) $(TOOL_FLAGS) -I. -Itests $< $(filter %.o,$^) -lcmocka -o $@

# Prints what a panel says; the rig turns and presses. Compiled everywhere.
test-build: $(B)/tests/gpio/panel
$(B)/tests/gpio/panel: tests/gpio/panel.c $(SKV_GPIO_OBJ)
	@mkdir -p $(@D)
	$(CC) $(TOOL_FLAGS) -I. $^ $(SKV_GPIO_LIBS) -o $@
