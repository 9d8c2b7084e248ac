# The geoid grid: EGM96 at 15' out of Debian's proj-data, into the form that GeographicLib reads.
DEPS_RUN  += proj-data
PROJ_DATA ?= /usr/share/proj
GEOID_GTX := $(wildcard $(PROJ_DATA)/egm96_15.gtx)
GEOID_PGM := $(B)/geoid/egm96-15.pgm

$(B)/tools/geoid/gtx2pgm: tools/geoid/gtx2pgm.c Makefile
	@mkdir -p $(@D)
	$(CC) $(TOOL_FLAGS) $< -lm -o $@

ifneq ($(GEOID_GTX),)
ifeq ($(call have,geographiclib),yes)
PROGRAMS += $(GEOID_PGM)
endif
$(GEOID_PGM): $(GEOID_GTX) $(B)/tools/geoid/gtx2pgm
	@mkdir -p $(@D)
	$(B)/tools/geoid/gtx2pgm $< $@
else
LEFT_OUT += geoid:proj-data
endif
