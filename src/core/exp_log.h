/// Exponentials and logarithms. Part of elementary.h: include that.
#ifndef SKV_CORE_EXP_LOG_H
#define SKV_CORE_EXP_LOG_H

/// 2^x = 2^n 2^f with n the nearest integer. Adding 1.5 * 2^23 leaves n in the low bits of the sum; shifted by 23 they
/// are what the exponent of 2^f has to grow by. (In another rounding mode f reaches +-1: less accurate, still finite.)
#define SKV_EXP2_SHIFT 12582912.0f

/// 2^f = 1 + f q(f), |f| <= 1/2, q of degree 5.
SKV_INLINE float skv_exp2_poly6(float f) {
    return SKV_EXP2_D6_0 +
           f * (SKV_EXP2_D6_1 + f * (SKV_EXP2_D6_2 + f * (SKV_EXP2_D6_3 + f * (SKV_EXP2_D6_4 + f * SKV_EXP2_D6_5))));
}

typedef struct skv_exp2_parts {
    float f;           ///< x - n
    uint32_t exponent; ///< n << 23
} skv_exp2_parts;

SKV_INLINE skv_exp2_parts skv_exp2_split(float x) {
    const float v = skv_clampf(x, -126.0f, 127.0f);
    const float shifted = v + SKV_EXP2_SHIFT;
    return (skv_exp2_parts){v - (shifted - SKV_EXP2_SHIFT), skv_bits(shifted) << 23};
}

SKV_INLINE float skv_exp2_join(float x, uint32_t exponent, float p) {
    const float r = skv_from_bits(skv_bits(p) + exponent);
    return x >= -126.0f ? r : 0.0f;
}

/// 2^x for x in [-126, 127]; below exactly 0 (no subnormals), above 2^127; NaN gives 0. Exactly 1 at 0.
/// Error: rel 9.4e-8 on [-126, 127], worst at -0x1.fd536ap-2
SKV_INLINE float skv_exp2f(float x) {
    const skv_exp2_parts s = skv_exp2_split(x);
    return skv_exp2_join(x, s.exponent, 1.0f + s.f * skv_exp2_poly6(s.f));
}

/// skv_exp2f() by a polynomial of degree 5.
/// Error: rel 1.82e-7 on [-126, 127], worst at 0x1.001d78p-1
SKV_INLINE float skv_exp2f_d5(float x) {
    const skv_exp2_parts s = skv_exp2_split(x);
    const float f = s.f;
    const float p = 1.0f + f * (SKV_EXP2_D5_0 +
                                f * (SKV_EXP2_D5_1 + f * (SKV_EXP2_D5_2 + f * (SKV_EXP2_D5_3 + f * SKV_EXP2_D5_4))));
    return skv_exp2_join(x, s.exponent, p);
}

/// skv_exp2f() by a polynomial of degree 4.
/// Error: rel 2.95e-6 on [-126, 127], worst at -0x1.fff97cp-2
SKV_INLINE float skv_exp2f_d4(float x) {
    const skv_exp2_parts s = skv_exp2_split(x);
    const float f = s.f;
    const float p = 1.0f + f * (SKV_EXP2_D4_0 + f * (SKV_EXP2_D4_1 + f * (SKV_EXP2_D4_2 + f * SKV_EXP2_D4_3)));
    return skv_exp2_join(x, s.exponent, p);
}

/// skv_exp2f() by a polynomial of degree 3.
/// Error: rel 1.02e-4 on [-126, 127], worst at -0x1.ffff84p-2
SKV_INLINE float skv_exp2f_d3(float x) {
    const skv_exp2_parts s = skv_exp2_split(x);
    const float f = s.f;
    const float p = 1.0f + f * (SKV_EXP2_D3_0 + f * (SKV_EXP2_D3_1 + f * SKV_EXP2_D3_2));
    return skv_exp2_join(x, s.exponent, p);
}

/// Degree of the exponential of the inner loops: 3 (1e-4), 4 (3e-6) or 5 (2e-7). `make trade` measures what each is
/// worth.
#ifndef SKV_EXP2_DEGREE
#define SKV_EXP2_DEGREE 4
#endif

/// 2^x for x in [-126, 127], unguarded: skv_exp2f_d4() at half its price for callers that have clamped x.
SKV_INLINE float skv_exp2f_inner(float x) {
    const float shifted = x + SKV_EXP2_SHIFT;
    const float f = x - (shifted - SKV_EXP2_SHIFT);
#if SKV_EXP2_DEGREE == 3
    const float p = 1.0f + f * (SKV_EXP2_D3_0 + f * (SKV_EXP2_D3_1 + f * SKV_EXP2_D3_2));
#elif SKV_EXP2_DEGREE == 4
    const float p = 1.0f + f * (SKV_EXP2_D4_0 + f * (SKV_EXP2_D4_1 + f * (SKV_EXP2_D4_2 + f * SKV_EXP2_D4_3)));
#elif SKV_EXP2_DEGREE == 5
    const float p = 1.0f + f * (SKV_EXP2_D5_0 +
                                f * (SKV_EXP2_D5_1 + f * (SKV_EXP2_D5_2 + f * (SKV_EXP2_D5_3 + f * SKV_EXP2_D5_4))));
#else
#error "SKV_EXP2_DEGREE: 3, 4 or 5"
#endif
    return skv_from_bits(skv_bits(p) + (skv_bits(shifted) << 23));
}

