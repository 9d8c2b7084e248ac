# Tables for engines: samplers in C (skv_bake.h, skv_bake_file.h) and GLSL (skv_bake.glsl) need nothing; tables as EXR
# need OpenEXRCore, whose flags port/openexr/build.mk finds.
DEPS_RUN += libopenexr-dev
ifeq ($(call have,OpenEXR),yes)
SKV_EXR_TEXTURE_OBJ := $(B)/port/bake/exr_texture.o
PORT_OBJ   += $(SKV_EXR_TEXTURE_OBJ)
PORT_FLAGS += -DSKV_HAVE_EXR_TEXTURE
$(SKV_EXR_TEXTURE_OBJ): port/bake/exr_texture.c port/bake/skv_exr_texture.h Makefile
	@mkdir -p $(@D)
	$(CC) $(TOOL_FLAGS) $(SKV_EXR_CPP) -c $< -o $@
endif
