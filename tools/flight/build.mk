# The sample flight. The file is committed; `make flight` writes it anew, tests/port/geographiclib compares.
ifeq ($(call have,geographiclib),yes)
FLIGHT_CSV := tools/flight/dusk-lszh-loww.csv

$(B)/tools/flight/flight: tools/flight/flight.c $(GEO_OBJ) port/geographiclib/skv_geo.h Makefile
	@mkdir -p $(@D)
	$(CC) $(TOOL_FLAGS) -I. $< $(GEO_OBJ) $(GEO_LIBS) -o $@

.PHONY: flight
flight: $(B)/tools/flight/flight ## write the sample flight tools/flight/*.csv anew
	$< > $(FLIGHT_CSV).tmp && mv $(FLIGHT_CSV).tmp $(FLIGHT_CSV) || { rm -f $(FLIGHT_CSV).tmp; exit 1; }
endif
