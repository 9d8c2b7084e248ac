/// Where, when, and where sun and moon stand: options of render and dome, and what track derives from each fix.
#ifndef SKYVERT_MOMENT_H
#define SKYVERT_MOMENT_H

#include <getopt.h>
#include <stdbool.h>

#include "skyvert/skyvert.h"

#include "command.h"
#include "place.h"

/// A moment of an observer, settled.
typedef struct moment {
    bool has_position;
    place at;
    bool has_utc;
    utc_time utc;
    float sun_enu[3];
    double sun_azimuth_deg, sun_elevation_deg; ///< geometric
    double sun_distance_au;                    ///< 1 where the sun was placed by hand
    bool has_moon;                             ///< where it stands is known
    skv_moon moon;                             ///< geometric
    int moon_side;                             ///< skv_moon_side(); 0 where the moon was placed by hand
} moment;

typedef struct moment_options {
    const char *command; ///< for error lines
    const char *position;
    double lat_deg, lon_deg, height_m, sun_zenith_deg, sun_azimuth_deg, moon_zenith_deg, moon_azimuth_deg;
    bool has_lat, has_lon, has_height, has_utc, has_sun_zenith, has_sun_azimuth, has_moon_zenith, has_moon_azimuth;
    int datum; ///< a height_datum
    utc_time utc;
} moment_options;

enum {
    OPT_POSITION = 1100,
    OPT_LAT,
    OPT_LON,
    OPT_HEIGHT_M,
    OPT_HEIGHT_DATUM,
    OPT_UTC,
    OPT_SUN_ZENITH,
    OPT_SUN_AZIMUTH,
    OPT_MOON_ZENITH,
    OPT_MOON_AZIMUTH,
};

// clang-format off
#define MOMENT_OPTIONS_LONG                                                                                             \
    {"position", required_argument, NULL, OPT_POSITION}, {"lat", required_argument, NULL, OPT_LAT},                    \
    {"lon", required_argument, NULL, OPT_LON}, {"height-m", required_argument, NULL, OPT_HEIGHT_M},                    \
    {"height-datum", required_argument, NULL, OPT_HEIGHT_DATUM}, {"utc", required_argument, NULL, OPT_UTC},            \
    {"sun-zenith-deg", required_argument, NULL, OPT_SUN_ZENITH},                                                       \
    {"sun-azimuth-deg", required_argument, NULL, OPT_SUN_AZIMUTH},                                                     \
    {"moon-zenith-deg", required_argument, NULL, OPT_MOON_ZENITH},                                                     \
    {"moon-azimuth-deg", required_argument, NULL, OPT_MOON_AZIMUTH}
// clang-format on

extern const char moment_options_help[];

void moment_options_begin(moment_options *options, const char *command);
/// Takes one option. @return 0; 2 after an error line; -1 iff it is none of these.
int moment_options_take(moment_options *options, int option, const char *value);
/// Checks them together. Without --height-m the observer stands 2 m above ground_m.
/// @return 0, or a status after an error line.
int moment_options_finish(const moment_options *options, double ground_m, moment *out);

/// Both heights of a position; the geoid is only looked for where the height is above the ellipsoid. @return 0 or a
/// status
int moment_set_height(place *at, double height_m, height_datum datum);

/// Fills in the sun's and the moon's fields from position and UTC. @return 0, or a status after an error line.
int moment_find_lights(moment *now, const char *command);

#endif
