# Programs of the board. It has libgpiod 1.6, and 2 from a later Debian.
RIG_GPIO := $(SKV_GPIO_PANEL) port/gpiod/chips.c port/gpiod/gpiod1.c
$(eval $(call RIG_PROGRAM,panel,tests/gpio/panel.c $(RIG_GPIO),-lgpiod))
$(eval $(call RIG_SANITIZED,panel,tests/gpio/panel.c $(RIG_GPIO),-lgpiod))
# The CAN port against the board's kernel.
$(eval $(call RIG_PROGRAM,socket_check,tests/can/socket_check.c $(SKV_CAN_SRC) $(SKV_CAS_SRC),))
$(eval $(call RIG_PROGRAM,random-frames,tests/can/random_frames.c $(SKV_CAS_SRC),))
$(eval $(call RIG_PROGRAM,slcan-adapter,tests/rig/slcan_adapter.c,))

# panel2: as panel, with libgpiod 2.
RIG_NEXT := $(RIG)/trixie/usr
$(RIG)/next/%.o: %.c | $(RIG)/names
	@mkdir -p $(@D)
	$(RIG_CC) $(TOOL_FLAGS) -I. -isystem $(RIG_NEXT)/include $(RIG_SANITIZE) -c $< -o $@
RIG_PANEL2 := $(patsubst %.c,$(RIG)/san/%.o,tests/gpio/panel.c $(SKV_GPIO_PANEL) port/gpiod/chips.c) $(RIG)/next/port/gpiod/gpiod2.o
RIG_PROGRAMS += $(RIG)/guest/bin/panel2-san
$(RIG)/guest/bin/panel2-san: $(RIG_PANEL2)
	@mkdir -p $(@D)
	$(RIG_CC) $(RIG_SANITIZE) $^ -L$(RIG_NEXT)/lib/aarch64-linux-gnu -lgpiod -o $@

# skyvert-sim: plain C here, without a geoid.
RIG_FLIGHT := $(COCKPIT_FLIGHT:$(B)/%.o=%.c)
$(eval $(call RIG_PROGRAM,skyvert-sim,$(COCKPIT_SIM_SRC) $(COCKPIT_COMMON_SRC) $(RIG_FLIGHT) $(SKV_CAN_SRC) $(SKV_CAS_SRC),-lskyvert))
$(eval $(call RIG_SANITIZED,skyvert-sim,$(COCKPIT_SIM_SRC) $(COCKPIT_COMMON_SRC) $(RIG_FLIGHT) $(SKV_CAN_SRC) $(SKV_CAS_SRC),-lskyvert))
$(eval $(call RIG_PROGRAM,sim-check,tests/cockpit/sim_check.c,))

# skyvert-cockpit, without OpenEXR.
RIG_COCKPIT := $(COCKPIT_SRC) $(COCKPIT_COMMON_SRC) $(COCKPIT_TOOLS:$(B)/%.o=%.c) $(SKV_CAN_SRC) $(SKV_CAN_FAKE_SRC) $(SKV_CAS_SRC) $(RIG_GPIO) port/png/png.c
RIG_COCKPIT_FLAGS := -DSKV_HAVE_INIH=1 -DSKV_HAVE_PNG
$(RIG)/plain/tools/%.o $(RIG)/san/tools/%.o: RIG_FLAGS += $(RIG_COCKPIT_FLAGS)
$(eval $(call RIG_PROGRAM,skyvert-cockpit,$(RIG_COCKPIT),-lskyvert -lgpiod -linih -lpng -lz))
$(eval $(call RIG_SANITIZED,skyvert-cockpit,$(RIG_COCKPIT),-lskyvert -lgpiod -linih -lpng -lz))
$(eval $(call RIG_PROGRAM,vertices,tests/cockpit/reader.c,))
