# Positions, heights and frames by GeographicLib; left out where its package is not there.
DEPS_RUN += libgeographiclib-dev proj-data
ifeq ($(call have,geographiclib),yes)
GEO_OBJ  := $(patsubst %.cc,$(B)/%.o,$(wildcard port/geographiclib/*.cc))
# The programs are C: they are linked with the C++ run time by name.
GEO_LIBS := $(shell $(PKG_CONFIG) --libs geographiclib) -lstdc++ -lm
PORT_OBJ   += $(GEO_OBJ)
PORT_LIBS  += $(GEO_LIBS)
PORT_FLAGS += -DSKV_HAVE_GEOGRAPHICLIB

$(B)/port/geographiclib/%.o: port/geographiclib/%.cc port/geographiclib/skv_geo.h port/geographiclib/fence.hh $(HEADERS) Makefile
	@mkdir -p $(@D)
	$(CXX) $(CXX_FLAGS) $(shell $(PKG_CONFIG) --cflags geographiclib) -c $< -o $@
else
LEFT_OUT += geographiclib:libgeographiclib-dev
endif
