/// `skyvert bake`: options and the order of things.
#include "bake.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#define NAME "bake"

enum {
    OPT_WHAT = 1500,
    OPT_FORMAT,
    OPT_OUTPUT,
    OPT_TEXEL,
    OPT_COLOURS,
    OPT_PHASE,
    OPT_ROWS, // these four in the order of AXIS_*
    OPT_AZIMUTHS,
    OPT_SUNS,
    OPT_ALTITUDES,
    OPT_SUN_LOWEST,
    OPT_NAME,
};

static const struct option long_options[] = {{"what", required_argument, NULL, OPT_WHAT},
                                             {"format", required_argument, NULL, OPT_FORMAT},
                                             {"output", required_argument, NULL, OPT_OUTPUT},
                                             {"texel", required_argument, NULL, OPT_TEXEL},
                                             {"colours", required_argument, NULL, OPT_COLOURS},
                                             {"phase", required_argument, NULL, OPT_PHASE},
                                             {"rows", required_argument, NULL, OPT_ROWS},
                                             {"azimuths", required_argument, NULL, OPT_AZIMUTHS},
                                             {"suns", required_argument, NULL, OPT_SUNS},
                                             {"altitudes", required_argument, NULL, OPT_ALTITUDES},
                                             {"sun-lowest-deg", required_argument, NULL, OPT_SUN_LOWEST},
                                             {"name", required_argument, NULL, OPT_NAME},
                                             SKY_OPTIONS_LONG,
                                             MOMENT_OPTIONS_LONG,
                                             {"help", no_argument, NULL, 'h'},
                                             {"version", no_argument, NULL, 'V'},
                                             {NULL, 0, NULL, 0}};

// clang-format off
static const char help[] =
    "usage: skyvert bake --what NAME --output FILE [OPTION...]\n\n"
    "Tables of the sky for engines that want textures, with their mapping written in the file, and model and\n"
    "table of multiple scattering as constant C. Samplers: port/bake/skv_bake.h (C), skv_bake.glsl (GLSL ES 3).\n"
    "  --what sky-view        radiance and transmittance for one observer and sun, azimuth by elevation\n"
    "         transmittance   altitude by zenith angle, to the top of the air or to the ground\n"
    "         scattering-3d   radiance for any altitude, direction and sun: a 3-D texture\n"
    "         irradiance      altitude by sun: on horizontal surfaces up and down, and of the sun's beam\n"
    "         model           C alone: skv_model, skv_table and colour matrix, for read-only memory\n"
    "  --output FILE          of any name\n"
    "  --format exr|raw16f|c  default: by the ending of FILE, .exr, .raw16f, .c or .h. raw16f: text, then halves,\n"
    "                         little-endian, as textures are uploaded\n"
    "  --texel half|float     exr and c (default half: scaled by a power of two that the file says)\n"
    "  --colours bands|rgb    a channel per band (default), or linear BT.709, (1,1,1) = 1000 cd/m2 (irradiance:\n"
    "                         1000 lx); without transmittances\n"
    "  --phase baked|deferred whether what aerosol and dust scatter once are layers of their own without their\n"
    "                         phase functions, which the sampler multiplies: exact about the sun (sky-view: baked;\n"
    "                         scattering-3d: deferred)\n"
    "  --orders single|all    of scattering (default all)\n"
    "  --table accurate|small|large  the table of multiple scattering (default accurate)\n"
    "  --name NAME            what C names begin with (default skyvert_baked)\n"
    "Sizes (defaults in the order sky-view, transmittance, scattering-3d, irradiance):\n"
    "  --rows N               even, 4 to 4096 (96, 128, 64, -)\n"
    "  --azimuths N           2 to 4096 (64, -, 12, -)\n"
    "  --suns N               2 to 1024 (-, -, 64, 96)\n"
    "  --altitudes N          2 to 1024 (-, 48, 24, 24)\n"
    "  --sun-lowest-deg Z     zenith angle at the end of the sun axis, 91 to 120 (default 102)\n"
    "scattering-3d leaves out the ground's own light unless --ground land is given. Only sky-view has a place, a\n"
    "height and a moment. The sun is the one light, and it is no disc: moonlight, the night sky and a sea's mirror\n"
    "image are not in tables.\n";
// clang-format on

const char *const bake_what_names[] = {"sky-view", "transmittance", "scattering-3d", "irradiance", "model", NULL};
static const char *const format_names[] = {"exr", "raw16f", "c", NULL};
static const char *const axis_options[AXES] = {"--rows", "--azimuths", "--suns", "--altitudes"};
static const int axis_low[AXES] = {4, 2, 2, 2}, axis_high[AXES] = {4096, 4096, 1024, 1024};
/// Default sizes; 0: the table has no such axis.
static const int axis_default[BAKE_MODEL + 1][AXES] = {
    {96, 64, 0, 0}, {128, 0, 0, 48}, {64, 12, 64, 24}, {0, 0, 96, 24}, {0, 0, 0, 0}};

/// Most texels of one layer.
#define TEXELS_MAX (16 << 20)

