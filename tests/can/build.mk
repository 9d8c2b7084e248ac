# CAN: the protocol, its DBC file, candump logs and the fake bus. On a real kernel: socket_check in tests/rig/guest/can.sh.
DEPS_TEST += python3 python3-canmatrix tshark clang gcc-arm-none-eabi
CAN_TESTS := $(patsubst tests/can/%.c,$(B)/tests/can/%,$(wildcard tests/can/test_*.c))
TEST_BIN    += $(CAN_TESTS)
TEST_SCRIPT += tests/can/dbc.sh tests/can/fuzz.sh tests/can/micro.sh
$(CAN_TESTS): $(B)/tests/can/%: tests/can/%.c tests/check.h $(SKV_CAS_OBJ) $(SKV_CAN_OBJ) $(SKV_CAN_FAKE_OBJ)
	@mkdir -p $(@D)
	$(CC) $(TOOL_FLAGS) -I. -Itests $< $(filter %.o,$^) -lcmocka -o $@

CAN_PROGRAMS := $(addprefix $(B)/tests/can/,dbc random_log random_frames speed)
$(CAN_PROGRAMS): $(B)/tests/can/%: tests/can/%.c $(SKV_CAS_OBJ)
	@mkdir -p $(@D)
	$(CC) $(TOOL_FLAGS) -I. $^ -o $@
# Needs a kernel with CAN to say anything: on the board.
CAN_CHECK := $(B)/tests/can/socket_check
$(CAN_CHECK): tests/can/socket_check.c $(SKV_CAS_OBJ) $(SKV_CAN_OBJ)
	@mkdir -p $(@D)
	$(CC) $(TOOL_FLAGS) -I. $^ -o $@
test-build: $(CAN_PROGRAMS) $(CAN_CHECK)

.PHONY: dbc
dbc: $(B)/tests/can/dbc ## write port/canaerospace/skyvert.dbc from the table of messages
	@$< >$(B)/skyvert.dbc
	@mv $(B)/skyvert.dbc port/canaerospace/skyvert.dbc
