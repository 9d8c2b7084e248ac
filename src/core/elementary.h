/// Elementary functions of the core: + - * / and sqrt only, so every target gives the same bits. No branches: loops
/// that call them vectorise. Defined for every float, NaN and infinities included: what those give stands at each
/// function.
///
/// This file has the building blocks and includes the rest: exp_log.h, erfcx.h, trig.h. The line `Error:` above a
/// function is its worst error and where; tests/white/test_elementary.c reads it and checks it.
#ifndef SKV_CORE_ELEMENTARY_H
#define SKV_CORE_ELEMENTARY_H

#include <float.h>
#include <stdint.h>

#include "core/elementary_coefficients.h"

// -ffast-math folds the rounding steps of exp2 and drops the guards against NaN: refused for the library itself (a
// program that links it may use what it likes). Allowed: -fno-math-errno -fno-trapping-math.
#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__) ||                               \
    (defined(__ASSOCIATIVE_MATH__) && __ASSOCIATIVE_MATH__) || (defined(__RECIPROCAL_MATH__) && __RECIPROCAL_MATH__)
#error "skyvert: the library needs IEEE arithmetic: no -ffast-math, -Ofast or part of them"
#endif

/// A square root in hardware? Without one the compiler would call libm.
#if !defined(SKV_SOFT_SQRT)
#if !defined(__GNUC__) || (defined(__arm__) && !defined(__ARM_FP)) || (defined(__riscv) && !defined(__riscv_flen))
#define SKV_SOFT_SQRT 1
#else
#define SKV_SOFT_SQRT 0
#endif
#endif

/// Functions of one line in the inner loops: a call would keep the loop from being vectorised.
#if defined(__GNUC__)
#define SKV_INLINE   static inline __attribute__((always_inline))
#define SKV_NOINLINE __attribute__((noinline))
#else
#define SKV_INLINE static inline
#define SKV_NOINLINE
#endif

SKV_INLINE uint32_t skv_bits(float x) {
#if defined(__GNUC__)
    uint32_t u;
    __builtin_memcpy(&u, &x, sizeof u);
    return u;
#else
    const union {
        float f;
        uint32_t u;
    } v = {x};
    return v.u;
#endif
}

SKV_INLINE float skv_from_bits(uint32_t u) {
#if defined(__GNUC__)
    float x;
    __builtin_memcpy(&x, &u, sizeof x);
    return x;
#else
    union {
        float f;
        uint32_t u;
    } v;
    v.u = u;
    return v.f;
#endif
}

/// Integer test: holds whatever the compiler assumes about NaN.
SKV_INLINE int skv_isfinite(float x) {
    return (skv_bits(x) & 0x7f800000u) != 0x7f800000u;
}

SKV_INLINE float skv_fabsf(float x) {
    return skv_from_bits(skv_bits(x) & 0x7fffffffu);
}

/// |x| with the sign of s.
SKV_INLINE float skv_copysignf(float x, float s) {
    return skv_from_bits((skv_bits(x) & 0x7fffffffu) | (skv_bits(s) & 0x80000000u));
}

/// The smaller; b where either is NaN.
SKV_INLINE float skv_minf(float a, float b) {
    return a < b ? a : b;
}

/// The larger; b where either is NaN.
SKV_INLINE float skv_maxf(float a, float b) {
    return a > b ? a : b;
}

/// x within [lo, hi]; NaN gives lo.
SKV_INLINE float skv_clampf(float x, float lo, float hi) {
    return skv_minf(skv_maxf(x, lo), hi);
}

/// Square root of a normal positive float in integers: 24 binary digits and one to round by, then round to nearest.
/// A tie cannot occur: the root of a 25-bit number never ends in digit 25.
static inline float skv_sqrt_soft(float x) {
    const uint32_t ix = skv_bits(x);
    const int32_t e = (int32_t)(ix >> 23) - 127;
    uint32_t rest = ((ix & 0x7fffffu) | 0x800000u) << (1 + (e & 1)); // 2m or 4m, so that the exponent is even
    uint32_t twice = 0;                                              // two times the root so far
    uint32_t root = 0;
    for (uint32_t digit = 0x1000000u; digit != 0; digit >>= 1) {
        const uint32_t trial = twice + digit;
        const uint32_t take = 0u - (uint32_t)(trial <= rest);
        rest -= trial & take;
        twice += (digit << 1) & take;
        root += digit & take;
        rest <<= 1;
    }
    root = (root + 1) >> 1; // the 25th digit rounds
    return skv_from_bits((uint32_t)(((e - (e & 1)) / 2 + 126) << 23) + root);
}

/// Square root, correctly rounded. 0 for x < FLT_MIN (subnormals too: flush-to-zero changes nothing), negative, NaN.
/// +infinity stays.
/// Error: rel 6.0e-8 on [0x1p-126, 0x1.fffffep127], worst at 0x1.000002p+0
SKV_INLINE float skv_sqrtf(float x) {
    const float v = x >= FLT_MIN ? x : 0.0f;
#if SKV_SOFT_SQRT
    return v > FLT_MAX || v == 0.0f ? v : skv_sqrt_soft(v);
#else
    return __builtin_sqrtf(v);
#endif
}

/// skv_sqrtf() where the caller knows that x is 0 or normal and positive.
SKV_INLINE float skv_root(float x) {
#if SKV_SOFT_SQRT
    return skv_sqrtf(x);
#else
    return __builtin_sqrtf(x);
#endif
}

#include "core/exp_log.h"
#include "core/erfcx.h"
#include "core/trig.h"

#endif
