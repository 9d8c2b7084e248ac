// Pictures: the standard attributes that say what their colours mean, and when and where the sky was.
#include "raster.h"

static void add_colour(skv_exr_header *header, const skv_exr_image *image) {
    skv_exr_add_chromaticities(header);
    skv_exr_add_float(header, "whiteLuminance", image->white_luminance);
    if (header->result == EXR_ERR_SUCCESS && image->latlong)
        header->result = exr_attr_set_envmap(header->context, header->part, "envmap", EXR_ENVMAP_LATLONG);
}

static void add_capture(skv_exr_header *header, const skv_exr_image *image) {
    if (image->has_position) {
        skv_exr_add_float(header, "latitude", image->latitude_deg);
        skv_exr_add_float(header, "longitude", image->longitude_deg);
        skv_exr_add_float(header, "altitude", image->altitude_m);
    }
    if (image->cap_date) {
        skv_exr_add_string(header, "capDate", image->cap_date);
        skv_exr_add_float(header, "utcOffset", image->utc_offset_s);
    }
}

static void describe(skv_exr_header *header, const void *what) {
    const skv_exr_image *const image = what;
    header->result = exr_set_screen_window_width(header->context, header->part, image->screen_window_width);
    add_colour(header, image);
    add_capture(header, image);
    skv_exr_add_string(header, "owner", image->owner);
    skv_exr_add_string(header, "software", image->software);
    skv_exr_add_string(header, "comments", image->comments);
    skv_exr_add_extras(header, image->extra, image->extras);
}

static const char *bad_field(const skv_exr_image *image) {
    if (!image || !image->pixels)
        return "no pixels";
    if (image->width < 1 || image->width > SKV_EXR_SIDE_MAX || image->height < 1 || image->height > SKV_EXR_SIDE_MAX)
        return "width or height out of range";
    if (image->channels != 3 && image->channels != 4)
        return "channels: 3 or 4";
    if (!(image->white_luminance > 0.0f) || !(image->screen_window_width > 0.0f))
        return "white_luminance and screen_window_width must be above 0";
    if (image->extras > 0 && !image->extra)
        return "no extra attributes at their pointer";
    return NULL;
}

int skv_exr_write(int fd, const skv_exr_image *image, char *message, size_t message_size) {
    const char *const bad = bad_field(image);
    if (bad)
        return skv_exr_refuse(bad, message, message_size);
    const skv_exr_raster raster = {.width = image->width,
                                   .height = image->height,
                                   .layers = 1,
                                   .channels = image->channels,
                                   .values = image->pixels,
                                   .half = image->half,
                                   .treatment = EXR_PERCEPTUALLY_LOGARITHMIC};
    return skv_exr_raster_write(fd, &raster, describe, image, message, message_size);
}
