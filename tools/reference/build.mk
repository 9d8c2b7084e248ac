# The double-precision reference: build/skyvert-reference, and build/libreference.a for the tests and make bench.
REFERENCE_LIB := $(B)/libreference.a
REFERENCE_OBJ := $(addprefix $(B)/tools/reference/,single.o depth.o convert.o air.o guide.o paths.o orders.o state.o successive.o)
DEPS_RUN += libinih-dev

$(B)/tools/reference/%.o: tools/reference/%.c $(wildcard tools/reference/*.h) $(wildcard include/skyvert/*.h)
	@mkdir -p $(@D)
	$(CC) $(TOOL_FLAGS) -O3 -pthread $(CORE_EXTRA) -c $< -o $@

$(REFERENCE_LIB): $(REFERENCE_OBJ)
	@mkdir -p $(@D)
	@rm -f $@
	$(AR) rcs $@ $^

ifeq ($(call have,inih),yes)
PROGRAMS += $(B)/skyvert-reference
endif
$(B)/skyvert-reference: $(addprefix $(B)/tools/reference/,main.o queries.o read_ini.o) $(REFERENCE_LIB)
	$(CC) $(TOOL_FLAGS) -pthread $^ $$($(PKG_CONFIG) --libs inih) -lm -o $@

.PHONY: reference-data
reference-data: $(B)/skyvert-reference ## regenerate the truth for all light in tools/reference/data (minutes)
	B=$(B) $(BASH) tools/reference/data.sh
