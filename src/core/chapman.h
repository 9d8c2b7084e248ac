/// Column of an exponential atmosphere around a sphere, in closed form [Chapman31], by erfcx. For mu >= 0, X = r/H:
///
///     col = H rho sqrt(pi X/2)/sin * erfcx(y) * (1 + 3/(8X) sin^8),   y = sqrt(X/2) mu/sin      (3e-4 at X = 800)
///
/// With erfcx(y) = t p(t), t = 1/(1 + c y) = sin/(sin + c sqrt(X/2) mu), the zenith needs no special case.
#ifndef SKV_CORE_CHAPMAN_H
#define SKV_CORE_CHAPMAN_H

#include "core/elementary.h"

/// erfcx at mu = 0, p(1).
#define SKV_ERFCX_AT_0 skv_erfcx_poly(1.0f)

SKV_INLINE float skv_power8(float x) {
    const float x2 = x * x, x4 = x2 * x2;
    return x4 * x4;
}

/// col/(H sqrt(pi) k sqrt(r) rho), k = 1/sqrt(2H).
/// @param ckr  SKV_ERFCX_C k sqrt(r)
/// @param z    3H/8
/// @param s8r  sin^8/r
SKV_INLINE float skv_chapman(float ckr, float z, float mu, float sin_chi, float s8r) {
    const float inv = 1.0f / (sin_chi + ckr * mu);
    return inv * skv_erfcx_poly(sin_chi * inv) * (1.0f + z * s8r);
}

#endif
