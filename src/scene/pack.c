/// Packed pixel formats.
#include "skyvert/display.h"

#include "core/elementary.h"
#include "scene/strided.h"

size_t skv_format_bytes(skv_format format) {
    switch (format) {
    case SKV_FORMAT_RGBA16F:
        return 8;
    case SKV_FORMAT_R11G11B10F:
    case SKV_FORMAT_RGB9E5:
    case SKV_FORMAT_ABGR8:
        return 4;
    case SKV_FORMAT_SRGB8:
        return 3;
    case SKV_FORMAT_COUNT:
    default:
        return 0;
    }
}

/// Unsigned float of 5 exponent bits (bias 15) and `mantissa` bits, to nearest, ties to even; x in [0, largest].
/// Normal: round the float's bits and move the bias. Subnormal: in steps of 2^-(14+mantissa), which are the last place
/// of the number 2^(9-mantissa): adding it lets the addition round.
static uint32_t small_float(float x, uint32_t mantissa) {
    const uint32_t shift = 23u - mantissa, u = skv_bits(x);
    const uint32_t normal = (u + ((1u << (shift - 1u)) - 1u) + ((u >> shift) & 1u) - (112u << 23)) >> shift;
    const uint32_t step_bits = (127u + 9u - mantissa) << 23;
    const uint32_t subnormal = skv_bits(x + skv_from_bits(step_bits)) - step_bits;
    return x < 0x1p-14f ? subnormal : normal;
}

static void store(unsigned char *out, const void *element, size_t bytes) {
    const unsigned char *const from = element;
    for (size_t i = 0; i < bytes; i++)
        out[i] = from[i];
}

static void pack_rgba16f(const float rgb[3], unsigned char *out) {
    uint16_t half[4];
    for (int c = 0; c < 3; c++)
        half[c] = (uint16_t)small_float(skv_clampf(rgb[c], 0.0f, 65504.0f), 10);
    half[3] = 0x3c00u; // 1
    store(out, half, sizeof half);
}

static void pack_r11g11b10f(const float rgb[3], unsigned char *out) {
    const uint32_t word = small_float(skv_clampf(rgb[0], 0.0f, 65024.0f), 6) |
                          small_float(skv_clampf(rgb[1], 0.0f, 65024.0f), 6) << 11 |
                          small_float(skv_clampf(rgb[2], 0.0f, 64512.0f), 5) << 22;
    store(out, &word, sizeof word);
}

/// Nearest integer of x in [0, 2^23], half up, without the rounding of x + 0.5.
static uint32_t nearest(float x) {
    const uint32_t whole = (uint32_t)x;
    return whole + (x - (float)whole >= 0.5f ? 1u : 0u);
}

/// [EXT_texture_shared_exponent]: N = 9 mantissa bits, bias B = 15. The exponent is that of the largest component; it
/// grows by one where rounding would need a tenth bit.
static void pack_rgb9e5(const float rgb[3], unsigned char *out) {
    float c[3];
    for (int i = 0; i < 3; i++)
        c[i] = skv_clampf(rgb[i], 0.0f, 65408.0f);
    const float most = skv_maxf(skv_maxf(c[0], c[1]), c[2]);
    const uint32_t exponent = skv_bits(most) >> 23; // floor(log2) + 127
    uint32_t shared = exponent > 111u ? exponent - 111u : 0u;
    if (nearest(most * skv_from_bits((127u + 24u - shared) << 23)) == 512u)
        shared++;
    const float scale = skv_from_bits((127u + 24u - shared) << 23); // 2^-(shared - B - N)
    const uint32_t word =
        nearest(c[0] * scale) | nearest(c[1] * scale) << 9 | nearest(c[2] * scale) << 18 | shared << 27;
    store(out, &word, sizeof word);
}

/// sRGB transfer function [IEC 61966-2-1] in 256 codes.
static uint32_t srgb_code(float linear) {
    const float x = skv_clampf(linear, 0.0f, 1.0f);
    const float v = x <= 0.0031308f ? 12.92f * x : 1.055f * skv_powf(x, 1.0f / 2.4f) - 0.055f;
    return (uint32_t)(skv_clampf(v, 0.0f, 1.0f) * 255.0f + 0.5f);
}

static void pack_srgb8(const float rgb[3], unsigned char *out) {
    for (int c = 0; c < 3; c++)
        out[c] = (unsigned char)srgb_code(rgb[c]);
}

static void pack_abgr8(const float rgb[3], unsigned char *out) {
    const uint32_t word = srgb_code(rgb[0]) | srgb_code(rgb[1]) << 8 | srgb_code(rgb[2]) << 16 | 0xff000000u;
    store(out, &word, sizeof word);
}

static void pack_one(skv_format format, const float rgb[3], unsigned char *out) {
    switch (format) {
    case SKV_FORMAT_RGBA16F:
        pack_rgba16f(rgb, out);
        break;
    case SKV_FORMAT_R11G11B10F:
        pack_r11g11b10f(rgb, out);
        break;
    case SKV_FORMAT_RGB9E5:
        pack_rgb9e5(rgb, out);
        break;
    case SKV_FORMAT_SRGB8:
        pack_srgb8(rgb, out);
        break;
    case SKV_FORMAT_ABGR8:
    case SKV_FORMAT_COUNT:
    default:
        pack_abgr8(rgb, out);
        break;
    }
}

skv_status skv_pack(skv_format format, size_t n, const float *rgb, size_t rgb_stride, void *out, size_t out_stride) {
    const size_t bytes = skv_format_bytes(format);
    if (bytes == 0)
        return SKV_ERR_UNSUPPORTED;
    if (n > 0 && (rgb == NULL || out == NULL))
        return SKV_ERR_NULL;
    if (!skv_stride_ok(rgb_stride, 3 * sizeof(float)) || (out_stride != 0 && out_stride < bytes))
        return SKV_ERR_SIZE;
    const size_t from = skv_stride(rgb_stride, 3 * sizeof(float)), to = skv_stride(out_stride, bytes);
    for (size_t i = 0; i < n; i++)
        pack_one(format, skv_const_at(rgb, from, i), (unsigned char *)out + i * to);
    return SKV_OK;
}
