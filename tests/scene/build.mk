# Time, sun and moon against independent ephemerides: ERFA (double), and PyEphem for the moon.
TEST_BIN    += $(B)/tests/scene/test_ephemeris
TEST_SCRIPT += tests/scene/moon_ephem.sh
DEPS_TEST   += liberfa-dev libcmocka-dev python3-ephem
FIT_CHECKS  += tools/fit/ephemeris.py

$(B)/tests/scene/%.o: tests/scene/%.c $(wildcard tests/scene/*.h) tests/api/sun_vectors.h tests/check.h $(HEADERS)
	@mkdir -p $(@D)
	$(CC) $(TOOL_FLAGS) -frounding-math -Itests -c $< -o $@

$(B)/tests/scene/test_ephemeris: $(addprefix $(B)/tests/scene/,test_ephemeris.o erfa_oracle.o) $(LIB)
	$(CC) $(TOOL_FLAGS) $^ -lcmocka -lerfa -lm -o $@

$(B)/tests/scene/moon_rows: $(B)/tests/scene/moon_rows.o $(LIB)
	$(CC) $(TOOL_FLAGS) $^ -lm -o $@

test-build: $(B)/tests/scene/moon_rows
