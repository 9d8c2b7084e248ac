/// Whether the library was compiled with arithmetic that is not IEEE single precision.
#ifndef SKV_CORE_ARITHMETIC_H
#define SKV_CORE_ARITHMETIC_H

/// Whether this file was compiled with arithmetic other than IEEE single: products fused with sums, sums reordered, or
/// wider intermediate results. Compilers do not tell in macros. Holds in every rounding mode and with flush-to-zero.
static inline int skv_arithmetic_changed(void) {
    const volatile float a_ = 1.000244140625f, big_ = 16777216.0f, one_ = 1.0f; // 1 + 2^-12, 2^24
    const float a = a_, big = big_, one = one_;
    const float fused = a * a - (a + a - one); // 2^-24 when fused or wider; else 0 or 2^-23
    const float reordered = (big + one) - big; // 1 when reordered or wider; else 0 or 2
    return fused == 5.9604644775390625e-8f || reordered == 1.0f;
}

#endif
