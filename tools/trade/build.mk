# The trade: error against the reference and cost of every configuration and baseline. build/libtrade.a is linked into
# the command (skyvert trade) and the studies.
DEPS_RUN  += libinih-dev
TRADE_LIB := $(B)/libtrade.a
TRADE_OBJ := $(patsubst %.c,$(B)/%.o,$(sort $(wildcard tools/trade/*.c)))

$(B)/tools/trade/%.o: tools/trade/%.c $(wildcard tools/trade/*.h tools/reference/*.h tools/baselines/baseline.h) $(HEADERS) Makefile tools/trade/build.mk
	@mkdir -p $(@D)
	$(CC) $(TOOL_FLAGS) $(CORE_EXTRA) -I. -Itools/reference -c $< -o $@

$(B)/tools/trade/machine.o: CORE_EXTRA += -DTRADE_FLAGS='"$(strip $(OPT) $(ARCH) $(FP))"'

ifneq ($(call have,inih),)
$(TRADE_LIB): $(TRADE_OBJ) $(B)/tools/reference/read_ini.o
	@mkdir -p $(@D)
	@rm -f $@
	$(AR) rcs $@ $^
endif

.PHONY: trade-truth
trade-truth: $(B)/skyvert-reference ## regenerate the truth of the trade in tools/trade/truth (minutes)
	@B=$(B) $(BASH) tools/trade/truth.sh

# The core once more per degree of 2^x, its symbols renamed: for `make trade` alone (TRADE_EXP=yes), it takes a minute.
ifeq ($(TRADE_EXP),yes)
TRADE_DEGREES := $(if $(shell grep -ls SKV_EXP2_DEGREE src/core/exp_log.h),3 5)
endif
ifneq ($(TRADE_DEGREES),)
$(B)/tools/trade/core.o: CORE_EXTRA += -DTRADE_HAVE_EXP_DEGREES=1
$(TRADE_LIB): $(TRADE_DEGREES:%=$(B)/tools/trade/exp%.o)

define TRADE_DEGREE
$(B)/tools/trade/exp$(1)/%.o: src/core/%.c $$(HEADERS) Makefile
	@mkdir -p $$(@D)
	$$(CC) $$(CORE_FLAGS) -DSKV_EXP2_DEGREE=$(1) -c $$< -o $$@
$(B)/tools/trade/exp$(1).o: $$(CORE_SRC:src/core/%.c=$(B)/tools/trade/exp$(1)/%.o)
	$$(LD) -r $$^ -o $$@.all
	nm -g --defined-only $$@.all | awk '{ print $$$$3, $$$$3 "_exp$(1)" }' > $$@.names
	objcopy --redefine-syms=$$@.names $$@.all $$@
endef
$(foreach degree,$(TRADE_DEGREES),$(eval $(call TRADE_DEGREE,$(degree))))
endif

# With the vectors that this processor has, as on a desktop.
TRADE_ARCH = $(or $(ARCH),$(shell grep -qsw avx2 /proc/cpuinfo && echo -mavx2))
.PHONY: trade
trade: ## error, time and size of every configuration and of other models, into out/trade (minutes)
	@DEPS=$(DEPS) $(BASH) tools/deps.sh trade $(sort $(DEPS_RUN) valgrind gnuplot-nox binutils)
	@$(MAKE) --no-print-directory DEPS=no B=$(B)/trade ARCH="$(TRADE_ARCH)" TRADE_EXP=yes $(B)/trade/skyvert
	@$(B)/trade/skyvert trade $(TRADE_OPTIONS)

.PHONY: trade-picture
trade-picture: trade ## the README's picture of it, tools/pictures/trade.png
	cp out/trade/pareto.png tools/pictures/trade.png
