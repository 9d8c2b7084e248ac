# PNG pictures, through libpng.
DEPS_RUN += libpng-dev
ifeq ($(call have,libpng),yes)
SKV_PNG_OBJ  := $(B)/port/png/png.o
SKV_PNG_LIBS := $(shell $(PKG_CONFIG) --libs libpng)
PORT_OBJ   += $(SKV_PNG_OBJ)
PORT_LIBS  += $(SKV_PNG_LIBS)
PORT_FLAGS += -DSKV_HAVE_PNG
$(SKV_PNG_OBJ): port/png/png.c port/png/skv_png.h Makefile
	@mkdir -p $(@D)
	$(CC) $(TOOL_FLAGS) $(patsubst -I%,-isystem %,$(shell $(PKG_CONFIG) --cflags-only-I libpng)) -c $< -o $@
else
LEFT_OUT += PNG-pictures:libpng-dev
endif
