#include "moment.h"

#include <math.h>
#include <string.h>

#include "skyvert/moonlight.h"

// clang-format off
const char moment_options_help[] =
    "Where and when:\n"
    "  --position TEXT        decimal degrees, degrees minutes seconds, UTM or MGRS: \"47:27:32N 8:32:2E\"\n"
    "  --lat D --lon D        instead: degrees, north and east positive\n"
    "  --height-m M           of the observer (default 2 m above the ground)\n"
    "  --height-datum msl|ellipsoid  what --height-m is above (default msl, the sea)\n"
    "  --utc TIME             2021-08-17T04:30:00Z\n"
    "  --sun-zenith-deg Z --sun-azimuth-deg A   place the sun by hand: 0 to 180 from the zenith, clockwise\n"
    "                         from north (default 180); then neither position nor time is needed\n"
    "  --moon-zenith-deg Z --moon-azimuth-deg A   place the moon by hand (azimuth 0 without it), as far from the\n"
    "                         Earth as it is on average; its phase follows from where the sun stands\n"
    "Sun and moon are where geometry puts them: refraction is not applied.\n";
// clang-format on

void moment_options_begin(moment_options *options, const char *command) {
    memset(options, 0, sizeof *options);
    options->command = command;
    options->sun_azimuth_deg = 180.0;
}

static int take_utc(moment_options *options, const char *value) {
    const char *problem = utc_parse(value, &options->utc);
    if (problem)
        return fail_usage("skyvert %s: --utc '%.60s': %s", options->command, value, problem);
    options->has_utc = true;
    return 0;
}

static int take_number(const char *command, const char *option, const char *value, double low, double high, double *out,
                       bool *given) {
    const int status = option_number(command, option, value, low, high, out);
    *given = status == 0;
    return status;
}

int moment_options_take(moment_options *options, int option, const char *value) {
    const char *const command = options->command;
    switch (option) {
    case OPT_POSITION:
        options->position = value;
        return 0;
    case OPT_LAT:
        return take_number(command, "--lat", value, -90.0, 90.0, &options->lat_deg, &options->has_lat);
    case OPT_LON:
        return take_number(command, "--lon", value, -180.0, 360.0, &options->lon_deg, &options->has_lon);
    case OPT_HEIGHT_M:
        return take_number(command, "--height-m", value, HEIGHT_LOW_M, HEIGHT_HIGH_M, &options->height_m,
                           &options->has_height);
    case OPT_HEIGHT_DATUM:
        return option_choice(command, "--height-datum", value, height_datum_names, &options->datum);
    case OPT_UTC:
        return take_utc(options, value);
    case OPT_SUN_ZENITH:
        return take_number(command, "--sun-zenith-deg", value, 0.0, 180.0, &options->sun_zenith_deg,
                           &options->has_sun_zenith);
    case OPT_SUN_AZIMUTH:
        return take_number(command, "--sun-azimuth-deg", value, -360.0, 360.0, &options->sun_azimuth_deg,
                           &options->has_sun_azimuth);
    case OPT_MOON_ZENITH:
        return take_number(command, "--moon-zenith-deg", value, 0.0, 180.0, &options->moon_zenith_deg,
                           &options->has_moon_zenith);
    case OPT_MOON_AZIMUTH:
        return take_number(command, "--moon-azimuth-deg", value, -360.0, 360.0, &options->moon_azimuth_deg,
                           &options->has_moon_azimuth);
    default:
        return -1;
    }
}

static int settle_position(const moment_options *options, moment *out) {
    if (options->position && (options->has_lat || options->has_lon))
        return fail_usage("skyvert %s: --position or --lat and --lon, not both", options->command);
    if (options->has_lat != options->has_lon)
        return fail_usage("skyvert %s: --lat and --lon go together", options->command);
    out->has_position = options->has_lat || options->position;
    out->at.lat_deg = options->lat_deg;
    out->at.lon_deg = options->lon_deg;
    return options->position ? place_parse(options->command, options->position, &out->at.lat_deg, &out->at.lon_deg) : 0;
}

int moment_set_height(place *at, double height_m, height_datum datum) {
    at->msl_m = at->ellipsoid_m = height_m; // their difference moves the sun by less than a thousandth of
                                            // an arc second
    return datum == HEIGHT_MSL ? 0 : place_set_height(at, height_m, datum);
}

static int settle_height(const moment_options *options, double ground_m, moment *out) {
    if (options->has_height && options->datum == HEIGHT_ELLIPSOID && !out->has_position)
        return fail_usage("skyvert %s: --height-datum ellipsoid needs a position", options->command);
    if (!options->has_height)
        return moment_set_height(&out->at, ground_m + 2.0, HEIGHT_MSL);
    return moment_set_height(&out->at, options->height_m, (height_datum)options->datum);
}

