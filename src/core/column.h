/// Columns of the species from a point to the top of the air, by lanes.
///
/// Downward (mu < 0): col = 2 col(tangent, 0) - col(h, -mu); the tangent point lies above the ground.
/// The closed form counts the air above the top too; differences of two columns on one ray do not see that, sun columns
/// subtract it.
#ifndef SKV_CORE_COLUMN_H
#define SKV_CORE_COLUMN_H

#include "core/chapman.h"
#include "core/gauss_legendre.h"
#include "core/geometry.h"
#include "core/profile.h"

/// A point per lane: altitude above the ground, radius, densities of the closed form's exponentials.
typedef struct skv_points {
    skv_lanes h_km;
    skv_lanes r_km;
    skv_lanes rho[2];
} skv_points;

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

/// exp(-h/H) of Rayleigh and aerosol.
SKV_INLINE void skv_points_densities(const skv_frame *frame, skv_points *p) {
    for (int s = 0; s < 2; s++)
        if (skv_present(frame, s)) {
            const float k = frame->species[s].inv_scale_log2e;
            SKV_EACH_LANE(l) p->rho[s].v[l] = skv_exp2f_d5(-p->h_km.v[l] * k);
        }
}

/// Density that scatters: the exponential plus its background, or the profile's own.
SKV_INLINE void skv_scattering_density(const skv_frame *frame, const skv_points *p, int s, skv_lanes *density) {
#if SKV_PROFILE_TABULATED
    const skv_species *sp = &frame->model->species[s];
    if (sp->column != 0) {
        skv_density_lanes(sp, skv_density_table(frame->model, s), frame->model->top_km, frame->ground_km, &p->h_km,
                          density);
        return;
    }
#endif
    const float background = frame->species[s].background;
    SKV_EACH_LANE(l) density->v[l] = p->rho[s].v[l] + background;
}

#if SKV_TERM_OZONE || SKV_PROFILE_TABULATED
/// Tables: rows evenly spaced in h/top (layers) or its square root (ratios), columns in t = 1/(1 + 14 mu) on [1/15, 1].
SKV_INLINE void skv_table_rows(const skv_frame *frame, int by_root, int rows, const skv_lanes *h_km, int32_t row[],
                               skv_lanes *w) {
    const float top = frame->model->top_km, ground = frame->ground_km, scale = 1.0f / top;
    SKV_EACH_LANE(l) {
        const float x = skv_clampf((h_km->v[l] + ground) * scale, 0.0f, 1.0f);
        w->v[l] = x;
    }
    if (by_root)
        SKV_EACH_LANE(l) w->v[l] = skv_sqrtf(w->v[l]);
    SKV_EACH_LANE(l) {
        const float x = w->v[l] * (float)(rows - 1);
        int32_t i = (int32_t)x;
        i = i > rows - 2 ? rows - 2 : i;
        row[l] = i;
        w->v[l] = x - (float)i;
    }
}

/// Column at (h, mu >= 0) in the units of the table's base.
SKV_INLINE void skv_table_column(const skv_frame *frame, const skv_column_table *table, int by_root,
                                 const skv_lanes *h_km, const skv_lanes *t, skv_lanes *value) {
    int32_t at[SKV_LANES];
    skv_lanes wx, wy, v00, v01, v10, v11;
    skv_table_rows(frame, by_root, SKV_COLUMN_ROWS, h_km, at, &wx);
    SKV_EACH_LANE(l) {
        const float y = (t->v[l] - 1.0f / 15.0f) * (15.0f / 14.0f * (float)(SKV_COLUMN_COLS - 1));
        int32_t i = (int32_t)y;
        i = i > SKV_COLUMN_COLS - 2 ? SKV_COLUMN_COLS - 2 : i;
        i = i < 0 ? 0 : i;
        at[l] = at[l] * SKV_COLUMN_COLS + i;
        wy.v[l] = y - (float)i;
    }
    SKV_EACH_LANE(l) {
        const float *p = table->column + at[l];
        v00.v[l] = p[0];
        v01.v[l] = p[1];
        v10.v[l] = p[SKV_COLUMN_COLS];
        v11.v[l] = p[SKV_COLUMN_COLS + 1];
    }
    SKV_EACH_LANE(l) {
        const float a = v00.v[l] + wy.v[l] * (v01.v[l] - v00.v[l]);
        const float b = v10.v[l] + wy.v[l] * (v11.v[l] - v10.v[l]);
        value->v[l] = a + wx.v[l] * (b - a);
    }
}

