/// Pictures: rendered in linear light, exposed for the eye, written as EXR or PNG.
#ifndef SKYVERT_PICTURE_H
#define SKYVERT_PICTURE_H

#include <getopt.h>
#include <stdbool.h>
#include <stdint.h>

#include "projection.h"
#include "scene.h"

typedef struct picture_options {
    const char *command; ///< for error lines
    projection map;
    bool has_size, has_fov, has_azimuth;
    int supersample; ///< rays per pixel and axis
    bool exposure_auto;
    double exposure;
    bool half;
    int png_bits;
    bool dither;
    const char *owner; ///< EXR attribute; NULL = none
} picture_options;

enum {
    OPT_PROJECTION = 1200,
    OPT_SIZE,
    OPT_FOV,
    OPT_AZIMUTH,
    OPT_ELEVATION,
    OPT_SUPERSAMPLE,
    OPT_EXPOSURE,
    OPT_HALF,
    OPT_FLOAT,
    OPT_PNG_BITS,
    OPT_NO_DITHER,
    OPT_OWNER,
};

// clang-format off
#define PICTURE_OPTIONS_LONG                                                                                           \
    {"projection", required_argument, NULL, OPT_PROJECTION}, {"size", required_argument, NULL, OPT_SIZE},              \
    {"fov-deg", required_argument, NULL, OPT_FOV}, {"azimuth-deg", required_argument, NULL, OPT_AZIMUTH},              \
    {"elevation-deg", required_argument, NULL, OPT_ELEVATION},                                                         \
    {"supersample", required_argument, NULL, OPT_SUPERSAMPLE}, {"exposure", required_argument, NULL, OPT_EXPOSURE},    \
    {"half", no_argument, NULL, OPT_HALF}, {"float", no_argument, NULL, OPT_FLOAT},                                    \
    {"png-bits", required_argument, NULL, OPT_PNG_BITS}, {"no-dither", no_argument, NULL, OPT_NO_DITHER}, \
    {"owner", required_argument, NULL, OPT_OWNER}
// clang-format on

extern const char picture_options_help[];

void picture_options_begin(picture_options *options, const char *command);
/// Takes one option. @return 0; 2 after an error line; -1 iff it is none of these.
int picture_options_take(picture_options *options, int option, const char *value);
/// Checks them together and fills in defaults. @return 0; 2 after an error line.
int picture_options_finish(picture_options *options, int default_side);

typedef struct picture {
    projection map;
    int channels;       ///< 3, or 4 with premultiplied alpha (fisheye)
    float *pixels;      ///< [height][width][channels]
    double horizon_deg; ///< below it is ground
} picture;

/// What the scene needs to know of a picture.
scene_plan picture_plan(const picture_options *options);

/// Renders. @param progress  whether to show a bar. @return 0, or a status after an error line; then nothing to free.
int picture_render(picture *image, const picture_options *options, scene *view, const moment *now, bool progress);
void picture_free(picture *image);

/// Exposure k for 1 - exp(-k L): brings the picture's brightness to `EXPOSURE_KEY` of white. That is the average of log
/// luminance (over solid angle) of what lies above the horizon and of what lies below it, each weighed by its light:
/// the brighter of the two counts most. Discs, the brightest hundredth, and what is under 1/1000 of the rest are left
/// out.
double picture_auto_exposure(const picture *image);
#define EXPOSURE_KEY 0.32

/// The same for a list of colours [n][3] with weights [n] (NULL = equal).
double colours_auto_exposure(const float *rgb, size_t n, size_t channels, const float *weight);

/// Linear 0..1 to the sRGB transfer function, 0..1.
double srgb_from_linear(double linear);

/// An exposed copy with straight alpha, 8 bits a channel, [height][width][channels]; NULL = no memory. dither: +-half
/// a step of ordered noise, so that smooth skies show no bands.
uint8_t *picture_to_srgb8(const picture *image, double exposure, bool dither);
uint16_t *picture_to_srgb16(const picture *image, double exposure);

/// Writes beside and renames. @return 0, or a status after an error line.
int picture_write_exr(const picture *image, const picture_options *options, scene *view, const moment *now,
                      const char *path);
int picture_write_png(const picture *image, const picture_options *options, const moment *now, double exposure,
                      const char *path);

/// Writes ready-made sRGB bytes (3 or 4 channels, 8 or 16 bits).
int png_write_file(const char *command, const void *pixels, int width, int height, int channels, int bits,
                   const char *comment, const char *path);

#endif
