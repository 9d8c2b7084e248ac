#include <string.h>

#include "command.h"
#include "picture.h"

static const char *const projection_names[] = {"fisheye", "latlong", "perspective", NULL};

/// Most pixels of a picture: 1 GiB of floats.
#define PIXELS_MAX (64 * 1024 * 1024)
#define SIDE_MAX   16384

// clang-format off
const char picture_options_help[] =
    "Picture:\n"
    "  --projection NAME      fisheye (default): equidistant, zenith in the centre, north up, east LEFT (the\n"
    "                         sky as seen from below), transparent outside;\n"
    "                         latlong: OpenEXR environment map, north in the centre, east right of it;\n"
    "                         perspective: a pinhole camera\n"
    "  --size WxH             2x2 to 16384x16384, at most 64 Mi pixels\n"
    "  --fov-deg F            fisheye: of the whole circle, 10 to 360 (default 180);\n"
    "                         perspective: across, 1 to 170 (default 60)\n"
    "  --azimuth-deg A        perspective: of the centre, clockwise from north (default: toward the sun)\n"
    "  --elevation-deg E      perspective: of the centre, -90 to 90 (default 0)\n"
    "  --supersample N        N x N rays per pixel, 1 to 8 (default 1)\n"
    "  --exposure K|auto      PNG: 1 - exp(-K L), L = 1 at 1000 cd/m2; auto (default) brings the mean of\n"
    "                         log luminance of sky and ground, whichever is brighter, to 0.32 of white.\n"
    "                         EXR is never exposed\n"
    "  --float, --half        EXR: 32 (default) or 16 bits a channel; half is clamped at 65504\n"
    "  --owner TEXT           EXR: whose picture it is\n"
    "  --png-bits 8|16        (default 8)\n"
    "  --no-dither            8 bits without the half step of noise that hides bands\n";
// clang-format on

void picture_options_begin(picture_options *options, const char *command) {
    memset(options, 0, sizeof *options);
    options->command = command;
    options->supersample = 1;
    options->exposure_auto = true;
    options->png_bits = 8;
    options->dither = true;
}

static int take_size(picture_options *options, const char *value) {
    char first[8];
    const char *const times = strpbrk(value, "xX");
    const size_t length = times ? (size_t)(times - value) : 0;
    if (length < 1 || length >= sizeof first)
        return fail_usage("skyvert %s: --size '%.40s': WxH, e.g. 1024x512, 2x2 to %dx%d", options->command, value,
                          SIDE_MAX, SIDE_MAX);
    memcpy(first, value, length);
    first[length] = '\0';
    int status = option_integer(options->command, "--size (width)", first, 2, SIDE_MAX, &options->map.width);
    if (status == 0)
        status = option_integer(options->command, "--size (height)", times + 1, 2, SIDE_MAX, &options->map.height);
    if (status == 0 && (long long)options->map.width * options->map.height > PIXELS_MAX)
        status =
            fail_usage("skyvert %s: --size '%.40s': at most %d pixels in all", options->command, value, PIXELS_MAX);
    options->has_size = status == 0;
    return status;
}

static int take_exposure(picture_options *options, const char *value) {
    options->exposure_auto = strcmp(value, "auto") == 0;
    if (options->exposure_auto)
        return 0;
    if (!parse_number(value, &options->exposure) || !(options->exposure >= 0.0 && options->exposure <= 1e12))
        return fail_usage("skyvert %s: --exposure '%.40s': auto or a number from 0 to 1e12", options->command, value);
    return 0;
}

static int take_png_bits(picture_options *options, const char *value) {
    static const char *const names[] = {"8", "16", NULL};
    int index = 0;
    const int status = option_choice(options->command, "--png-bits", value, names, &index);
    options->png_bits = index == 1 ? 16 : 8;
    return status;
}

int picture_options_take(picture_options *options, int option, const char *value) {
    const char *const command = options->command;
    int index = 0, status;
    switch (option) {
    case OPT_PROJECTION:
        status = option_choice(command, "--projection", value, projection_names, &index);
        options->map.kind = status == 0 ? (projection_kind)index : options->map.kind;
        return status;
    case OPT_SIZE:
        return take_size(options, value);
    case OPT_FOV:
        options->has_fov = true;
        return option_number(command, "--fov-deg", value, 1.0, 360.0, &options->map.fov_deg);
    case OPT_AZIMUTH:
        options->has_azimuth = true;
        return option_number(command, "--azimuth-deg", value, -360.0, 360.0, &options->map.azimuth_deg);
    case OPT_ELEVATION:
        return option_number(command, "--elevation-deg", value, -90.0, 90.0, &options->map.elevation_deg);
    case OPT_SUPERSAMPLE:
        return option_integer(command, "--supersample", value, 1, 8, &options->supersample);
    case OPT_EXPOSURE:
        return take_exposure(options, value);
    case OPT_HALF:
        options->half = true;
        return 0;
    case OPT_FLOAT:
        options->half = false;
        return 0;
    case OPT_PNG_BITS:
        return take_png_bits(options, value);
    case OPT_OWNER:
        options->owner = value;
        return 0;
    case OPT_NO_DITHER:
        options->dither = false;
        return 0;
    default:
        return -1;
    }
}

int picture_options_finish(picture_options *options, int default_side) {
    projection *map = &options->map;
    const bool fisheye = map->kind == PROJECTION_FISHEYE, perspective = map->kind == PROJECTION_PERSPECTIVE;
    if (!options->has_size) {
        map->width = default_side;
        map->height = fisheye ? default_side : default_side / 2;
    }
    if (!options->has_fov)
        map->fov_deg = fisheye ? 180.0 : 60.0;
    else if ((fisheye && map->fov_deg < 10.0) || (perspective && map->fov_deg > 170.0))
        return fail_usage("skyvert %s: --fov-deg %g: fisheye 10 to 360, perspective 1 to 170", options->command,
                          map->fov_deg);
    else if (!fisheye && !perspective)
        return fail_usage("skyvert %s: --fov-deg: for fisheye and perspective only", options->command);
    return 0;
}
