# Tests of the command: eval, sun, their error lines, their readers under seeded changes.
TEST_BIN    += $(B)/tests/command/test_text
TEST_SCRIPT += tests/command/eval_atmosphere.sh tests/command/eval_queries.sh tests/command/eval_truth.sh tests/command/eval_orders.sh tests/command/sun.sh tests/command/fuzz.sh
TEST_FULL_SCRIPT += tests/command/fuzz_full.sh

COMMAND_TOOL = $(patsubst %,$(B)/tools/skyvert/%.o,$(1))

$(B)/tests/command/test_text: tests/command/test_text.c tests/check.h $(call COMMAND_TOOL,answers csv errors options output progress queries utc_text) $(LIB)
	@mkdir -p $(@D)
	$(CC) $(TOOL_FLAGS) -I. $< $(filter %.o %.a,$^) -lcmocka -lm -o $@

# The readers once more, with the sanitizers, beside messages that check themselves.
COMMAND_SAN     := -g -O1 -fsanitize=address,undefined,float-cast-overflow -fno-sanitize-recover=all
COMMAND_FUZZED  := $(addprefix tools/skyvert/,csv.c ini.c ini_document.c options.c output.c progress.c queries.c table_file.c)
COMMAND_FUZZ    := $(addprefix $(B)/tests/command/,fuzz_ini fuzz_csv)

ifneq ($(call have,inih),)
test-build: $(COMMAND_FUZZ)
$(COMMAND_FUZZ): $(B)/tests/command/%: tests/command/%.c tests/command/fuzz_main.c tests/command/fuzz.h $(COMMAND_FUZZED) $(wildcard tools/skyvert/*.h) $(LIB)
	@mkdir -p $(@D)
	$(CC) $(TOOL_FLAGS) $(COMMAND_SAN) -I. $(SKYVERT_INIH_FLAGS) $< tests/command/fuzz_main.c $(COMMAND_FUZZED) $(LIB) $(SKYVERT_INIH_LIBS) -lm -o $@

# libFuzzer, for as long as one likes: make fuzz-command FUZZ_SECONDS=600
FUZZ_SECONDS ?= 60
.PHONY: fuzz-command
fuzz-command: $(LIB) ## fuzz the command's readers with libFuzzer (clang)
	@mkdir -p $(B)/tests/command/corpus_ini $(B)/tests/command/corpus_csv
	@cp tests/command/air.ini $(B)/tests/command/corpus_ini/ && cp tests/command/queries.csv $(B)/tests/command/corpus_csv/
	for t in ini csv; do clang $(TOOL_FLAGS) -g -O1 -fsanitize=fuzzer,address,undefined -fno-sanitize-recover=all -I. $(SKYVERT_INIH_FLAGS) \
	    tests/command/fuzz_$$t.c $(COMMAND_FUZZED) $(LIB) $(SKYVERT_INIH_LIBS) -lm -o $(B)/tests/command/lf_$$t && \
	    $(B)/tests/command/lf_$$t -max_total_time=$(FUZZ_SECONDS) -print_final_stats=1 $(B)/tests/command/corpus_$$t || exit 1; done
endif
