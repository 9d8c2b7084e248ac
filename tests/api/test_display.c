/// Exposure, star transparency and packed formats against the formulas and independent decoders in double.
#include "check.h"
#include "random.h"

#include <float.h>

#include "skyvert/display.h"

#define GUARD 0xa5

/// Bits of a float or a value, as a float that may be anything.
static float any_component(int i) {
    static const float edge[] = {0.0f,        -0.0f,      1.0f,          -1.0f,      FLT_MAX,  FLT_MIN,
                                 1e-45f,      65504.0f,   65519.0f,      65520.0f,   65408.0f, 65535.0f,
                                 65024.0f,    64512.0f,   0x1p-14f,      0x1p-15f,   0x1p-16f, 0x1p-24f,
                                 0x1p-25f,    0x1p-26f,   511.5f,        511.49997f, 0.5f,     255.5f,
                                 0.49999997f, 0x1.ffep0f, 0x1.fff8p-14f, 1e-20f,     1e20f,    0.0031308f};
    const int n = (int)(sizeof edge / sizeof edge[0]);
    if (i < n)
        return edge[i];
    switch (i % 4) {
    case 0:
        return random_float();
    case 1:
        return (float)random_in(0, 1);
    case 2:
        return (float)ldexp(random_in(1, 2), random_int(-28, 17));
    default: // halfway between two values of the formats
        return (float)ldexp((double)random_int(0, 4095) + 0.5, random_int(-30, 6));
    }
}

static double usable(float x, double most) {
    return x > 0 ? ((double)x < most ? (double)x : most) : 0; // NaN too
}

/// 1 - exp(-kL) by the library's double expm1; relative, so that dark values count. 4e-7: k log2(e), the product and
/// the exponential each round.
static void expose_is_the_formula(void **state) {
    (void)state;
    random_state = 11;
    for (int i = 0; i < CASES(20000); i++) {
        float rgb[6], out[6];
        const float k = i % 7 == 0 ? 0.0f : (float)pow(10, random_in(-12, 12));
        for (int c = 0; c < 6; c++)
            rgb[c] = any_component(i * 6 + c);
        assert_int_equal(skv_expose(k, 2, rgb, 0, out, 0), SKV_OK);
        for (int c = 0; c < 6; c++) {
            const double want = -expm1(-(double)k * usable(rgb[c], (double)FLT_MAX));
            // Below the smallest normal product the input has no digits left.
            check_near("1 - exp(-kL)", (double)out[c], want, 4e-7 * want + 2e-38);
            assert_true(out[c] >= 0.0f && out[c] <= 1.0f);
        }
    }
    const float inf[3] = {INFINITY, -INFINITY, NAN};
    float out[3];
    assert_int_equal(skv_expose(1.0f, 1, inf, 0, out, 0), SKV_OK);
    assert_true(out[0] == 1.0f && out[1] == 0.0f && out[2] == 0.0f);
}

static void star_alpha_is_the_formula(void **state) {
    (void)state;
    random_state = 12;
    for (int i = 0; i < CASES(20000); i++) {
        float rgb[3], alpha = -1;
        const float t = (float)pow(10, random_in(-2, 2));
        double sum = 0;
        for (int c = 0; c < 3; c++) {
            rgb[c] = i % 2 ? (float)pow(10, random_in(-9, 0)) : any_component(i * 3 + c);
            sum += usable(rgb[c], (double)FLT_MAX);
        }
        assert_int_equal(skv_star_alpha(t, 1, rgb, 0, &alpha, 0), SKV_OK);
        const double want = sum < (double)FLT_MIN ? 0 : fmin(1, pow(sum, (double)t));
        const double bits = sum < (double)FLT_MIN ? 0 : fabs((double)t * log2(sum));
        // The documented error; 1.2e-38 where the power is below the smallest normal float.
        check_near("min(1, s^t)", (double)alpha, want, want * (2e-7 + 1.6e-7 * bits + 1.2e-7 * (double)t) + 1.2e-38);
        assert_true(alpha >= 0.0f && alpha <= 1.0f);
    }
}

