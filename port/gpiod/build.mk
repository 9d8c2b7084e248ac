# Switches and lamps over GPIO, by libgpiod 1.6 or 2.x. Without it every line is reported as not there.
#   SKV_GPIO_OBJ SKV_GPIO_LIBS   what a program is linked with; SKV_GPIO_PURE: encoder, debounce and lamps alone
DEPS_RUN += libgpiod-dev
SKV_GPIO_LIBS :=
ifneq ($(call have,libgpiod),yes)
SKV_GPIO_BACK := none
LEFT_OUT += GPIO:libgpiod-dev
else
SKV_GPIO_BACK := $(if $(shell $(PKG_CONFIG) --atleast-version=2 libgpiod && echo 2),gpiod2,gpiod1)
SKV_GPIO_LIBS := $(shell $(PKG_CONFIG) --libs libgpiod)
endif
SKV_GPIO_PURE  := $(addprefix port/gpiod/,quadrature.c debounce.c lamp.c)
SKV_GPIO_PANEL := $(SKV_GPIO_PURE) port/gpiod/panel.c port/gpiod/config.c
SKV_GPIO_SRC   := $(SKV_GPIO_PANEL) port/gpiod/chips.c port/gpiod/$(SKV_GPIO_BACK).c
SKV_GPIO_OBJ   := $(SKV_GPIO_SRC:%.c=$(B)/%.o)

$(B)/port/gpiod/%.o: port/gpiod/%.c $(wildcard port/gpiod/*.h) Makefile
	@mkdir -p $(@D)
	$(CC) $(TOOL_FLAGS) -I. $(shell $(PKG_CONFIG) --cflags libgpiod 2>/dev/null) -c $< -o $@
