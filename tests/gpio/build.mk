# GPIO without hardware: the pure parts, the panel on fake lines, what both versions of libgpiod share. On a real kernel:
# tests/rig/guest/gpio.sh.
GPIO_TESTS := $(patsubst tests/gpio/%.c,$(B)/tests/gpio/%,$(wildcard tests/gpio/test_*.c))
TEST_BIN   += $(GPIO_TESTS)
GPIO_PARTS := $(patsubst %.c,$(B)/%.o,$(SKV_GPIO_PANEL))
$(B)/tests/gpio/test_logic $(B)/tests/gpio/test_panel: $(GPIO_PARTS) $(B)/port/gpiod/fake.o
$(B)/tests/gpio/test_none: $(GPIO_PARTS) $(B)/port/gpiod/chips.o $(B)/port/gpiod/none.o
$(B)/tests/gpio/test_chips: port/gpiod/chips.c port/gpiod/chips.h port/gpiod/lines.h
$(GPIO_TESTS): $(B)/tests/gpio/%: tests/gpio/%.c tests/check.h
	@mkdir -p $(@D)
	$(CC) $(TOOL_FLAGS) -I. -Itests $< $(filter %.o,$^) -lcmocka -o $@

# Prints what a panel says; the rig turns and presses. Compiled everywhere.
test-build: $(B)/tests/gpio/panel
$(B)/tests/gpio/panel: tests/gpio/panel.c $(SKV_GPIO_OBJ)
	@mkdir -p $(@D)
	$(CC) $(TOOL_FLAGS) -I. $^ $(SKV_GPIO_LIBS) -o $@