/// Unsigned float of 5 exponent bits and m mantissa bits, by its definition.
static double decode_small(uint32_t code, int m) {
    const uint32_t e = code >> m, f = code & ((1u << m) - 1u);
    return e == 0 ? ldexp((double)f, -14 - m) : ldexp((double)(f + (1u << m)), (int)e - 15 - m);
}

/// The code must be the nearest of all, the even one of two equally near.
static void check_nearest(const char *what, uint32_t code, int m, float x, double most) {
    const double v = usable(x, most), e = fabs(decode_small(code, m) - v);
    const uint32_t last = (30u << m) | ((1u << m) - 1u); // the largest finite one
    assert_true(code <= last);
    if (code > 0 && fabs(decode_small(code - 1, m) - v) < e)
        fail_msg("%s: %.9g: code %u, but %u is nearer", what, (double)x, (unsigned)code, (unsigned)code - 1);
    if (code < last && fabs(decode_small(code + 1, m) - v) < e)
        fail_msg("%s: %.9g: code %u, but %u is nearer", what, (double)x, (unsigned)code, (unsigned)code + 1);
    if ((code & 1u) &&
        ((code < last && fabs(decode_small(code + 1, m) - v) == e) || fabs(decode_small(code - 1, m) - v) == e))
        fail_msg("%s: %.9g: odd code %u of two equally near", what, (double)x, (unsigned)code);
}

static void float_formats_are_nearest(void **state) {
    (void)state;
    random_state = 13;
    for (int i = 0; i < CASES(60000); i++) {
        const float rgb[3] = {any_component(3 * i), any_component(3 * i + 1), any_component(3 * i + 2)};
        uint16_t half[4];
        uint32_t word;
        assert_int_equal(skv_pack(SKV_FORMAT_RGBA16F, 1, rgb, 0, half, 0), SKV_OK);
        for (int c = 0; c < 3; c++)
            check_nearest("RGBA16F", half[c], 10, rgb[c], 65504);
        assert_int_equal(half[3], 0x3c00);
        assert_int_equal(skv_pack(SKV_FORMAT_R11G11B10F, 1, rgb, 0, &word, 0), SKV_OK);
        check_nearest("R11", word & 0x7ffu, 6, rgb[0], 65024);
        check_nearest("G11", word >> 11 & 0x7ffu, 6, rgb[1], 65024);
        check_nearest("B10", word >> 22, 5, rgb[2], 64512);
    }
}

/// The algorithm of EXT_texture_shared_exponent in double, word for word.
static uint32_t rgb9e5(const float rgb[3]) {
    double c[3], most = 0;
    for (int i = 0; i < 3; i++) {
        c[i] = usable(rgb[i], 65408);
        most = c[i] > most ? c[i] : most;
    }
    int e = 0; // max(-B-1, floor(log2(max))) + 1 + B
    if (most > 0) {
        int p;
        (void)frexp(most, &p);
        e = (p - 1 > -16 ? p - 1 : -16) + 16;
    }
    if (floor(ldexp(most, 24 - e) + 0.5) == 512)
        e++;
    uint32_t word = (uint32_t)e << 27;
    for (int i = 0; i < 3; i++)
        word |= (uint32_t)floor(ldexp(c[i], 24 - e) + 0.5) << 9 * i;
    return word;
}

static void rgb9e5_is_the_specification(void **state) {
    (void)state;
    random_state = 14;
    for (int i = 0; i < CASES(60000); i++) {
        float rgb[3] = {any_component(3 * i), any_component(3 * i + 1), any_component(3 * i + 2)};
        if (i % 2)
            for (int c = 1; c < 3; c++) // of one size, as colours are
                rgb[c] = rgb[0] * (float)random_in(0, 1);
        uint32_t word;
        assert_int_equal(skv_pack(SKV_FORMAT_RGB9E5, 1, rgb, 0, &word, 0), SKV_OK);
        if (word != rgb9e5(rgb))
            fail_msg("RGB9E5 of (%a %a %a): got %08x, want %08x", (double)rgb[0], (double)rgb[1], (double)rgb[2],
                     (unsigned)word, (unsigned)rgb9e5(rgb));
        double most = 0;
        for (int c = 0; c < 3; c++)
            most = fmax(most, usable(rgb[c], 65408));
        for (int c = 0; c < 3; c++) { // half of a step of the largest component's exponent
            const double got = ldexp((double)(word >> 9 * c & 511u), (int)(word >> 27) - 24);
            check_near("RGB9E5 decoded", got, usable(rgb[c], 65408), fmax(most / 511, ldexp(1, -25)));
        }
    }
}

