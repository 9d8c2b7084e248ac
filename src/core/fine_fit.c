#include "core/fine_fit.h"

#include "core/phase.h"

#if SKV_TERM_DIFFUSE

static const float skv_fine_mu[SKV_FINE_ELEVATIONS] = {-0.9f, -0.5f, -0.25f, -0.1f, -0.03f,
                                                       0.03f, 0.1f,  0.25f,  0.5f,  0.9f};
/// cos(phi) of 0, 20, 45, 80, 130 and 180 degrees from the light.
static const float skv_fine_cos[SKV_FINE_AZIMUTHS] = {1.0f,         0.939692621f,  0.707106781f,
                                                      0.173648178f, -0.642787610f, -1.0f};

void skv_fine_directions_init(skv_fine_directions *d) {
    for (int i = 0; i < SKV_FINE_DIRECTIONS; i++) {
        const float mu = skv_fine_mu[i / SKV_FINE_AZIMUTHS], c = skv_fine_cos[i % SKV_FINE_AZIMUTHS];
        const float s = skv_sqrtf((1.0f - mu) * (1.0f + mu));
        d->x[i] = s * c;
        d->y[i] = s * skv_sqrtf(skv_maxf((1.0f - c) * (1.0f + c), 0.0f));
        d->z[i] = mu;
    }
}

void skv_fine_phases(int cornette_shanks, float g, const skv_fine_directions *d, const float w[3],
                     float phase[restrict SKV_FINE_DIRECTIONS]) {
    const float side = g < 0.0f ? -1.0f : 1.0f;
    for (int i = 0; i < SKV_FINE_DIRECTIONS; i++) {
        const float flat = d->x[i] * w[0] + d->z[i] * w[2], across = d->y[i] * w[1];
        const float nu0 = skv_clampf(flat + across, -1.0f, 1.0f), nu1 = skv_clampf(flat - across, -1.0f, 1.0f);
        const float d0 = skv_phase_distance(g, 1.0f - side * nu0), d1 = skv_phase_distance(g, 1.0f - side * nu1);
        const float more0 = cornette_shanks ? 1.0f + nu0 * nu0 : 1.0f,
                    more1 = cornette_shanks ? 1.0f + nu1 * nu1 : 1.0f;
        phase[i] = more0 / (d0 * skv_root(d0)) + more1 / (d1 * skv_root(d1));
    }
    const float hg = 0.0397887358f * ((1.0f - g) * (1.0f + g)), cs = 1.5f * hg / (2.0f + g * g);
    for (int i = 0; i < SKV_FINE_DIRECTIONS; i++)
        phase[i] *= cornette_shanks ? cs : hg;
}

/// Solves A x = y by Cholesky's decomposition; A symmetric and positive definite.
static void skv_fine_solve(float a[SKV_TABLE_FINE][SKV_TABLE_FINE], float y[SKV_TABLE_FINE]) {
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

void skv_fine_fit(const float source[SKV_FINE_DIRECTIONS], const float low[6], const float moment[4], float g,
                  const float toward[3], float mu_s, float out[SKV_TABLE_FINE]) {
    float a[SKV_TABLE_FINE][SKV_TABLE_FINE] = {{0.0f}}, y[SKV_TABLE_FINE] = {0.0f}, scale[SKV_TABLE_FINE];
    const float sine = skv_sqrtf(skv_maxf((1.0f - mu_s) * (1.0f + mu_s), 0.0f));
    skv_fine_directions d;
    skv_fine_directions_init(&d);
    for (int i = 0; i < SKV_FINE_DIRECTIONS; i++) {
        float f[SKV_TABLE_FINE];
        const float mu = d.z[i], q = d.x[i] * sine;
        const float dx = d.x[i] - toward[0], dy = d.y[i] - toward[1], dz = mu - toward[2];
        const float xy = 2.0f * q * q - sine * sine * (1.0f - mu * mu);
        const float rest = source[i] - low[0] - moment[0] * (low[1] * mu + low[2] * q) -
                           moment[1] * (low[3] * (1.5f * mu * mu - 0.5f) + low[4] * mu * q + low[5] * xy);
        const float weight = skv_exp2f(-23.0f * mu * mu) + 1.0f,
                    w = weight / skv_maxf(source[i], 1e-3f * low[0] + 1e-30f), wl = w * low[0];
        skv_fine_basis(moment, skv_aureole(g, 0.5f * (dx * dx + dy * dy + dz * dz)), mu, q, mu_s, f);
        for (int j = 0; j < SKV_TABLE_FINE; j++) {
            for (int k = 0; k <= j; k++)
                a[j][k] += wl * f[j] * wl * f[k];
            y[j] += wl * f[j] * w * rest;
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
