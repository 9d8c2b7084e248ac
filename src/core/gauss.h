/// The rule gauss-exp: N Gauss-Legendre nodes per lit part of a ray, in an exponential map from its densest end.
///
/// A leg is a piece of a ray on which the altitude only grows with the distance s from its origin: from the observer
/// up, from the tangent point either way, or from the ground back to the observer. Of it [a, b] is lit. With the origin
/// of the map at a, s = a + l(exp(k u) - 1), k = log(1 + (b-a)/l), ds = k l exp(k u) du, u in [0, 1]. View columns:
/// from the observer to P they are K + sigma col(P, up along the leg); K belongs to the leg.
#ifndef SKV_CORE_GAUSS_H
#define SKV_CORE_GAUSS_H

#include "core/legs.h"
#include "core/scatter.h"

#if SKV_RULE_GAUSS_EXP

/// A sample per lane: what skv_scatter() needs of it.
typedef struct skv_samples {
    skv_lanes ds;      ///< path length it stands for
    skv_lanes e;       ///< r^2 - R^2
    skv_lanes rm, rms; ///< r mu along the leg, r mu_s
    skv_points p;
    skv_columns c;     ///< light -> sample -> observer
    skv_lanes mu_view; ///< cosines of the zenith angles of view and light, and the light's tangent altitude: for tables
    skv_lanes mu_light, tangent_km;
} skv_samples;

/// Columns of exponentials in closed form, in one pass.
SKV_INLINE void skv_samples_closed(const skv_frame *frame, unsigned has, const skv_legs *leg, skv_samples *q) {
    const skv_frame_limits *limits = &frame->limits;
    const float radius = frame->radius_km, radius2 = radius * radius, top = frame->top_km;
    const float rt = radius + top, inv_rt2 = 1.0f / (rt * rt);
    SKV_EACH_LANE(l) {
        const float e = q->e.v[l], rms = q->rms.v[l];
        const float r = skv_root(radius2 + e), h = skv_minf(e / (radius + r), top);
        const float inv_r = 1.0f / r, root_r = skv_root(r);
        const float mv = q->rm.v[l] * inv_r, sv = skv_minf(leg->p_km.v[l] * inv_r, limits->one);
        const float ml = skv_minf(skv_fabsf(rms * inv_r), limits->one), sl = skv_root(1.0f - ml * ml);
        const float v8 = skv_power8(sv) * inv_r, l8 = skv_power8(sl) * inv_r;
        float tangent_r = radius, tangent_h = 0.0f;
        if ((has & SKV_HAS_DOWN) != 0) {
            const float et = skv_maxf(h * (2.0f * radius + h) - rms * rms, limits->zero);
            tangent_r = skv_root(radius2 + et);
            tangent_h = skv_minf(et / (radius + tangent_r), top);
        }
        const float m2 = skv_minf((rms * rms + (top - h) * (radius + rt + h)) * inv_rt2, limits->one);
        SKV_EACH_SCATTERER(s) {
            if (!SKV_PRESENT(has, s))
                continue;
            const skv_frame_species *sp = &frame->species[s];
            const float rho = skv_decay(limits, -h * sp->inv_scale_log2e), kr = sp->chapman_ck * root_r;
            const float amount = sp->chapman_a * root_r * rho;
            const float view = amount * skv_chapman(kr, sp->chapman_z, mv, sv, v8);
            float light = amount * skv_chapman(kr, sp->chapman_z, ml, sl, l8);
            if ((has & SKV_HAS_DOWN) != 0) {
                const float both = 2.0f * sp->chapman_a * skv_root(tangent_r) *
                                   skv_decay(limits, -tangent_h * sp->inv_scale_log2e) *
                                   (SKV_ERFCX_AT_0 + SKV_ERFCX_AT_0 * sp->chapman_z / tangent_r);
                light = rms < 0.0f ? both - light : light;
            }
            if ((has & SKV_HAS_CUT) != 0)
                light -= sp->top_column / (skv_root(m2) + skv_root(m2 + sp->top_k * (1.0f - m2)));
            q->p.rho[s].v[l] = rho;
            q->c.of[s].v[l] = light + (leg->k.of[s].v[l] + leg->sigma.v[l] * view);
        }
        q->p.h_km.v[l] = h;
#if SKV_TERM_OZONE
        if (SKV_PRESENT(has, SKV_OZONE)) {
            q->mu_view.v[l] = mv;
            q->mu_light.v[l] = ml;
            q->tangent_km.v[l] = tangent_h;
        }
#endif
    }
}

