# The same bits everywhere: one program, built for each variant below, must print the same checksums (tests/bits/compare.sh).
DEPS_TEST += clang gcc-aarch64-linux-gnu libc6-dev-arm64-cross qemu-user-static
TEST_SCRIPT += tests/bits/compare.sh
TEST_FULL_SCRIPT += tests/bits/compare-full.sh

BITS := $(B)/bits
BITS_SRC := $(CORE_SRC) $(SCENE_SRC) $(sort $(wildcard tests/bits/*.c))
BITS_FLAGS = -std=c99 $(FP) $(filter-out -Wdouble-promotion,$(WARN)) -Iinclude -Isrc

# Variants: compiler and flags. Contraction is off in all of them, with FMA there or not. Four more (cc-O3, gcc-O3-fma,
# clang-O3-fma, aarch64) use objects that are built for other purposes. Those of BITS_FULL, the rest of the grid, and everything
# on an emulated aarch64, which has the small selection else, run in `make test-full`.
BITS_gcc-O1           := gcc -O1
BITS_gcc-O1-avx2      := gcc -O1 -mavx2
BITS_gcc-O2-lanes1    := gcc -O2 -mavx2 -DSKV_LANES=1
BITS_gcc-O2-lanes8    := gcc -O2 -march=haswell -DSKV_LANES=8
BITS_clang-O1         := clang -O1
BITS_clang-O3         := clang -O3
BITS_clang-O3-avx2    := clang -O3 -mavx2
BITS_clang-O2-lanes4  := clang -O2 -DSKV_LANES=4
BITS_clang-O2-lanes32 := clang -O2 -march=haswell -DSKV_LANES=32
BITS_gcc-O3           := gcc -O3
BITS_gcc-O3-avx2      := gcc -O3 -mavx2
BITS_gcc-O3-haswell   := gcc -O3 -march=haswell
BITS_gcc-O3-lanes1    := gcc -O3 -DSKV_LANES=1
BITS_gcc-O3-lanes16   := gcc -O3 -mavx2 -DSKV_LANES=16
BITS_FULL  := clang-O1 gcc-O2-lanes1 gcc-O1-avx2 gcc-O2-lanes8 clang-O3-avx2 clang-O2-lanes4 gcc-O3 gcc-O3-avx2 gcc-O3-haswell gcc-O3-lanes1 gcc-O3-lanes16
BITS_NAMES := gcc-O1 clang-O3 clang-O2-lanes32

BITS_DEPENDS := $(BITS_SRC) $(wildcard tests/bits/*.h) $(HEADERS) Makefile tests/bits/build.mk
$(BITS)/%/bits: $(BITS_DEPENDS)
	@mkdir -p $(@D)
	$(BITS_$*) $(BITS_FLAGS) $(filter %.c,$^) -o $@
BITS_OWN := $(sort $(wildcard tests/bits/*.c))
$(BITS)/cc-O3/bits: $(LIB) $(BITS_OWN) $(wildcard tests/bits/*.h)
	@mkdir -p $(@D)
	$(CC) -O3 $(ARCH) $(BITS_FLAGS) $(BITS_OWN) $(LIB) -o $@
$(BITS)/gcc-O3-fma/bits: $(CORE_SRC:%.c=$(B)/gates/gcc/%.o) $(SCENE_SRC:%.c=$(B)/gates/gcc/%.o) $(BITS_OWN) $(wildcard tests/bits/*.h)
	@mkdir -p $(@D)
	gcc -O3 -mavx2 -mfma $(BITS_FLAGS) $(BITS_OWN) $(filter %.o,$^) -o $@
$(BITS)/clang-O3-fma/bits: $(CORE_SRC:%.c=$(B)/gates/clang/%.o) $(SCENE_SRC:%.c=$(B)/gates/clang/%.o) $(BITS_OWN) $(wildcard tests/bits/*.h)
	@mkdir -p $(@D)
	clang -O3 -mavx2 -mfma $(BITS_FLAGS) $(BITS_OWN) $(filter %.o,$^) -o $@

# With the board's library (tests/rig/build.mk).
$(BITS)/aarch64/bits $(BITS)/aarch64-all/bits: $(B)/rig/plain/libskyvert.a $(BITS_OWN) $(wildcard tests/bits/*.h)
	@mkdir -p $(@D)
	aarch64-linux-gnu-gcc -O2 -static $(BITS_FLAGS) $(if $(findstring all,$@),,-DSKV_TEST_SMALL) $(BITS_OWN) $< -o $@

# On the boards the parts are one more program of port/cortexm.
define BITS_BOARD
$(CM)/$(1)/bits/bits.elf: $(patsubst %.c,$(CM)/$(1)/%.o,$(sort $(wildcard tests/bits/*.c))) $(CM)/$(1)/port/start.o $(CM)/$(1)/port/semihosting.o \
                          $(CM)/$(1)/port/newlib.o $(CM)/$(1)/libskyvert.a port/cortexm/cortexm.ld
	@mkdir -p $$(@D)
	$(CM_CC) $$(CM_ARCH_$(1)) $(CM_LD) $$(filter %.o %.a,$$^) -o $$@
endef
$(foreach b,m4f m7 m3,$(eval $(call BITS_BOARD,$(b))))

.PHONY: bits-host bits-full bits-names bits-boards-full bits-aarch64 bits-aarch64-full bits-boards bits
bits-host: $(BITS_NAMES:%=$(BITS)/%/bits) $(BITS)/cc-O3/bits $(BITS)/gcc-O3-fma/bits $(BITS)/clang-O3-fma/bits
bits-full: $(BITS_FULL:%=$(BITS)/%/bits)
bits-names: # the variants for this machine that compare.sh runs; with BITS=full all
	@echo cc-O3 gcc-O3-fma clang-O3-fma $(BITS_NAMES) $(if $(filter full,$(BITS_RUN)),$(BITS_FULL))
bits-aarch64: $(BITS)/aarch64/bits
bits-aarch64-full: $(BITS)/aarch64-all/bits
bits-boards: $(CM)/m4f/bits/bits.elf
bits-boards-full: $(CM)/m3/bits/bits.elf $(CM)/m7/bits/bits.elf
bits: ## the checksum over everything, on all targets
	@B=$(B) MAKE="$(MAKE)" $(BASH) tests/bits/compare.sh
