#include "sky_options.h"

#include <stdio.h>
#include <string.h>

#include "command.h"

static const char *const preset_names[] = {"earth-clear", "earth-hazy", "mars",  "tiny",        "giant", "earth-thin",
                                           "earth-dense", "earth-x25",  "titan", "earth-smoke", NULL};
static const char *const tier_names[] = {"fast", "standard", "high", NULL};
static const char *const rule_names[] = {"uniform", "keller", "gauss-exp", NULL};
static const char *const ground_names[] = {"none", "lit", "land", "water", NULL};
enum { GROUND_NONE, GROUND_LIT, GROUND_LAND, GROUND_WATER };

// clang-format off
const char sky_options_help[] =
    "Air and integration:\n"
    "  --preset NAME          earth-clear (default), earth-hazy, earth-thin (a fifth of the air), earth-dense\n"
    "                         (five times), earth-x25, earth-smoke, mars, titan, tiny or giant\n"
    "  --atmosphere FILE.ini  an atmosphere of your own instead\n"
    "  --bands 3|4            spectral bands of a preset (default 4)\n"
    "  --turbidity T          multiplies aerosol and dust, 0 to 10000 (default 1)\n"
    "  --ground land|water|none\n"
    "                         land (default; lit is the same): the ground sends back its albedo's share of the\n"
    "                         light; water: it mirrors the sky and lights, see --wind-m-s; none: it is black\n"
    "  --ground-m M           height of the ground above the sea, -12000 to 12000 (default 0)\n"
    "  --tier NAME            fast, standard (default) or high\n"
    "  --rule NAME            uniform, keller or gauss-exp instead of the tier's\n"
    "  --samples N            along each ray, 1 to 64 (gauss-exp: 2 to 16, in each lit part)\n"
    "  --depth-samples M      of the optical depth by inner integration, 1 to 64; without it: Chapman's\n"
    "                         function for gauss-exp, N samples for the other rules\n"
    "  --timing               print on standard error what table and rays cost\n";
// clang-format on

void sky_options_begin(sky_options *options, const char *command) {
    memset(options, 0, sizeof *options);
    options->command = command;
    options->bands = 4;
    options->turbidity = 1.0;
    options->ground_lit = true;
    options->tier = SKV_TIER_STANDARD;
    options->rule = -1;
    light_options_begin(&options->light);
}

int sky_options_take(sky_options *options, int option, const char *value) {
    const char *const command = options->command;
    int index = 0, status;
    switch (option) {
    case OPT_PRESET:
        status = option_choice(command, "--preset", value, preset_names, &index);
        options->preset = status == 0 ? (skv_preset)index : options->preset;
        return status;
    case OPT_ATMOSPHERE:
        options->atmosphere_path = value;
        return 0;
    case OPT_BANDS:
        return option_integer(command, "--bands", value, 3, 4, &options->bands);
    case OPT_TIER:
        return option_choice(command, "--tier", value, tier_names, &options->tier);
    case OPT_RULE:
        return option_choice(command, "--rule", value, rule_names, &options->rule);
    case OPT_SAMPLES:
        return option_integer(command, "--samples", value, 1, SKV_SAMPLES_MAX, &options->samples);
    case OPT_DEPTH_SAMPLES:
        return option_integer(command, "--depth-samples", value, 1, SKV_SAMPLES_MAX, &options->depth_samples);
    case OPT_TURBIDITY:
        return option_number(command, "--turbidity", value, 0.0, 1e4, &options->turbidity);
    case OPT_GROUND:
        status = option_choice(command, "--ground", value, ground_names, &index);
        options->ground_lit = index != GROUND_NONE;
        options->water = index == GROUND_WATER;
        return status;
    case OPT_GROUND_M:
        return option_number(command, "--ground-m", value, -12e3, 12e3, &options->ground_m);
    case OPT_TIMING:
        options->timing = true;
        return 0;
    default:
        return light_options_take(&options->light, command, option, value);
    }
}

static int settle_quality(sky_options *options) {
    skv_quality *quality = &options->quality;
    if (skv_quality_tier(quality, (skv_tier)options->tier) != SKV_OK)
        return fail_job("skyvert %s: this build has no tier %s", options->command, tier_names[options->tier]);
    if (options->rule >= 0)
        quality->rule = (skv_rule)options->rule;
    if (options->samples > 0)
        quality->samples = options->samples;
    const bool gauss = quality->rule == SKV_GAUSS_EXP;
    if (gauss && (quality->samples < 2 || quality->samples > 16))
        return fail_usage("skyvert %s: --samples %d: with gauss-exp 2 to 16", options->command, quality->samples);
    if (!gauss || options->depth_samples > 0) { // the other rules are whole with their own
                                                // inner integration only
        quality->depth = SKV_DEPTH_BY_INNER;
        quality->depth_samples = options->depth_samples > 0 ? options->depth_samples : quality->samples;
    }
    if (options->ground_lit)
        quality->terms |= SKV_WITH_GROUND;
    else
        quality->terms &= ~(uint32_t)SKV_WITH_GROUND;
    return 0;
}

void sky_options_free(sky_options *options) {
    if (options->atmosphere_path)
        atmosphere_free(&options->file);
}

static int settle_atmosphere(sky_options *options) {
    if (options->atmosphere_path) {
        const int status = atmosphere_load(&options->file, options->atmosphere_path);
        if (status != 0)
            return status;
        options->atmosphere = options->file.atmosphere;
        options->bands = options->atmosphere.bands;
    } else if (skv_atmosphere_preset(&options->atmosphere, options->preset, options->bands) != SKV_OK) {
        return fail_job("skyvert %s: this build has no preset %s with %d bands", options->command,
                        preset_names[options->preset], options->bands);
    }
    if (options->turbidity != 1.0)
        options->atmosphere.turbidity = (float)options->turbidity;
    if (options->water)
        water_albedo(options->bands, options->atmosphere.wavelength_nm, options->atmosphere.albedo);
    if (skv_colour_matrix_for(&options->matrix, options->bands, options->atmosphere.wavelength_nm,
                              options->atmosphere.solar_irradiance) == SKV_OK)
        return 0;
    sky_options_free(options);
    return fail_usage("%.200s: no colours without a band of wavelength_nm from 380 to 780 that the sun shines in",
                      options->atmosphere_path ? options->atmosphere_path : "skyvert");
}

int sky_options_finish(sky_options *options) {
    const int status = settle_quality(options);
    return status != 0 ? status : settle_atmosphere(options);
}

/// A picture's comment names the file, not the folders of somebody's machine.
static const char *file_name_of(const char *path) {
    const char *const slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

char *sky_options_describe(const sky_options *options, char *text, size_t size) {
    const skv_quality *quality = &options->quality;
    char light[80];
    int n = snprintf(text, size, "%s, %d bands, %s with %d samples",
                     options->atmosphere_path ? file_name_of(options->atmosphere_path) : preset_names[options->preset],
                     options->bands, rule_names[quality->rule], quality->samples);
    if (n > 0 && (size_t)n < size && quality->depth == SKV_DEPTH_BY_INNER)
        n += snprintf(text + n, size - (size_t)n, " (depth %d)", quality->depth_samples);
    if (n > 0 && (size_t)n < size)
        snprintf(text + n, size - (size_t)n, ", %s, %s", light_options_describe(&options->light, light, sizeof light),
                 options->water        ? "water"
                 : options->ground_lit ? "ground lit"
                                       : "ground dark");
    return text;
}
