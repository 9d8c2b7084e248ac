/// Options that say what the air is, what shines and how it is integrated: shared by render, track and dome.
#ifndef SKYVERT_SKY_OPTIONS_H
#define SKYVERT_SKY_OPTIONS_H

#include <getopt.h>
#include <stdbool.h>

#include "skyvert/skyvert.h"

#include "ini.h"
#include "light_options.h"

typedef struct sky_options {
    const char *command; ///< for error lines
    skv_preset preset;
    int bands;                   ///< 3 or 4; of a file: its own
    const char *atmosphere_path; ///< NULL: the preset
    skv_quality quality;
    double turbidity;
    bool ground_lit; ///< the ground's own light is wanted
    bool water;      ///< it is a sea: mirrors the sky
    double ground_m; ///< above the sea
    bool timing;     ///< print what it cost
    light_options light;
    // What was given, settled by sky_options_finish().
    int tier, rule, samples, depth_samples;
    atmosphere_file file;
    skv_atmosphere atmosphere;
    skv_colour_matrix matrix;
} sky_options;

enum {
    OPT_PRESET = 1000,
    OPT_ATMOSPHERE,
    OPT_BANDS,
    OPT_TIER,
    OPT_RULE,
    OPT_SAMPLES,
    OPT_DEPTH_SAMPLES,
    OPT_TURBIDITY,
    OPT_GROUND,
    OPT_GROUND_M,
    OPT_TIMING,
};

// clang-format off
#define SKY_OPTIONS_LONG                                                                                               \
    {"preset", required_argument, NULL, OPT_PRESET}, {"atmosphere", required_argument, NULL, OPT_ATMOSPHERE},          \
    {"bands", required_argument, NULL, OPT_BANDS}, {"tier", required_argument, NULL, OPT_TIER},                        \
    {"rule", required_argument, NULL, OPT_RULE}, {"samples", required_argument, NULL, OPT_SAMPLES},                    \
    {"depth-samples", required_argument, NULL, OPT_DEPTH_SAMPLES},                                                     \
    {"turbidity", required_argument, NULL, OPT_TURBIDITY}, {"ground", required_argument, NULL, OPT_GROUND},            \
    {"ground-m", required_argument, NULL, OPT_GROUND_M}, {"timing", no_argument, NULL, OPT_TIMING}, \
    LIGHT_OPTIONS_LONG
// clang-format on

/// Lines of --help.
extern const char sky_options_help[];

void sky_options_begin(sky_options *options, const char *command);
/// Takes one option. @return 0; 2 after an error line; -1 iff it is none of these.
int sky_options_take(sky_options *options, int option, const char *value);
/// Checks them together, reads the atmosphere file, finds the colour matrix.
/// @return 0, or a status after an error line.
int sky_options_finish(sky_options *options);
void sky_options_free(sky_options *options);
/// One line for a picture's comment. @return text
char *sky_options_describe(const sky_options *options, char *text, size_t size);

#endif
