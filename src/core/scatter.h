/// What a sample adds: scattering towards the observer times the light's and the view's transmittance, per band.
#ifndef SKV_CORE_SCATTER_H
#define SKV_CORE_SCATTER_H

#include "core/column.h"

SKV_INLINE void skv_source(const skv_frame *frame, unsigned has, const skv_points *p, int s, const skv_lanes *phase,
                           const skv_lanes *ds, skv_lanes *source) {
    if (!SKV_PRESENT(has, s)) {
        SKV_EACH_LANE(l) source->v[l] = 0.0f;
        return;
    }
    skv_scattering_density(frame, has, p, s, source);
    SKV_EACH_LANE(l) source->v[l] *= ds->v[l] * phase->v[l];
}

/// @param phase  1/sr.
/// @param ds     path length that the sample stands for, km.
/// @param c      columns light -> sample -> observer, >= 0.
SKV_INLINE void skv_scatter(const skv_frame *frame, unsigned has, const skv_points *p,
                            const skv_lanes phase[SKV_SCATTERERS], const skv_lanes *ds, const skv_columns *c,
                            skv_lanes radiance[]) {
    const int bands = SKV_BANDS_OF(has);
    skv_lanes source[SKV_SCATTERERS];
    skv_source(frame, has, p, SKV_RAYLEIGH, &phase[SKV_RAYLEIGH], ds, &source[SKV_RAYLEIGH]);
    skv_source(frame, has, p, SKV_AEROSOL, &phase[SKV_AEROSOL], ds, &source[SKV_AEROSOL]);
    skv_source(frame, has, p, SKV_DUST, &phase[SKV_DUST], ds, &source[SKV_DUST]);
    for (int b = 0; b < bands; b++) {
        const float br = frame->extinction_log2e_per_km[SKV_RAYLEIGH][b],
                    sr = frame->scattering_per_km[SKV_RAYLEIGH][b];
        const float ba = frame->extinction_log2e_per_km[SKV_AEROSOL][b], sa = frame->scattering_per_km[SKV_AEROSOL][b];
        const float bd = frame->extinction_log2e_per_km[SKV_DUST][b], sd = frame->scattering_per_km[SKV_DUST][b];
        const float bo = frame->extinction_log2e_per_km[SKV_OZONE][b];
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
            if (SKV_PRESENT(has, SKV_DUST)) {
                tau += bd * c->of[SKV_DUST].v[l];
                s += sd * source[SKV_DUST].v[l];
            }
            if (SKV_PRESENT(has, SKV_OZONE))
                tau += bo * c->of[SKV_OZONE].v[l];
            radiance[b].v[l] += s * skv_decay(&frame->limits, -tau);
        }
    }
}

#endif
