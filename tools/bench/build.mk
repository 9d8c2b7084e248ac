# make bench: error, instructions and time of every rule and tier. bench.sh builds bench-cost once per compiler and flags.
BENCH_OBJ := $(addprefix $(B)/tools/bench/,cases.o dome.o) $(B)/tools/reference/read_ini.o $(B)/libreference.a $(CORE_OBJ)

$(B)/tools/bench/%.o: tools/bench/%.c $(wildcard tools/bench/*.h) $(wildcard tools/reference/*.h) $(HEADERS)
	@mkdir -p $(@D)
	$(CC) $(TOOL_FLAGS) $(CORE_EXTRA) -Itools/reference -c $< -o $@

$(B)/bench-errors $(B)/bench-orders $(B)/bench-cost $(B)/bench-tables: $(B)/bench-%: $(B)/tools/bench/%.o $(BENCH_OBJ)
	$(CC) $(TOOL_FLAGS) $(filter %.o,$^) $(filter %.a,$^) $$($(PKG_CONFIG) --libs inih) -lm -o $@

bench: $(B)/bench-errors $(B)/bench-orders ## error, instructions (callgrind) and time per vertex of every rule and tier
	@B=$(B) MAKE="$(MAKE)" $(BASH) tools/bench/bench.sh
