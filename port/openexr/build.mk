# OpenEXR files (pictures, and tables for engines), through OpenEXRCore alone.
DEPS_RUN += libopenexr-dev
ifeq ($(call have,OpenEXR),yes)
SKV_EXR_OBJ   := $(patsubst %.c,$(B)/%.o,$(sort $(wildcard port/openexr/*.c)))
SKV_EXR_CPP   := $(patsubst -I%,-isystem %,$(shell $(PKG_CONFIG) --cflags-only-I OpenEXR))
SKV_EXR_LIBS  := $(filter -L% -lOpenEXRCore%,$(shell $(PKG_CONFIG) --libs OpenEXR))
PORT_OBJ   += $(SKV_EXR_OBJ)
PORT_LIBS  += $(SKV_EXR_LIBS)
PORT_FLAGS += -DSKV_HAVE_EXR
$(SKV_EXR_OBJ): $(B)/port/openexr/%.o: port/openexr/%.c $(wildcard port/openexr/*.h) Makefile
	@mkdir -p $(@D)
	$(CC) $(TOOL_FLAGS) $(SKV_EXR_CPP) -c $< -o $@
else
LEFT_OUT += OpenEXR-pictures:libopenexr-dev
endif
