/// The scaled complementary error function exp(y^2) erfc(y) for y >= 0, the core of the Chapman function. Part of
/// elementary.h: include that.
///
/// erfcx(y) = t p(t) with t = 1/(1 + c y): one division, shared with others if you like, and no exponential. c is
/// chosen with the polynomial.
#ifndef SKV_CORE_ERFCX_H
#define SKV_CORE_ERFCX_H

#define SKV_ERFCX_C  SKV_ERFCX4_T
#define SKV_ERFCX6_C SKV_ERFCX6_T
#define SKV_ERFCX8_C SKV_ERFCX8_T

/// p of degree 4 for t = 1/(1 + SKV_ERFCX_C y) in (0, 1]: erfcx(y) = t p(t).
/// Error: rel 9.1e-5 on [0x1p-60, 1], worst at 0x1.d4e6c4p-1
SKV_INLINE float skv_erfcx_poly(float t) {
    return SKV_ERFCX4_0 + t * (SKV_ERFCX4_1 + t * (SKV_ERFCX4_2 + t * (SKV_ERFCX4_3 + t * SKV_ERFCX4_4)));
}

/// p of degree 6 for t = 1/(1 + SKV_ERFCX6_C y) in (0, 1]: erfcx(y) = t p(t).
/// Error: rel 3.7e-6 on [0x1p-60, 1], worst at 0x1.e7212ap-1
SKV_INLINE float skv_erfcx_poly6(float t) {
    return SKV_ERFCX6_0 +
           t * (SKV_ERFCX6_1 +
                t * (SKV_ERFCX6_2 + t * (SKV_ERFCX6_3 + t * (SKV_ERFCX6_4 + t * (SKV_ERFCX6_5 + t * SKV_ERFCX6_6)))));
}

/// erfcx(y) for y >= 0; negative and NaN count as 0, +infinity gives 0.
/// Error: rel 5.5e-7 on [0, 0x1p126], worst at 0x1.14bdfap-2
SKV_INLINE float skv_erfcxf(float y) {
    const float t = 1.0f / (1.0f + SKV_ERFCX8_C * skv_maxf(y, 0.0f));
    return t *
           (SKV_ERFCX8_0 +
            t * (SKV_ERFCX8_1 +
                 t * (SKV_ERFCX8_2 +
                      t * (SKV_ERFCX8_3 +
                           t * (SKV_ERFCX8_4 +
                                t * (SKV_ERFCX8_5 + t * (SKV_ERFCX8_6 + t * (SKV_ERFCX8_7 + t * SKV_ERFCX8_8))))))));
}

#endif