/// e^x; 0 below -87.33, 2^127 above 88.02, NaN gives 0. The product x log2(e) is formed in two parts.
/// Error: rel 1.2e-7 on [-87.33, 88.02], worst at -0x1.1966b8p+6
SKV_INLINE float skv_expf(float x) {
    // n from the rounded product, the rest from x itself: ln 2 = hi + lo, n*hi exact.
    const float v = skv_clampf(x, -87.33f, 88.02f);
    const float shifted = v * 1.44269504f + SKV_EXP2_SHIFT;
    const float n = shifted - SKV_EXP2_SHIFT;
    const float f = ((v - n * 0.693359375f) + n * 2.12194440e-4f) * 1.44269504f;
    const float p = 1.0f + f * skv_exp2_poly6(f);
    const float r = skv_from_bits(skv_bits(p) + (skv_bits(shifted) << 23));
    return x >= -87.33f ? r : 0.0f;
}

/// 1 - 2^-y for y >= 0, relative error small at small y too: 2^n 2^f - 1 = 2^n f q(f) + (2^n - 1), the bracket exact.
/// Negative and NaN count as 0; from 25 on it is 1 within a rounding.
/// Error: rel 1.3e-7 on [0x1p-100, 126], worst at 0x1.ab5f6cp-2
SKV_INLINE float skv_one_minus_exp2f(float y) {
    const skv_exp2_parts s = skv_exp2_split(-skv_clampf(y, 0.0f, 126.0f));
    const float scale = skv_from_bits(0x3f800000u + s.exponent);
    return (1.0f - scale) - scale * (s.f * skv_exp2_poly6(s.f));
}

/// x = m 2^e with m in [sqrt(1/2), sqrt(2)).
typedef struct skv_log_parts {
    float m, e;
} skv_log_parts;

SKV_INLINE skv_log_parts skv_log_split(float x) {
    const uint32_t u = skv_bits(skv_clampf(x, FLT_MIN, FLT_MAX));
    const int32_t e = (int32_t)((u + (0x3f800000u - 0x3f3504f3u)) >> 23) - 127; // 0x3f3504f3 is sqrt(1/2)
    return (skv_log_parts){skv_from_bits(u - ((uint32_t)e << 23)), (float)e};
}

SKV_INLINE float skv_log_poly(float s) {
    const float z = s * s;
    return s * (SKV_LOG_0 + z * (SKV_LOG_1 + z * (SKV_LOG_2 + z * SKV_LOG_3)));
}

/// log2(x) for normal x > 0; smaller, negative and NaN give -126, +infinity 128.
/// Error: rel 2.3e-7 on [0x1p-126, 0x1.fffffep127], worst at 0x1.69f092p-1
SKV_INLINE float skv_log2f(float x) {
    const skv_log_parts p = skv_log_split(x);
    const float s = (p.m - 1.0f) / (p.m + 1.0f);
    const float z = s * s;
    return p.e + s * (SKV_LOG2_0 + z * (SKV_LOG2_1 + z * (SKV_LOG2_2 + z * SKV_LOG2_3)));
}

/// ln(x) for normal x > 0; smaller, negative and NaN give ln(2^-126), +infinity ln(2^128).
/// Error: rel 2.3e-7 on [0x1p-126, 0x1.fffffep127], worst at 0x1.22f4e2p+0
SKV_INLINE float skv_logf(float x) {
    const skv_log_parts p = skv_log_split(x);
    const float r = skv_log_poly((p.m - 1.0f) / (p.m + 1.0f));
    return p.e * 0.693359375f + (r - p.e * 2.12194440e-4f); // ln 2 = 355/512 - 2.1e-4
}

/// ln(1+x) for x >= 0, relative error small at small x too; negative and NaN give 0, +infinity ln(2^128).
/// Error: rel 2.75e-7 on [0x1p-100, 0x1.fffffep127], worst at 0x1.a833fcp-2
SKV_INLINE float skv_log1pf(float x) {
    const float v = skv_clampf(x, 0.0f, FLT_MAX);
    const skv_log_parts p = skv_log_split(1.0f + v);
    const int small = v < 0.41421356f; // below sqrt(2) - 1 no exponent is taken out, and 1 + x need not be formed
    const float s = (small ? v : p.m - 1.0f) / ((small ? v : p.m - 1.0f) + 2.0f);
    const float e = small ? 0.0f : p.e;
    return e * 0.693359375f + (skv_log_poly(s) - e * 2.12194440e-4f);
}

/// x^y for normal x > 0 as 2^(y log2 x): relative error <= 2e-7 + 1.6e-7 |y log2 x|; 0 where that is below -126, 2^127
/// above 127; x <= 0 or NaN counts as 2^-126, y NaN gives 0.
SKV_INLINE float skv_powf(float x, float y) {
    return skv_exp2f(y * skv_log2f(x));
}

#endif