#if SKV_TERM_OZONE
/// Ozone's columns from its table.
SKV_INLINE void skv_samples_ozone(const skv_frame *frame, unsigned has, const skv_legs *leg, skv_samples *q) {
    skv_lanes t, view, light;
    skv_lookup k;
    const skv_column_table *table = &frame->model->ozone_column;
    SKV_EACH_LANE(l) t.v[l] = 1.0f / (1.0f + 14.0f * q->mu_view.v[l]);
    skv_lookup_column(frame, table, 0, &q->p.h_km, &t, &k, &view);
    SKV_EACH_LANE(l) view.v[l] *= t.v[l];
    SKV_EACH_LANE(l) t.v[l] = 1.0f / (1.0f + 14.0f * q->mu_light.v[l]);
    skv_lookup_column(frame, table, 0, &q->p.h_km, &t, &k, &light);
    SKV_EACH_LANE(l) light.v[l] *= t.v[l];
    if ((has & SKV_HAS_DOWN) != 0) {
        skv_lookup_tangent(frame, table, 0, &q->tangent_km, &k, &t);
        SKV_EACH_LANE(l) {
            const float down = 2.0f * t.v[l] - light.v[l];
            light.v[l] = q->rms.v[l] < 0.0f ? down : light.v[l];
        }
    }
    SKV_EACH_LANE(l)
    q->c.of[SKV_OZONE].v[l] = light.v[l] + (leg->k.of[SKV_OZONE].v[l] + leg->sigma.v[l] * view.v[l]);
}
#endif

/// Columns of any profiles by any backend.
SKV_INLINE void skv_samples_general(const skv_frame *frame, unsigned has, const skv_legs *leg, skv_samples *q) {
    skv_lanes *const mu = &q->mu_view, *const sin_view = &q->mu_light;
    skv_points_at(frame, has, &q->e, &q->p);
    skv_columns_light(frame, has, &q->p, &q->rms, &q->c);
    skv_columns view; // only now: what the light's columns were made in is free again
    SKV_EACH_LANE(l) {
        mu->v[l] = skv_clampf(q->rm.v[l] * q->p.inv_r.v[l], 0.0f, 1.0f);
        sin_view->v[l] = skv_minf(leg->p_km.v[l] * q->p.inv_r.v[l], 1.0f);
    }
    skv_columns_up(frame, has, &q->p, mu, sin_view, &view);
    SKV_EACH_SPECIES(s)
    if (SKV_PRESENT(has, s))
        SKV_EACH_LANE(l)
    q->c.of[s].v[l] += skv_maxf(leg->k.of[s].v[l] + leg->sigma.v[l] * view.of[s].v[l], 0.0f);
}

/// Single scattering along `count` legs, added to where they say.
SKV_INLINE void skv_gauss_kernel(const skv_frame *frame, unsigned has, int general, const skv_legs *leg, int count,
                                 const float irradiance[4]) {
    const int n = frame->quality.samples, bands = SKV_BANDS_OF(has);
    const float *const node = frame->node, *const weight = frame->weight;
    skv_samples q;
    skv_lanes e0, rm, rms, l_km, k, whole, grown, radiance[SKV_BANDS_MAX];
    skv_legs_start(frame, has, leg, &q.p, &e0, &rm, &rms);
    skv_legs_map(frame, has, leg, &q.p, &rm, &rms, &l_km, &k, &whole);
    for (int b = 0; b < bands; b++)
        SKV_EACH_LANE(l) radiance[b].v[l] = 0.0f;
    SKV_EACH_LANE(l) grown.v[l] = 1.0f;

    // Nodes come in pairs u, 1-u: exp(k(1-u)) = exp(k)/exp(k u) saves every second exponential.
    for (int i = 0; i < n; i++) {
        const int far = i & 1, at = far ? n - 1 - i / 2 : i / 2;
        const float u = 1.44269504f * node[at], w = weight[at];
        if (far)
            SKV_EACH_LANE(l) grown.v[l] = whole.v[l] / grown.v[l];
        else
            SKV_EACH_LANE(l) grown.v[l] = skv_exp2f_d5(k.v[l] * u);
        SKV_EACH_LANE(l) {
            const float g = grown.v[l], s = l_km.v[l] * (g - 1.0f);
            q.ds.v[l] = w * k.v[l] * l_km.v[l] * g;
            q.e.v[l] = skv_maxf(e0.v[l] + s * (2.0f * rm.v[l] + s), frame->limits.zero);
            q.rm.v[l] = rm.v[l] + s;
            q.rms.v[l] = rms.v[l] + s * leg->nu.v[l];
        }
        if (general)
            skv_samples_general(frame, has, leg, &q);
        else
            skv_samples_closed(frame, has, leg, &q);
#if SKV_TERM_OZONE
        if (!general && SKV_PRESENT(has, SKV_OZONE))
            skv_samples_ozone(frame, has, leg, &q);
#endif
        skv_scatter(frame, has, &q.p, leg->phase, &q.ds, &q.c, radiance);
    }
    for (int l = 0; l < count; l++)
        for (int b = 0; b < bands; b++)
            leg->out[l][b] = skv_minf(leg->out[l][b] + radiance[b].v[l] * irradiance[b], SKV_RADIANCE_MAX);
}

/// Whether any sample of any leg may see the light below its horizontal: r mu_s is linear along a leg. Signs are
/// gathered as bits: such a reduction is vectorised.
SKV_INLINE unsigned skv_legs_down(const skv_legs *leg) {
    uint32_t signs = 0;
    SKV_EACH_LANE(l) {
        const float rms = leg->rms.v[l], nu = leg->nu.v[l];
        signs |= skv_bits(rms + leg->a.v[l] * nu) | skv_bits(rms + leg->b.v[l] * nu);
    }
    return (signs & 0x80000000u) != 0 ? (unsigned)SKV_HAS_DOWN : 0u;
}

