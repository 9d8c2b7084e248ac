# Cortex-M under QEMU: the tests of tests/api, the checksum program and the counts of instructions on three boards.
#   m4f mps2-an386 (the reference), m7 mps2-an500, m3 mps2-an385 (no FPU). Without the cross compiler nothing is built.
DEPS_TEST += gcc-arm-none-eabi libnewlib-arm-none-eabi qemu-system-arm
TEST_SCRIPT += port/cortexm/test.sh

CM := $(B)/cortexm
CM_CC := arm-none-eabi-gcc
CM_HAVE := $(shell command -v $(CM_CC) 2>/dev/null)
ifeq ($(CM_HAVE),)
LEFT_OUT += port/cortexm:gcc-arm-none-eabi
endif

CM_ARCH_m4f := -mcpu=cortex-m4 -mthumb -mfloat-abi=hard -mfpu=fpv4-sp-d16
CM_ARCH_m7  := -mcpu=cortex-m7 -mthumb -mfloat-abi=hard -mfpu=fpv5-sp-d16
CM_ARCH_m3  := -mcpu=cortex-m3 -mthumb
CM_OPT      := -O2 -ffunction-sections -fdata-sections
CM_LD       := -nostartfiles -Wl,-T,port/cortexm/cortexm.ld -Wl,--gc-sections -Wl,--no-warn-rwx-segments
# The core as any product would build it. An enum is a byte here, so some range checks cannot fail: no word about those.
CM_WARN     := $(WARN) -Wno-type-limits
CM_CORE_FLAGS = -std=c99 $(CM_OPT) $(FP) $(CM_WARN) -Iinclude -Isrc
# Tests: the stand-in for cmocka, and SKV_TEST_SMALL where a test would not fit into 64 KiB of RAM or take minutes.
CM_TEST_FLAGS = -std=c99 $(CM_OPT) $(FP) $(filter-out -Wdouble-promotion,$(CM_WARN)) -Iinclude -Isrc -Itests -Iport/cortexm \
                -isystem port/cortexm/cmocka -DSKV_TEST_SMALL=1
CM_PORT_SRC := port/cortexm/start.c port/cortexm/semihosting.c
CM_TESTS    := $(notdir $(basename $(wildcard tests/api/test_*.c)))
CM_DEMO     := $(CM)/m4f/demo.elf

# $(1) board
define CM_BOARD
$(CM)/$(1)/src/%.o: src/%.c $(HEADERS) Makefile port/cortexm/build.mk
	@mkdir -p $$(@D)
	$(CM_CC) $$(CM_CORE_FLAGS) $$(CM_ARCH_$(1)) -fcallgraph-info=su -c $$< -o $$@
$(CM)/$(1)/port/%.o: port/cortexm/%.c $(wildcard port/cortexm/*.h) $(HEADERS) port/cortexm/build.mk
	@mkdir -p $$(@D)
	$(CM_CC) $$(CM_TEST_FLAGS) $$(CM_ARCH_$(1)) -c $$< -o $$@
$(CM)/$(1)/tests/%.o: tests/%.c $(wildcard tests/*.h tests/*/*.h) port/cortexm/cmocka/cmocka.h $(HEADERS) port/cortexm/build.mk
	@mkdir -p $$(@D)
	$(CM_CC) $$(CM_TEST_FLAGS) $$(CM_ARCH_$(1)) -c $$< -o $$@
$(CM)/$(1)/libskyvert.a: $(CORE_SRC:%.c=$(CM)/$(1)/%.o) $(SCENE_SRC:%.c=$(CM)/$(1)/%.o)
	@mkdir -p $$(@D)
	@rm -f $$@
	arm-none-eabi-ar rcs $$@ $$^
$(CM)/$(1)/%.elf: $(CM)/$(1)/tests/%.o $(CM)/$(1)/port/start.o $(CM)/$(1)/port/semihosting.o $(CM)/$(1)/port/newlib.o $(CM)/$(1)/libskyvert.a port/cortexm/cortexm.ld
	@mkdir -p $$(@D)
	$(CM_CC) $$(CM_ARCH_$(1)) $(CM_LD) $$(filter %.o %.a,$$^) -lm -o $$@
endef
$(foreach b,m4f m7 m3,$(eval $(call CM_BOARD,$(b))))

# No C library at all: what the core needs of one (memcpy, memset) comes from the compiler's own.
$(CM_DEMO): $(CM)/m4f/port/demo.o $(CM_PORT_SRC:port/cortexm/%.c=$(CM)/m4f/port/%.o) $(CM)/m4f/port/memory.o $(CM)/m4f/libskyvert.a port/cortexm/cortexm.ld
	$(CM_CC) $(CM_ARCH_m4f) $(CM_LD) -nostdlib $(filter %.o %.a,$^) -lgcc -o $@

$(CM)/libcount.so: port/cortexm/plugin/count.c
	@mkdir -p $(@D)
	$(CC) -std=c99 -O2 $(WARN) -fPIC -fvisibility=hidden -shared $< -o $@

CM_ELF := $(CM_TESTS:%=$(CM)/m4f/api/%.elf) $(CM_DEMO)
.PHONY: cortexm
cortexm: $(CM_ELF) ## tests/api and the demo for Cortex-M4F
ifneq ($(CM_HAVE),)
test-build: $(CM_ELF) $(CM)/libcount.so
endif
