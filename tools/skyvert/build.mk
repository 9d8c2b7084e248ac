# The command `skyvert`.
DEPS_RUN += libinih-dev

ifneq ($(call have,inih),)
SKYVERT_INIH_FLAGS := -DSKV_HAVE_INIH=1 $(shell $(PKG_CONFIG) --cflags inih)
SKYVERT_INIH_LIBS  := $(shell $(PKG_CONFIG) --libs inih)
else
SKYVERT_INIH_FLAGS := -DSKV_HAVE_INIH=0
SKYVERT_INIH_LIBS  :=
LEFT_OUT += eval:libinih-dev
endif

SKYVERT_SRC := $(sort $(wildcard tools/skyvert/*.c))
SKYVERT_OBJ := $(SKYVERT_SRC:%.c=$(B)/%.o)
PROGRAMS    += $(B)/skyvert
# Ports may be C++: link with the C++ compiler where there is one.
SKYVERT_LD  := $(if $(shell command -v $(firstword $(CXX)) 2>/dev/null),$(CXX),$(CC))

# A package that was installed or removed changes the flags: compile again then.
$(B)/tools/skyvert/flags: FORCE
	@mkdir -p $(@D)
	@echo '$(TOOL_FLAGS) $(PORT_FLAGS) $(SKYVERT_INIH_FLAGS)' | cmp -s - $@ || echo '$(TOOL_FLAGS) $(PORT_FLAGS) $(SKYVERT_INIH_FLAGS)' > $@

.PHONY: FORCE
FORCE:

$(SKYVERT_OBJ): $(B)/tools/skyvert/%.o: tools/skyvert/%.c $(wildcard tools/skyvert/*.h tools/baselines/*.h port/*/*.h) $(HEADERS) $(B)/tools/skyvert/flags Makefile tools/skyvert/build.mk
	@mkdir -p $(@D)
	$(CC) $(TOOL_FLAGS) -I. $(PORT_FLAGS) $(SKYVERT_INIH_FLAGS) -c $< -o $@

# Libraries of other tools: the trade reads ini files, so it is there when eval is.
SKYVERT_TOOLS := $(if $(SKYVERT_INIH_LIBS),$(B)/libtrade.a) $(B)/libreference.a $(B)/libbaselines.a

$(B)/skyvert: $(SKYVERT_OBJ) $(PORT_OBJ) $(SKYVERT_TOOLS) $(LIB)
	$(SKYVERT_LD) $(SAN) -pthread $(SKYVERT_OBJ) $(PORT_OBJ) $(SKYVERT_TOOLS) $(LIB) $(PORT_LIBS) $(SKYVERT_INIH_LIBS) -lm -o $@
