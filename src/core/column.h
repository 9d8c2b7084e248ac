/// Columns of the species from a point to the top of the air, by lanes.
///
/// Downward (mu < 0): col = 2 col(tangent, 0) - col(h, -mu); the tangent point lies above the ground.
/// The closed form counts the air above the top too; differences of two columns on one ray do not see that, sun columns
/// subtract it. `has` are SKV_HAS_* bits.
#ifndef SKV_CORE_COLUMN_H
#define SKV_CORE_COLUMN_H

#include "core/chapman.h"
#include "core/gauss_legendre.h"
#include "core/geometry.h"
#include "core/knots.h"
#include "core/lookup.h"
#include "core/profile.h"

/// A point per lane: altitude above the ground, radius and what is often needed of it, the exponentials exp(-h/H).
typedef struct skv_points {
    skv_lanes h_km;
    skv_lanes r_km;
    skv_lanes inv_r, root_r;
    skv_lanes rho[SKV_SCATTERERS];
} skv_points;

/// From E = r^2 - R^2 >= 0.
SKV_INLINE void skv_points_at(const skv_frame *frame, unsigned has, const skv_lanes *e, skv_points *p) {
    const float radius = frame->radius_km, top = frame->top_km, radius2 = radius * radius;
    SKV_EACH_LANE(l) {
        const float r = skv_root(radius2 + e->v[l]);
        p->h_km.v[l] = skv_minf(e->v[l] / (radius + r), top);
        p->r_km.v[l] = r;
        p->inv_r.v[l] = 1.0f / r;
        p->root_r.v[l] = skv_root(r);
    }
    SKV_EACH_SCATTERER(s)
    if (SKV_PRESENT(has, s)) {
        const float k = -frame->species[s].inv_scale_log2e;
        SKV_EACH_LANE(l) p->rho[s].v[l] = skv_decay(&frame->limits, p->h_km.v[l] * k);
    }
}

/// From altitudes.
SKV_INLINE void skv_points_above(const skv_frame *frame, unsigned has, const skv_lanes *h_km, skv_points *p) {
    const float radius = frame->radius_km;
    skv_lanes e;
    SKV_EACH_LANE(l) e.v[l] = h_km->v[l] * (2.0f * radius + h_km->v[l]);
    skv_points_at(frame, has, &e, p);
}

#if SKV_PROFILE_TABULATED
SKV_INLINE void skv_density_tabulated(const skv_frame *frame, int s, const skv_lanes *h_km, skv_lanes *density) {
    const skv_model *model = frame->model;
    if (model->species[s].column == SKV_COLUMN_KNOTS)
        skv_density_knots(frame, s, h_km, density);
    else
        skv_density_lanes(&model->species[s], skv_density_table(model, s), model->top_km, frame->ground_km, h_km,
                          density);
}
#endif

/// Density that scatters: the exponential plus its background, or the profile's own.
SKV_INLINE void skv_scattering_density(const skv_frame *frame, unsigned has, const skv_points *p, int s,
                                       skv_lanes *density) {
#if SKV_PROFILE_TABULATED
    if ((has & SKV_HAS_RATIO) != 0 && frame->model->species[s].column != 0) {
        skv_density_tabulated(frame, s, &p->h_km, density);
        return;
    }
#endif
    *density = p->rho[s];
    if ((has & SKV_HAS_BACKGROUND) != 0) {
        const float background = frame->species[s].background;
        SKV_EACH_LANE(l) density->v[l] += background;
    }
}

SKV_INLINE void skv_columns_background(const skv_frame *frame, unsigned has, const skv_points *p, const skv_lanes *mu,
                                       float factor, skv_columns *out) {
    SKV_EACH_SCATTERER(s) {
        const float background = factor * frame->species[s].background;
        if (SKV_PRESENT(has, s) && background > 0.0f)
            SKV_EACH_LANE(l)
        out->of[s].v[l] +=
            background * skv_to_top(frame->radius_km, frame->top_km, p->h_km.v[l], p->r_km.v[l] * mu->v[l]);
    }
}

// The backends are functions of their own: their callers are many and seldom pressed.
#if SKV_DEPTH_CHAPMAN
static SKV_NOINLINE void skv_columns_chapman_up(const skv_frame *frame, unsigned bits, const skv_points *p,
                                                const skv_lanes *mu, const skv_lanes *sin_chi,
                                                skv_columns *restrict out) {
    const unsigned has = bits & SKV_HAS_BUILT;
    SKV_EACH_SCATTERER(s) {
        if (!SKV_PRESENT(has, s) || skv_is_layer(frame, has, s))
            continue;
        const float ck = frame->species[s].chapman_ck, a = frame->species[s].chapman_a, z = frame->species[s].chapman_z;
        SKV_EACH_LANE(l) {
            const float root = p->root_r.v[l], s8r = skv_power8(sin_chi->v[l]) * p->inv_r.v[l];
            out->of[s].v[l] = a * root * p->rho[s].v[l] * skv_chapman(ck * root, z, mu->v[l], sin_chi->v[l], s8r);
        }
    }
#if SKV_TERM_OZONE || SKV_PROFILE_TABULATED
    if ((has & (SKV_HAS_OZONE | SKV_HAS_RATIO)) != 0)
        skv_columns_tables_up(frame, has, &p->h_km, mu, out);
#endif
    if ((has & SKV_HAS_BACKGROUND) != 0)
        skv_columns_background(frame, has, p, mu, 1.0f, out);
}

