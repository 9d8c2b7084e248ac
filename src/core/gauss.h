/// The rule gauss-exp: N Gauss-Legendre nodes per lit part of a ray, in an exponential map from its densest end.
///
/// A leg is a piece of a ray on which the altitude only grows with the distance s from its origin: from the observer up,
/// from the tangent point either way, or from the ground back to the observer. Of it [a, b] is lit. With the origin of
/// the map at a, s = a + l(exp(k u) - 1), k = log(1 + (b-a)/l), ds = k l exp(k u) du, u in [0, 1].
/// View columns: from the observer to P they are K + sigma col(P, up along the leg); K belongs to the leg.
#ifndef SKV_CORE_GAUSS_H
#define SKV_CORE_GAUSS_H

#include "core/scatter.h"

typedef struct skv_legs {
    skv_lanes h_km, rm, rms, nu; ///< at the origin: altitude, r mu (>= 0), r mu_s, cos(leg direction, light)
    skv_lanes a, b;              ///< lit range, km from the origin; b <= a: nothing
    skv_lanes p_km;              ///< r sin(zenith angle), constant along a ray
    skv_lanes sigma;             ///< -1: the observer is at the origin's end, +1: at the far end
    skv_lanes phase[2];          ///< Rayleigh, aerosol, 1/sr
    skv_columns k;
    float *out[SKV_LANES];       ///< where the radiance is added, [bands]
} skv_legs;

/// Scale of the map: altitude scale Hs(mu_s) over the slope of the ray, shortened where the air is dense.
SKV_INLINE float skv_map_length(float hs, float mu, float r, float extinction_per_km, float weight) {
    const float inv = (0.5f * mu + skv_sqrtf(0.25f * mu * mu + 0.5f * hs / r)) / hs;
    return 1.0f / (inv + weight * extinction_per_km);
}

/// Hs against the sine of the light's elevation: one smooth function, so that nothing pops.
SKV_INLINE float skv_map_scale(float mu_s) {
    const float x = skv_clampf((0.2f - mu_s) * 2.5f, 0.0f, 1.0f);
    return 6.0f + 6.0f * x * x * (3.0f - 2.0f * x);
}

/// Moves the origin of each leg to the start of its lit range.
SKV_INLINE void skv_legs_start(const skv_frame *frame, const skv_legs *leg, skv_points *o, skv_lanes *e0, skv_lanes *rm,
                               skv_lanes *rms) {
    const float radius = frame->radius_km;
    SKV_EACH_LANE(l) {
        const float h = leg->h_km.v[l], a = leg->a.v[l];
        const float e = h * (2.0f * radius + h) + a * (2.0f * leg->rm.v[l] + a);
        o->h_km.v[l] = skv_clampf(skv_altitude(radius, e, &o->r_km.v[l]), 0.0f, frame->top_km);
        e0->v[l] = e;
        rm->v[l] = leg->rm.v[l] + a;
        rms->v[l] = leg->rms.v[l] + a * leg->nu.v[l];
    }
    skv_points_densities(frame, o);
}

/// Single scattering along `count` legs, added to where they say.
static void skv_gauss_legs(const skv_frame *frame, const skv_legs *leg, int count, const float irradiance[4]) {
    const skv_model *model = frame->model;
    const int n = frame->quality.samples, bands = skv_bands(model);
    const float *node = skv_gauss_node + skv_gauss_offset(n), *weight = skv_gauss_weight + skv_gauss_offset(n);
    const float radius = frame->radius_km;
    skv_points p;
    skv_lanes e0, rm, rms, l_km, k, whole, e_far, mu, sin_view, ds, radiance[SKV_BANDS_MAX];

    skv_legs_start(frame, leg, &p, &e0, &rm, &rms);
    float lowest = 0.0f;
    SKV_EACH_LANE(l) {
        const float r = p.r_km.v[l];
        float extinction = 0.0f;
        if (skv_present(frame, SKV_RAYLEIGH))
            extinction += p.rho[SKV_RAYLEIGH].v[l] * frame->map_per_km[SKV_RAYLEIGH];
        if (skv_present(frame, SKV_AEROSOL))
            extinction += p.rho[SKV_AEROSOL].v[l] * frame->map_per_km[SKV_AEROSOL];
        const float length = skv_maxf(leg->b.v[l] - leg->a.v[l], 0.0f);
        l_km.v[l] = skv_map_length(skv_map_scale(rms.v[l] / r), rm.v[l] / r, r, extinction, 0.15f);
        whole.v[l] = 1.0f + length / l_km.v[l];
        k.v[l] = skv_log1pf(length / l_km.v[l]);
    }
    SKV_EACH_LANE(l) {
        const float far = rms.v[l] + (leg->b.v[l] - leg->a.v[l]) * leg->nu.v[l];
        lowest = skv_minf(lowest, skv_minf(rms.v[l], far));
    }
    const int down = lowest < 0.0f;
    for (int b = 0; b < bands; b++)
        SKV_EACH_LANE(l) radiance[b].v[l] = 0.0f;

    // Nodes come in pairs u, 1-u: exp(k(1-u)) = exp(k)/exp(k u) saves every second exponential.
    for (int i = 0; i < n; i++) {
        const int far = i & 1, at = far ? n - 1 - i / 2 : i / 2;
        if (far)
            SKV_EACH_LANE(l) e_far.v[l] = whole.v[l] / e_far.v[l];
        else
            SKV_EACH_LANE(l) e_far.v[l] = skv_exp2f_d5(k.v[l] * (1.44269504f * node[at]));
        skv_lanes rms_p;
        SKV_EACH_LANE(l) {
            const float e = e_far.v[l];
            const float s = l_km.v[l] * (e - 1.0f);
            ds.v[l] = weight[at] * k.v[l] * l_km.v[l] * e;
            const float ep = e0.v[l] + s * (2.0f * rm.v[l] + s);
            float r;
            p.h_km.v[l] = skv_clampf(skv_altitude(radius, skv_maxf(ep, 0.0f), &r), 0.0f, frame->top_km);
            p.r_km.v[l] = r;
            mu.v[l] = skv_clampf((rm.v[l] + s) / r, 0.0f, 1.0f);
            sin_view.v[l] = skv_minf(leg->p_km.v[l] / r, 1.0f);
            rms_p.v[l] = rms.v[l] + s * leg->nu.v[l];
        }
        skv_columns view, light;
        skv_points_densities(frame, &p);
        skv_columns_up(frame, &p, &mu, &sin_view, &view);
        skv_columns_light(frame, &p, &rms_p, down, &light);
        for (int s = 0; s < SKV_SPECIES; s++)
            if (skv_present(frame, s))
                SKV_EACH_LANE(l)
                    light.of[s].v[l] = skv_maxf(
                        light.of[s].v[l] + skv_maxf(leg->k.of[s].v[l] + leg->sigma.v[l] * view.of[s].v[l], 0.0f), 0.0f);
        skv_scatter(frame, &p, leg->phase, &ds, &light, radiance);
    }
    for (int l = 0; l < count; l++)
        for (int b = 0; b < bands; b++)
            leg->out[l][b] += radiance[b].v[l] * irradiance[b];
}

#endif
