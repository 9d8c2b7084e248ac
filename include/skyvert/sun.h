/// Time and the directions of sun and moon, in float.
///
/// Time is a whole day and float seconds of that day: one float of days would put the sun 0.35 deg off. Inside, angles
/// are fixed-point turns, so a float never holds more than an eighth of a circle.
/// Angles are in degrees where the name says so; azimuth is clockwise from north; directions are east-north-up, up
/// along the normal of the ellipsoid (WGS84).
///
/// UT1 is taken as UTC: they differ by 0.9 s at most while there are leap seconds, which is 0.004 deg of the Earth's
/// turning. TT - UTC is taken as 69.184 s, right since 2017: 10 s more or less are 0.0001 deg of the sun, 0.0015 deg of
/// the moon.
#ifndef SKYVERT_SUN_H
#define SKYVERT_SUN_H

#include <stdint.h>

#include "skyvert/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/// UTC. Valid for the sun and the moon: years 1900 to 2100 (and a day on either side), best 2020 to 2050.
/// A float of seconds has steps of 0.008 s late in the day: the sky turns 0.00003 deg in one.
typedef struct skv_utc {
    int32_t day;   ///< since 2000-01-01, may be negative; [-36525, 36890]
    float seconds; ///< of the day, [0, 86401): from 86400 on it is the leap second
} skv_utc;

/// Gregorian calendar to skv_utc. Any day may have a leap second; there is no table of them. A time that would round up
/// to the next day, or into the leap second, stays before it (23:59:59.999 becomes 86399.992 s).
/// @param[out] utc
/// @param[in]  year    [1900, 2100].
/// @param[in]  month   [1, 12].
/// @param[in]  day     [1, days of that month].
/// @param[in]  hour    [0, 23].
/// @param[in]  minute  [0, 59].
/// @param[in]  second  [0, 60); at 23:59 [0, 61).
/// @return SKV_OK; SKV_ERR_NULL iff utc is NULL; SKV_ERR_RANGE iff there is no such date or time, or second is NaN.
///         On error nothing is written.
skv_status skv_utc_from_calendar(skv_utc *utc, int year, int month, int day, int hour, int minute, float second);

/// Gregorian date and time of day, UTC.
typedef struct skv_calendar {
    int32_t year, month, day;
    int32_t hour, minute;
    float second; ///< [0, 61)
} skv_calendar;

/// The inverse of skv_utc_from_calendar().
/// @param[out] calendar
/// @param[in]  utc       seconds from 86400 on give 23:59:60.
/// @return SKV_OK; SKV_ERR_NULL; SKV_ERR_RANGE iff a field of utc is out of range or NaN. On error nothing is written.
skv_status skv_utc_to_calendar(skv_calendar *calendar, const skv_utc *utc);

/// Geodetic position. At a pole, east and north are what they become along the meridian of lon_deg.
typedef struct skv_position {
    float lat_deg;   ///< [-90, 90]
    float lon_deg;   ///< [-360, 360], east positive
    float height_km; ///< above the ellipsoid, [-12, 1000000]; only the parallax of sun and moon depends on it
} skv_position;

typedef struct skv_sun {
    float direction_enu[3]; ///< unit, geometric (no refraction), topocentric
    float azimuth_deg;      ///< [0, 360)
    float elevation_deg;    ///< [-90, 90], geometric
    float distance_au;      ///< from the observer
} skv_sun;

typedef struct skv_moon {
    float direction_enu[3];     ///< unit, geometric, topocentric (parallax included)
    float azimuth_deg;          ///< [0, 360)
    float elevation_deg;        ///< [-90, 90], geometric
    float distance_km;          ///< from the observer
    float phase_angle_deg;      ///< sun-moon-observer, [0, 180]: 0 = full, 180 = new
    float illuminated_fraction; ///< of the disc, [0, 1]
} skv_moon;

/// The centre of the sun seen from a position: parallax, light time, annual and diurnal aberration included.
/// @param[out] sun
/// @param[in]  utc
/// @param[in]  position
/// @return SKV_OK; SKV_ERR_NULL; SKV_ERR_RANGE iff a field of utc or position is out of range, infinite or NaN.
///         On error nothing is written.
/// Source: [Bretagnon88] (24 terms), [Petit10] (sidereal time, obliquity), [Meeus98] (five terms of nutation).
/// Error:  on the sphere 0.001 deg over 2020-2050 and over 1900-2100, distance 3e-5 au, against ERFA at DUT1 = 0 (0.005
///         deg with DUT1); 0.004 deg where the host rounds otherwise than to nearest. Measured by
///         tests/scene/test_ephemeris.c.
/// Cost:   45 sines and cosines, 4,900 x86-64 instructions; stack <= 400 bytes, no allocation. Thread-safe: no hidden
///         state.
skv_status skv_sun_at(skv_sun *sun, const skv_utc *utc, const skv_position *position);

/// The centre of the moon seen from a position, as skv_sun_at().
/// @return as skv_sun_at(); SKV_ERR_RANGE also iff the position is inside the moon.
/// Source: [Meeus98] ch. 47, its 39 and 29 largest terms and the planets'; [Chapront83] is behind it.
/// Error:  on the sphere 0.010 deg over 2020-2050 and 0.015 deg over 1900-2100, distance 40 km, phase angle 0.015 deg,
///         against ERFA at DUT1 = 0. Measured by tests/scene/test_ephemeris.c.
/// Cost:   125 sines and cosines, 13,700 x86-64 instructions; stack <= 500 bytes.
skv_status skv_moon_at(skv_moon *moon, const skv_utc *utc, const skv_position *position);

/// Refraction to add to a geometric elevation, degrees. Source: [Saemundsson86], scaled by pressure and temperature.
/// Below -1 deg geometric elevation the value fades linearly to 0 at -5 deg (the formula is not valid there, and
/// nothing above the horizon of an observer on the ground is seen from so far below). Continuous; geometric plus
/// refraction rises with the geometric elevation and never exceeds 90 deg.
/// @param[in] elevation_deg  geometric, [-90, 90].
/// @param[in] pressure_hpa   at the observer, [0, 2000]; 0 gives 0.
/// @param[in] temperature_c  at the observer, [-100, 100].
/// @return the refraction, >= 0; 0 for a parameter out of range or NaN.
float skv_refraction_deg(float elevation_deg, float pressure_hpa, float temperature_c);

#ifdef __cplusplus
}
#endif
#endif
