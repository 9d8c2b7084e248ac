# A CAN bus: the Linux kernel's (SKV_CAN_SRC, SKV_CAN_OBJ) and a fake one (beside it: SKV_CAN_FAKE_SRC, SKV_CAN_FAKE_OBJ).
# The kernel's headers are all it needs; which CAN the kernel has shows when a program runs.
SKV_CAN_SRC := $(addprefix port/socketcan/,bus.c socketcan.c cyclic.c link.c)
SKV_CAN_FAKE_SRC := port/socketcan/fake.c
SKV_CAN_OBJ := $(SKV_CAN_SRC:%.c=$(B)/%.o)
SKV_CAN_FAKE_OBJ := $(SKV_CAN_FAKE_SRC:%.c=$(B)/%.o)
$(B)/port/socketcan/%.o: port/socketcan/%.c $(wildcard port/socketcan/*.h) Makefile
	@mkdir -p $(@D)
	$(CC) $(TOOL_FLAGS) -c $< -o $@
