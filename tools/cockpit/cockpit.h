/// skyvert-cockpit: what its parts share.
#ifndef COCKPIT_H
#define COCKPIT_H

#include "common.h"
#include "port/gpiod/skv_gpio.h"

#define COCKPIT "skyvert-cockpit"

typedef struct cockpit_options {
    char interface[16];
    int node;      ///< own CANaerospace node, [1, 255]
    bool transmit; ///< sky state, zenith luminance and knobs once a second
    const char *replay, *shm, *png, *exr, *stats;
    bool fake;
    bool terminal;
    double speed, rate, duration_s; ///< duration 0: until it is stopped
    int vertices;
    // From the configuration file.
    int preset, bands, tier;
    double visibility_km;
    double geoid_m;                                 ///< height of the sea above the ellipsoid
    double exposure;                                ///< k of 1 - exp(-k rgb); 0: by itself
    double minutes_per_click, visibility_per_click; ///< factor
    double night_below_deg, night_width_deg;
    skv_gpio_config gpio;
} cockpit_options;

/// Reads the command line and the configuration file that it names.
/// @return 0 go on; 1 there was a question (help, version) and *status is what to exit with; 2 after an error line
int cockpit_options_read(cockpit_options *options, int argc, char **argv, int *status);

/// Reads a configuration file (cockpit.ini shows all of it). @return 0; 2 or 1 after an error line
int cockpit_config_read(cockpit_options *options, const char *path);

int64_t cockpit_mono_ns(void);

#endif
