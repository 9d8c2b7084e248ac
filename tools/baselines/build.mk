# Published sky models beside ours, for comparison: build/libbaselines.a. Link it with -pthread -lm.
BASELINES_LIB := $(B)/libbaselines.a
BASELINES_OBJ := $(patsubst %.c,$(B)/%.o,$(sort $(wildcard tools/baselines/*.c)))

$(BASELINES_OBJ): $(B)/tools/baselines/%.o: tools/baselines/%.c $(wildcard tools/baselines/*.h) $(wildcard include/skyvert/*.h) Makefile tools/baselines/build.mk
	@mkdir -p $(@D)
	$(CC) $(TOOL_FLAGS) -O3 -pthread $(CORE_EXTRA) -c $< -o $@

$(BASELINES_LIB): $(BASELINES_OBJ)
	@mkdir -p $(@D)
	@rm -f $@
	$(AR) rcs $@ $^
