# Gates: scripts that hold limits, each with samples that it has to refuse.
DEPS_TEST += clang binutils gcc-arm-none-eabi libnewlib-arm-none-eabi valgrind
TEST_SCRIPT += tests/gates/objects.sh

GATES := $(B)/gates
GATES_FLAGS = -std=c99 -O3 -mavx2 -mfma $(FP) $(WARN) -Iinclude -Isrc
$(GATES)/gcc/%.o: %.c $(HEADERS) Makefile tests/gates/build.mk
	@mkdir -p $(@D)
	gcc $(GATES_FLAGS) -fcallgraph-info=su -c $< -o $@
$(GATES)/clang/%.o: %.c $(HEADERS) Makefile tests/gates/build.mk
	@mkdir -p $(@D)
	clang $(GATES_FLAGS) -c $< -o $@

GATES_SRC := $(CORE_SRC) $(SCENE_SRC)
.PHONY: gates-objects cortexm-objects
gates-objects: $(GATES_SRC:%.c=$(GATES)/gcc/%.o) $(GATES_SRC:%.c=$(GATES)/clang/%.o)
cortexm-objects: $(foreach b,m4f m3,$(GATES_SRC:%.c=$(CM)/$(b)/%.o))

# Programs that count and measure; each host set is linked against its own objects.
$(GATES)/%/count: tests/gates/count.c tests/gates/window.h
	@mkdir -p $(@D)
	$(firstword $(subst -, ,$*)) -std=c99 -O2 $(WARN) -Iinclude $< $(filter %.o,$^) -o $@
$(GATES)/%/stack: tests/gates/stack.c
	@mkdir -p $(@D)
	$(firstword $(subst -, ,$*)) -std=c99 -O2 $(WARN) -Iinclude $< $(filter %.o,$^) -o $@
$(GATES)/gcc/count $(GATES)/gcc/stack: $(GATES_SRC:%.c=$(GATES)/gcc/%.o)
$(GATES)/clang/count $(GATES)/clang/stack: $(GATES_SRC:%.c=$(GATES)/clang/%.o)
TEST_FULL_SCRIPT += tests/gates/config-full.sh
TEST_SCRIPT += tests/gates/sizes.sh tests/gates/config.sh tests/gates/fastmath.sh
.PHONY: gates-programs cortexm-programs sizes
$(GATES)/cc/stack: tests/gates/stack.c $(LIB)
	@mkdir -p $(@D)
	$(CC) -std=c99 -O2 $(WARN) -Iinclude $^ -o $@
gates-programs: $(GATES)/cc/stack $(GATES)/gcc/count $(GATES)/gcc/stack $(GATES)/clang/count $(GATES)/clang/stack
cortexm-programs: $(CM)/m4f/gates/count.elf $(CM)/m4f/gates/stack.elf $(CM)/m4f/gates/sizes.elf $(CM)/m4f/demo.elf $(CM)/libcount.so
sizes: ## flash, stack, table bytes and instructions per vertex, x86-64 and Cortex-M4F
	@B=$(B) MAKE="$(MAKE)" $(BASH) tests/gates/sizes.sh
TEST_SCRIPT += tests/gates/without_packages.sh tests/gates/steps.sh
