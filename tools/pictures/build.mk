# The README's pictures: `make pictures` writes tools/pictures/*.png anew.
DEPS_RUN += libpng-dev
.PHONY: pictures
pictures: $(B)/skyvert ## write the README's pictures tools/pictures/*.png anew
	@$(BASH) tools/pictures/make.sh $(B)/skyvert tools/pictures 400
