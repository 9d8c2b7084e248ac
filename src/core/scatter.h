/// What a sample adds: scattering towards the observer times the light's and the view's transmittance, per band.
#ifndef SKV_CORE_SCATTER_H
#define SKV_CORE_SCATTER_H

#include "core/column.h"

/// @param phase  Rayleigh, aerosol, 1/sr.
/// @param ds     path length that the sample stands for, km.
/// @param c      columns light -> sample -> observer, >= 0.
SKV_INLINE void skv_scatter(const skv_frame *frame, unsigned has, const skv_points *p, const skv_lanes phase[2],
                            const skv_lanes *ds, const skv_columns *c, skv_lanes radiance[]) {
    const int bands = SKV_BANDS_OF(has);
    skv_lanes source[2];
    for (int s = 0; s < 2; s++) {
        if (!SKV_PRESENT(has, s)) {
            SKV_EACH_LANE(l) source[s].v[l] = 0.0f;
            continue;
        }
        skv_scattering_density(frame, has, p, s, &source[s]);
        SKV_EACH_LANE(l) source[s].v[l] *= ds->v[l] * phase[s].v[l];
    }
    for (int b = 0; b < bands; b++) {
        const float br = frame->rayleigh_log2e_per_km[b], ba = frame->aerosol_log2e_per_km[b];
        const float bo = frame->ozone_log2e_per_km[b];
        const float sr = frame->rayleigh_per_km[b], sa = frame->aerosol_per_km[b];
        SKV_EACH_LANE(l) {
            float tau = 0.0f, s = 0.0f;
            if (SKV_PRESENT(has, SKV_RAYLEIGH)) {
                tau = br * c->of[SKV_RAYLEIGH].v[l];
                s = sr * source[SKV_RAYLEIGH].v[l];
            }
            if (SKV_PRESENT(has, SKV_AEROSOL)) {
                tau += ba * c->of[SKV_AEROSOL].v[l];
                s += sa * source[SKV_AEROSOL].v[l];
            }
            if (SKV_PRESENT(has, SKV_OZONE))
                tau += bo * c->of[SKV_OZONE].v[l];
            radiance[b].v[l] += s * skv_decay(&frame->limits, -tau);
        }
    }
}

#endif
