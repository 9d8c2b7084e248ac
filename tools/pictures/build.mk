# The README's pictures: `make pictures` writes tools/pictures/*.png anew, `make pictures-light` those about all light.
DEPS_RUN += libpng-dev
PICTURE_OBJ := $(B)/tools/pictures/sheet.o

$(B)/tools/pictures/%.o: tools/pictures/%.c tools/pictures/sheet.h $(wildcard tools/reference/*.h) $(HEADERS)
	@mkdir -p $(@D)
	$(CC) $(TOOL_FLAGS) -I. -Itools/reference -c $< -o $@

$(B)/picture-views: $(B)/tools/pictures/views.o $(PICTURE_OBJ) $(SKV_PNG_OBJ) $(LIB)
	$(CC) $(TOOL_FLAGS) $^ $(SKV_PNG_LIBS) -lm -o $@

$(B)/picture-fisheyes: $(B)/tools/pictures/fisheyes.o $(PICTURE_OBJ) $(B)/tools/reference/read_ini.o $(B)/libreference.a $(SKV_PNG_OBJ) $(LIB)
	$(CC) $(TOOL_FLAGS) $(filter %.o,$^) $(filter %.a,$^) $(SKV_PNG_LIBS) $$($(PKG_CONFIG) --libs inih) -lm -o $@

.PHONY: pictures pictures-light
pictures: $(B)/skyvert ## write the README's pictures tools/pictures/*.png anew
	@$(BASH) tools/pictures/make.sh $(B)/skyvert tools/pictures 400

pictures-light: $(B)/skyvert-reference $(B)/picture-views $(B)/picture-fisheyes ## write the sheets about all light, with the path tracer (minutes)
	@$(BASH) tools/pictures/light.sh $(B) tools/pictures