static SKV_NOINLINE void skv_columns_chapman_tangent(const skv_frame *frame, unsigned bits, const skv_points *p,
                                                     skv_columns *restrict out) {
    const unsigned has = bits & SKV_HAS_BUILT;
    SKV_EACH_SCATTERER(s) {
        if (!SKV_PRESENT(has, s) || skv_is_layer(frame, has, s))
            continue;
        const float a = 2.0f * frame->species[s].chapman_a, z = frame->species[s].chapman_z;
        SKV_EACH_LANE(l)
        out->of[s].v[l] = a * p->root_r.v[l] * p->rho[s].v[l] * (SKV_ERFCX_AT_0 + SKV_ERFCX_AT_0 * z * p->inv_r.v[l]);
    }
#if SKV_TERM_OZONE || SKV_PROFILE_TABULATED
    if ((has & (SKV_HAS_OZONE | SKV_HAS_RATIO)) != 0)
        skv_columns_tables_tangent(frame, has, &p->h_km, out);
#endif
    if ((has & SKV_HAS_BACKGROUND) != 0) {
        skv_lanes mu;
        SKV_EACH_LANE(l) mu.v[l] = 0.0f;
        skv_columns_background(frame, has, p, &mu, 2.0f, out);
    }
}
#endif

#if SKV_DEPTH_INNER
/// Densities of all species at once, from E = r^2 - R^2: what skv_points_at() and skv_scattering_density() give.
SKV_INLINE void skv_densities(const skv_frame *frame, unsigned has, const skv_lanes *e, skv_columns *out) {
    const skv_model *model = frame->model;
    const float radius = frame->radius_km, top = frame->top_km, radius2 = radius * radius;
    skv_lanes h;
    SKV_EACH_LANE(l) h.v[l] = skv_minf(e->v[l] / (radius + skv_root(radius2 + e->v[l])), top);
    SKV_EACH_SPECIES(s) {
        if (s >= SKV_SCATTERERS || !SKV_PRESENT(has, s))
            continue;
#if SKV_PROFILE_TABULATED
        if ((has & SKV_HAS_RATIO) != 0 && model->species[s].column != 0) {
            skv_density_tabulated(frame, s, &h, &out->of[s]);
            continue;
        }
#endif
        const float k = -frame->species[s].inv_scale_log2e, background = frame->species[s].background;
        SKV_EACH_LANE(l) out->of[s].v[l] = skv_decay(&frame->limits, h.v[l] * k) + background;
    }
#if SKV_TERM_OZONE
    if (SKV_PRESENT(has, SKV_OZONE))
        skv_density_lanes(&model->species[SKV_OZONE], model->ozone_density, model->top_km, frame->ground_km, &h,
                          &out->of[SKV_OZONE]);
#endif
    (void)model;
}

/// By Gauss-Legendre nodes in an exponential map: any profile, any size of planet.
static SKV_NOINLINE void skv_columns_inner_up(const skv_frame *frame, unsigned bits, const skv_points *p,
                                              const skv_lanes *mu, skv_columns *restrict out) {
    const unsigned has = bits & SKV_HAS_BUILT;
    const int want = frame->quality.depth_samples, m = want < 2 ? 2 : want > 16 ? 16 : want;
    const float *node = skv_gauss_node + skv_gauss_offset(m), *weight = skv_gauss_weight + skv_gauss_offset(m);
    const float radius = frame->radius_km, hs = frame->inner_scale_km;
    skv_lanes l_km, k;
    SKV_EACH_LANE(l) {
        const float c = mu->v[l];
        const float top = skv_to_top(radius, frame->top_km, p->h_km.v[l], p->r_km.v[l] * c);
        l_km.v[l] = hs / (0.5f * c + skv_root(0.25f * c * c + 0.5f * hs * p->inv_r.v[l]));
        k.v[l] = skv_log1pf(top / l_km.v[l]);
    }
    SKV_EACH_SPECIES(s)
    if (SKV_PRESENT(has, s))
        SKV_EACH_LANE(l) out->of[s].v[l] = 0.0f;
    for (int i = 0; i < m; i++) {
        skv_columns rho;
        skv_lanes ds, eq;
        SKV_EACH_LANE(l) {
            const float e = skv_exp2f(k.v[l] * 1.44269504f * node[i]);
            const float s = l_km.v[l] * (e - 1.0f), h = p->h_km.v[l];
            ds.v[l] = weight[i] * k.v[l] * l_km.v[l] * e;
            eq.v[l] = skv_maxf(h * (2.0f * radius + h) + s * (2.0f * p->r_km.v[l] * mu->v[l] + s), 0.0f);
        }
        skv_densities(frame, has, &eq, &rho);
        SKV_EACH_SPECIES(s)
        if (SKV_PRESENT(has, s))
            SKV_EACH_LANE(l) out->of[s].v[l] += ds.v[l] * rho.of[s].v[l];
    }
}
#endif

