/// Phase functions, 1/sr, normalised to 1 over the sphere. nu = cos angle between view and light direction.
#ifndef SKV_CORE_PHASE_H
#define SKV_CORE_PHASE_H

#include "core/elementary.h"

/// Rayleigh without depolarisation: 3/(16 pi) (1 + nu^2).
SKV_INLINE float skv_phase_rayleigh(float nu) {
    return 0.0596831037f * (1.0f + nu * nu);
}

/// d = 1 + g^2 - 2 g nu of Henyey-Greenstein, without cancellation at |g| -> 1.
/// @param near  1 - nu = |v-s|^2/2 for g >= 0, 1 + nu = |v+s|^2/2 for g < 0.
SKV_INLINE float skv_phase_distance(float g, float near) {
    const float a = skv_fabsf(g);
    return (1.0f - a) * (1.0f - a) + 2.0f * a * near;
}

/// [Henyey41]: (1-g^2)/(4 pi d^1.5).
SKV_INLINE float skv_phase_henyey_greenstein(float g, float d) {
    return 0.0795774715f * ((1.0f - g) * (1.0f + g)) / (d * skv_root(d));
}

/// [Cornette92]: 3/(8 pi) (1-g^2)(1+nu^2)/((2+g^2) d^1.5).
SKV_INLINE float skv_phase_cornette_shanks(float g, float d, float nu) {
    return 0.119366207f * ((1.0f - g) * (1.0f + g)) * (1.0f + nu * nu) / ((2.0f + g * g) * (d * skv_root(d)));
}

#endif