SKV_INLINE void skv_table_tangent(const skv_frame *frame, const skv_column_table *table, int by_root,
                                  const skv_lanes *h_km, skv_lanes *value) {
    int32_t at[SKV_LANES];
    skv_lanes w, v0, v1;
    skv_table_rows(frame, by_root, SKV_COLUMN_TANGENTS, h_km, at, &w);
    SKV_EACH_LANE(l) {
        v0.v[l] = table->tangent[at[l]];
        v1.v[l] = table->tangent[at[l] + 1];
    }
    SKV_EACH_LANE(l) value->v[l] = v0.v[l] + w.v[l] * (v1.v[l] - v0.v[l]);
}
#endif

#if SKV_DEPTH_CHAPMAN
SKV_INLINE const skv_column_table *skv_column_table_of(const skv_model *model, int species) {
#if SKV_TERM_OZONE
    if (species == SKV_OZONE)
        return &model->ozone_column;
#endif
#if SKV_PROFILE_TABULATED
    return &model->column[species];
#else
    (void)model;
    (void)species;
    return NULL;
#endif
}

/// One exponential species, lanes.
SKV_INLINE void skv_chapman_lanes(const skv_frame_species *sp, const skv_lanes *r_km, const skv_lanes *rho,
                                  const skv_lanes *mu, const skv_lanes *sin_chi, skv_lanes *column) {
    const float k = sp->chapman_k, a = sp->chapman_a, z = sp->chapman_z;
    SKV_EACH_LANE(l)
        column->v[l] = a * rho->v[l] * skv_chapman(k, z, r_km->v[l], mu->v[l], sin_chi->v[l]);
}

SKV_INLINE void skv_columns_chapman_up(const skv_frame *frame, const skv_points *p, const skv_lanes *mu,
                               const skv_lanes *sin_chi, skv_columns *out) {
    skv_lanes t;
#if SKV_TERM_OZONE || SKV_PROFILE_TABULATED
    SKV_EACH_LANE(l) t.v[l] = 1.0f / (1.0f + 14.0f * mu->v[l]);
#endif
    (void)t;
    for (int s = 0; s < 2; s++) {
        if (!skv_present(frame, s))
            continue;
        const skv_frame_species *sp = &frame->species[s];
        skv_chapman_lanes(sp, &p->r_km, &p->rho[s], mu, sin_chi, &out->of[s]);
#if SKV_PROFILE_TABULATED
        if (frame->model->species[s].column != 0) {
            skv_lanes ratio;
            skv_table_column(frame, skv_column_table_of(frame->model, s), 1, &p->h_km, &t, &ratio);
            SKV_EACH_LANE(l) out->of[s].v[l] *= ratio.v[l];
        }
#endif
        if (sp->background > 0.0f)
            SKV_EACH_LANE(l)
                out->of[s].v[l] += sp->background * skv_to_top(frame->radius_km, frame->top_km, p->h_km.v[l],
                                                               p->r_km.v[l] * mu->v[l]);
    }
#if SKV_TERM_OZONE
    if (skv_present(frame, SKV_OZONE)) {
        skv_table_column(frame, &frame->model->ozone_column, 0, &p->h_km, &t, &out->of[SKV_OZONE]);
        SKV_EACH_LANE(l) out->of[SKV_OZONE].v[l] *= t.v[l];
    }
#endif
}

