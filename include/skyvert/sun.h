/// Time and the directions of sun and moon, in float.
///
/// Time is a whole day and float seconds of that day: one float of days would put the sun 0.35 deg off.
/// Angles are in degrees where the name says so; azimuth is clockwise from north; directions are east-north-up.
#ifndef SKYVERT_SUN_H
#define SKYVERT_SUN_H

#include <stdint.h>

#include "skyvert/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/// UTC. Valid for the sun and the moon: years 1900 to 2100, best 2020 to 2050.
typedef struct skv_utc {
    int32_t day;   ///< since 2000-01-01, may be negative; [-36525, 36890]
    float seconds; ///< of the day, [0, 86401)
} skv_utc;

/// Gregorian calendar to skv_utc.
/// @return SKV_OK; SKV_ERR_NULL; SKV_ERR_RANGE iff there is no such date or time (year 1900 to 2100; second < 61, a leap
///         second only at 23:59).
skv_status skv_utc_from_calendar(skv_utc *utc, int year, int month, int day, int hour, int minute, float second);

/// Geodetic position.
typedef struct skv_position {
    float lat_deg;   ///< [-90, 90]
    float lon_deg;   ///< [-360, 360], east positive
    float height_km; ///< above the ellipsoid, [-12, 1000000]; only the moon's parallax depends on it
} skv_position;

typedef struct skv_sun {
    float direction_enu[3]; ///< unit, geometric (no refraction), topocentric
    float azimuth_deg;      ///< [0, 360)
    float elevation_deg;    ///< [-90, 90], geometric
    float distance_au;
} skv_sun;

typedef struct skv_moon {
    float direction_enu[3]; ///< unit, geometric, topocentric (parallax included)
    float azimuth_deg;
    float elevation_deg;
    float distance_km;          ///< from the observer
    float phase_angle_deg;      ///< sun-moon-observer, 0 = full, 180 = new
    float illuminated_fraction; ///< [0, 1]
} skv_moon;

/// Sun seen from a position. Source: [Blanco20] (PSA, 2020 coefficients), adapted to split float time.
/// Error: see src/scene/sun.c; measured by tests/api/test_sun.c against ERFA.
/// @return SKV_OK; SKV_ERR_NULL; SKV_ERR_RANGE. On error nothing is written.
skv_status skv_sun_at(skv_sun *sun, const skv_utc *utc, const skv_position *position);

/// Moon seen from a position. Error <= 0.1 deg against [source in src/scene/moon.c].
skv_status skv_moon_at(skv_moon *moon, const skv_utc *utc, const skv_position *position);

/// Refraction to add to a geometric elevation, degrees. Source: [Saemundsson86], scaled by pressure and temperature.
/// Below -1 deg geometric elevation the value fades linearly to 0 at -5 deg (the formula is not valid there).
/// @param[in] pressure_hpa [0, 2000]; temperature_c [-100, 100]; elevation_deg [-90, 90].
/// @return the refraction, >= 0; 0 for a parameter out of range or NaN.
float skv_refraction_deg(float elevation_deg, float pressure_hpa, float temperature_c);

#ifdef __cplusplus
}
#endif
#endif
