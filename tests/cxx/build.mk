# The public headers as C99 and as C++11, each alone.
DEPS_TEST += clang
TEST_SCRIPT += tests/cxx/headers.sh
test-build: $(LIB)