static int print_help(void) {
    printf("%s\n%s\n%s", help, sky_options_help, moment_options_help);
    return output_finish_stdout();
}

// ---- options

/// What was typed where that is not the same as what it means.
typedef struct given {
    bool what, format, ground, height, texel, phase;
    int texel_index, phase_index;
} given;

static int take_choice(const char *option, const char *const names[], int *index, bool *set) {
    const int status = option_choice(NAME, option, optarg, names, index);
    *set = *set || status == 0;
    return status;
}

/// Options of pictures that tables have no use for.
static int refuse_picture(int c) {
    const bool moon = c == OPT_MOON_ZENITH || c == OPT_MOON_AZIMUTH || c == OPT_MOON;
    if (moon || c == OPT_GRID || c == OPT_DISCS || c == OPT_NIGHT || c == OPT_WIND || c == OPT_WIND_AZIMUTH)
        return fail_usage("skyvert bake: moon, night, discs, grid and wind: allowed with pictures; tables hold the "
                          "sun's light in the air");
    if (c == OPT_GROUND && strcmp(optarg, "water") == 0)
        return fail_usage("skyvert bake: --ground water: allowed is land, lit or none: a table has no mirror");
    return 0;
}

static int take_sky(bake_options *options, given *g, int c, char **argv) {
    const int refused = refuse_picture(c);
    if (refused != 0)
        return refused;
    g->ground = g->ground || c == OPT_GROUND;
    int status = sky_options_take(&options->sky, c, optarg);
    if (status < 0)
        status = moment_options_take(&options->when, c, optarg);
    return status < 0 ? option_unknown(NAME, c, argv) : status;
}

static int take(bake_options *options, given *g, int c, char **argv) {
    static const char *const texels[] = {"half", "float", NULL}, *const colours[] = {"bands", "rgb", NULL};
    static const char *const phases[] = {"baked", "deferred", NULL};
    int index = 0, status = 0;
    switch (c) {
    case OPT_WHAT:
        return take_choice("--what", bake_what_names, &options->what, &g->what);
    case OPT_FORMAT:
        return take_choice("--format", format_names, &options->format, &g->format);
    case OPT_TEXEL:
        return take_choice("--texel", texels, &g->texel_index, &g->texel);
    case OPT_PHASE:
        return take_choice("--phase", phases, &g->phase_index, &g->phase);
    case OPT_COLOURS:
        status = option_choice(NAME, "--colours", optarg, colours, &index);
        options->rgb = index == 1;
        return status;
    case OPT_ROWS:
    case OPT_AZIMUTHS:
    case OPT_SUNS:
    case OPT_ALTITUDES:
        index = c - OPT_ROWS;
        return option_integer(NAME, axis_options[index], optarg, axis_low[index], axis_high[index],
                              &options->size[index]);
    case OPT_SUN_LOWEST:
        return option_number(NAME, "--sun-lowest-deg", optarg, 91.0, 120.0, &options->sun_lowest_deg);
    case OPT_OUTPUT:
        options->output = optarg;
        return 0;
    case OPT_NAME:
        options->name = optarg;
        return 0;
    default:
        return take_sky(options, g, c, argv);
    }
}

static int settle_format(bake_options *options, const given *g) {
    static const struct {
        const char *ending;
        bake_format format;
    } endings[] = {{".exr", BAKE_EXR}, {".raw16f", BAKE_RAW16F}, {".c", BAKE_C}, {".h", BAKE_C}};
    const size_t n = strlen(options->output);
    bool found = g->format;
    for (size_t i = 0; i < sizeof endings / sizeof endings[0] && !found; i++) {
        const size_t m = strlen(endings[i].ending);
        found = n > m && strcasecmp(options->output + n - m, endings[i].ending) == 0;
        options->format = found ? (int)endings[i].format : options->format;
    }
    if (!found)
        return fail_usage(
            "skyvert bake: --format exr, raw16f or c is needed where the name of the file does not end in "
            ".exr, .raw16f, .c or .h");
    if (options->what == BAKE_MODEL && options->format != BAKE_C)
        return fail_usage("skyvert bake: --format %s: --what model is written as c only",
                          format_names[options->format]);
    options->half = !g->texel || g->texel_index == 0;
    if (!options->half && options->format == BAKE_RAW16F)
        return fail_usage("skyvert bake: --texel float: raw16f is half; allowed with --format exr or c");
    return 0;
}

static int settle_sizes(bake_options *options) {
    const int *const normal = axis_default[options->what];
    const char *const what = bake_what_names[options->what];
    double texels = 1.0;
    for (int a = 0; a < AXES; a++) {
        if (options->size[a] > 0 && normal[a] == 0)
            return fail_usage("skyvert bake: %s: --what %s has no such axis", axis_options[a], what);
        if (options->size[a] == 0)
            options->size[a] = normal[a];
        texels *= options->size[a] > 0 ? options->size[a] : 1.0;
    }
    if (options->size[AXIS_ROWS] % 2 != 0)
        return fail_usage("skyvert bake: --rows %d: an even number is needed: half of them are sky, half ground",
                          options->size[AXIS_ROWS]);
    if (texels > TEXELS_MAX)
        return fail_usage("skyvert bake: %.3g texels: allowed are %d (the product of all sizes)", texels, TEXELS_MAX);
    return 0;
}

