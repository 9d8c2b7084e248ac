// Tables: layers of numbers, and texts that say what they are.
#include "skv_exr_texture.h"

#include "raster.h"

static void describe(skv_exr_header *header, const void *what) {
    const skv_exr_texture *const texture = what;
    if (texture->colour)
        skv_exr_add_chromaticities(header);
    skv_exr_add_string(header, "software", texture->software);
    skv_exr_add_string(header, "comments", texture->comments);
    if (texture->text_name)
        skv_exr_add_string(header, texture->text_name, texture->text);
    skv_exr_add_extras(header, texture->number, texture->numbers);
}

static const char *bad_field(const skv_exr_texture *t) {
    if (!t || !t->pixels)
        return "no pixels";
    if (t->width < 1 || t->width > SKV_EXR_TEXTURE_SIDE_MAX || t->height < 1 || t->height > SKV_EXR_TEXTURE_SIDE_MAX)
        return "width or height out of range";
    if (t->layers < 1 || t->layers > SKV_EXR_TEXTURE_LAYERS_MAX || t->channels < 1 || t->channels > 4)
        return "layers or channels out of range";
    for (int l = 1; l < t->layers; l++)
        if (!t->layer_name[l])
            return "a layer without a name";
    if ((t->text_name && !t->text) || (t->numbers > 0 && !t->number))
        return "an attribute without a value";
    return NULL;
}

int skv_exr_texture_write(int fd, const skv_exr_texture *texture, char *message, size_t message_size) {
    const char *const bad = bad_field(texture);
    if (bad)
        return skv_exr_refuse(bad, message, message_size);
    const skv_exr_raster raster = {.width = texture->width,
                                   .height = texture->height,
                                   .layers = texture->layers,
                                   .channels = texture->channels,
                                   .layer_name = texture->layer_name,
                                   .values = texture->pixels,
                                   .half = texture->half,
                                   .treatment = EXR_PERCEPTUALLY_LINEAR};
    return skv_exr_raster_write(fd, &raster, describe, texture, message, message_size);
}
