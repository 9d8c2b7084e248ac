/// Private to src/scene: time as fixed-point angles, and what sun and moon share.
///
/// An angle is a skv_turn: 2^32 to the full circle, wrapping. An argument phase + rate * time is summed in 64-bit
/// turns, so that no float ever holds a large angle: in float the Greenwich sidereal time alone would be 0.35 deg off.
#ifndef SKV_SCENE_EPHEMERIS_H
#define SKV_SCENE_EPHEMERIS_H

#include <stdint.h>

#include "core/elementary.h"
#include "skyvert/sun.h"

/// Angle: 2^32 units to the circle.
typedef uint32_t skv_turn;

#define SKV_RAD_PER_DEG 0.0174532925f
#define SKV_DEG_PER_RAD 57.2957795f
/// Units of skv_turn.
#define SKV_TURN_PER_RAD   683565276.0f
#define SKV_TURN_PER_DEG   11930464.7f
#define SKV_RAD_PER_TURN   1.46291808e-9f
#define SKV_RAD_PER_ARCSEC 4.84813681e-6f
/// IAU 2012 Resolution B2.
#define SKV_AU_KM 149597871.0f

/// Turns * 2^64: at 2000-01-01 00:00 UTC, per day, per 2^-15 s.
typedef struct skv_argument {
    uint64_t base, per_day, per_tick;
} skv_argument;

typedef struct skv_linear_argument {
    skv_argument argument;
    float square; ///< skv_turn per century squared
} skv_linear_argument;

/// (amplitude + trend * centuries) * cos(argument)
typedef struct skv_harmonic {
    skv_argument argument;
    float amplitude, trend;
} skv_harmonic;

typedef enum skv_linear_name {
    SKV_MOON_LONGITUDE,
    SKV_MOON_ELONGATION,
    SKV_SUN_ANOMALY,
    SKV_MOON_ANOMALY,
    SKV_MOON_LATITUDE,
    SKV_MOON_NODE,
    SKV_VENUS_A1,
    SKV_JUPITER_A2,
    SKV_MOON_A3,
    SKV_EARTH_LONGITUDE,
    SKV_SIDEREAL,
    SKV_LINEAR_COUNT
} skv_linear_name;

enum { SKV_EARTH_LONGITUDE_TERMS = 27, SKV_EARTH_DISTANCE_TERMS = 8 };

extern const skv_linear_argument skv_linear[SKV_LINEAR_COUNT];
extern const skv_harmonic skv_earth_longitude[SKV_EARTH_LONGITUDE_TERMS];
extern const skv_harmonic skv_earth_distance[SKV_EARTH_DISTANCE_TERMS];

/// A checked moment.
typedef struct skv_instant {
    int32_t day;     ///< since 2000-01-01
    uint32_t ticks;  ///< of the day, 2^-15 s
    float centuries; ///< from J2000.0
} skv_instant;

/// From the mean ecliptic and equinox of date.
typedef struct skv_ecliptic {
    skv_turn longitude;
    float latitude_rad;
    float distance_km; ///< from the Earth's centre
} skv_ecliptic;

/// Nutation and obliquity of date.
typedef struct skv_equator {
    float nutation_rad; ///< in longitude
    skv_sincos obliquity;
} skv_equator;

/// What turns the ecliptic of date into the observer's horizon.
typedef struct skv_horizon {
    skv_equator equator;
    skv_sincos sidereal; ///< local apparent sidereal time
    skv_sincos latitude; ///< geodetic
    float north_km;      ///< of the observer, from the Earth's centre, along the local axes; the east part is 0
    float up_km;
} skv_horizon;

/// Direction and distance from the observer.
typedef struct skv_topocentric {
    float enu_km[3];
    float distance_km;
} skv_topocentric;

// time.c
skv_status skv_instant_from_utc(skv_instant *instant, const skv_utc *utc);
skv_turn skv_argument_at(const skv_argument *argument, const skv_instant *instant);
skv_turn skv_linear_at(skv_linear_name name, const skv_instant *instant);
float skv_harmonics_at(const skv_harmonic *harmonics, int count, const skv_instant *instant);
/// Nearest whole units of an angle that is small enough: |units| < 2^31.
skv_turn skv_turn_from_units(float units);
skv_turn skv_turn_from_deg(float deg); ///< |deg| <= 360
skv_sincos skv_sincos_of_turn(skv_turn turn);

// horizon.c
skv_equator skv_equator_at(const skv_instant *instant);
skv_status skv_horizon_at(skv_horizon *horizon, const skv_instant *instant, const skv_position *position);
skv_topocentric skv_to_horizon(const skv_horizon *horizon, const skv_ecliptic *body);
/// Unit direction; the distance must not be 0.
void skv_unit_enu(float direction_enu[3], const skv_topocentric *body);
float skv_azimuth_deg(const float direction_enu[3]);
float skv_elevation_deg(const float direction_enu[3]);

// sun.c
/// Geometric: without aberration.
skv_ecliptic skv_sun_ecliptic(const skv_instant *instant);

#endif