static int settle_name(const bake_options *options) {
    const char *const name = options->name;
    bool good = isalpha((unsigned char)name[0]) || name[0] == '_';
    for (const char *c = name; *c; c++)
        good = good && (isalnum((unsigned char)*c) || *c == '_');
    if (good && strlen(name) <= 60)
        return 0;
    return fail_usage("skyvert bake: --name '%.60s': a C name of at most 60 letters, digits and underscores", name);
}

static int settle_kind(bake_options *options, const given *g) {
    const bool radiance = options->what == SKV_BAKE_SKY_VIEW || options->what == SKV_BAKE_SCATTERING;
    if (options->rgb && (options->what == SKV_BAKE_TRANSMITTANCE || options->what == BAKE_MODEL))
        return fail_usage(
            "skyvert bake: --colours rgb: a transmittance has no colour of its own; allowed with sky-view, "
            "scattering-3d and irradiance");
    if (g->phase && !radiance)
        return fail_usage("skyvert bake: --phase: allowed with sky-view and scattering-3d");
    if (options->what == BAKE_MODEL && options->sky.light.orders == 0)
        return fail_usage("skyvert bake: --orders single: --what model is the table of all orders");
    options->deferred = g->phase ? g->phase_index == 1 : options->what == SKV_BAKE_SCATTERING;
    if (options->what == SKV_BAKE_SCATTERING && !g->ground)
        options->sky.ground_lit = false;
    return 0;
}

/// Only sky-view has a place and a moment.
static int settle_moment(bake_options *options) {
    const moment_options *const w = &options->when;
    if (options->what == SKV_BAKE_SKY_VIEW)
        return moment_options_finish(w, options->sky.ground_m, &options->now);
    if (w->position || w->has_lat || w->has_lon || w->has_height || w->has_utc || w->has_sun_zenith ||
        w->has_sun_azimuth)
        return fail_usage("skyvert bake: a place, a height, a time or a sun: allowed with --what sky-view only");
    return 0;
}

static int settle(bake_options *options, const given *g) {
    if (!g->what)
        return fail_usage(
            "skyvert bake: --what sky-view, transmittance, scattering-3d, irradiance or model is missing");
    if (!options->output || !options->output[0])
        return fail_usage("skyvert bake: --output FILE is missing (skyvert bake --help)");
    int status = settle_format(options, g);
    if (status == 0)
        status = settle_sizes(options);
    if (status == 0)
        status = settle_name(options);
    if (status == 0)
        status = settle_kind(options, g);
    if (status == 0)
        status = settle_moment(options);
    return status;
}

// ---- the job

static int write_texture(bake_texture *texture, const bake_air *air, output *out) {
    switch (air->options->format) {
    case BAKE_EXR:
        bake_texture_describe(texture, air, 0);
        return bake_write_exr(texture, air->options, out);
    case BAKE_RAW16F:
        return bake_write_raw16f(texture, air, out);
    default:
        bake_texture_describe(texture, air, 0);
        return bake_write_c(texture, air->options, out);
    }
}

/// The file is opened first: a name that cannot be written fails before the work, not after it.
static int bake(const bake_options *options) {
    static bake_air air;
    static bake_texture texture;
    output out;
    int status = output_open(&out, options->output);
    if (status != 0)
        return status;
    status = bake_air_begin(&air, options);
    if (status == 0 && options->what == BAKE_MODEL) {
        status = bake_write_model(&air, &out);
    } else if (status == 0) {
        status = bake_texture_make(&texture, &air);
        if (status == 0)
            status = write_texture(&texture, &air, &out);
        free(texture.texels);
    }
    bake_air_end(&air);
    if (status == 0 && options->sky.timing)
        fprintf(stderr, "%.3g rays, %.3g s of processor time in all\n", (double)air.evaluations, processor_s());
    if (status == 0)
        return output_commit(&out);
    output_discard(&out);
    return status;
}

int cmd_bake(int argc, char **argv) {
    static bake_options options;
    given g = {0};
    options = (bake_options){.sun_lowest_deg = 102.0, .name = "skyvert_baked"};
    sky_options_begin(&options.sky, NAME);
    moment_options_begin(&options.when, NAME);
    int status = 0;
    for (int c; status == 0 && (c = getopt_long(argc, argv, ":hV", long_options, NULL)) != -1;) {
        if (c == 'h')
            return print_help();
        if (c == 'V')
            return option_version();
        status = take(&options, &g, c, argv);
    }
    if (status == 0)
        status = option_no_more(NAME, argc, argv);
    if (status == 0)
        status = settle(&options, &g);
    if (status == 0)
        status = sky_options_finish(&options.sky);
    if (status != 0)
        return status;
    status = bake(&options);
    place_end();
    sky_options_free(&options.sky);
    return status;
}
