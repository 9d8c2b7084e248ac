/// Gathering the radiance that arrives at a cell, and the nine numbers that stand for it.
#ifndef SKV_CORE_GATHER_H
#define SKV_CORE_GATHER_H

#include "core/gauss_legendre.h"
#include "core/moments.h"
#include "core/cells.h"

/// Integrals over all directions of radiance times: 1, mu, sin cos(phi), P2, 3 mu sin cos(phi), 3 sin^2 cos(2 phi), P3,
/// P4, the aureole's kernel, and max(mu, 0).
enum { SKV_GATHER_P3 = 6, SKV_GATHER_P4 = 7, SKV_GATHER_AROUND = 8, SKV_GATHER_DOWN = 9, SKV_GATHER_COUNT = 10 };

/// Below this sine of its elevation the light counts as standing there: the middle of the glow that it leaves.
#define SKV_AUREOLE_LOWEST 0.06f

/// A gathered direction; the light is at azimuth 0.
typedef struct skv_gather_ray {
    float direction[3];
    float cos_phi;
    float weight; ///< solid angle, both half circles
} skv_gather_ray;

/// Gauss-Legendre in t: polar angles mu = horizon +- range t^2, azimuths phi = pi t^1.5.
static inline skv_gather_ray skv_gather_direction(float horizon, int polar, int azimuths, int index) {
    const int ip = index / azimuths, ia = index % azimuths, up = ip < polar;
    const int at = skv_gauss_offset(polar) + (up ? ip : ip - polar), az = skv_gauss_offset(azimuths) + ia;
    const float t = skv_gauss_node[at], u = skv_gauss_node[az], range = up ? 1.0f - horizon : 1.0f + horizon;
    const float mu = horizon + (up ? range : -range) * t * t, root = skv_sqrtf(u);
    const float sin_theta = skv_sqrtf(skv_maxf((1.0f - mu) * (1.0f + mu), 0.0f));
    const skv_sincos phi = skv_sincosf(SKV_PI * u * root);
    skv_gather_ray ray = {{sin_theta * phi.cos, sin_theta * phi.sin, mu}, phi.cos, 0.0f};
    ray.weight = 6.0f * SKV_PI * t * range * root * skv_gauss_weight[at] * skv_gauss_weight[az];
    return ray;
}

/// What radiance from a direction counts in each integral.
/// @param toward   centre of the aureole.
/// @param kernel_g g of the aureole's kernel.
static inline void skv_gather_factors(const skv_gather_ray *ray, const float toward[3], float kernel_g,
                                      float factor[SKV_GATHER_COUNT]) {
    const float mu = ray->direction[2], mu2 = mu * mu, x = ray->direction[0], s2 = skv_maxf(1.0f - mu2, 0.0f);
    const float dx = x - toward[0], dy = ray->direction[1] - toward[1], dz = mu - toward[2];
    factor[0] = 1.0f;
    factor[1] = mu;
    factor[2] = x;
    factor[3] = 1.5f * mu2 - 0.5f;
    factor[4] = 3.0f * mu * x;
    factor[5] = 3.0f * s2 * (2.0f * ray->cos_phi * ray->cos_phi - 1.0f);
    factor[SKV_GATHER_P3] = (2.5f * mu2 - 1.5f) * mu;
    factor[SKV_GATHER_P4] = (4.375f * mu2 - 3.75f) * mu2 + 0.375f;
    factor[SKV_GATHER_AROUND] = skv_aureole(kernel_g, 0.5f * (dx * dx + dy * dy + dz * dz));
    factor[SKV_GATHER_DOWN] = skv_maxf(mu, 0.0f);
}

/// The aureole's strength: the least-squares fit of its shape to all degrees from 3 on, weighed as the source sees
/// them, but the zonal parts of degrees 3 and 4, which have numbers of their own; drawn towards `expected` where the
/// light stands so that nothing tells the two apart.
static inline float skv_gather_aureole(const float m[SKV_GATHER_COUNT], const float moment[4], float g, float p3,
                                       float p4, float expected) {
    const float per_sr = 0.0795774715f, b3 = g * g * g, b4 = b3 * g;
    const float z3 = 7.0f * per_sr * p3, z4 = 9.0f * per_sr * p4;
    const float seen =
        m[SKV_GATHER_AROUND] - moment[2] * b3 * z3 * m[SKV_GATHER_P3] - moment[3] * b4 * z4 * m[SKV_GATHER_P4];
    const float whole = skv_aureole(g * g, 0.0f) - b3 * b3 * z3 * p3 - b4 * b4 * z4 * p4;
    const float rho = 1e-3f * per_sr * (7.0f * b3 * b3 + 9.0f * b4 * b4);
    return whole + rho > 1e-20f ? skv_maxf((seen + rho * expected) / (whole + rho), 0.0f) : 0.0f;
}

/// Nine numbers: mean radiance, coefficients of the polynomials in diffuse.h, aureole.
/// @param moment  of the species whose aureole is kept, degrees 1 to 4; g of that aureole.
static inline void skv_gather_fit(const float m[SKV_GATHER_COUNT], const float moment[4], float g, float mu_s,
                                  float expected, float out[SKV_TABLE_TERMS]) {
    const float per_sr = 0.0795774715f, b3 = g * g * g, z = skv_maxf(mu_s, SKV_AUREOLE_LOWEST), z2 = z * z;
    const float p3 = (2.5f * z2 - 1.5f) * z, p4 = (4.375f * z2 - 3.75f) * z2 + 0.375f;
    // Where the light stands in the zenith the terms over sines are lost in noise: they count for nothing there.
    const float inv_s = 1.0f / skv_maxf(skv_sqrtf(skv_maxf((1.0f - mu_s) * (1.0f + mu_s), 0.0f)), 0.01f);
    const float alpha = skv_gather_aureole(m, moment, g, p3, p4, expected);
    out[0] = per_sr * m[0];
    out[1] = 3.0f * per_sr * m[1];
    out[2] = 3.0f * per_sr * m[2] * inv_s;
    out[3] = 5.0f * per_sr * m[3];
    out[4] = 5.0f * per_sr * m[4] * inv_s;
    out[5] = 1.25f * per_sr * m[5] * inv_s * inv_s;
    out[6] = 7.0f * per_sr * (m[SKV_GATHER_P3] - (skv_fabsf(moment[2]) > 1e-6f ? alpha * b3 / moment[2] * p3 : 0.0f));
    out[7] =
        9.0f * per_sr * (m[SKV_GATHER_P4] - (skv_fabsf(moment[3]) > 1e-6f ? alpha * b3 * g / moment[3] * p4 : 0.0f));
    out[8] = alpha;
}

#endif
