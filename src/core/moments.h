/// Legendre moments of the phase functions, and the aureole: light scattered forward twice.
#ifndef SKV_CORE_MOMENTS_H
#define SKV_CORE_MOMENTS_H

#include "core/lanes.h"

/// Moment of degree l >= 0: Henyey-Greenstein g^l; Cornette-Shanks from x^2 P_l = A P_(l+2) + B P_l + C P_(l-2).
static inline float skv_moment(int cornette_shanks, float g, int l) {
    float power[8]; // g^0 ... g^7
    power[0] = 1.0f;
    for (int i = 1; i < 8; i++)
        power[i] = power[i - 1] * g;
    if (!cornette_shanks)
        return power[l];
    const float x = (float)l;
    const float up = (x + 1.0f) * (x + 2.0f) / ((2.0f * x + 1.0f) * (2.0f * x + 3.0f));
    const float same = (2.0f * x * x + 2.0f * x - 1.0f) / ((2.0f * x - 1.0f) * (2.0f * x + 3.0f));
    const float down = l < 2 ? 0.0f : x * (x - 1.0f) / ((2.0f * x - 1.0f) * (2.0f * x + 1.0f)) * power[l - 2];
    return 1.5f / (2.0f + g * g) * (power[l] + up * power[l + 2] + same * power[l] + down);
}

static inline float skv_third_root(float x) {
    return x > 1e-30f ? skv_exp2f(skv_log2f(x) * (1.0f / 3.0f)) : 0.0f;
}

/// Degrees 3 and up of Henyey-Greenstein's function of g >= 0: what light that was scattered forward twice looks like
/// about its source beside the degrees that a table keeps.
/// @param near  1 - nu.
SKV_INLINE float skv_aureole(float g, float near) {
    const float d = (1.0f - g) * (1.0f - g) + 2.0f * g * near, nu = 1.0f - near;
    const float whole = ((1.0f - g) * (1.0f + g)) / (d * skv_root(d));
    return 0.0795774715f * (whole - (1.0f + 3.0f * g * nu + 2.5f * g * g * (3.0f * nu * nu - 1.0f)));
}

#endif