static const double degree = 3.14159265358979323846 / 180.0;

static void direction_of(double zenith_deg, double azimuth_deg, float enu[3]) {
    const double z = zenith_deg * degree, a = azimuth_deg * degree;
    enu[0] = (float)(sin(z) * sin(a));
    enu[1] = (float)(sin(z) * cos(a));
    enu[2] = (float)cos(z);
}

static double positive_azimuth(double azimuth_deg) {
    return azimuth_deg < 0.0 ? azimuth_deg + 360.0 : azimuth_deg;
}

static void place_sun(moment *now, double zenith_deg, double azimuth_deg) {
    now->sun_azimuth_deg = positive_azimuth(azimuth_deg);
    now->sun_elevation_deg = 90.0 - zenith_deg;
    now->sun_distance_au = 1.0;
    direction_of(zenith_deg, azimuth_deg, now->sun_enu);
}

/// At its mean distance; the angle sun-moon-observer from the triangle of the three.
static void place_moon(moment *now, double zenith_deg, double azimuth_deg) {
    const double distance_km = 384400.0, au_km = 149597870.7;
    skv_moon *const moon = &now->moon;
    direction_of(zenith_deg, azimuth_deg, moon->direction_enu);
    double cosine = 0.0;
    for (int i = 0; i < 3; i++)
        cosine += (double)moon->direction_enu[i] * (double)now->sun_enu[i];
    cosine = fmax(-1.0, fmin(1.0, cosine));
    const double sun_km = au_km * now->sun_distance_au;
    const double phase = atan2(sun_km * sqrt(1.0 - cosine * cosine), distance_km - sun_km * cosine);
    moon->azimuth_deg = (float)positive_azimuth(azimuth_deg);
    moon->elevation_deg = (float)(90.0 - zenith_deg);
    moon->distance_km = (float)distance_km;
    moon->phase_angle_deg = (float)(phase / degree);
    moon->illuminated_fraction = (float)(0.5 + 0.5 * cos(phase));
    now->has_moon = true;
}

int moment_find_lights(moment *now, const char *command) {
    const skv_utc utc = utc_to_skv(&now->utc);
    const skv_position position = place_to_skv(&now->at);
    skv_sun sun;
    if (skv_sun_at(&sun, &utc, &position) != SKV_OK)
        return fail_usage("skyvert %s: no sun for this time and place: years 1900 to 2100", command);
    memcpy(now->sun_enu, sun.direction_enu, sizeof now->sun_enu);
    now->sun_azimuth_deg = (double)sun.azimuth_deg;
    now->sun_elevation_deg = (double)sun.elevation_deg;
    now->sun_distance_au = (double)sun.distance_au;
    now->has_moon = skv_moon_at(&now->moon, &utc, &position) == SKV_OK && // not from beside it
                    now->moon.distance_km > 3000.0f && now->moon.distance_km < 1e7f;
    if (now->has_moon)
        now->moon_side = skv_moon_side(now->moon.direction_enu, now->sun_enu, position.lat_deg);
    return 0;
}

static int settle_sun(const moment_options *options, moment *out) {
    if (options->has_sun_zenith) {
        place_sun(out, options->sun_zenith_deg, options->sun_azimuth_deg);
        return 0;
    }
    if (!out->has_position)
        return fail_usage("skyvert %s: where? --position, or --lat and --lon, or --sun-zenith-deg", options->command);
    if (!out->has_utc)
        return fail_usage("skyvert %s: when? --utc, or --sun-zenith-deg", options->command);
    return moment_find_lights(out, options->command);
}

int moment_options_finish(const moment_options *options, double ground_m, moment *out) {
    memset(out, 0, sizeof *out);
    out->has_utc = options->has_utc;
    out->utc = options->utc;
    int status = settle_position(options, out);
    if (status == 0)
        status = settle_height(options, ground_m, out);
    if (status != 0)
        return status;
    if (options->has_sun_azimuth && !options->has_sun_zenith)
        return fail_usage("skyvert %s: --sun-azimuth-deg goes with --sun-zenith-deg", options->command);
    if (options->has_moon_azimuth && !options->has_moon_zenith)
        return fail_usage("skyvert %s: --moon-azimuth-deg goes with --moon-zenith-deg", options->command);
    status = settle_sun(options, out);
    if (status == 0 && options->has_moon_zenith) {
        out->moon_side = 0;
        place_moon(out, options->moon_zenith_deg, options->moon_azimuth_deg);
    }
    return status;
}
