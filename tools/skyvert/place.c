/// Positions, heights, standard air.
#include "place.h"

#include <math.h>

const char *const height_datum_names[] = {"msl", "ellipsoid", NULL};

skv_position place_to_skv(const place *at) {
    return (skv_position){(float)at->lat_deg, (float)at->lon_deg, (float)(at->ellipsoid_m / 1000)};
}

#ifdef SKV_HAVE_GEOGRAPHICLIB
#include "port/geographiclib/skv_geo.h"

int place_parse(const char *command, const char *text, double *lat_deg, double *lon_deg) {
    char why[SKV_GEO_MESSAGE];
    if (skv_geo_parse(text, lat_deg, lon_deg, why, sizeof why) != SKV_OK)
        return fail_usage("skyvert %s: --position: %s", command, why);
    return 0;
}

/// Opened with the first height that needs it.
static skv_geoid *geoid;
static bool geoid_sought;
static char geoid_problem[SKV_GEO_MESSAGE];

/// @return NULL, or why there is no undulation
static const char *undulation(const place *at, double *metres) {
    char path[4096];
    if (!geoid_sought) {
        geoid_sought = true;
        if (skv_geo_geoid_find(path, sizeof path, geoid_problem, sizeof geoid_problem) == SKV_OK)
            (void)skv_geo_geoid_open(path, &geoid, geoid_problem, sizeof geoid_problem);
    }
    if (!geoid)
        return geoid_problem;
    return skv_geo_undulation(geoid, at->lat_deg, at->lon_deg, metres) == SKV_OK ? NULL : "no such position";
}

void place_end(void) {
    skv_geo_geoid_close(geoid);
    geoid = NULL;
    geoid_sought = false;
}

#else

int place_parse(const char *command, const char *text, double *lat_deg, double *lon_deg) {
    (void)text, (void)lat_deg, (void)lon_deg;
    return fail_job(
        "skyvert %s: --position: this build lacks GeographicLib: install the package libgeographiclib-dev and "
        "make it again, or give --lat and --lon",
        command);
}

static const char *undulation(const place *at, double *metres) {
    (void)at, (void)metres;
    return "this build lacks GeographicLib (package libgeographiclib-dev)";
}

void place_end(void) {}

#endif

const char *place_set_height_roughly(place *at, double height_m, height_datum datum) {
    double n = 0;
    const char *const problem = undulation(at, &n);
    at->msl_m = datum == HEIGHT_MSL ? height_m : height_m - n;
    at->ellipsoid_m = datum == HEIGHT_MSL ? height_m + n : height_m;
    return problem;
}

int place_set_height(place *at, double height_m, height_datum datum) {
    static bool said;
    const char *const problem = place_set_height_roughly(at, height_m, datum);
    if (problem && !said)
        fail_usage("note: heights above the sea and above the ellipsoid count as equal: %s", problem);
    said = said || problem;
    return 0;
}

/// US Standard Atmosphere 1976 [USSA76]: layers of constant lapse rate by geopotential height.
void standard_air(double msl_m, double *pressure_hpa, double *temperature_c) {
    static const struct {
        double base_m, lapse_k_per_m;
    } layer[] = {{0, -.0065}, {11000, 0}, {20000, .001}, {32000, .0028}, {47000, 0}, {51000, -.0028}, {71000, -.002}};
    enum { LAYERS = sizeof layer / sizeof layer[0] };
    const double top_m = 84852, g_over_r = .0341631947, earth_m = 6356766; // K/m; radius of the geopotential height
    const double z = fmin(fmax(msl_m, -5000), 1e6), h = fmin(z * earth_m / (earth_m + z), top_m);
    double t = 288.15, p = 1013.25;
    for (int i = 0; i < LAYERS && (i == 0 || h > layer[i].base_m); i++) {
        const double end = i + 1 < LAYERS && h > layer[i + 1].base_m ? layer[i + 1].base_m : h;
        const double t_end = t + layer[i].lapse_k_per_m * (end - layer[i].base_m);
        p *= layer[i].lapse_k_per_m < 0 || layer[i].lapse_k_per_m > 0
                 ? pow(t / t_end, g_over_r / layer[i].lapse_k_per_m)
                 : exp(-g_over_r * (end - layer[i].base_m) / t);
        t = t_end;
    }
    *pressure_hpa = z * earth_m / (earth_m + z) > top_m ? 0 : p; // above 86 km nothing is left that bends light
    *temperature_c = t - 273.15;
}
