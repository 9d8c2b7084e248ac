/// Limb darkening of the sun, I(mu)/I(1) = sum of A_k mu^k, k = 0 to 5 [Neckel05]: A_0 = a + b/lambda,
/// A_k = c_k + d_k/lambda^5 for k >= 2, A_1 the rest to 1; lambda in micrometres, [0.3, 1.1].
#ifndef SKV_SCENE_LIMB_H
#define SKV_SCENE_LIMB_H

#include "core/elementary.h"

typedef struct skv_limb_range {
    float a, b, c[4], d[4];
} skv_limb_range;

#define SKV_LIMB_FIRST_UM 0.3f
#define SKV_LIMB_LAST_UM  1.1f
/// The Balmer jump, between two ranges, and where the third begins.
#define SKV_LIMB_JUMP_UM  0.37298f
#define SKV_LIMB_RED_UM   0.385f
#define SKV_LIMB_THIRD_UM 0.42257f

static const skv_limb_range skv_limb_ranges[3] = {
    {0.35601f, -0.085217f, {-0.67237f, 0.18696f, 0.00038f, 0.01373f}, {0.003589f, -0.002415f, 0.000897f, -0.000200f}},
    {0.09900f, 0.010643f, {-2.80511f, 3.32780f, -2.17878f, 0.58825f}, {0.024873f, -0.029317f, 0.018273f, -0.004663f}},
    {0.75267f, -0.265577f, {-1.89287f, 2.42234f, -1.71150f, 0.49062f}, {0.012582f, -0.017117f, 0.011977f, -0.003347f}},
};

static inline void skv_limb_in_range(float a[6], int range, float um) {
    const skv_limb_range *const r = &skv_limb_ranges[range];
    const float inv = 1.0f / um, inv2 = inv * inv, inv5 = inv2 * inv2 * inv;
    a[0] = r->a + r->b * inv;
    float rest = 1.0f - a[0];
    for (int k = 0; k < 4; k++) {
        a[k + 2] = r->c[k] + r->d[k] * inv5;
        rest -= a[k + 2];
    }
    a[1] = rest;
}

/// Divided by the mean over the disc, sum of 2 A_k/(k + 2).
static inline void skv_limb_at(float a[6], float wavelength_nm) {
    const float um = skv_clampf(wavelength_nm * 1e-3f, SKV_LIMB_FIRST_UM, SKV_LIMB_LAST_UM);
    if (um >= SKV_LIMB_RED_UM) {
        skv_limb_in_range(a, um < SKV_LIMB_THIRD_UM ? 1 : 2, um);
    } else {
        float red[6];
        const float t = skv_clampf((um - SKV_LIMB_JUMP_UM) / (SKV_LIMB_RED_UM - SKV_LIMB_JUMP_UM), 0.0f, 1.0f);
        skv_limb_in_range(a, 0, skv_minf(um, SKV_LIMB_JUMP_UM));
        skv_limb_in_range(red, 1, SKV_LIMB_RED_UM);
        for (int k = 0; k < 6; k++)
            a[k] += t * (red[k] - a[k]);
    }
    float mean = 0.0f;
    for (int k = 0; k < 6; k++)
        mean += 2.0f * a[k] / (float)(k + 2);
    for (int k = 0; k < 6; k++)
        a[k] /= mean;
}

#endif
