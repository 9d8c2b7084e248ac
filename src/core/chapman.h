/// Column of an exponential atmosphere around a sphere, in closed form [Chapman31], by erfcx. For mu >= 0, X = r/H:
///
///     col = H rho sqrt(pi X/2)/sin * erfcx(y) * (1 + 3/(8X) sin^8),   y = sqrt(X/2) mu/sin      (3e-4 at X = 800)
///
/// With erfcx(y) = t p(t), t = 1/(1 + c y) = sin/(sin + c sqrt(X/2) mu), the zenith needs no special case.
#ifndef SKV_CORE_CHAPMAN_H
#define SKV_CORE_CHAPMAN_H

#include "core/elementary.h"

/// col/(rho a) with a = H sqrt(pi) k, k = 1/sqrt(2H), z = 3H/8.
SKV_INLINE float skv_chapman(float k, float z, float root_r, float inv_r, float mu, float sin_chi) {
    const float inv = 1.0f / (sin_chi + SKV_ERFCX_C * k * root_r * mu);
    const float s2 = sin_chi * sin_chi, s4 = s2 * s2;
    return root_r * inv * skv_erfcx_poly(sin_chi * inv) * (1.0f + z * (s4 * s4) * inv_r);
}

#endif
