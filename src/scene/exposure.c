/// Exposure and star transparency [Keller08].
#include "skyvert/display.h"

#include "core/elementary.h"
#include "scene/strided.h"

/// Vertices worked on side by side.
#define BLOCK 8

/// Pointers and strides of the two arrays of a call, with `out_size` bytes an element of the second.
static skv_status check_arrays(size_t n, const float *rgb, size_t rgb_stride, const float *out, size_t out_stride,
                               size_t out_size) {
    if (n > 0 && (rgb == NULL || out == NULL))
        return SKV_ERR_NULL;
    if (!skv_stride_ok(rgb_stride, 3 * sizeof(float)) || !skv_stride_ok(out_stride, out_size))
        return SKV_ERR_SIZE;
    return SKV_OK;
}

/// Vertices from index i on, of n, into a packed block.
static void read_block(float block[3 * BLOCK], const float *rgb, size_t stride, size_t i, size_t n) {
    for (size_t v = 0; v < BLOCK && i + v < n; v++) {
        const float *const p = skv_const_at(rgb, stride, i + v);
        for (size_t c = 0; c < 3; c++)
            block[3 * v + c] = p[c];
    }
}

skv_status skv_expose(float k, size_t n, const float *rgb, size_t rgb_stride, float *out, size_t out_stride) {
    const skv_status status = check_arrays(n, rgb, rgb_stride, out, out_stride, 3 * sizeof(float));
    if (status != SKV_OK)
        return status;
    if (!(k >= 0.0f && k <= 1.0e12f))
        return SKV_ERR_RANGE;
    const size_t from = skv_stride(rgb_stride, 3 * sizeof(float)), to = skv_stride(out_stride, 3 * sizeof(float));
    const float scale = k * 1.44269504f; // 1 - e^-kL = 1 - 2^-(kL log2 e)
    float block[3 * BLOCK] = {0};
    for (size_t i = 0; i < n; i += BLOCK) {
        read_block(block, rgb, from, i, n);
        for (int c = 0; c < 3 * BLOCK; c++)
            block[c] = skv_one_minus_exp2f(scale * skv_clampf(block[c], 0.0f, FLT_MAX));
        for (size_t v = 0; v < BLOCK && i + v < n; v++)
            for (size_t c = 0; c < 3; c++)
                skv_at(out, to, i + v)[c] = block[3 * v + c];
    }
    return SKV_OK;
}

/// min(1, s^t), with 0 for what is no normal float.
static float opacity(float s, float t) {
    return s < FLT_MIN ? 0.0f : skv_minf(skv_powf(s, t), 1.0f);
}

skv_status skv_star_alpha(float t, size_t n, const float *rgb, size_t rgb_stride, float *alpha, size_t alpha_stride) {
    const skv_status status = check_arrays(n, rgb, rgb_stride, alpha, alpha_stride, sizeof(float));
    if (status != SKV_OK)
        return status;
    if (!(t >= 0.01f && t <= 100.0f))
        return SKV_ERR_RANGE;
    const size_t from = skv_stride(rgb_stride, 3 * sizeof(float)), to = skv_stride(alpha_stride, sizeof(float));
    for (size_t i = 0; i < n; i++) {
        const float *const p = skv_const_at(rgb, from, i);
        // More than 1 is opaque: the clamp keeps the sum finite.
        const float s = skv_clampf(p[0], 0.0f, 1.0f) + skv_clampf(p[1], 0.0f, 1.0f) + skv_clampf(p[2], 0.0f, 1.0f);
        *skv_at(alpha, to, i) = opacity(s, t);
    }
    return SKV_OK;
}
