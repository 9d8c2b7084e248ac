/// Colour, exposure, star transparency and the packed formats.
#include "bits.h"

#include <string.h>

#include "skyvert/skyvert.h"

enum { MOST = 37 };

static void colours(int n) {
    static const float wavelength[3][4] = {{450, 535, 610, 0}, {445, 520, 570, 630}, {440, 520, 600, 680}};
    for (int i = 0; i < n; ++i) {
        float radiance[MOST][4], rgb[MOST][3], luminance[MOST];
        skv_colour_matrix matrix;
        const int bands = i % 3 == 0 ? 3 : 4;
        const skv_status status = skv_colour_matrix_fitted(&matrix, bands, wavelength[i % 3]);
        bits_word((uint32_t)status);
        if (status != SKV_OK)
            continue;
        for (int v = 0; v < MOST; ++v)
            for (int band = 0; band < 4; ++band)
                radiance[v][band] = bits_product(-0.01f, 1.0f, 1.0f);
        const size_t vertices = 1 + bits_pick(MOST);
        bits_word(
            (uint32_t)skv_colour(&matrix, bands, vertices, radiance[0], sizeof *radiance, rgb[0], 0, luminance, 0));
        bits_floats(rgb[0], 3 * vertices, BITS_FINITE);
        bits_floats(luminance, vertices, BITS_FINITE);
    }
}

/// Values of the display side: mostly in [0, 4), at times negative, infinite or NaN.
static void fill(float *value, size_t n) {
    for (size_t i = 0; i < n; ++i) {
        const uint32_t word = bits_random();
        if (bits_pick(20) == 0)
            memcpy(&value[i], &word, sizeof word);
        else
            value[i] = bits_product(-0.1f, 2.0f, 2.0f);
    }
}

static void exposures(int n) {
    for (int i = 0; i < n; ++i) {
        float rgb[MOST][3], alpha[MOST];
        fill(rgb[0], 3 * MOST);
        bits_word((uint32_t)skv_expose(bits_uniform(0.0f, 3.0f), MOST, rgb[0], 0, rgb[0], 0));
        bits_floats(rgb[0], 3 * MOST, BITS_NOT_NEGATIVE);
        bits_word((uint32_t)skv_star_alpha(bits_uniform(0.01f, 4.0f), MOST, rgb[0], 0, alpha, 0));
        bits_floats(alpha, MOST, BITS_NOT_NEGATIVE);
    }
}

/// Packed values are compared as numbers, not as bytes: the order of the bytes is the machine's.
static void packed(skv_format format, const float (*rgb)[3], size_t n) {
    static const uint8_t words[5] = {0, 1, 1, 0, 1};
    uint32_t word[2 * MOST];
    uint16_t half[4 * MOST];
    uint8_t byte[3 * MOST];
    void *const out = words[format] ? (void *)word : format == SKV_FORMAT_RGBA16F ? (void *)half : (void *)byte;
    bits_word((uint32_t)skv_pack(format, n, rgb[0], 0, out, 0));
    for (size_t i = 0; words[format] && i < n; ++i)
        bits_word(word[i]);
    for (size_t i = 0; format == SKV_FORMAT_RGBA16F && i < 4 * n; ++i)
        bits_word(half[i]);
    for (size_t i = 0; format == SKV_FORMAT_SRGB8 && i < 3 * n; ++i)
        bits_word(byte[i]);
}

static void formats(int n) {
    for (int i = 0; i < n; ++i) {
        float rgb[MOST][3];
        fill(rgb[0], 3 * MOST);
        packed((skv_format)(i % 5), (const float(*)[3])rgb, MOST);
    }
}

void bits_display(bits_scale scale) {
    const char *const name = scale == BITS_SMALL ? "small" : "full";
    const int n = scale == BITS_SMALL ? 30 : 3000;
    bits_begin(name, "colour");
    colours(n);
    bits_end();
    bits_begin(name, "exposure");
    exposures(n);
    bits_end();
    bits_begin(name, "formats");
    formats(n);
    bits_end();
}
