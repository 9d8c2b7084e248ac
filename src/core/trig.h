/// Trigonometric functions. Part of elementary.h: include that.
#ifndef SKV_CORE_TRIG_H
#define SKV_CORE_TRIG_H

#define SKV_PI      3.14159265f
#define SKV_HALF_PI 1.57079633f

typedef struct skv_sincos {
    float sin, cos;
} skv_sincos;

/// sin and cos for |x| <= 1e4 rad; beyond, and for NaN, as at 0.
/// x = n pi/2 + r by pi/2 in three parts [Cody & Waite 1980]; the first two have 11 bits, so n times them is exact.
static inline skv_sincos skv_sincosf(float x) {
    const float v = skv_fabsf(x) <= 1.0e4f ? x : 0.0f;
    const float shifted = v * 0.636619772f + 12582912.0f; // rounds to the nearest integer, as in skv_exp2f()
    const uint32_t n = skv_bits(shifted);
    const float q = shifted - 12582912.0f;
    const float r = ((v - q * 1.5703125f) - q * 4.83751297e-4f) - q * 7.54953362e-8f;
    const float z = r * r;
    const float s = r + r * z * (SKV_SIN_0 + z * (SKV_SIN_1 + z * SKV_SIN_2));
    const float c = 1.0f - 0.5f * z + z * z * (SKV_COS_0 + z * (SKV_COS_1 + z * SKV_COS_2));
    const float sine = (n & 1u) ? c : s;
    const float cosine = (n & 1u) ? s : c;
    return (skv_sincos){skv_from_bits(skv_bits(sine) ^ ((n & 2u) << 30)),
                        skv_from_bits(skv_bits(cosine) ^ (((n + 1u) & 2u) << 30))};
}

/// Error: rel 7.2e-8 on [-0x1.921fb4p-1, 0x1.921fb4p-1], worst at 0x1.0c411ep-1
/// Error: abs 1.04e-7 on [-1e4, 1e4], worst at 0x1.e35cc8p+12
static inline float skv_sinf(float x) {
    return skv_sincosf(x).sin;
}

/// Error: abs 1.04e-7 on [-1e4, 1e4], worst at 0x1.eab9fp+12
static inline float skv_cosf(float x) {
    return skv_sincosf(x).cos;
}

/// sin/cos; at the poles large and finite. As skv_sincosf() otherwise.
/// Error: rel 2.35e-7 on [-1.5, 1.5], worst at 0x1.967f82p-1
static inline float skv_tanf(float x) {
    const skv_sincos s = skv_sincosf(x);
    return s.sin / (s.cos == 0.0f ? FLT_MIN : s.cos);
}

/// asin(x) / x for z = x^2 <= 1/4.
static inline float skv_asin_poly(float z) {
    return SKV_ASIN_0 + z * (SKV_ASIN_1 + z * (SKV_ASIN_2 + z * (SKV_ASIN_3 + z * SKV_ASIN_4)));
}

/// asin(x); beyond [-1, 1] as at its end, NaN as -1. Over |x| = 1/2 by pi/2 - 2 asin(sqrt((1-|x|)/2)).
/// Error: rel 2.75e-7 on [-1, 1], worst at 0x1.0054a6p-1
static inline float skv_asinf(float x) {
    const float v = skv_clampf(x, -1.0f, 1.0f);
    const float a = skv_fabsf(v);
    const int far = a > 0.5f;
    const float z = far ? (1.0f - a) * 0.5f : a * a;
    const float s = far ? skv_sqrtf(z) : a;
    const float p = s + s * z * skv_asin_poly(z);
    return skv_copysignf(far ? SKV_HALF_PI - (2.0f * p + 4.37113883e-8f) : p, v); // pi/2 in two parts
}

/// acos(x); beyond [-1, 1] as at its end, NaN as -1. Relative error small near 1 too.
/// Error: rel 1.46e-7 on [-1, 1], worst at -0x1.007364p-1
static inline float skv_acosf(float x) {
    const float v = skv_clampf(x, -1.0f, 1.0f);
    const float a = skv_fabsf(v);
    const int far = a > 0.5f;
    const float z = far ? (1.0f - a) * 0.5f : a * a;
    const float s = far ? skv_sqrtf(z) : a;
    const float p = s + s * z * skv_asin_poly(z);
    const float near = SKV_HALF_PI - skv_copysignf(p, v);
    const float tip = v > 0.0f ? 2.0f * p : SKV_PI - 2.0f * p;
    return far ? tip : near;
}

/// Angle of (x, y) in [-pi, pi]; 0 at the origin; infinities count as FLT_MAX, NaN as -FLT_MAX.
static inline float skv_atan2f(float y, float x) {
    const float ay = skv_fabsf(skv_clampf(y, -FLT_MAX, FLT_MAX));
    const float ax = skv_fabsf(skv_clampf(x, -FLT_MAX, FLT_MAX));
    const float large = skv_maxf(ax, ay);
    // Scaled, so that neither the sum below overflows nor a subnormal is divided.
    const float scale = large > 1.0e30f ? 0x1p-64f : large < 1.0e-20f ? 0x1p64f : 1.0f;
    const float hi = large * scale;
    const float lo = skv_minf(ax, ay) * scale;
    const int over = lo > 0.414213562f * hi; // beyond tan(pi/8): atan(u) = pi/4 + atan((u-1)/(u+1))
    const float den = over ? lo + hi : hi;
    const float t = (over ? lo - hi : lo) / (den > 0.0f ? den : 1.0f);
    const float z = t * t;
    const float p = t + t * z * (SKV_ATAN_0 + z * (SKV_ATAN_1 + z * (SKV_ATAN_2 + z * SKV_ATAN_3)));
    const float octant = over ? 0.785398163f + p : p;
    const float quadrant = ay > ax ? SKV_HALF_PI - octant : octant;
    const float half = skv_bits(x) >> 31 ? SKV_PI - quadrant : quadrant;
    return skv_copysignf(half, y);
}

#endif