static double srgb_of(double x) {
    return 255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1 / 2.4) - 0.055);
}

static void srgb_is_the_formula(void **state) {
    (void)state;
    random_state = 15;
    uint8_t seen[256] = {0};
    double worst = 0;
    for (int i = 0; i < CASES(60000); i++) {
        const float rgb[3] = {any_component(3 * i), (float)random_in(0, 1), (float)pow(random_in(0, 1), 4)};
        uint8_t code[3];
        uint32_t word;
        assert_int_equal(skv_pack(SKV_FORMAT_SRGB8, 1, rgb, 0, code, 0), SKV_OK);
        assert_int_equal(skv_pack(SKV_FORMAT_ABGR8, 1, rgb, 0, &word, 0), SKV_OK);
        assert_int_equal(word, 0xff000000u | code[0] | (uint32_t)code[1] << 8 | (uint32_t)code[2] << 16);
        for (int c = 0; c < 3; c++) {
            const double e = fabs(code[c] - srgb_of(usable(rgb[c], 1)));
            worst = e > worst ? e : worst;
        }
    }
    for (int k = 0; k < 256; k++) { // every code at its own linear value
        const double v = k / 255.0, x = v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4);
        const float rgb[3] = {(float)x, (float)x, (float)x};
        uint8_t code[3];
        assert_int_equal(skv_pack(SKV_FORMAT_SRGB8, 1, rgb, 0, code, 0), SKV_OK);
        assert_int_equal(code[0], k);
        seen[code[1]] = 1;
    }
    for (int k = 0; k < 256; k++)
        assert_true(seen[k]);
    check_at_most("sRGB, codes", worst, 0.5 + 1e-4); // 1e-4: float's power
    print_message("figure: sRGB8: largest error %.6f codes\n", worst);
}

/// Writes only the elements, whatever the stride, and nothing on an error.
static void strides_and_errors(void **state) {
    (void)state;
    const float rgb[2][5] = {{0.25f, 0.5f, 1.0f, NAN, NAN}, {1.0f, 0.125f, 2.0f, NAN, NAN}};
    for (int f = 0; f < SKV_FORMAT_COUNT; f++) {
        const skv_format format = (skv_format)f;
        const size_t bytes = skv_format_bytes(format), stride = bytes + 5;
        unsigned char out[64], packed[16];
        memset(out, GUARD, sizeof out);
        assert_int_equal(skv_pack(format, 2, rgb[0], sizeof rgb[0], out + 1, stride), SKV_OK);
        const float plain[6] = {0.25f, 0.5f, 1.0f, 1.0f, 0.125f, 2.0f};
        assert_int_equal(skv_pack(format, 2, plain, 0, packed, 0), SKV_OK);
        for (size_t i = 0; i < sizeof out; i++) {
            const size_t at = i - 1, element = at / stride, within = at % stride;
            const int inside = i >= 1 && element < 2 && within < bytes;
            assert_int_equal(out[i], inside ? packed[element * bytes + within] : GUARD);
        }
        memset(out, GUARD, sizeof out);
        assert_int_equal(skv_pack(format, 2, rgb[0], 8, out, 0), SKV_ERR_SIZE);
        assert_int_equal(skv_pack(format, 2, rgb[0], 14, out, 0), SKV_ERR_SIZE);
        assert_int_equal(skv_pack(format, 2, rgb[0], 0, out, bytes - 1), SKV_ERR_SIZE);
        assert_int_equal(skv_pack(format, 2, NULL, 0, out, 0), SKV_ERR_NULL);
        assert_int_equal(skv_pack(format, 2, rgb[0], 0, NULL, 0), SKV_ERR_NULL);
        assert_int_equal(skv_pack(format, 0, NULL, 0, NULL, 0), SKV_OK);
        for (size_t i = 0; i < sizeof out; i++)
            assert_int_equal(out[i], GUARD);
    }
    assert_int_equal(skv_format_bytes(SKV_FORMAT_COUNT), 0);
    unsigned char out[16];
    assert_int_equal(skv_pack(SKV_FORMAT_COUNT, 1, rgb[0], 0, out, 0), SKV_ERR_UNSUPPORTED);
    assert_int_equal(skv_pack((skv_format)-1, 1, rgb[0], 0, out, 0), SKV_ERR_UNSUPPORTED);
}

