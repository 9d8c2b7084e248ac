# The cockpit demo: skyvert-sim sends a flight on a CAN bus (sim*.c), skyvert-cockpit colours its sky from it (all other files);
# common*.c is in both.
COCKPIT_FLIGHT := $(patsubst %,$(B)/tools/skyvert/%.o,csv errors flight flight_csv flight_igc moment options output place progress utc_text)
COCKPIT_COMMON_SRC := $(sort $(wildcard tools/cockpit/common*.c))
COCKPIT_SIM_SRC := $(sort $(wildcard tools/cockpit/sim*.c))
COCKPIT_SRC := $(filter-out $(COCKPIT_COMMON_SRC) $(COCKPIT_SIM_SRC),$(sort $(wildcard tools/cockpit/*.c)))
COCKPIT_COMMON := $(COCKPIT_COMMON_SRC:%.c=$(B)/%.o)
COCKPIT_SIM_OBJ := $(COCKPIT_SIM_SRC:%.c=$(B)/%.o)
COCKPIT_OBJ := $(COCKPIT_SRC:%.c=$(B)/%.o)

# Later fragments set some of these flags: a recipe sees them all.
$(COCKPIT_COMMON) $(COCKPIT_SIM_OBJ) $(COCKPIT_OBJ): $(B)/tools/cockpit/%.o: tools/cockpit/%.c \
		$(wildcard tools/cockpit/*.h tools/skyvert/*.h port/*/*.h) $(HEADERS) $(B)/tools/skyvert/flags Makefile tools/cockpit/build.mk
	@mkdir -p $(@D)
	$(CC) $(TOOL_FLAGS) -I. $(PORT_FLAGS) $(SKYVERT_INIH_FLAGS) -c $< -o $@

# What skyvert-sim is made of but for its main file: tests link it too.
SKYVERT_SIM_PARTS := $(filter-out %/sim_main.o,$(COCKPIT_SIM_OBJ)) $(COCKPIT_COMMON) $(COCKPIT_FLIGHT) $(GEO_OBJ) $(SKV_CAS_OBJ) $(SKV_CAN_OBJ)
ifneq ($(wildcard tools/cockpit/sim_main.c),)
PROGRAMS += $(B)/skyvert-sim
endif
$(B)/skyvert-sim: $(B)/tools/cockpit/sim_main.o $(SKYVERT_SIM_PARTS) $(LIB)
	$(SKYVERT_LD) $(SAN) $^ $(GEO_LIBS) -lm -o $@

# What skyvert-cockpit is made of but for its main file: all C, so that it runs on a small board.
COCKPIT_TOOLS := $(patsubst %,$(B)/tools/skyvert/%.o,errors ini_document options output progress)
SKYVERT_COCKPIT_PARTS := $(filter-out %/cockpit_main.o,$(COCKPIT_OBJ)) $(COCKPIT_COMMON) $(COCKPIT_TOOLS) $(SKV_CAS_OBJ) $(SKV_CAN_OBJ) \
	$(SKV_CAN_FAKE_OBJ) $(SKV_GPIO_OBJ) $(SKV_EXR_OBJ) $(SKV_PNG_OBJ)
SKYVERT_COCKPIT_LIBS = $(SKV_EXR_LIBS) $(SKV_PNG_LIBS) $(SKV_GPIO_LIBS) $(SKYVERT_INIH_LIBS) -lrt -lm
ifneq ($(wildcard tools/cockpit/cockpit_main.c),)
PROGRAMS += $(B)/skyvert-cockpit
endif
$(B)/skyvert-cockpit: $(B)/tools/cockpit/cockpit_main.o $(SKYVERT_COCKPIT_PARTS) $(LIB)
	$(CC) $(SAN) $^ $(SKYVERT_COCKPIT_LIBS) -o $@

.PHONY: demo-cockpit
demo-cockpit: deps-test ## the cockpit on this machine: on vcan when the kernel has it, else on a board under QEMU
	@$(MAKE) --no-print-directory DEPS=no $(B)/skyvert-sim $(B)/skyvert-cockpit rig-build
	@B=$(B) $(BASH) tools/cockpit/demo.sh
