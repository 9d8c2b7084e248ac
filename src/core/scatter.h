/// What a sample adds: scattering towards the observer times the light's and the view's transmittance, per band.
#ifndef SKV_CORE_SCATTER_H
#define SKV_CORE_SCATTER_H

#include "core/column.h"

SKV_INLINE void skv_scatter_bands(const skv_frame *frame, int aerosol, int ozone, const skv_lanes source[2],
                                  const skv_columns *c, skv_lanes radiance[]) {
    const int bands = skv_bands(frame->model);
    for (int b = 0; b < bands; b++) {
        const float br = frame->rayleigh_log2e_per_km[b], ba = frame->aerosol_log2e_per_km[b];
        const float bo = frame->ozone_log2e_per_km[b];
        const float sr = frame->rayleigh_per_km[b], sa = frame->aerosol_per_km[b];
        SKV_EACH_LANE(l) {
            float tau = br * c->of[SKV_RAYLEIGH].v[l];
            float s = sr * source[SKV_RAYLEIGH].v[l];
            if (aerosol) {
                tau += ba * c->of[SKV_AEROSOL].v[l];
                s += sa * source[SKV_AEROSOL].v[l];
            }
            if (ozone)
                tau += bo * c->of[SKV_OZONE].v[l];
            radiance[b].v[l] += s * skv_exp2f_d4(-tau);
        }
    }
}

/// @param ds  path length that the sample stands for, km.
/// @param c   columns light -> sample -> observer, >= 0.
SKV_INLINE void skv_scatter(const skv_frame *frame, const skv_points *p, const skv_lanes phase[2], const skv_lanes *ds,
                            skv_columns *c, skv_lanes radiance[]) {
    skv_lanes source[2];
    for (int s = 0; s < 2; s++) {
        if (skv_present(frame, s)) {
            skv_scattering_density(frame, p, s, &source[s]);
            SKV_EACH_LANE(l) source[s].v[l] *= ds->v[l] * phase[s].v[l];
        } else {
            SKV_EACH_LANE(l) source[s].v[l] = c->of[s].v[l] = 0.0f;
        }
    }
    const int aerosol = SKV_TERM_AEROSOL && skv_present(frame, SKV_AEROSOL);
    const int ozone = SKV_TERM_OZONE && skv_present(frame, SKV_OZONE);
    if (aerosol && ozone)
        skv_scatter_bands(frame, 1, 1, source, c, radiance);
    else if (aerosol)
        skv_scatter_bands(frame, 1, 0, source, c, radiance);
    else if (ozone)
        skv_scatter_bands(frame, 0, 1, source, c, radiance);
    else
        skv_scatter_bands(frame, 0, 0, source, c, radiance);
}

#endif
