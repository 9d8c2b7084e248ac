# The trade: its metric and its truth, the command end to end, the studies.
DEPS_TEST   += libinih-dev valgrind gnuplot-nox python3
TRADE_TESTS := $(patsubst tests/trade/test_%.c,$(B)/tests/trade/test_%,$(wildcard tests/trade/test_*.c))
ifneq ($(call have,inih),)
TEST_BIN    += $(TRADE_TESTS)
TEST_SCRIPT += $(sort $(wildcard tests/trade/*.sh))
endif

$(TRADE_TESTS): $(B)/tests/trade/test_%: tests/trade/test_%.c $(wildcard tests/trade/*.h tools/trade/*.h) tests/check.h $(B)/libtrade.a $(B)/libreference.a $(B)/libbaselines.a $(LIB)
	@mkdir -p $(@D)
	$(CC) $(TOOL_FLAGS) -I. -Itests -Itools/reference -pthread $< $(filter %.a,$^) $$($(PKG_CONFIG) --libs inih) -lcmocka -lm -o $@
