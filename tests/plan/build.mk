# The planner: its errors and answers, and 20 random scenes that are built, counted and compared with path tracing.
DEPS_TEST += valgrind gcc-arm-none-eabi libnewlib-arm-none-eabi qemu-system-arm gcc-aarch64-linux-gnu libc6-dev-arm64-cross qemu-user
PLAN_TEST_OBJ := $(addprefix $(B)/tools/plan/,scene.o sample.o kind.o light.o error.o cost.o search.o) $(B)/tools/trade/metric.o

$(B)/tests/plan/%.o: tests/plan/%.c $(wildcard tools/plan/*.h tools/skyvert/*.h tools/trade/*.h) $(HEADERS) tests/plan/build.mk
	@mkdir -p $(@D)
	$(CC) $(TOOL_FLAGS) $(CORE_EXTRA) -I. -c $< -o $@
$(B)/plan-case $(B)/plan-compare: $(B)/plan-%: $(B)/tests/plan/%.o $(PLAN_TEST_OBJ) $(PLAN_BASE) $(LIB)
	$(PLAN_LINK)

# White-box: the library's own loops with their inner calls counted.
TEST_BIN += $(B)/tests/plan/test_work
$(B)/tests/plan/test_work: tests/plan/test_work.c tests/check.h $(HEADERS) $(LIB)
	@mkdir -p $(@D)
	$(CC) $(TOOL_FLAGS) $(OPT) $(ARCH) -fno-math-errno -fno-trapping-math -Isrc -Itests $< $(LIB) -lcmocka -lm -o $@

ifeq ($(call have,inih),yes)
TEST_SCRIPT += tests/plan/plan.sh tests/plan/random.sh
TEST_FULL_SCRIPT += tests/plan/random-full.sh
test-build: $(B)/plan-case $(B)/plan-compare
endif

.PHONY: plan-scenes
plan-scenes: $(B)/plan-truth ## trace the truth of the planner's 20 random scenes again (tests/plan/truth); many minutes
	@B=$(B) $(BASH) tests/plan/truth.sh
