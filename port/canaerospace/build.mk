# CANaerospace: pure bytes, needs nothing. Programs link SKV_CAS_OBJ; programs of the board name SKV_CAS_SRC.
SKV_CAS_SRC := $(sort $(wildcard port/canaerospace/*.c))
SKV_CAS_OBJ := $(SKV_CAS_SRC:%.c=$(B)/%.o)
# As for a microcontroller: no C library but memcpy and memset.
SKV_CAS_FLAGS = -std=c99 -O2 $(ARCH) $(FP) $(WARN) -Iinclude $(SAN)
$(B)/port/canaerospace/%.o: port/canaerospace/%.c $(wildcard port/canaerospace/*.h) include/skyvert/status.h Makefile
	@mkdir -p $(@D)
	$(CC) $(SKV_CAS_FLAGS) -c $< -o $@
