# The cockpit's programs and tests with the sanitizers, core and C++ without: sanitize.sh runs them. Objects in
# $(B)/sanitize, beside plain ones of C++, pictures and GPIO lines.
SANITIZE       := -g -O1 -fno-omit-frame-pointer -fsanitize=address,undefined -fno-sanitize-recover=all
SANITIZED      := $(B)/sanitize
$(SANITIZED)/%.o: %.c $(wildcard tests/cockpit/*.h tools/cockpit/*.h tools/skyvert/*.h port/*/*.h) $(HEADERS) Makefile tests/cockpit/sanitize.mk
	@mkdir -p $(@D)
	$(CC) $(TOOL_FLAGS) $(SANITIZE) -I. -Itests $(PORT_FLAGS) $(SKYVERT_INIH_FLAGS) -c $< -o $@

# $(call sanitized,OBJECT...): those of C, with the sanitizers.
sanitized = $(patsubst $(B)/%,$(SANITIZED)/%,$(1))
SANITIZED_SIM     := $(call sanitized,$(filter-out $(GEO_OBJ),$(SKYVERT_SIM_PARTS) $(SKV_CAN_FAKE_OBJ)))
SANITIZED_COCKPIT := $(call sanitized,$(filter-out $(SKV_EXR_OBJ) $(SKV_PNG_OBJ) $(SKV_GPIO_OBJ),$(SKYVERT_COCKPIT_PARTS)))
SANITIZED_PROGRAMS := $(addprefix $(SANITIZED)/,skyvert-sim skyvert-cockpit $(notdir $(SIM_TESTS) $(COCKPIT_TESTS)))
test-build: $(SANITIZED_PROGRAMS)

$(SANITIZED)/skyvert-sim: $(SANITIZED)/tools/cockpit/sim_main.o $(SANITIZED_SIM) $(GEO_OBJ) $(LIB)
	$(CC) $(SANITIZE) $^ $(GEO_LIBS) -lm -o $@
$(addprefix $(SANITIZED)/,$(notdir $(SIM_TESTS))): $(SANITIZED)/%: $(SANITIZED)/tests/cockpit/%.o $(SANITIZED_SIM) $(GEO_OBJ) $(LIB)
	$(CC) $(SANITIZE) $(filter-out $(if $(filter test_sim,$*),%/sim_wire.o),$^) $(GEO_LIBS) -lcmocka -lm -o $@
$(SANITIZED)/skyvert-cockpit: $(SANITIZED)/tools/cockpit/cockpit_main.o $(SANITIZED_COCKPIT) $(SKV_EXR_OBJ) $(SKV_PNG_OBJ) $(SKV_GPIO_OBJ) $(LIB)
	$(CC) $(SANITIZE) $^ $(SKYVERT_COCKPIT_LIBS) -o $@
$(addprefix $(SANITIZED)/,$(notdir $(COCKPIT_TESTS))): $(SANITIZED)/%: $(SANITIZED)/tests/cockpit/%.o $(SANITIZED_COCKPIT) $(SKV_EXR_OBJ) $(SKV_PNG_OBJ) \
		$(patsubst %.c,$(B)/%.o,$(SKV_GPIO_PANEL) port/gpiod/fake.c) $(LIB)
	$(CC) $(SANITIZE) -pthread $^ $(filter-out $(SKV_GPIO_LIBS),$(SKYVERT_COCKPIT_LIBS)) -lcmocka -lm -o $@
