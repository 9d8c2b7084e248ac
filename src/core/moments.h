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

/// The species whose aureole a table keeps: of those that scatter forward the one that scatters most.
static inline int skv_kept_species(const skv_model *m) {
    int kept = SKV_AEROSOL;
    float most = 0.0f;
    for (int s = SKV_AEROSOL; s < SKV_SCATTERERS; s++) {
        float sum = 0.0f;
        for (int b = 0; b < skv_bands(m); b++)
            sum += m->scattering_per_km[s][b] * m->species[s].scale_height_km * skv_fabsf(m->g[s]);
        kept = m->species[s].kind != SKV_PROFILE_NONE && sum > most ? s : kept;
        most = skv_maxf(most, sum);
    }
    return kept;
}

/// Largest vertical optical depth of scattering of the bands, roughly.
static inline float skv_scattering_depth(const skv_model *m) {
    float tau = 0.0f;
    for (int b = 0; b < skv_bands(m); b++) {
        float sum = 0.0f;
        for (int s = 0; s < SKV_SCATTERERS; s++)
            sum += m->scattering_per_km[s][b] * m->species[s].scale_height_km;
        tau = skv_maxf(tau, sum);
    }
    return tau;
}

/// Nodes a leg of diffuse light needs: more change nothing in Earth's air, the source of thick air varies faster.
static inline int32_t skv_diffuse_nodes(const skv_model *m) {
    const float tau = skv_scattering_depth(m);
    return tau < 0.6f ? 4 : tau < 1.2f ? 6 : 8;
}

#endif
