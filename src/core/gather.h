/// Gathering the radiance that arrives at a cell, and the numbers of degrees 0 to 2 that stand for it.
#ifndef SKV_CORE_GATHER_H
#define SKV_CORE_GATHER_H

#include "core/cells.h"
#include "core/gauss_legendre.h"
#include "core/moments.h"

/// Integrals over all directions of radiance times: 1, mu, sin cos(phi), P2, 3 mu sin cos(phi), 3 sin^2 cos(2 phi), and
/// max(mu, 0).
enum { SKV_GATHER_DOWN = 6, SKV_GATHER_MOMENTS = 7 };

/// Below this sine of its elevation the light counts as standing there: the middle of the glow that it leaves.
#define SKV_AUREOLE_LOWEST 0.06f

/// A gathered direction; the light is at azimuth 0.
typedef struct skv_gather_ray {
    float direction[3];
    float cos_phi;
    float weight; ///< solid angle, both half circles
} skv_gather_ray;

/// The directions of a cell.
typedef struct skv_gather_fan {
    float horizon;       ///< cosine of the zenith angle of the geometric horizon
    int polar, azimuths; ///< twice and once so many
    int even;            ///< azimuths are evenly spaced
    int dark;            ///< nothing that is lit is seen below the horizon
} skv_gather_fan;

/// Polar angles mu = horizon +- range t^2, t by Gauss-Legendre; in the dark none are below the horizon, and each half
/// of t above it has its own: after sunset the light comes from some degrees above the horizon. Azimuths crowd towards
/// the light, phi = pi t^1.5, but for a light high up, where evenly spaced ones are exact for harmonics.
static inline skv_gather_ray skv_gather_direction(const skv_gather_fan *fan, int index) {
    const int ip = index / fan->azimuths, ia = index % fan->azimuths, first = ip < fan->polar, up = first || fan->dark;
    const int at = skv_gauss_offset(fan->polar) + (first ? ip : ip - fan->polar);
    const int az = skv_gauss_offset(fan->azimuths) + ia;
    const float part = fan->dark ? 0.5f : 1.0f, from = fan->dark && !first ? 0.5f : 0.0f;
    const float t = from + part * skv_gauss_node[at], u = skv_gauss_node[az], root = skv_sqrtf(u);
    const float range = up ? 1.0f - fan->horizon : 1.0f + fan->horizon;
    const float mu = fan->horizon + (up ? range : -range) * t * t;
    const float sin_theta = skv_sqrtf(skv_maxf((1.0f - mu) * (1.0f + mu), 0.0f));
    const float whole = 1.0f / (float)fan->azimuths;
    const skv_sincos phi = skv_sincosf(SKV_PI * (fan->even ? ((float)ia + 0.5f) * whole : u * root));
    skv_gather_ray ray = {{sin_theta * phi.cos, sin_theta * phi.sin, mu}, phi.cos, 0.0f};
    ray.weight = 4.0f * SKV_PI * t * range * part * skv_gauss_weight[at] *
                 (fan->even ? whole : 1.5f * root * skv_gauss_weight[az]);
    return ray;
}

/// What radiance from a direction counts in each integral.
static inline void skv_gather_factors(const skv_gather_ray *ray, float factor[SKV_GATHER_MOMENTS]) {
    const float mu = ray->direction[2], x = ray->direction[0], s2 = skv_maxf(1.0f - mu * mu, 0.0f);
    factor[0] = 1.0f;
    factor[1] = mu;
    factor[2] = x;
    factor[3] = 1.5f * mu * mu - 0.5f;
    factor[4] = 3.0f * mu * x;
    factor[5] = 3.0f * s2 * (2.0f * ray->cos_phi * ray->cos_phi - 1.0f);
    factor[SKV_GATHER_DOWN] = skv_maxf(mu, 0.0f);
}

/// Six numbers: mean radiance and the coefficients of degrees 1 and 2 (diffuse.c).
static inline void skv_gather_low(const float m[SKV_GATHER_MOMENTS], float mu_s, float out[]) {
    const float per_sr = 0.0795774715f;
    // Where the light stands in the zenith the terms over sines are lost in noise: they count for nothing there.
    const float inv_s = 1.0f / skv_maxf(skv_sqrtf(skv_maxf((1.0f - mu_s) * (1.0f + mu_s), 0.0f)), 0.01f);
    out[0] = per_sr * m[0];
    out[1] = 3.0f * per_sr * m[1];
    out[2] = 3.0f * per_sr * m[2] * inv_s;
    out[3] = 5.0f * per_sr * m[3];
    out[4] = 5.0f * per_sr * m[4] * inv_s;
    out[5] = 1.25f * per_sr * m[5] * inv_s * inv_s;
}

#endif