/// Columns upward, mu >= 0, by the frame's backend.
SKV_INLINE void skv_columns_up(const skv_frame *frame, unsigned has, const skv_points *p, const skv_lanes *mu,
                               const skv_lanes *sin_chi, skv_columns *out) {
#if SKV_DEPTH_INNER
    if (!SKV_DEPTH_CHAPMAN || (has & SKV_HAS_INNER) != 0) {
        skv_columns_inner_up(frame, has, p, mu, out);
        return;
    }
#endif
#if SKV_DEPTH_CHAPMAN
    skv_columns_chapman_up(frame, has, p, mu, sin_chi, out);
#endif
    (void)sin_chi;
}

/// Columns of the whole ray that is tangent at p: both halves.
SKV_INLINE void skv_columns_tangent(const skv_frame *frame, unsigned has, const skv_points *p, skv_columns *out) {
#if SKV_DEPTH_INNER
    if (!SKV_DEPTH_CHAPMAN || (has & SKV_HAS_INNER) != 0) {
        skv_lanes mu;
        SKV_EACH_LANE(l) mu.v[l] = 0.0f;
        skv_columns_inner_up(frame, has, p, &mu, out);
        SKV_EACH_SPECIES(s)
        if (SKV_PRESENT(has, s))
            SKV_EACH_LANE(l) out->of[s].v[l] *= 2.0f;
        return;
    }
#endif
#if SKV_DEPTH_CHAPMAN
    skv_columns_chapman_tangent(frame, has, p, out);
#endif
}

/// The closed form counts the air above the top; this is what a ray that leaves with r_top mu_e meets there:
/// erfcx(y) ~ 2/sqrt(pi)/(y + sqrt(y^2 + 4/pi)), a few % of a small correction.
SKV_INLINE void skv_columns_cut_top(const skv_frame *frame, unsigned has, const skv_points *p, const skv_lanes *rm,
                                    skv_columns *out) {
    const float top = frame->top_km, rt = frame->radius_km + top, inv_rt2 = 1.0f / (rt * rt);
    SKV_EACH_SCATTERER(s) {
        const float cut = frame->species[s].top_column, kx = frame->species[s].top_k;
        if (!SKV_PRESENT(has, s) || !(cut > 0.0f))
            continue;
        SKV_EACH_LANE(l) {
            const float c = (top - p->h_km.v[l]) * (frame->radius_km + rt + p->h_km.v[l]);
            const float m2 = (rm->v[l] * rm->v[l] + c) * inv_rt2;
            out->of[s].v[l] -= cut / (skv_root(m2) + skv_root(m2 + kx * skv_maxf(1.0f - m2, 0.0f)));
        }
    }
}

/// Columns toward a light that no ground hides, per lane: mu of either sign. >= 0.
SKV_INLINE void skv_columns_light(const skv_frame *frame, unsigned has, const skv_points *p, const skv_lanes *rms,
                                  skv_columns *out) {
    skv_lanes mu, sin_chi;
    SKV_EACH_LANE(l) {
        const float c = skv_minf(skv_fabsf(rms->v[l] * p->inv_r.v[l]), 1.0f);
        mu.v[l] = c;
        sin_chi.v[l] = skv_root(1.0f - c * c);
    }
    skv_columns_up(frame, has, p, &mu, &sin_chi, out);
    if ((has & SKV_HAS_DOWN) != 0) {
        skv_points t;
        skv_columns both;
        skv_lanes e;
        const float radius = frame->radius_km;
        SKV_EACH_LANE(l)
        e.v[l] = skv_maxf(p->h_km.v[l] * (2.0f * radius + p->h_km.v[l]) - rms->v[l] * rms->v[l], 0.0f);
        skv_points_at(frame, has, &e, &t);
        skv_columns_tangent(frame, has, &t, &both);
        SKV_EACH_SPECIES(s)
        if (SKV_PRESENT(has, s))
            SKV_EACH_LANE(l) {
                const float up = out->of[s].v[l], down = both.of[s].v[l] - up;
                out->of[s].v[l] = rms->v[l] < 0.0f ? down : up;
            }
    }
    if ((has & SKV_HAS_CUT) != 0)
        skv_columns_cut_top(frame, has, p, rms, out);
    SKV_EACH_SPECIES(s)
    if (SKV_PRESENT(has, s))
        SKV_EACH_LANE(l) out->of[s].v[l] = skv_maxf(out->of[s].v[l], 0.0f);
}

/// Optical depth of columns times log2(e).
SKV_INLINE float skv_optical_depth_log2e(const skv_frame *frame, unsigned has, const skv_columns *c, int band, int l) {
    float tau = 0.0f;
    SKV_EACH_SPECIES(s)
    if (SKV_PRESENT(has, s))
        tau += frame->extinction_log2e_per_km[s][band] * c->of[s].v[l];
    return tau;
}

#endif
