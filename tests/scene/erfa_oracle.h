/// Sun and moon by ERFA in double: what the float code is measured against. It shares no code and no series with it but
/// the moon's (eraMoon98 is the full form of [Meeus98] ch. 47; tests/scene/moon_ephem.sh brings another theory).
#ifndef TESTS_SCENE_ERFA_ORACLE_H
#define TESTS_SCENE_ERFA_ORACLE_H

#include "skyvert/sun.h"

typedef struct oracle_body {
    double enu[3]; ///< unit, geometric, topocentric
    double distance_km;
} oracle_body;

typedef struct oracle_sky {
    oracle_body sun, moon;
    double phase_angle_rad;
} oracle_sky;

/// DUT1, polar motion and air are 0. The leap seconds are ERFA's.
oracle_sky oracle_at(const skv_utc *utc, const skv_position *position);

/// Angle between two vectors, rad; exact for small ones.
double oracle_angle(const double a[3], const double b[3]);

#endif
