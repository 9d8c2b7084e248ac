# Skyvert: an embedded sky model for flight simulators.
# Two commands do everything on a fresh Debian 12: `make run` and `make test`. `make help` lists the rest.

B      ?= build
CC     ?= cc
CXX    ?= c++
AR     ?= ar
PKG_CONFIG ?= pkg-config
# Flags of the machine the library is for, e.g. ARCH=-mavx2.
ARCH   ?=
OPT    ?= -O3
SAN    ?=
BASH   ?= bash

WARN   := -Wall -Wextra -Wpedantic -Werror -Wconversion -Wdouble-promotion -Wfloat-conversion -Wshadow \
          -Wstrict-prototypes -Wundef
CXXWARN := $(filter-out -Wstrict-prototypes -Wdouble-promotion,$(WARN))
# Contraction off: the same bits everywhere. No errno, no traps: the loops vectorise.
FP     := -ffp-contract=off -fno-math-errno -fno-trapping-math
CORE_FLAGS = -std=c99 $(OPT) $(ARCH) $(FP) $(WARN) -Iinclude -Isrc $(SAN)
# Programs: POSIX, double where they like.
TOOL_FLAGS = -std=c99 -D_POSIX_C_SOURCE=200809L -D_FILE_OFFSET_BITS=64 -O2 $(FP) $(filter-out -Wdouble-promotion,$(WARN)) -Iinclude $(SAN)
CXX_FLAGS  = -std=c++17 -O2 -ffp-contract=off $(CXXWARN) -Iinclude $(SAN)

CORE_SRC  := $(sort $(wildcard src/core/*.c))
SCENE_SRC := $(sort $(wildcard src/scene/*.c))
CORE_OBJ  := $(CORE_SRC:%.c=$(B)/%.o)
SCENE_OBJ := $(SCENE_SRC:%.c=$(B)/%.o)
LIB       := $(B)/libskyvert.a
HEADERS   := $(wildcard include/skyvert/*.h) $(wildcard src/*/*.h)

.DEFAULT_GOAL := all
.DELETE_ON_ERROR:
.SUFFIXES:

# $(call have,PC) is non-empty when pkg-config knows PC.
have = $(shell $(PKG_CONFIG) --exists $(1) 2>/dev/null && echo yes)

# Folders add themselves: a port, a tool or a group of tests has a build.mk. It may add to
#   PORT_OBJ PORT_LIBS     objects and libraries of ports that are there
#   PORT_FLAGS             -DSKV_HAVE_... for the command
#   LEFT_OUT               port:debian-package of ports that are not there
#   PROGRAMS               programs that `make` builds
#   TEST_BIN TEST_SCRIPT   what `make test` runs (exit 0 = pass, 77 = skip, else fail)
#   TEST_FULL_BIN TEST_FULL_SCRIPT   further ones of `make test-full`
#   DEPS_RUN DEPS_TEST     Debian packages of `make run`, of `make test`
PORT_OBJ    :=
PORT_LIBS   :=
PORT_FLAGS  :=
LEFT_OUT    :=
PROGRAMS    :=
TEST_BIN    :=
TEST_SCRIPT :=
TEST_FULL_BIN :=
TEST_FULL_SCRIPT :=
DEPS_RUN    := gcc g++ make pkg-config
DEPS_TEST   := clang libclang-rt-14-dev libcmocka-dev valgrind clang-format clang-tidy cppcheck
include $(sort $(wildcard port/*/build.mk)) $(sort $(wildcard tools/*/build.mk)) $(sort $(wildcard tests/*/build.mk))

.PHONY: all core help deps-run deps-test run test test-full bench lint format fit-check clean left-out

all: $(LIB) $(PROGRAMS) left-out ## build the core, the ports whose packages are there, and the command build/skyvert

core: $(LIB) ## build the library alone: needs a C99 compiler and make

help: ## list the targets
	@awk -F ':.*## ' '/^[a-z-]+:.*## /{printf "  make %-12s %s\n", $$1, $$2}' $(MAKEFILE_LIST)

left-out:
	@for x in $(LEFT_OUT); do echo "left out: $${x%%:*} (install the package $${x#*:} to add it)"; done

$(LIB): $(CORE_OBJ) $(SCENE_OBJ)
	@mkdir -p $(@D)
	@rm -f $@
	$(AR) rcs $@ $^

$(B)/src/%.o: src/%.c $(HEADERS) Makefile
	@mkdir -p $(@D)
	$(CC) $(CORE_FLAGS) $(CORE_EXTRA) -c $< -o $@

# Packages: listed first, then installed as root or with sudo. DEPS=no turns it off.
deps-run:
	@DEPS=$(DEPS) $(BASH) tools/deps.sh run $(sort $(DEPS_RUN))
deps-test:
	@DEPS=$(DEPS) $(BASH) tools/deps.sh test $(sort $(DEPS_RUN) $(DEPS_TEST))

# The fragments above ask pkg-config when make starts, so what was installed meanwhile needs a new make.
run: deps-run ## the main job: the sample flight's skies into out/
	@$(MAKE) --no-print-directory DEPS=no all
	@$(BASH) tools/run.sh $(B)

test: deps-test ## all tests (minutes)
	@$(MAKE) --no-print-directory DEPS=no all test-build
	@$(MAKE) --no-print-directory DEPS=no test-run

test-full: deps-test ## all tests and the long ones
	@$(MAKE) --no-print-directory DEPS=no all test-build test-full-build
	@$(MAKE) --no-print-directory DEPS=no FULL=yes test-run

.PHONY: test-run
test-run:
	@B=$(B) CC="$(CC)" MAKE=make LIMIT=$(if $(FULL),3600,600) $(BASH) tests/run.sh $(TEST_BIN) $(TEST_SCRIPT) \
		$(if $(FULL),$(TEST_FULL_BIN) $(TEST_FULL_SCRIPT))

.PHONY: test-build test-full-build
test-build: $(TEST_BIN)
test-full-build: $(TEST_FULL_BIN)

format: ## format all C sources in place
	clang-format -i $$(git ls-files '*.c' '*.h' '*.cc')

clean: ## remove build/ and out/
	rm -rf $(B) out
