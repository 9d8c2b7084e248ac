# skyvert-sim: on a fake bus, and its logs read by other programs. On a real kernel: tests/rig/guest/sim*.sh.
DEPS_TEST += python3 python3-canmatrix
SIM_TESTS   := $(addprefix $(B)/tests/cockpit/,test_sim test_sim_flight test_sim_replay)
TEST_BIN    += $(SIM_TESTS)
TEST_SCRIPT += tests/cockpit/sim_log.sh tests/cockpit/sim_bad.sh
# test_sim has sim_wire.c within.
$(SIM_TESTS): $(B)/tests/cockpit/%: tests/cockpit/%.c tests/check.h tests/cockpit/sim_rig.h tools/cockpit/sim_wire.c $(SKYVERT_SIM_PARTS) $(SKV_CAN_FAKE_OBJ) $(LIB)
	@mkdir -p $(@D)
	$(CC) $(TOOL_FLAGS) -I. -Itests -c $< -o $@.o
	$(SKYVERT_LD) $(SAN) $@.o $(filter-out $(if $(filter test_sim,$*),%/sim_wire.o),$(filter %.o,$^)) $(LIB) $(GEO_LIBS) -lcmocka -lm -o $@
