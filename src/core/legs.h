/// Legs of rays, their parts [a, b], and the exponential map along these: what the integrals over light scattered once
/// and over diffuse light share.
///
/// A leg is a piece of a ray on which the altitude only grows with the distance s from its origin: from the observer
/// up, from the tangent point either way, or from the ground back to the observer. With the origin of the map at a,
/// s = a + l(exp(k u) - 1), k = log(1 + (b-a)/l), ds = k l exp(k u) du, u in [0, 1].
#ifndef SKV_CORE_LEGS_H
#define SKV_CORE_LEGS_H

#include "core/rays.h"

typedef struct skv_legs {
    skv_lanes h_km, rm, rms, nu;     ///< at the origin: altitude, r mu (>= 0), r mu_s, cos(leg direction, light)
    skv_lanes a, b;                  ///< lit range, km from the origin; b <= a: nothing
    skv_lanes end;                   ///< where the leg itself ends; b is that or where the shadow begins
    skv_lanes p_km;                  ///< r sin(zenith angle), constant along a ray
    skv_lanes sigma;                 ///< -1: the observer is at the origin's end, +1: at the far end
    skv_lanes phase[SKV_SCATTERERS]; ///< 1/sr
    skv_columns k;
    float *out[SKV_LANES]; ///< where the radiance is added, [bands]
} skv_legs;

/// 1/l: the slope of the ray over the altitude scale Hs, more where the air is dense.
SKV_INLINE float skv_map_inverse(float hs, float mu, float inv_r, float extinction_per_km) {
    return (0.5f * mu + skv_root(0.25f * mu * mu + 0.5f * hs * inv_r)) / hs + 0.19f * extinction_per_km;
}

/// Hs against the sine of the light's elevation, km where the largest scale height is 8 km: smooth, so that nothing
/// pops.
SKV_INLINE float skv_map_scale(float mu_s) {
    const float x = skv_clampf((0.2f - mu_s) * 2.5f, 0.0f, 1.0f);
    return 6.0f + 8.0f * x * x * (3.0f - 2.0f * x);
}

/// Moves the origin of each leg to the start of its lit range.
SKV_INLINE void skv_legs_start(const skv_frame *frame, unsigned has, const skv_legs *leg, skv_points *o, skv_lanes *e0,
                               skv_lanes *rm, skv_lanes *rms) {
    const float radius = frame->radius_km;
    SKV_EACH_LANE(l) {
        const float h = leg->h_km.v[l], a = leg->a.v[l];
        e0->v[l] = h * (2.0f * radius + h) + a * (2.0f * leg->rm.v[l] + a);
        rm->v[l] = leg->rm.v[l] + a;
        rms->v[l] = leg->rms.v[l] + a * leg->nu.v[l];
    }
    skv_points_at(frame, has, e0, o);
}

/// The map of each leg: l, k, and exp(k).
SKV_INLINE void skv_legs_map(const skv_frame *frame, unsigned has, const skv_legs *leg, const skv_points *o,
                             const skv_lanes *rm, const skv_lanes *rms, skv_lanes *l_km, skv_lanes *k,
                             skv_lanes *whole) {
    const float *const dense = frame->map_per_km;
    SKV_EACH_LANE(l) {
        float extinction = 0.0f;
        SKV_EACH_SCATTERER(s)
        if (SKV_PRESENT(has, s))
            extinction += o->rho[s].v[l] * dense[s];
        const float inv_r = o->inv_r.v[l];
        const float inv =
            skv_map_inverse(frame->map_scale * skv_map_scale(rms->v[l] * inv_r), rm->v[l] * inv_r, inv_r, extinction);
        const float x = skv_maxf(leg->b.v[l] - leg->a.v[l], 0.0f) * inv;
        l_km->v[l] = 1.0f / inv;
        k->v[l] = skv_log1pf(x);
        whole->v[l] = 1.0f + x;
    }
}

/// One leg of each ray as the light sees it.
SKV_INLINE void skv_legs_fill(const skv_frame *frame, unsigned has, int light, const skv_block *block, int part,
                              const skv_block_light *toward, const skv_columns *k, skv_legs *leg) {
    const float rms0 = (frame->radius_km + frame->height_km) * frame->light[light].mu_s;
    SKV_EACH_LANE(l) {
        const float dir = block->leg[part].dir.v[l];
        leg->h_km.v[l] = block->leg[part].h_km.v[l];
        leg->rm.v[l] = block->leg[part].rm.v[l];
        leg->rms.v[l] = rms0 + block->leg[part].from_km.v[l] * toward->nu.v[l];
        leg->nu.v[l] = dir * toward->nu.v[l];
        leg->a.v[l] = block->leg[part].a.v[l];
        leg->b.v[l] = leg->end.v[l] = block->leg[part].b.v[l];
        leg->p_km.v[l] = block->p_km.v[l];
        leg->sigma.v[l] = -dir;
    }
    SKV_EACH_SCATTERER(s)
    if (SKV_PRESENT(has, s))
        leg->phase[s] = toward->phase[s];
    SKV_EACH_SPECIES(s)
    if (SKV_PRESENT(has, s))
        leg->k.of[s] = k->of[s];
}

#endif
