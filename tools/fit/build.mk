# Tables and constants that are made, never typed in. A script of FIT_CHECKS is run from the root with python3: without
# arguments it writes its files, with --check it compares them (exit status 1 where they differ). Any build.mk may add one.
FIT_CHECKS += tools/fit/elementary.py tools/fit/gauss_legendre.py
FIT_CHECKS += tools/fit/presets.py tools/fit/colour.py tools/fit/linan23.py
DEPS_TEST  += python3 python3-mpmath python3-numpy

fit-check: ## make every generated table again and compare
	@$(BASH) tools/fit/check.sh $(FIT_CHECKS)

.PHONY: fit
fit: ## make every generated table again, in place
	@set -e; for x in $(FIT_CHECKS); do echo $$x; python3 $$x; done
