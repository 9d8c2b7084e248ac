# The double-precision reference: build/skyvert-reference, and build/libreference.a for the tests and make bench.
REFERENCE_LIB := $(B)/libreference.a
REFERENCE_OBJ := $(addprefix $(B)/tools/reference/,single.o depth.o convert.o)
DEPS_RUN += libinih-dev

$(B)/tools/reference/%.o: tools/reference/%.c $(wildcard tools/reference/*.h) $(wildcard include/skyvert/*.h)
	@mkdir -p $(@D)
	$(CC) $(TOOL_FLAGS) $(CORE_EXTRA) -c $< -o $@

$(REFERENCE_LIB): $(REFERENCE_OBJ)
	@mkdir -p $(@D)
	@rm -f $@
	$(AR) rcs $@ $^

ifeq ($(call have,inih),yes)
PROGRAMS += $(B)/skyvert-reference
endif
$(B)/skyvert-reference: $(addprefix $(B)/tools/reference/,main.o read_ini.o single.o depth.o)
	$(CC) $(TOOL_FLAGS) $^ $$($(PKG_CONFIG) --libs inih) -lm -o $@
