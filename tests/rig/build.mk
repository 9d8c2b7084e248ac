# The rig: programs for an arm64 board, run under QEMU with Debian's kernel, two CAN controllers on one bus and a GPIO chip that
# is driven from outside. What it can do and how a test is added: tests/rig/run.sh.
#   RIG_PACKAGES   Debian's arm64 packages on the board and to link with; not installed on this machine; NAME/SUITE of another
#                  release, whose libraries are on the board too
#   RIG_PROGRAMS   what is on the board in /bin beside them
#   RIG_FLAGS      of the programs for the board
RIG := $(B)/rig
DEPS_TEST   += qemu-system-arm gcc-aarch64-linux-gnu libc6-dev-arm64-cross cpio device-tree-compiler python3
RIG_PACKAGES += busybox-static iproute2 libbpf1 libelf1 libmnl0 libbsd0 libmd0 libcap2 zlib1g can-utils gpiod libgpiod2 libgpiod-dev \
                libinih1 libinih-dev libpng16-16 libpng-dev zlib1g-dev libgpiod3/trixie libgpiod-dev/trixie
TEST_SCRIPT += tests/rig/run.sh
TEST_FULL_SCRIPT += tests/rig/refuses.sh

RIG_CC        := aarch64-linux-gnu-gcc
RIG_SYS       := $(RIG)/sysroot
RIG_LINK      := -L$(RIG_SYS)/usr/lib/aarch64-linux-gnu -Wl,-rpath-link,$(RIG_SYS)/usr/lib/aarch64-linux-gnu
RIG_SANITIZE  := -g -O1 -fno-omit-frame-pointer -fsanitize=address,undefined -fno-sanitize-recover=all
RIG_INCLUDE   := -I. -Itests -isystem $(RIG_SYS)/usr/include -MMD -MP
RIG_CORE_FLAGS = $(filter-out -O%,$(CORE_FLAGS)) -O2 $(RIG_INCLUDE)
RIG_TOOL_FLAGS = $(TOOL_FLAGS) $(RIG_INCLUDE) $(RIG_FLAGS)

$(RIG)/names: tests/rig/packages.sh tests/rig/build.mk
	@mkdir -p $(@D)
	@$(BASH) tests/rig/packages.sh $(RIG) $(sort $(RIG_PACKAGES))
	@touch $@

$(RIG)/plain/src/%.o: src/%.c
	@mkdir -p $(@D)
	$(RIG_CC) $(RIG_CORE_FLAGS) -c $< -o $@
$(RIG)/san/src/%.o: src/%.c
	@mkdir -p $(@D)
	$(RIG_CC) $(RIG_CORE_FLAGS) $(RIG_SANITIZE) -c $< -o $@
$(RIG)/plain/%.o: %.c | $(RIG)/names
	@mkdir -p $(@D)
	$(RIG_CC) $(RIG_TOOL_FLAGS) -c $< -o $@
$(RIG)/san/%.o: %.c | $(RIG)/names
	@mkdir -p $(@D)
	$(RIG_CC) $(RIG_TOOL_FLAGS) $(RIG_SANITIZE) -c $< -o $@
define RIG_LIBRARY
$$(RIG)/$(1)/libskyvert.a: $$(CORE_SRC:%.c=$$(RIG)/$(1)/%.o) $$(SCENE_SRC:%.c=$$(RIG)/$(1)/%.o)
	@rm -f $$@
	aarch64-linux-gnu-ar rcs $$@ $$^
endef
$(foreach v,plain san,$(eval $(call RIG_LIBRARY,$(v))))
-include $(shell find $(RIG)/plain $(RIG)/san -name '*.d' 2>/dev/null)

# $(eval $(call RIG_PROGRAM,NAME,SOURCES,LIBS)): /bin/NAME; $(eval $(call RIG_SANITIZED,...)): /bin/NAME-san.
# -lskyvert in LIBS is the core.
RIG_PROGRAM   = $(call RIG_RULE,$(1),$(2),$(3),plain,)
RIG_SANITIZED = $(call RIG_RULE,$(1)-san,$(2),$(3),san,$$(RIG_SANITIZE))
define RIG_RULE
RIG_PROGRAMS += $$(RIG)/guest/bin/$(1)
$$(RIG)/guest/bin/$(1): $$(patsubst %.c,$$(RIG)/$(4)/%.o,$(2)) $(if $(findstring -lskyvert,$(3)),$$(RIG)/$(4)/libskyvert.a)
	@mkdir -p $$(@D)
	$$(RIG_CC) $(5) $$(filter %.o,$$^) -L$$(RIG)/$(4) $$(RIG_LINK) $(3) -lm -o $$@
endef

include tests/rig/programs.mk

.PHONY: rig rig-long rig-build
rig-build: $(RIG)/names $(RIG_PROGRAMS)
	@mkdir -p $(RIG)/guest/bin
test-build: rig-build
rig: deps-test ## the programs on an arm64 board with CAN and GPIO, under QEMU (RIG_TESTS=NAME for one)
	@$(MAKE) --no-print-directory DEPS=no rig-build
	@B=$(B) $(BASH) tests/rig/run.sh $(RIG_TESTS)
rig-long: deps-test ## the long tests of the board (guest/long_*)
	@$(MAKE) --no-print-directory DEPS=no rig-build
	@B=$(B) RIG_NAME=long RIG_SECONDS=1800 $(BASH) tests/rig/run.sh $(wildcard tests/rig/guest/long_*.sh)
