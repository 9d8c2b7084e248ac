/// Display side, optional, per vertex: exposure, star transparency, packed pixel formats. Tone mapping is never baked in.
#ifndef SKYVERT_DISPLAY_H
#define SKYVERT_DISPLAY_H

#include <stddef.h>
#include <stdint.h>

#include "skyvert/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/// 1 - exp(-k L) per component [Keller08]; rgb [n][3] in place or to another buffer, strides in bytes, 0 = packed.
/// Negative or non-finite input gives 0 (+infinity gives 1). k: [0, 1e12].
skv_status skv_expose(float k, size_t n, const float *rgb, size_t rgb_stride, float *out, size_t out_stride);

/// Opacity of the sky before the stars: alpha = min(1, (r+g+b)^t) of the exposed colour [Keller08]. t: [0.01, 100].
skv_status skv_star_alpha(float t, size_t n, const float *rgb, size_t rgb_stride, float *alpha, size_t alpha_stride);

/// Packed formats, byte order as the machine's for the 32-bit ones.
typedef enum skv_format {
    SKV_FORMAT_RGBA16F = 0,   ///< 4 halves, alpha 1; largest finite 65504, never infinite
    SKV_FORMAT_R11G11B10F = 1,///< one uint32, R in the low bits
    SKV_FORMAT_RGB9E5 = 2,    ///< one uint32, shared exponent
    SKV_FORMAT_SRGB8 = 3,     ///< 3 bytes, sRGB transfer function (input 0..1)
    SKV_FORMAT_ABGR8 = 4,     ///< one uint32, R in the low byte, A = 255, sRGB transfer function
} skv_format;

/// linear rgb [n][3] -> packed. Negative and NaN give 0. @param stride bytes of one output element to the next, 0 = packed.
skv_status skv_pack(skv_format format, size_t n, const float *rgb, size_t rgb_stride, void *out, size_t out_stride);

#ifdef __cplusplus
}
#endif
#endif
