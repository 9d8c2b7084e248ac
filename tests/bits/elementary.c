/// The core's elementary functions on every kind of float, NaN and infinities included.
#include "bits.h"

#include "core/elementary.h"

/// Any bit pattern half of the time, else a number of the size that the core uses.
static float any_float(void) {
    const uint32_t word = bits_random();
    return bits_pick(2) == 0 ? skv_from_bits(word) : bits_uniform(-100.0f, 100.0f);
}

static void exponentials(float x, float y) {
    bits_float(skv_exp2f(x), BITS_NOT_NEGATIVE);
    bits_float(skv_exp2f_d5(x), BITS_NOT_NEGATIVE);
    bits_float(skv_exp2f_d4(x), BITS_NOT_NEGATIVE);
    bits_float(skv_exp2f_d3(x), BITS_NOT_NEGATIVE);
    bits_float(skv_expf(x), BITS_NOT_NEGATIVE);
    bits_float(skv_log2f(x), BITS_FINITE);
    bits_float(skv_logf(x), BITS_FINITE);
    bits_float(skv_log1pf(x), BITS_NOT_NEGATIVE);
    bits_float(skv_powf(x, y), BITS_NOT_NEGATIVE);
    bits_float(skv_erfcxf(x), BITS_NOT_NEGATIVE);
}

static void angles(float x, float y) {
    const skv_sincos both = skv_sincosf(x);
    bits_float(both.sin, BITS_FINITE);
    bits_float(both.cos, BITS_FINITE);
    bits_float(skv_tanf(x), BITS_FINITE);
    bits_float(skv_asinf(x * 0.01f), BITS_FINITE);
    bits_float(skv_acosf(x * 0.01f), BITS_NOT_NEGATIVE);
    bits_float(skv_atan2f(y, x), BITS_FINITE);
}

void bits_elementary(bits_scale scale) {
    const char *const name = scale == BITS_SMALL ? "small" : "full";
    const int n = scale == BITS_SMALL ? 2000 : 100000;
    bits_begin(name, "sqrt");
    for (int i = 0; i < n; ++i)
        bits_float(skv_sqrtf(any_float()), BITS_ANY); // +infinity stays
    bits_end();
    bits_begin(name, "exp-log");
    for (int i = 0; i < n; ++i) {
        const float x = any_float(), y = any_float();
        exponentials(x, y);
    }
    bits_end();
    bits_begin(name, "trig");
    for (int i = 0; i < n; ++i) {
        const float x = any_float(), y = any_float();
        angles(x, y);
    }
    bits_end();
}