#if SKV_SPECIALISE
/// The kernel for what most frames are; functions of their own, so that their stacks do not add up. CUT costs little
/// and is exact where it is not needed.
enum {
    SKV_HAS_TWO = SKV_HAS_RAYLEIGH | SKV_HAS_AEROSOL | SKV_HAS_CUT,
    SKV_HAS_ALL = SKV_HAS_TWO | SKV_HAS_OZONE,
    /// All species that are compiled in, for a build that was trimmed to what it needs.
    SKV_HAS_TRIMMED = (SKV_HAS_BUILT & ((1 << SKV_SPECIES) - 1)) | SKV_HAS_CUT | (SKV_BANDS == 4 ? SKV_HAS_FOUR : 0)
};

#define SKV_GAUSS_KERNEL(name, bits)                                                                                   \
    static SKV_NOINLINE void name(const skv_frame *frame, const skv_legs *leg, int count, const float irradiance[4]) { \
        skv_gauss_kernel(frame, (unsigned)(bits), 0, leg, count, irradiance);                                          \
    }                                                                                                                  \
    static SKV_NOINLINE void name##_down(const skv_frame *frame, const skv_legs *leg, int count,                       \
                                         const float irradiance[4]) {                                                  \
        skv_gauss_kernel(frame, (unsigned)(bits) | SKV_HAS_DOWN, 0, leg, count, irradiance);                           \
    }
/// Runs one of the pair and returns where `has` is what it was made for.
#define SKV_GAUSS_TRY(name, bits)                                                                                      \
    if ((has & ~(unsigned)SKV_HAS_DOWN) == (unsigned)(bits)) {                                                         \
        ((has & SKV_HAS_DOWN) != 0 ? name##_down : name)(frame, leg, count, irradiance);                               \
        return 1;                                                                                                      \
    }
#if SKV_BANDS != 0
SKV_GAUSS_KERNEL(skv_gauss_trimmed, SKV_HAS_TRIMMED)
#else
SKV_GAUSS_KERNEL(skv_gauss_two_3, SKV_HAS_TWO)
SKV_GAUSS_KERNEL(skv_gauss_two_4, SKV_HAS_TWO | SKV_HAS_FOUR)
#if SKV_TERM_OZONE
SKV_GAUSS_KERNEL(skv_gauss_all_3, SKV_HAS_ALL)
SKV_GAUSS_KERNEL(skv_gauss_all_4, SKV_HAS_ALL | SKV_HAS_FOUR)
#endif
#endif

/// @return whether there is a kernel for it, which has run then.
static int skv_gauss_special(const skv_frame *frame, unsigned has, const skv_legs *leg, int count,
                             const float irradiance[4]) {
    has |= SKV_HAS_CUT;
#if SKV_BANDS != 0
    SKV_GAUSS_TRY(skv_gauss_trimmed, SKV_HAS_TRIMMED)
#else
    SKV_GAUSS_TRY(skv_gauss_two_3, SKV_HAS_TWO)
    SKV_GAUSS_TRY(skv_gauss_two_4, SKV_HAS_TWO | SKV_HAS_FOUR)
#if SKV_TERM_OZONE
    SKV_GAUSS_TRY(skv_gauss_all_3, SKV_HAS_ALL)
    SKV_GAUSS_TRY(skv_gauss_all_4, SKV_HAS_ALL | SKV_HAS_FOUR)
#endif
#endif
    return 0;
}
#else
static inline int skv_gauss_special(const skv_frame *frame, unsigned has, const skv_legs *leg, int count,
                                    const float irradiance[4]) {
    (void)frame;
    (void)has;
    (void)leg;
    (void)count;
    (void)irradiance;
    return 0;
}
#endif

static SKV_NOINLINE void skv_gauss_any(const skv_frame *frame, unsigned has, const skv_legs *leg, int count,
                                       const float irradiance[4]) {
    skv_gauss_kernel(frame, has & (SKV_HAS_BUILT & ~SKV_HAS_GENERAL), 0, leg, count, irradiance);
}

static SKV_NOINLINE void skv_gauss_general(const skv_frame *frame, unsigned has, const skv_legs *leg, int count,
                                           const float irradiance[4]) {
    skv_gauss_kernel(frame, has & SKV_HAS_BUILT, 1, leg, count, irradiance);
}

static void skv_gauss_legs(const skv_frame *frame, const skv_legs *leg, int count, const float irradiance[4]) {
    const unsigned has = frame->has | skv_legs_down(leg);
    if ((has & SKV_HAS_GENERAL) != 0)
        skv_gauss_general(frame, has, leg, count, irradiance);
    else if (!skv_gauss_special(frame, has, leg, count, irradiance))
        skv_gauss_any(frame, has, leg, count, irradiance);
}

#endif

#endif
