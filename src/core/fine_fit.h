/// The fine part of a cell: what degrees 0 to 2 leave of the light that the forward-scattering species sends on.
///
/// Its source is gathered exactly for a set of directions that crowd at the horizon, where paths are long, and fitted
/// there, in relative terms, by few functions of the direction: harmonics of degrees 3 and 4 about the vertical and
/// towards the light, and an aureole. A truncated series would spend its terms where nobody looks: near the horizon of
/// a setting sun it is two to three times as wrong (`make` figures in README "Tables").
#ifndef SKV_CORE_FINE_FIT_H
#define SKV_CORE_FINE_FIT_H

#include "core/moments.h"
#include "core/phase.h"

#include "skyvert/table.h"

/// Directions: elevations times azimuths.
#define SKV_FINE_ELEVATIONS 10
#define SKV_FINE_AZIMUTHS   6

static const float skv_fine_mu[SKV_FINE_ELEVATIONS] = {-0.9f, -0.5f, -0.25f, -0.1f, -0.03f,
                                                       0.03f, 0.1f,  0.25f,  0.5f,  0.9f};
/// cos(phi) of 0, 20, 45, 80, 130 and 180 degrees from the light.
static const float skv_fine_cos[SKV_FINE_AZIMUTHS] = {1.0f,         0.939692621f,  0.707106781f,
                                                      0.173648178f, -0.642787610f, -1.0f};

static inline void skv_fine_direction(int index, float v[3]) {
    const float mu = skv_fine_mu[index / SKV_FINE_AZIMUTHS], c = skv_fine_cos[index % SKV_FINE_AZIMUTHS];
    const float s = skv_sqrtf((1.0f - mu) * (1.0f + mu));
    v[0] = s * c;
    v[1] = s * skv_sqrtf(skv_maxf((1.0f - c) * (1.0f + c), 0.0f));
    v[2] = mu;
}

/// The phase function of a species between two directions, both half circles of the gathered one together.
static inline float skv_fine_phase(int cornette_shanks, float g, const float v[3], const float w[3]) {
    const float flat = v[0] * w[0] + v[2] * w[2], side = v[1] * w[1];
    float sum = 0.0f;
    for (int k = 0; k < 2; k++) {
        const float nu = skv_clampf(flat + (k ? -side : side), -1.0f, 1.0f);
        const float d = skv_phase_distance(g, g < 0.0f ? 1.0f + nu : 1.0f - nu);
        sum += cornette_shanks ? skv_phase_cornette_shanks(g, d, nu) : skv_phase_henyey_greenstein(g, d);
    }
    return 0.5f * sum;
}

/// The functions that are fitted, times the species' moments.
/// @param q  v.s - mu mu_s.
static inline void skv_fine_basis(const float moment[4], float aureole, float mu, float q, float mu_s,
                                  float out[SKV_TABLE_FINE]) {
    const float mu2 = mu * mu, a3 = moment[2], a4 = moment[3];
    out[0] = a3 * (2.5f * mu2 - 1.5f) * mu;
    out[1] = a4 * ((4.375f * mu2 - 3.75f) * mu2 + 0.375f);
    out[2] = aureole;
    out[3] = a3 * (5.0f * mu2 - 1.0f) * q;
    out[4] = a4 * (7.0f * mu2 - 3.0f) * mu * q;
    const float xy = 2.0f * q * q - (1.0f - mu_s * mu_s) * (1.0f - mu2);
    out[5] = a3 * mu * xy;
    out[6] = a4 * (7.0f * mu2 - 1.0f) * xy;
}

/// Solves A x = y by Cholesky's decomposition; A symmetric and positive definite.
static inline void skv_fine_solve(float a[SKV_TABLE_FINE][SKV_TABLE_FINE], float y[SKV_TABLE_FINE]) {
    for (int i = 0; i < SKV_TABLE_FINE; i++) {
        for (int j = 0; j <= i; j++) {
            float sum = a[i][j];
            for (int k = 0; k < j; k++)
                sum -= a[i][k] * a[j][k];
            a[i][j] = i == j ? skv_sqrtf(skv_maxf(sum, 1e-12f)) : sum / a[j][j];
        }
        for (int k = 0; k < i; k++)
            y[i] -= a[i][k] * y[k];
        y[i] /= a[i][i];
    }
    for (int i = SKV_TABLE_FINE - 1; i >= 0; i--) {
        for (int k = i + 1; k < SKV_TABLE_FINE; k++)
            y[i] -= a[k][i] * y[k];
        y[i] /= a[i][i];
    }
}

/// Least squares of relative errors, with a trace of weight on small coefficients.
/// @param source  [directions] of the species, per unit of its scattering.
/// @param low     mean and degrees 1 and 2 of the cell.
static inline void skv_fine_fit(const float source[SKV_FINE_ELEVATIONS * SKV_FINE_AZIMUTHS], const float low[6],
                                const float moment[4], float g, const float toward[3], float mu_s,
                                float out[SKV_TABLE_FINE]) {
    float a[SKV_TABLE_FINE][SKV_TABLE_FINE] = {{0.0f}}, y[SKV_TABLE_FINE] = {0.0f}, scale[SKV_TABLE_FINE];
    const float sine = skv_sqrtf(skv_maxf((1.0f - mu_s) * (1.0f + mu_s), 0.0f));
    for (int i = 0; i < SKV_FINE_ELEVATIONS * SKV_FINE_AZIMUTHS; i++) {
        float v[3], f[SKV_TABLE_FINE];
        skv_fine_direction(i, v);
        const float mu = v[2], q = v[0] * sine, dx = v[0] - toward[0], dy = v[1] - toward[1], dz = mu - toward[2];
        const float xy = 2.0f * q * q - sine * sine * (1.0f - mu * mu);
        const float rest = source[i] - low[0] - moment[0] * (low[1] * mu + low[2] * q) -
                           moment[1] * (low[3] * (1.5f * mu * mu - 0.5f) + low[4] * mu * q + low[5] * xy);
        const float weight = skv_exp2f(-23.0f * mu * mu) + 1.0f,
                    w = weight / skv_maxf(source[i], 1e-3f * low[0] + 1e-30f);
        skv_fine_basis(moment, skv_aureole(g, 0.5f * (dx * dx + dy * dy + dz * dz)), mu, q, mu_s, f);
        for (int j = 0; j < SKV_TABLE_FINE; j++) {
            for (int k = 0; k <= j; k++)
                a[j][k] += w * w * low[0] * low[0] * f[j] * f[k];
            y[j] += w * w * low[0] * f[j] * rest;
        }
    }
    // Columns of length 1; one that vanishes gets the coefficient 0.
    for (int j = 0; j < SKV_TABLE_FINE; j++)
        scale[j] = a[j][j] > 1e-12f ? 1.0f / skv_sqrtf(a[j][j]) : 0.0f;
    for (int j = 0; j < SKV_TABLE_FINE; j++) {
        for (int k = 0; k <= j; k++)
            a[j][k] *= scale[j] * scale[k];
        a[j][j] += 3e-3f;
        y[j] *= scale[j];
    }
    skv_fine_solve(a, y);
    for (int j = 0; j < SKV_TABLE_FINE; j++)
        out[j] = y[j] * scale[j] * low[0];
}

#endif