SKV_INLINE void skv_columns_chapman_tangent(const skv_frame *frame, const skv_points *p, skv_columns *out) {
    for (int s = 0; s < 2; s++) {
        if (!skv_present(frame, s))
            continue;
        const skv_frame_species *sp = &frame->species[s];
        SKV_EACH_LANE(l)
            out->of[s].v[l] = 2.0f * sp->chapman_a * p->rho[s].v[l] *
                              skv_chapman(sp->chapman_k, sp->chapman_z, p->r_km.v[l], 0.0f, 1.0f);
#if SKV_PROFILE_TABULATED
        if (frame->model->species[s].column != 0) {
            skv_lanes ratio;
            skv_table_tangent(frame, skv_column_table_of(frame->model, s), 1, &p->h_km, &ratio);
            SKV_EACH_LANE(l) out->of[s].v[l] *= ratio.v[l];
        }
#endif
        if (sp->background > 0.0f)
            SKV_EACH_LANE(l)
                out->of[s].v[l] +=
                    2.0f * sp->background * skv_to_top(frame->radius_km, frame->top_km, p->h_km.v[l], 0.0f);
    }
#if SKV_TERM_OZONE
    if (skv_present(frame, SKV_OZONE)) {
        skv_table_tangent(frame, &frame->model->ozone_column, 0, &p->h_km, &out->of[SKV_OZONE]);
        SKV_EACH_LANE(l) out->of[SKV_OZONE].v[l] *= 2.0f;
    }
#endif
}
#endif

#if SKV_DEPTH_INNER
/// By Gauss-Legendre nodes in an exponential map: any profile, any size of planet. Upward, mu >= 0.
SKV_INLINE void skv_columns_inner_up(const skv_frame *frame, const skv_points *p, const skv_lanes *mu,
                                     skv_columns *out) {
    const skv_model *model = frame->model;
    const int m = frame->quality.depth_samples;
    const float *node = skv_gauss_node + skv_gauss_offset(m), *weight = skv_gauss_weight + skv_gauss_offset(m);
    const float radius = frame->radius_km, hs = frame->inner_scale_km;
    skv_lanes l_km, k, e0, rm, top;
    skv_points q;
    SKV_EACH_LANE(l) {
        const float c = mu->v[l];
        rm.v[l] = p->r_km.v[l] * c;
        top.v[l] = skv_to_top(radius, frame->top_km, p->h_km.v[l], rm.v[l]);
        l_km.v[l] = hs / (0.5f * c + skv_sqrtf(0.25f * c * c + 0.5f * hs / p->r_km.v[l]));
        k.v[l] = skv_log1pf(top.v[l] / l_km.v[l]);
        e0.v[l] = p->h_km.v[l] * (2.0f * radius + p->h_km.v[l]);
    }
    for (int s = 0; s < SKV_SPECIES; s++)
        SKV_EACH_LANE(l) out->of[s].v[l] = 0.0f;
    for (int i = 0; i < m; i++) {
        skv_lanes ds;
        SKV_EACH_LANE(l) {
            const float e = skv_exp2f(k.v[l] * 1.44269504f * node[i]);
            const float s = skv_minf(l_km.v[l] * (e - 1.0f), top.v[l]);
            ds.v[l] = weight[i] * k.v[l] * l_km.v[l] * e;
            float r;
            const float h = skv_altitude(radius, e0.v[l] + s * (2.0f * rm.v[l] + s), &r);
            q.h_km.v[l] = skv_clampf(h, 0.0f, frame->top_km);
            q.r_km.v[l] = r;
        }
        skv_points_densities(frame, &q);
        for (int s = 0; s < SKV_SPECIES; s++) {
            if (!skv_present(frame, s))
                continue;
            skv_lanes rho;
            if (s == SKV_OZONE)
                skv_density_lanes(&model->species[s], skv_density_table(model, s), model->top_km, frame->ground_km,
                                  &q.h_km, &rho);
            else
                skv_scattering_density(frame, &q, s, &rho);
            SKV_EACH_LANE(l) out->of[s].v[l] += ds.v[l] * rho.v[l];
        }
    }
}
#endif

