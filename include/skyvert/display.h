/// Display side, optional, per vertex: exposure, star transparency, packed pixel formats. Tone mapping is never baked
/// in.
///
/// All calls read and write arrays with a stride in bytes from one element to the next, 0 = packed. Pointers to floats
/// and their strides are multiples of 4; packed elements may lie anywhere.
#ifndef SKYVERT_DISPLAY_H
#define SKYVERT_DISPLAY_H

#include <stddef.h>
#include <stdint.h>

#include "skyvert/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Exposure 1 - exp(-k L), component by component [Keller08].
/// @param[in]  k    [0, 1e12]; 1/k is the radiance or colour that comes out as 0.63.
/// @param[in]  rgb  [n][3]; negative and NaN count as 0, +infinity as the largest float.
/// @param[out] out  [n][3], [0, 1]; rgb itself with the same stride, or memory that does not overlap it.
/// @return SKV_OK; SKV_ERR_NULL iff a pointer is NULL and n > 0; SKV_ERR_RANGE iff k is out of range or NaN;
/// SKV_ERR_SIZE
///         iff a stride is shorter than an element or no multiple of 4. On error nothing is written.
/// Error:  relative 4e-7, at small values too: dark skies keep their steps.
skv_status skv_expose(float k, size_t n, const float *rgb, size_t rgb_stride, float *out, size_t out_stride);

/// Opacity of the sky before the stars: alpha = min(1, (r+g+b)^t) of the exposed colour [Keller08].
/// @param[in]  t     [0.01, 100].
/// @param[in]  rgb   [n][3]; negative and NaN count as 0; a sum below 1.2e-38 gives 0.
/// @param[out] alpha [n], [0, 1]; may not overlap rgb, but may be another field of the same vertices.
/// @return as skv_expose().
/// Error:  relative 2e-7 + t (1.2e-7 + 1.6e-7 |log2(r+g+b)|): the sum and the logarithm round, t multiplies it.
skv_status skv_star_alpha(float t, size_t n, const float *rgb, size_t rgb_stride, float *alpha, size_t alpha_stride);

/// Packed formats. 16- and 32-bit elements have the machine's byte order, as graphics interfaces want them.
typedef enum skv_format {
    SKV_FORMAT_RGBA16F = 0,    ///< 4 halves, alpha 1; up to 65504, never infinite
    SKV_FORMAT_R11G11B10F = 1, ///< one uint32, R in the low 11 bits; up to 65024 (blue 64512), never infinite
    SKV_FORMAT_RGB9E5 = 2,     ///< one uint32, R in the low 9 bits, shared exponent in the high 5; up to 65408
    SKV_FORMAT_SRGB8 = 3,      ///< 3 bytes R, G, B; sRGB transfer function of [0, 1]
    SKV_FORMAT_ABGR8 = 4,      ///< one uint32, R in the low byte, A = 255 in the high one; sRGB transfer function
    SKV_FORMAT_COUNT = 5
} skv_format;

/// Bytes of one packed element; 0 where there is no such format.
size_t skv_format_bytes(skv_format format);

/// Linear rgb -> packed, rounded to nearest (ties to even in the two float formats, as the OpenGL specification has it
/// for RGB9E5: half up). Values over the largest one become the largest one; negative and NaN become 0.
/// @param[in]  rgb  [n][3]
/// @param[out] out  [n] elements of skv_format_bytes(format) bytes; may not overlap rgb.
/// @return SKV_OK; SKV_ERR_NULL iff a pointer is NULL and n > 0; SKV_ERR_UNSUPPORTED iff there is no such format;
///         SKV_ERR_SIZE iff a stride is shorter than an element, or rgb's no multiple of 4. On error nothing is
///         written.
/// Error:  half a unit in the last place of the format; sRGB: half a code + 1e-4.
skv_status skv_pack(skv_format format, size_t n, const float *rgb, size_t rgb_stride, void *out, size_t out_stride);

#ifdef __cplusplus
}
#endif
#endif
