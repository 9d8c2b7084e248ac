# skyvert-sim: on a fake bus, and its logs read by other programs. On a real kernel: tests/rig/guest/sim_*.sh.
DEPS_TEST += python3 python3-canmatrix
TEST_BIN    += $(B)/tests/cockpit/test_sim
TEST_SCRIPT += tests/cockpit/sim_log.sh tests/cockpit/sim_bad.sh
$(B)/tests/cockpit/test_sim: tests/cockpit/test_sim.c tests/check.h tools/cockpit/sim_wire.c $(SKYVERT_SIM_PARTS) $(SKV_CAN_FAKE_OBJ) $(LIB)
	@mkdir -p $(@D)
	$(CC) $(TOOL_FLAGS) -I. -Itests -c $< -o $@.o
	$(SKYVERT_LD) $(SAN) $@.o $(filter-out %/sim_wire.o,$(filter %.o,$^)) $(LIB) $(GEO_LIBS) -lcmocka -lm -o $@
