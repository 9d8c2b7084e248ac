/// The truth that the trade measures against: rays in nine scenes of an air, the light of all orders along them from
/// the path tracer (tools/trade/truth/AIR.csv, ground lit, standard error .15 %) and the light scattered once,
/// converged, found while loading. Units: km, radiance in 1/sr (solar irradiance 1).
#ifndef TOOLS_TRADE_TRUTH_H
#define TOOLS_TRADE_TRUTH_H

#include "metric.h"
#include "skyvert/atmosphere.h"
#include "tools/reference/convert.h"

enum { TRADE_DAY, TRADE_SUNSET, TRADE_TWILIGHT, TRADE_SUNS }; ///< the sun 40, 88.5, 94 deg from the zenith
enum { TRADE_GROUND, TRADE_12KM, TRADE_40KM, TRADE_HEIGHTS }; ///< of the observer
enum { TRADE_SINGLE, TRADE_FULL, TRADE_LIGHTS };              ///< light scattered once; all orders
enum { TRADE_SCENES = TRADE_SUNS * TRADE_HEIGHTS, TRADE_RAYS = 24 };

extern const char *const trade_sun_name[TRADE_SUNS];       ///< day, sunset, twilight
extern const char *const trade_height_name[TRADE_HEIGHTS]; ///< ground, 12 km, 40 km
extern const char *const trade_light_name[TRADE_LIGHTS];   ///< single, full
extern const double trade_sun_zenith_deg[TRADE_SUNS], trade_height_km[TRADE_HEIGHTS];

/// One observer, one sun.
typedef struct trade_scene {
    char name[32];   ///< "ground, day"
    int sun, height; ///< TRADE_DAY ..., TRADE_GROUND ...
    double height_km, sun_zenith_deg;
    float sun_enu[3];                                            ///< toward the sun, which stands in the south
    int n;                                                       ///< rays, at most TRADE_RAYS
    double view_zenith_deg[TRADE_RAYS], azimuth_deg[TRADE_RAYS]; ///< azimuth 0 is toward the sun
    float direction[TRADE_RAYS][3];                              ///< unit vectors, east-north-up
    int to_ground[TRADE_RAYS];                                   ///< 1: the ray ends on the ground
    double radiance[TRADE_LIGHTS][TRADE_RAYS][TRADE_BANDS];      ///< the truth, light of the ground included
    double noise[TRADE_RAYS][TRADE_BANDS];                       ///< standard error of the full light
} trade_scene;

typedef struct trade_truth {
    const char *air; ///< "br16", "br17o"
    char ini[256];   ///< its atmosphere file
    ref_file file;
    ref_float_tables tables;
    skv_atmosphere atmosphere; ///< as the library takes it; points into tables
    int bands;
    trade_scene scene[TRADE_SCENES]; ///< the sun changes fastest: scene[height * TRADE_SUNS + sun]
} trade_truth;

/// Airs that have a truth: "br16" (strong haze), "br17o" (clear, ozone); NULL at the end.
extern const char *const trade_airs[];

/// Reads root/tools/bench/AIR.ini and root/tools/trade/truth/AIR.csv and integrates the light scattered once (some
/// .1 s).
/// @param root  folder of the project; "." from there.
/// @return 0; 1 or 2 after one line on stderr `file:line: what` (1: an integral does not converge).
int trade_truth_load(trade_truth *truth, const char *root, const char *air);

/// East-north-up, the sun in the south; exact at multiples of 90 deg, as in `skyvert eval`.
void trade_direction(float direction[3], double zenith_deg, double azimuth_deg);

#endif
