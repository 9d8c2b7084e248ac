# White-box tests: they may include headers and sources of src/. Every test_NAME.c becomes $(B)/tests/white/test_NAME and
# is run by `make test`, every full_NAME.c by `make test-full`. Further flags and libraries of one: WHITE_LIBS_test_NAME.
WHITE_TESTS   := $(patsubst tests/white/%.c,%,$(wildcard tests/white/test_*.c))
WHITE_FULL    := $(patsubst tests/white/%.c,%,$(wildcard tests/white/full_*.c))
TEST_BIN      += $(WHITE_TESTS:%=$(B)/tests/white/%)
TEST_FULL_BIN += $(WHITE_FULL:%=$(B)/tests/white/%)

# The code under test keeps the core's optimisation and arithmetic.
WHITE_FLAGS = $(TOOL_FLAGS) $(OPT) $(ARCH) -fno-math-errno -fno-trapping-math -Isrc -Itests

$(B)/tests/white/%: tests/white/%.c tests/check.h $(wildcard tests/white/*.h) $(HEADERS) $(LIB)
	@mkdir -p $(@D)
	$(CC) $(WHITE_FLAGS) $< $(LIB) -lcmocka -lpthread $(WHITE_LIBS_$*) -lm -o $@
