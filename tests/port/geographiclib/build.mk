# Tests of the port of GeographicLib, of the geoid grid and of the sample flight. The port is built once more with
# sanitizers, so that the rubbish these tests feed it cannot go unseen.
DEPS_TEST += libcmocka-dev liberfa-dev
GEO_TEST  := tests/port/geographiclib
ifeq ($(call have,geographiclib),yes)
GEO_SAN     := -g -fsanitize=address,undefined -fno-sanitize-recover=all
GEO_SAN_OBJ := $(patsubst port/geographiclib/%.cc,$(B)/$(GEO_TEST)/san/%.o,$(wildcard port/geographiclib/*.cc))
GEO_GRID    := $(if $(GEOID_GTX),geoid)
GEO_TESTS   := parse frames flight $(GEO_GRID)
TEST_BIN    += $(GEO_TESTS:%=$(B)/$(GEO_TEST)/test_%)
TEST_SCRIPT += $(GEO_TEST)/flight.sh $(GEO_TEST)/gtx2pgm.sh $(if $(GEO_GRID),,$(GEO_TEST)/absent.sh)
.SECONDARY: $(GEO_SAN_OBJ) $(GEO_TESTS:%=$(B)/$(GEO_TEST)/test_%.o)
# Built before the tests run.
$(B)/$(GEO_TEST)/test_flight: $(B)/tools/flight/flight $(B)/tools/geoid/gtx2pgm
$(B)/$(GEO_TEST)/test_geoid: $(GEOID_PGM) $(B)/$(GEO_TEST)/bilinear.o
$(B)/$(GEO_TEST)/test_geoid: GEO_TEST_LIBS := $(B)/$(GEO_TEST)/bilinear.o
$(B)/$(GEO_TEST)/test_flight: GEO_TEST_LIBS := -lerfa

$(B)/$(GEO_TEST)/san/%.o: port/geographiclib/%.cc $(wildcard port/geographiclib/*.h*) $(HEADERS) Makefile
	@mkdir -p $(@D)
	$(CXX) $(CXX_FLAGS) $(GEO_SAN) -c $< -o $@

$(B)/$(GEO_TEST)/bilinear.o: $(GEO_TEST)/bilinear.cc Makefile
	@mkdir -p $(@D)
	$(CXX) $(CXX_FLAGS) $(GEO_SAN) -c $< -o $@

# The tests themselves are C by $(CC); the sanitizers belong to the compiler that made and links the port.
$(B)/$(GEO_TEST)/test_%.o: $(GEO_TEST)/test_%.c $(GEO_TEST)/wgs84.h tests/check.h port/geographiclib/skv_geo.h Makefile
	@mkdir -p $(@D)
	$(CC) $(TOOL_FLAGS) -I. -Itests -DTEST_GTX='"$(GEOID_GTX)"' -DTEST_GEOID_DIR='"$(B)/geoid"' \
	  -DTEST_FLIGHT='"tools/flight/dusk-lszh-loww.csv"' -c $< -o $@

$(B)/$(GEO_TEST)/test_%: $(B)/$(GEO_TEST)/test_%.o $(GEO_SAN_OBJ)
	$(CXX) $(GEO_SAN) $(SAN) $< $(GEO_SAN_OBJ) $(GEO_TEST_LIBS) -lcmocka $(GEO_LIBS) -o $@
else
TEST_SCRIPT += $(GEO_TEST)/absent.sh
endif
