#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "command.h"
#include "picture.h"

#ifdef SKV_HAVE_EXR
#include "port/openexr/skv_exr.h"
#endif
#ifdef SKV_HAVE_PNG
#include "port/png/skv_png.h"
#endif

static const char *projection_words(const projection *map) {
    switch (map->kind) {
    case PROJECTION_FISHEYE:
        return "fisheye, equidistant, zenith in the centre, north up, east left";
    case PROJECTION_LATLONG:
        return "latlong environment map, north in the centre, east right";
    default:
        return "perspective";
    }
}

#ifdef SKV_HAVE_EXR
static const double degree = 3.14159265358979323846 / 180.0;

static void describe(const picture *image, const scene *view, char *text, size_t size) {
    char air[400], by[200] = "";
    if (view->other)
        other_model_describe(view->other, by, sizeof by);
    snprintf(text, size, "%s; %s%s%s; discs of sun and moon %s. Linear BT.709, (1,1,1) = %g cd/m2.",
             projection_words(&image->map), by, view->other ? " instead of " : "",
             sky_options_describe(view->options, air, sizeof air), view->around.discs > 0 ? "drawn" : "not drawn",
             (double)SKV_WHITE_LUMINANCE);
}

/// Zone time at sea: whole hours by longitude. @return what to add to it to get UTC, seconds
static double local_time(const moment *now, char text[32]) {
    const double lon = now->has_position ? remainder(now->at.lon_deg, 360.0) : 0.0;
    const double ahead_s = 3600.0 * floor(lon / 15.0 + 0.5);
    const utc_time local = utc_add(&now->utc, ahead_s);
    int year, month, day, hour, minute;
    double second;
    utc_calendar(&local, &year, &month, &day, &hour, &minute, &second);
    snprintf(text, 32, "%04d:%02d:%02d %02d:%02d:%02d", year, month, day, hour, minute, (int)second);
    return -ahead_s;
}

static int write_exr_stream(const skv_exr_image *exr, const char *path) {
    output out;
    char message[200];
    const int opened = output_open(&out, path);
    if (opened != 0)
        return opened;
    const int result = skv_exr_write(fileno(out.stream), exr, message, sizeof message);
    return result == SKV_EXR_OK ? output_commit(&out) : output_fail(&out, message);
}

int picture_write_exr(const picture *image, const picture_options *options, scene *view, const moment *now,
                      const char *path) {
    char comments[640], date[32];
    describe(image, view, comments, sizeof comments);
    const scene_zenith_light zenith = scene_zenith(view);
    const skv_exr_extra extra[] = {
        {"skyvert.sunAzimuthDeg", (float)now->sun_azimuth_deg},
        {"skyvert.sunElevationDeg", (float)now->sun_elevation_deg},
        {"skyvert.groundAltitudeM", (float)view->options->ground_m},
        {"skyvert.zenithLuminance", (float)zenith.luminance},
        {"skyvert.limitingMagnitude", (float)zenith.limiting_magnitude},
        {"skyvert.moonAzimuthDeg", now->moon.azimuth_deg},
        {"skyvert.moonElevationDeg", now->moon.elevation_deg},
        {"skyvert.moonIlluminatedFraction", now->moon.illuminated_fraction},
    };
    const size_t moon_extras = 3;
    const bool perspective = image->map.kind == PROJECTION_PERSPECTIVE;
    skv_exr_image exr = {
        .width = image->map.width,
        .height = image->map.height,
        .channels = image->channels,
        .pixels = image->pixels,
        .half = options->half,
        .white_luminance = SKV_WHITE_LUMINANCE,
        .latlong = image->map.kind == PROJECTION_LATLONG,
        .screen_window_width = perspective ? (float)(2.0 * tan(image->map.fov_deg * degree / 2.0)) : 1.0f,
        .has_position = now->has_position,
        .latitude_deg = (float)now->at.lat_deg,
        .longitude_deg = (float)now->at.lon_deg,
        .altitude_m = (float)now->at.msl_m,
        .owner = options->owner,
        .software = "skyvert " SKV_VERSION,
        .comments = comments,
        .extra = extra,
        .extras = sizeof extra / sizeof extra[0] - (now->has_moon ? 0 : moon_extras),
    };
    if (now->has_utc) {
        exr.utc_offset_s = (float)local_time(now, date);
        exr.cap_date = date;
    }
    return write_exr_stream(&exr, path);
}
#else
int picture_write_exr(const picture *image, const picture_options *options, scene *view, const moment *now,
                      const char *path) {
    (void)image, (void)view, (void)now;
    return fail_job("skyvert %s: %.200s: this build has no OpenEXR (package libopenexr-dev)", options->command, path);
}
#endif

#ifdef SKV_HAVE_PNG
int png_write_file(const char *command, const void *pixels, int width, int height, int channels, int bits,
                   const char *comment, const char *path) {
    (void)command;
    const skv_png_text text[] = {{"Software", "skyvert " SKV_VERSION}, {"Comment", comment}};
    const skv_png_image png = {.width = width,
                               .height = height,
                               .channels = channels,
                               .bits = bits,
                               .pixels = pixels,
                               .text = text,
                               .texts = 2};
    output out;
    char message[200];
    const int opened = output_open(&out, path);
    if (opened != 0)
        return opened;
    const int result = skv_png_write(fileno(out.stream), &png, message, sizeof message);
    return result == SKV_PNG_OK ? output_commit(&out) : output_fail(&out, message);
}
#else
int png_write_file(const char *command, const void *pixels, int width, int height, int channels, int bits,
                   const char *comment, const char *path) {
    (void)pixels, (void)width, (void)height, (void)channels, (void)bits, (void)comment;
    return fail_job("skyvert %s: %.200s: this build has no PNG (package libpng-dev)", command, path);
}
#endif

int picture_write_png(const picture *image, const picture_options *options, const moment *now, double exposure,
                      const char *path) {
    char comment[300];
    snprintf(comment, sizeof comment, "%s; sun at azimuth %.3f deg, elevation %.3f deg; exposure 1 - exp(-%.6g L)",
             projection_words(&image->map), now->sun_azimuth_deg, now->sun_elevation_deg, exposure);
    void *pixels = options->png_bits == 16 ? (void *)picture_to_srgb16(image, exposure)
                                           : (void *)picture_to_srgb8(image, exposure, options->dither);
    if (!pixels)
        return fail_job("skyvert %s: no memory for a PNG of %dx%d", options->command, image->map.width,
                        image->map.height);
    const int status = png_write_file(options->command, pixels, image->map.width, image->map.height, image->channels,
                                      options->png_bits, comment, path);
    free(pixels);
    return status;
}
