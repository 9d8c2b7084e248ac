# Stability at the extremes: `make extremes` prints the table that the README keeps between its markers; the check of it is
# part of `make test`, all sweeps and all 2^32 floats of `make test-full`.
EXTREMES := points continuity weather light monotone unary
EXTREMES_BIN := $(EXTREMES:%=$(B)/tests/extremes/%)
EXTREMES_NAIVE := $(B)/tests/extremes/naive_float.o $(B)/tests/extremes/naive_double.o

$(B)/tests/extremes/%.o: tests/extremes/%.c $(wildcard tests/extremes/*.h) $(wildcard tests/property/*.h) $(wildcard tests/white/*.h) tests/airs.h tests/check.h $(wildcard tools/reference/*.h) $(HEADERS)
	@mkdir -p $(@D)
	$(CC) $(TOOL_FLAGS) -Isrc -Itests -Itests/property -Itools/reference -c $< -o $@

$(EXTREMES_BIN): $(B)/tests/extremes/%: $(B)/tests/extremes/%.o $(EXTREMES_NAIVE) $(B)/libreference.a $(LIB)
	$(CC) $(TOOL_FLAGS) $(filter %.o,$^) $(B)/libreference.a $(LIB) -lcmocka -lpthread -lm -o $@

.PHONY: extremes
extremes: $(EXTREMES_BIN) ## what happens at the ends of all ranges: a table of naive float, ours and double
	@B=$(B) CC="$(CC)" $(BASH) tests/extremes/extremes.sh print

TEST_SCRIPT += tests/extremes/extremes.sh
TEST_FULL_SCRIPT += tests/extremes/extremes-full.sh tests/extremes/unary-full.sh
test-build: $(EXTREMES_BIN)