/// Columns upward, mu >= 0, by the frame's backend.
SKV_INLINE void skv_columns_up(const skv_frame *frame, const skv_points *p, const skv_lanes *mu,
                               const skv_lanes *sin_chi, skv_columns *out) {
#if SKV_DEPTH_INNER
#if SKV_DEPTH_CHAPMAN
    if (frame->quality.depth == SKV_DEPTH_BY_INNER)
#endif
    {
        skv_columns_inner_up(frame, p, mu, out);
        return;
    }
#endif
#if SKV_DEPTH_CHAPMAN
    skv_columns_chapman_up(frame, p, mu, sin_chi, out);
#endif
    (void)sin_chi;
}

/// Columns of the whole ray that is tangent at p: both halves.
SKV_INLINE void skv_columns_tangent(const skv_frame *frame, const skv_points *p, skv_columns *out) {
#if SKV_DEPTH_INNER
#if SKV_DEPTH_CHAPMAN
    if (frame->quality.depth == SKV_DEPTH_BY_INNER)
#endif
    {
        skv_lanes mu;
        SKV_EACH_LANE(l) mu.v[l] = 0.0f;
        skv_columns_inner_up(frame, p, &mu, out);
        for (int s = 0; s < SKV_SPECIES; s++)
            SKV_EACH_LANE(l) out->of[s].v[l] *= 2.0f;
        return;
    }
#endif
#if SKV_DEPTH_CHAPMAN
    skv_columns_chapman_tangent(frame, p, out);
#endif
}

/// The closed form counts the air above the top; this is what a ray that leaves at r_top mu_e meets there.
SKV_INLINE void skv_columns_cut_top(const skv_frame *frame, const skv_points *p, const skv_lanes *rm,
                                    skv_columns *out) {
    const float rt = frame->radius_km + frame->top_km;
    for (int s = 0; s < 2; s++) {
        const float cut = frame->species[s].top_column, kx = frame->species[s].top_k;
        if (!skv_present(frame, s) || !(cut > 0.0f))
            continue;
        SKV_EACH_LANE(l) {
            const float c = (frame->top_km - p->h_km.v[l]) * (2.0f * frame->radius_km + frame->top_km + p->h_km.v[l]);
            const float m2 = (rm->v[l] * rm->v[l] + c) / (rt * rt);
            const float m = skv_sqrtf(m2);
            out->of[s].v[l] -= cut / (m + skv_sqrtf(m2 + kx * (1.0f - m2)));
        }
    }
}

/// Columns toward a light that no ground hides, per lane: mu of either sign.
/// @param down  whether any lane may have mu < 0 (changes the work, not the result).
SKV_INLINE void skv_columns_light(const skv_frame *frame, const skv_points *p, const skv_lanes *rms, int down,
                                  skv_columns *out) {
    skv_lanes mu, sin_chi;
    SKV_EACH_LANE(l) {
        const float c = skv_minf(skv_fabsf(rms->v[l] / p->r_km.v[l]), 1.0f);
        mu.v[l] = c;
        sin_chi.v[l] = skv_sqrtf(1.0f - c * c);
    }
    skv_columns_up(frame, p, &mu, &sin_chi, out);
    if (down) {
        skv_points t;
        skv_columns both;
        const float radius = frame->radius_km;
        SKV_EACH_LANE(l) {
            const float e = p->h_km.v[l] * (2.0f * radius + p->h_km.v[l]) - rms->v[l] * rms->v[l];
            t.h_km.v[l] = skv_altitude(radius, skv_maxf(e, 0.0f), &t.r_km.v[l]);
        }
        skv_points_densities(frame, &t);
        skv_columns_tangent(frame, &t, &both);
        for (int s = 0; s < SKV_SPECIES; s++)
            if (skv_present(frame, s))
                SKV_EACH_LANE(l) {
                    const float up = out->of[s].v[l];
                    out->of[s].v[l] = rms->v[l] < 0.0f ? both.of[s].v[l] - up : up;
                }
    }
    skv_columns_cut_top(frame, p, rms, out);
}

#endif
