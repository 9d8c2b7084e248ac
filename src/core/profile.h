/// Relative density of a species against altitude: for single altitudes (model) and for lanes (inner depth, samples).
#ifndef SKV_CORE_PROFILE_H
#define SKV_CORE_PROFILE_H

#include <stddef.h>

#include "core/lanes.h"

/// Density of the kinds that are formulas, at altitude h_km above the sea; TABLE excepted. Parameters: profile.c.
static inline float skv_density_formula(const skv_species *sp, float h_km) {
    switch (sp->kind) {
    case SKV_PROFILE_EXPONENTIAL:
    case SKV_PROFILE_EXP_BACKGROUND:
        return skv_exp2f(-h_km * sp->inv_scale_log2e) + sp->background;
    case SKV_PROFILE_US76:
        return skv_exp2f(sp->p0 * skv_exp2f(sp->p1 * skv_log2f(skv_maxf(h_km, 1e-9f))));
    case SKV_PROFILE_TENT:
        return skv_maxf(0.0f, 1.0f - skv_fabsf(h_km - sp->p0) * sp->p1);
    case SKV_PROFILE_LOGNORMAL: {
        // exp(-k y^2 - ln h), y = ln h - mu, over its value at the peak.
        const float h = skv_maxf(h_km, 1e-9f);
        const float ln_h = skv_logf(h);
        const float y = ln_h - sp->p0;
        return skv_minf(1.0f, skv_exp2f((-sp->p1 * y * y - ln_h) * 1.44269504f + sp->p2));
    }
    default:
        return 0.0f;
    }
}

SKV_INLINE const float *skv_density_table(const skv_model *model, int species) {
#if SKV_TERM_OZONE
    if (species == SKV_OZONE)
        return model->ozone_density;
#endif
#if SKV_PROFILE_TABULATED
    return model->density[species];
#else
    (void)model;
    (void)species;
    return NULL;
#endif
}

/// Position in a table of n rows over [0, top]: whole part and fraction. Rows are evenly spaced in sqrt(h/top).
static inline int skv_sqrt_row(float h_km, float top_km, int rows, float *fraction) {
    const float x = skv_sqrtf(skv_clampf(h_km / top_km, 0.0f, 1.0f)) * (float)(rows - 1);
    int i = (int)x;
    i = i > rows - 2 ? rows - 2 : i;
    *fraction = x - (float)i;
    return i;
}

/// Density of any kind, lanes; h_km above the ground, which lies ground_km above the sea.
SKV_INLINE void skv_density_lanes(const skv_species *sp, const float *table, float top_sea_km, float ground_km,
                                  const skv_lanes *h_km, skv_lanes *density) {
    if (sp->kind == SKV_PROFILE_TABLE) {
        SKV_EACH_LANE(l) {
            float w;
            const int i = skv_sqrt_row(h_km->v[l] + ground_km, top_sea_km, SKV_DENSITY_ROWS, &w);
            density->v[l] = table[i] + w * (table[i + 1] - table[i]);
        }
    } else if (sp->kind == SKV_PROFILE_US76) {
        SKV_EACH_LANE(l) {
            const float h = skv_maxf(h_km->v[l] + ground_km, 1e-9f);
            density->v[l] = skv_exp2f(sp->p0 * skv_exp2f(sp->p1 * skv_log2f(h)));
        }
    } else {
        SKV_EACH_LANE(l) density->v[l] = skv_density_formula(sp, h_km->v[l] + ground_km);
    }
}

#endif
