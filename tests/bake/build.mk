# Tables of `skyvert bake`: samplers against direct evaluation, in C and in a real OpenGL ES; model and table as C.
DEPS_TEST += libegl-dev libgles-dev libegl-mesa0 libgl1-mesa-dri openexr openimageio-tools clang
TEST_SCRIPT += $(filter-out %/lib.sh,$(sort $(wildcard tests/bake/*.sh)))
BAKE_TEST := $(B)/tests/bake
test-build: $(BAKE_TEST)/compare $(BAKE_TEST)/texels $(BAKE_TEST)/baked.h

$(BAKE_TEST)/%: tests/bake/%.c tests/bake/sky.h $(wildcard port/bake/*.h) $(HEADERS) $(LIB)
	@mkdir -p $(@D)
	$(CC) $(TOOL_FLAGS) -I. $< $(LIB) $(BAKE_GL_LIBS) -lm -o $@

ifeq ($(call have,egl)$(call have,glesv2),yesyes)
test-build: $(BAKE_TEST)/gl
$(BAKE_TEST)/gl: BAKE_GL_LIBS := $(shell $(PKG_CONFIG) --libs egl glesv2)
endif

$(BAKE_TEST)/baked.h: $(B)/skyvert
	@mkdir -p $(@D)
	$(B)/skyvert bake --what model --preset earth-hazy --name baked --output $@

# On the microcontroller, by the rules of port/cortexm.
ifneq ($(CM_HAVE),)
test-build: $(CM)/m4f/bake/model.elf
$(CM)/m4f/tests/bake/model.o: $(BAKE_TEST)/baked.h
$(CM)/m4f/tests/bake/model.o: CM_TEST_FLAGS += -I$(BAKE_TEST)
endif
