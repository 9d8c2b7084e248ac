/// Distances and altitudes along a straight ray over a sphere, in forms that do not cancel.
///
/// A ray starts at altitude h above a ground of radius R, r = R + h, with cos zenith angle mu. Instead of mu the forms
/// carry rm = r mu, which is linear along the ray: rm(s) = rm + s; likewise r mu_s (s) = r mu_s + s nu.
#ifndef SKV_CORE_GEOMETRY_H
#define SKV_CORE_GEOMETRY_H

#include "core/elementary.h"

/// E = r(s)^2 - R^2 = h(2R+h) + s(2 rm + s); altitude = E/(R + sqrt(R^2 + E)).
SKV_INLINE float skv_altitude(float radius, float e, float *r) {
    const float q = skv_root(radius * radius + e);
    *r = q;
    return e / (radius + q);
}

/// Distance to the sphere of altitude top from below: root of s^2 + 2 rm s = c, c = (top-h)(2R+top+h).
SKV_INLINE float skv_to_top(float radius, float top, float h, float rm) {
    const float c = skv_maxf(0.0f, top - h) * (2.0f * radius + top + h);
    const float q = skv_root(rm * rm + c);
    return rm > 0.0f ? c / (rm + q) : q - rm;
}

/// Unit vector of any finite one that is neither 0 nor subnormal. @return whether it is such.
static inline int skv_unit(const float v[3], float out[3]) {
    const float m = skv_maxf(skv_maxf(skv_fabsf(v[0]), skv_fabsf(v[1])), skv_fabsf(v[2]));
    if (!skv_isfinite(v[0]) || !skv_isfinite(v[1]) || !skv_isfinite(v[2]) || !(m >= 1.17549435e-38f))
        return 0;
    const float x = v[0] / m, y = v[1] / m, z = v[2] / m, norm = 1.0f / skv_sqrtf(x * x + y * y + z * z);
    out[0] = x * norm;
    out[1] = y * norm;
    out[2] = z * norm;
    return 1;
}

#endif
