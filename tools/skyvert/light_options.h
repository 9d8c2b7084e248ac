/// Options that say what shines and how it is computed: part of the sky options of render, track and dome.
#ifndef SKYVERT_LIGHT_OPTIONS_H
#define SKYVERT_LIGHT_OPTIONS_H

#include <getopt.h>
#include <stdbool.h>

#include "skyvert/skyvert.h"
#include "skyvert/water.h"

typedef enum choice { CHOICE_OFF, CHOICE_ON, CHOICE_AUTO } choice;

typedef struct light_options {
    int orders;      ///< 0: light scattered once, 1: all
    int table;       ///< skv_table_kind
    int grid;        ///< a choice
    int discs;       ///< off or on
    int moon, night; ///< choices
    double wind_m_s; ///< over water; 0: a mirror
    double wind_azimuth_deg;
} light_options;

enum {
    OPT_ORDERS = 1400,
    OPT_TABLE,
    OPT_GRID,
    OPT_DISCS,
    OPT_MOON,
    OPT_NIGHT,
    OPT_WIND,
    OPT_WIND_AZIMUTH,
};

// clang-format off
#define LIGHT_OPTIONS_LONG                                                                                             \
    {"orders", required_argument, NULL, OPT_ORDERS}, {"table", required_argument, NULL, OPT_TABLE},                    \
    {"grid", required_argument, NULL, OPT_GRID}, {"discs", required_argument, NULL, OPT_DISCS},                        \
    {"moon", required_argument, NULL, OPT_MOON}, {"night", required_argument, NULL, OPT_NIGHT},                        \
    {"wind-m-s", required_argument, NULL, OPT_WIND},                                                                   \
    {"wind-azimuth-deg", required_argument, NULL, OPT_WIND_AZIMUTH}
// clang-format on

extern const char light_options_help[];

void light_options_begin(light_options *options);
/// Takes one option. @return 0; 2 after an error line; -1 iff it is none of these.
int light_options_take(light_options *options, const char *command, int option, const char *value);
/// ", all orders" and the like, for a picture's comment. @return text
char *light_options_describe(const light_options *options, char *text, size_t size);

/// What comes out of clear water, per band, as an albedo.
/// Source: [Gordon81] clear-water radiances over the sun's irradiance, at 520, 550 and 670 nm; to the blue rising to
/// what water of 0.1 mg/m3 of pigment has at 443 nm.
void water_albedo(int bands, const float wavelength_nm[], float albedo[]);

#endif
