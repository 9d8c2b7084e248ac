# Checks of the sources; `make test` runs them too.
DEPS_TEST += clang-format clang-tidy cppcheck
TEST_SCRIPT += tools/lint/lint.sh

lint: ## format, include directions, poisoned words, machine paths, cppcheck, clang-tidy
	@B=$(B) $(BASH) tools/lint/lint.sh
