/// Shape of a disc at a distance from its centre.
#ifndef SKV_SCENE_DISC_H
#define SKV_SCENE_DISC_H

#include "skyvert/disc.h"

#include "core/elementary.h"

/// Least cosine of emission in the moon's law: it keeps the outermost thousandth of the radius smooth.
#define SKV_DISC_MU_MIN 0.05f

/// 1 inside, 0 outside, a smooth step between.
static inline float skv_disc_edge(const skv_disc *disc, float c) {
    const float width = disc->edge[1] - disc->edge[0];
    if (!(width > 0.0f))
        return c <= disc->radius ? 1.0f : 0.0f;
    const float t = skv_clampf((disc->edge[1] - c) / width, 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

/// Cosine of emission; 0 beyond the limb.
static inline float skv_disc_mu(const skv_disc *disc, float c) {
    const float x = c / disc->radius;
    return skv_sqrtf(1.0f - x * x);
}

static inline float skv_disc_sun_shape(const float a[6], float mu) {
    return a[0] + mu * (a[1] + mu * (a[2] + mu * (a[3] + mu * (a[4] + mu * a[5]))));
}

/// 2 mu0/(mu0 + mu), before it is scaled to mean 1; `toward` is the distance from the centre toward the bright limb, in
/// radii.
static inline float skv_disc_moon_shape(const skv_disc *disc, float toward, float mu) {
    const float z = skv_maxf(mu, SKV_DISC_MU_MIN);
    const float mu0 = toward * disc->limb[0][1] + z * disc->limb[0][0];
    return mu0 > 0.0f ? 2.0f * mu0 / (mu0 + z) : 0.0f;
}

#endif
