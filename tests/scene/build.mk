# Time, sun and moon against independent ephemerides: ERFA (double), and PyEphem for the moon. What is added to the sky
# (discs, moonlight, stars, night, water) against published figures and integrals in double; these five need cmocka alone.
SCENE_TESTS := disc moonlight stars night water
TEST_BIN    += $(B)/tests/scene/test_ephemeris $(SCENE_TESTS:%=$(B)/tests/scene/test_%)
TEST_SCRIPT += tests/scene/moon_ephem.sh
DEPS_TEST   += liberfa-dev libcmocka-dev python3-ephem
FIT_CHECKS  += tools/fit/ephemeris.py

$(B)/tests/scene/%.o: tests/scene/%.c $(wildcard tests/scene/*.h) tests/api/random.h tests/api/sun_vectors.h tests/check.h $(HEADERS)
	@mkdir -p $(@D)
	$(CC) $(TOOL_FLAGS) -frounding-math -Itests -c $< -o $@

$(B)/tests/scene/test_ephemeris: $(addprefix $(B)/tests/scene/,test_ephemeris.o erfa_oracle.o) $(LIB)
	$(CC) $(TOOL_FLAGS) $^ -lcmocka -lerfa -lm -o $@

$(SCENE_TESTS:%=$(B)/tests/scene/test_%): $(B)/tests/scene/test_%: $(B)/tests/scene/test_%.o $(LIB)
	$(CC) $(TOOL_FLAGS) $^ -lcmocka -lm -o $@

$(B)/tests/scene/moon_rows: $(B)/tests/scene/moon_rows.o $(LIB)
	$(CC) $(TOOL_FLAGS) $^ -lm -o $@

test-build: $(B)/tests/scene/moon_rows
