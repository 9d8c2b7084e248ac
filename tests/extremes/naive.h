/// The textbook's way, for comparison: points as vectors from the planet's centre, the sphere by b^2 - c, altitude as
/// |p| - R, uniform steps along the ray and towards the sun, Henyey-Greenstein by 1 + g^2 - 2 g nu. The same source
/// compiled in float and in double tells what the rounding does from what the steps do.
#ifndef TESTS_EXTREMES_NAIVE_H
#define TESTS_EXTREMES_NAIVE_H

#include "skyvert/atmosphere.h"

#define NAIVE_VIEW_STEPS 256
#define NAIVE_SUN_STEPS  64

/// Light scattered once, per band; nothing is checked. Densities: exponential, with background, tent.
void naive_float(const skv_atmosphere *a, float ground_km, float observer_km, const float view[3], const float sun[3],
                 double radiance[4]);
void naive_double(const skv_atmosphere *a, float ground_km, float observer_km, const float view[3], const float sun[3],
                  double radiance[4]);

#endif