static void expose_strides_and_errors(void **state) {
    (void)state;
    float vertex[19][8], packed[19][3], out[19][3];
    random_state = 16;
    for (int i = 0; i < 19; i++)
        for (int c = 0; c < 8; c++)
            vertex[i][c] = c < 3 ? (packed[i][c] = (float)random_in(0, 3)) : 77.0f;
    assert_int_equal(skv_expose(0.7f, 19, packed[0], 0, out[0], 0), SKV_OK);
    assert_int_equal(skv_expose(0.7f, 19, vertex[0], sizeof vertex[0], vertex[0], sizeof vertex[0]), SKV_OK);
    assert_int_equal(skv_star_alpha(0.5f, 19, vertex[0], sizeof vertex[0], &vertex[0][3], sizeof vertex[0]), SKV_OK);
    for (int i = 0; i < 19; i++) {
        for (int c = 0; c < 3; c++)
            assert_true(vertex[i][c] == out[i][c]);
        float alpha;
        assert_int_equal(skv_star_alpha(0.5f, 1, out[i], 0, &alpha, 0), SKV_OK);
        assert_true(vertex[i][3] == alpha);
        for (int c = 4; c < 8; c++)
            assert_true(vertex[i][c] == 77.0f);
    }
    const float bad_k[] = {-1.0f, 1.1e12f, INFINITY, NAN};
    const float bad_t[] = {0.0f, 0.009f, 101.0f, -1.0f, INFINITY, NAN};
    float keep[3] = {5.0f, 5.0f, 5.0f};
    for (int i = 0; i < 4; i++)
        assert_int_equal(skv_expose(bad_k[i], 1, packed[0], 0, keep, 0), SKV_ERR_RANGE);
    for (int i = 0; i < 6; i++)
        assert_int_equal(skv_star_alpha(bad_t[i], 1, packed[0], 0, keep, 0), SKV_ERR_RANGE);
    assert_int_equal(skv_expose(1.0f, 1, NULL, 0, keep, 0), SKV_ERR_NULL);
    assert_int_equal(skv_expose(1.0f, 1, packed[0], 0, NULL, 0), SKV_ERR_NULL);
    assert_int_equal(skv_expose(1.0f, 1, packed[0], 8, keep, 0), SKV_ERR_SIZE);
    assert_int_equal(skv_expose(1.0f, 1, packed[0], 0, keep, 13), SKV_ERR_SIZE);
    assert_int_equal(skv_star_alpha(1.0f, 1, packed[0], 0, NULL, 0), SKV_ERR_NULL);
    assert_int_equal(skv_star_alpha(1.0f, 1, packed[0], 0, keep, 2), SKV_ERR_SIZE);
    assert_true(keep[0] == 5.0f && keep[1] == 5.0f && keep[2] == 5.0f);
    assert_int_equal(skv_expose(1.0f, 0, NULL, 0, NULL, 0), SKV_OK);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(expose_is_the_formula),     cmocka_unit_test(star_alpha_is_the_formula),
        cmocka_unit_test(float_formats_are_nearest), cmocka_unit_test(rgb9e5_is_the_specification),
        cmocka_unit_test(srgb_is_the_formula),       cmocka_unit_test(strides_and_errors),
        cmocka_unit_test(expose_strides_and_errors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
