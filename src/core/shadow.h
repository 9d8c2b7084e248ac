/// The planet's shadow on a leg: one stretch at most, found exactly.
///
/// With A = 1 - nu^2, B = (position - its part along the light) . direction, C = r^2 - R^2 - (r mu_s)^2 the squared
/// distance to the shadow's axis minus R^2 is A s^2 + 2 B s + C; dark is where it is negative on the far side of the
/// planet, r mu_s + s nu < 0. A ray whose light only dips low, just missing the ground, is cut at the lowest point all
/// the same: the light has a sharp minimum there, and nothing jumps when it is hidden at last.
#ifndef SKV_CORE_SHADOW_H
#define SKV_CORE_SHADOW_H

#include "core/rays.h"

#if SKV_RULE_GAUSS_EXP

/// Altitude, over the thickest layer's scale height / 8 km, that a light ray must keep to count as unhindered.
#define SKV_SHADOW_CLEAR 40.0f

/// @param[in]  rms, nu  of the leg: r mu_s at its origin, cos(its direction, light).
/// @param[out] from, to the dark stretch within [a, b]; from >= to where there is none.
/// @return whether any lane has one.
static SKV_NOINLINE int skv_leg_shadow(const skv_frame *frame, const skv_block *block, int part,
                                       const skv_block_light *light, const skv_lanes *rms, const skv_lanes *nu,
                                       skv_lanes *restrict from, skv_lanes *restrict to) {
    const float radius = frame->radius_km, r0 = radius + frame->height_km;
    // r^2 - R^2 of the light's rays that are as good as unhindered, with the sign of the discriminant.
    const float low = -SKV_SHADOW_CLEAR * frame->map_scale * (2.0f * radius);
    uint32_t signs = 0, any = 0;
    SKV_EACH_LANE(l)
    signs |= skv_bits(rms->v[l]) | skv_bits(rms->v[l] + block->leg[part].b.v[l] * nu->v[l]);
    if ((signs & 0x80000000u) == 0)
        return 0;
    SKV_EACH_LANE(l) {
        const float h = block->leg[part].h_km.v[l], begin = block->leg[part].a.v[l], end = block->leg[part].b.v[l];
        const float a = light->cross2.v[l];
        const float b = block->leg[part].dir.v[l] * (r0 * light->climb.v[l] + block->leg[part].from_km.v[l] * a);
        const float c = h * (2.0f * radius + h) - rms->v[l] * rms->v[l];
        const float disc = b * b - a * c;
        const float q = skv_root(skv_maxf(disc, 0.0f));
        const float t = b < 0.0f ? q - b : -(b + q);
        const float t1 = t / a, t2 = disc > 0.0f ? c / (skv_fabsf(t) > 1e-30f ? t : 1e-30f) : t1;
        const float lo = skv_maxf(skv_minf(t1, t2), begin), hi = skv_minf(skv_maxf(t1, t2), end);
        const int dark = (disc > a * low) & (lo <= hi) & (rms->v[l] + 0.5f * (lo + hi) * nu->v[l] < 0.0f);
        from->v[l] = dark ? lo : end;
        to->v[l] = dark ? hi : end;
    }
    SKV_EACH_LANE(l) any |= skv_bits(from->v[l]) ^ skv_bits(block->leg[part].b.v[l]);
    return any != 0;
}

#endif

#endif
