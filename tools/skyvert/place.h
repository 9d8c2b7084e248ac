/// Positions and heights of sun, render and track: text to numbers, sea level to ellipsoid and back.
#ifndef SKYVERT_PLACE_H
#define SKYVERT_PLACE_H

#include "command.h"

typedef enum height_datum { HEIGHT_MSL = 0, HEIGHT_ELLIPSOID = 1 } height_datum;
extern const char *const height_datum_names[]; ///< for option_choice(): msl, ellipsoid

enum { HEIGHT_LOW_M = -12000, HEIGHT_HIGH_M = 1000000000 };

typedef struct place {
    double lat_deg, lon_deg;
    double msl_m;       ///< above the sea
    double ellipsoid_m; ///< above the WGS 84 ellipsoid
} place;

/// `--position TEXT` in any of GeographicLib's forms. @return 0; 2 after an error line; 1 iff this build lacks
/// GeographicLib
int place_parse(const char *command, const char *text, double *lat_deg, double *lon_deg);
/// Sets both heights from one of them. Without a geoid grid they count as equal, which one line on stderr says, once.
/// @return 0
int place_set_height(place *at, double height_m, height_datum datum);
/// The same without the line, for where 100 m do not matter. @return NULL, or why the heights are equal
const char *place_set_height_roughly(place *at, double height_m, height_datum datum);
/// Frees the geoid grid that place_set_height() keeps.
void place_end(void);
skv_position place_to_skv(const place *at);

/// Pressure and temperature of the standard atmosphere (US 1976) at a height above the sea.
void standard_air(double msl_m, double *pressure_hpa, double *temperature_c);

#endif
