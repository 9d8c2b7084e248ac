# Pictures and tables: the two ports read back by other programs, projections, flights, and what render, track and dome refuse.
DEPS_TEST += libcmocka-dev openexr openimageio-tools pngcheck
ifeq ($(call have,OpenEXR)$(call have,libpng),yesyes)
TEST_BIN    += $(B)/tests/picture/test_ports $(B)/tests/picture/test_exr_texture
TEST_SCRIPT += $(filter-out %/lib.sh,$(sort $(wildcard tests/picture/*.sh)))
endif
TEST_BIN    += $(B)/tests/picture/test_projection

$(B)/tests/picture/test_projection: tests/picture/test_projection.c tests/check.h tools/skyvert/projection.c tools/skyvert/projection.h Makefile
	@mkdir -p $(@D)
	$(CC) $(TOOL_FLAGS) -I. -Itests $< tools/skyvert/projection.c -lcmocka -lm -o $@

$(B)/tests/picture/test_ports: tests/picture/test_ports.c tests/picture/ports.h tests/check.h $(SKV_EXR_OBJ) $(SKV_PNG_OBJ) Makefile
	@mkdir -p $(@D)
	$(CC) $(TOOL_FLAGS) -I. -Itests $< $(SKV_EXR_OBJ) $(SKV_PNG_OBJ) -lcmocka $(SKV_EXR_LIBS) $(SKV_PNG_LIBS) -lm -o $@

$(B)/tests/picture/test_exr_texture: tests/picture/test_exr_texture.c tests/picture/ports.h tests/api/random.h tests/check.h $(SKV_EXR_OBJ) Makefile
	@mkdir -p $(@D)
	$(CC) $(TOOL_FLAGS) -I. -Itests $< $(SKV_EXR_OBJ) -lcmocka $(SKV_EXR_LIBS) -lm -o $@
