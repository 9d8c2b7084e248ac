/// src/core/elementary.h and gauss_legendre.h against double libm: claimed errors, special values, rounding modes,
/// seams.
#include "check.h"

#include <fenv.h>
#include <stdlib.h>
#if defined(__SSE__)
#include <xmmintrin.h>
#endif

#include "core/gauss_legendre.h"
#include "elementary_cases.h"

#define SAMPLES 60000

/// xorshift32, seeded per test: the same sample every time.
static uint32_t rng_state;

static uint32_t rng(void) {
    rng_state ^= rng_state << 13;
    rng_state ^= rng_state >> 17;
    rng_state ^= rng_state << 5;
    return rng_state;
}

static double uniform(double lo, double hi) {
    return lo + (hi - lo) * (double)rng() / 4294967295.0;
}

/// Half of them spread over the values of [lo, hi], half over its exponents.
static float sample(float lo, float hi) {
    if (rng() & 1u)
        return (float)uniform((double)lo, (double)hi);
    for (;;) {
        const float x = skv_from_bits(rng());
        if (x >= lo && x <= hi)
            return x;
    }
}

static void claims_hold(void **state) {
    (void)state;
    rng_state = 1;
    for (size_t i = 0; i < UNARY_CASES; i++) {
        const unary_case *const u = &unary_cases[i];
        claim claims[3];
        const int n = find_claims(u->name, claims, 3);
        if (n == 0)
            fail_msg("%s: no line `Error:` above it", u->name);
        for (int k = 0; k < n; k++) {
            double worst = case_error(u, claims[k].relative, claims[k].worst);
            // A claim far above what its own worst input gives is out of date.
            if (worst < 0.9 * claims[k].bound)
                fail_msg("%s(%a): error %.3g, but %.3g is claimed", u->name, (double)claims[k].worst, worst,
                         claims[k].bound);
            for (int s = 0; s < SAMPLES; s++) {
                const float x = sample(claims[k].lo, claims[k].hi);
                const double e = case_error(u, claims[k].relative, x);
                if (!(e <= claims[k].bound))
                    fail_msg("%s(%a): got %a, want %a, error %.3g, claimed %.3g", u->name, (double)x, (double)u->f(x),
                             u->ref((double)x), e, claims[k].bound);
                worst = e > worst ? e : worst;
            }
            print_message("figure: %s: %s error %.3g on [%g, %g]\n", u->name,
                          claims[k].relative ? "relative" : "absolute", worst, (double)claims[k].lo,
                          (double)claims[k].hi);
        }
    }
}

/// What each function gives where mathematics has no answer or float has no room. Bits are compared.
static void special_values(void **state) {
    (void)state;
    static const struct {
        const char *name;
        float (*f)(float);
        float x, want;
    } t[] = {
        {"sqrt(0)", skv_sqrtf, 0.0f, 0.0f},
        {"sqrt(-0)", skv_sqrtf, -0.0f, 0.0f},
        {"sqrt(-1)", skv_sqrtf, -1.0f, 0.0f},
        {"sqrt(subnormal)", skv_sqrtf, 1e-40f, 0.0f},
        {"sqrt(nan)", skv_sqrtf, NAN, 0.0f},
        {"sqrt(4)", skv_sqrtf, 4.0f, 2.0f},
        {"exp2(0)", skv_exp2f, 0.0f, 1.0f},
        {"exp2(-0)", skv_exp2f, -0.0f, 1.0f},
        {"exp2(1e-30)", skv_exp2f, 1e-30f, 1.0f},
        {"exp2(-126)", skv_exp2f, -126.0f, 0x1p-126f},
        {"exp2(below -126)", skv_exp2f, -126.00001f, 0.0f},
        {"exp2(-inf)", skv_exp2f, -INFINITY, 0.0f},
        {"exp2(127)", skv_exp2f, 127.0f, 0x1p127f},
        {"exp2(inf)", skv_exp2f, INFINITY, 0x1p127f},
        {"exp2(nan)", skv_exp2f, NAN, 0.0f},
        {"exp2_d5(0)", skv_exp2f_d5, 0.0f, 1.0f},
        {"exp2_d4(0)", skv_exp2f_d4, 0.0f, 1.0f},
        {"exp2_d3(0)", skv_exp2f_d3, 0.0f, 1.0f},
        {"exp2_d3(-200)", skv_exp2f_d3, -200.0f, 0.0f},
        {"exp2_d3(nan)", skv_exp2f_d3, NAN, 0.0f},
        {"exp(0)", skv_expf, 0.0f, 1.0f},
        {"exp(-inf)", skv_expf, -INFINITY, 0.0f},
        {"exp(nan)", skv_expf, NAN, 0.0f},
        {"log2(1)", skv_log2f, 1.0f, 0.0f},
        {"log2(8)", skv_log2f, 8.0f, 3.0f},
        {"log2(0)", skv_log2f, 0.0f, -126.0f},
        {"log2(subnormal)", skv_log2f, 1e-40f, -126.0f},
        {"log2(-1)", skv_log2f, -1.0f, -126.0f},
        {"log2(inf)", skv_log2f, INFINITY, 128.0f},
        {"log2(nan)", skv_log2f, NAN, -126.0f},
        {"log(1)", skv_logf, 1.0f, 0.0f},
        {"log1p(0)", skv_log1pf, 0.0f, 0.0f},
        {"log1p(-1)", skv_log1pf, -1.0f, 0.0f},
        {"log1p(nan)", skv_log1pf, NAN, 0.0f},
        {"log1p(1e-20)", skv_log1pf, 1e-20f, 1e-20f},
        {"erfcx(inf)", skv_erfcxf, INFINITY, 0.0f},
        {"sin(0)", skv_sinf, 0.0f, 0.0f},
        {"cos(0)", skv_cosf, 0.0f, 1.0f},
        {"sin(nan)", skv_sinf, NAN, 0.0f},
        {"cos(nan)", skv_cosf, NAN, 1.0f},
        {"sin(inf)", skv_sinf, INFINITY, 0.0f},
        {"cos(-1e5)", skv_cosf, -1e5f, 1.0f},
        {"asin(2)", skv_asinf, 2.0f, 1.57079633f},
        {"asin(nan)", skv_asinf, NAN, -1.57079633f},
        {"acos(1)", skv_acosf, 1.0f, 0.0f},
        {"acos(-1)", skv_acosf, -1.0f, 3.14159265f},
        {"acos(nan)", skv_acosf, NAN, 3.14159265f},
    };
    for (size_t i = 0; i < sizeof t / sizeof t[0]; i++) {
        const float got = t[i].f(t[i].x);
        if (skv_bits(got) != skv_bits(t[i].want))
            fail_msg("%s: got %a, want %a", t[i].name, (double)got, (double)t[i].want);
    }
    for (int n = -126; n <= 127; n++)
        check_near("exp2 of an integer", (double)skv_exp2f((float)n), ldexp(1.0, n), 0.0);
}

static void selects(void **state) {
    (void)state;
    assert_true(skv_clampf(NAN, 2.0f, 3.0f) == 2.0f);
    assert_true(skv_clampf(INFINITY, 2.0f, 3.0f) == 3.0f);
    assert_true(skv_clampf(2.5f, 2.0f, 3.0f) == 2.5f);
    assert_true(skv_minf(NAN, 1.0f) == 1.0f && skv_maxf(NAN, 1.0f) == 1.0f);
    assert_true(skv_minf(1.0f, 2.0f) == 1.0f && skv_maxf(1.0f, 2.0f) == 2.0f);
    assert_true(!skv_isfinite(NAN) && !skv_isfinite(INFINITY) && !skv_isfinite(-INFINITY));
    assert_true(skv_isfinite(FLT_MAX) && skv_isfinite(-0.0f) && skv_isfinite(1e-45f));
    assert_true(skv_bits(skv_fabsf(-0.0f)) == 0u && skv_fabsf(-3.0f) == 3.0f);
    assert_true(skv_copysignf(3.0f, -0.0f) == -3.0f && skv_copysignf(-3.0f, 1.0f) == 3.0f);
}

/// The software root must be the correctly rounded one: every mantissa of an odd and of an even exponent, and the ends.
static void soft_sqrt(void **state) {
    (void)state;
    for (uint32_t b = 0x3f000000u; b < 0x40000000u; b++) {
        const float x = skv_from_bits(b), got = skv_sqrt_soft(x), want = sqrtf(x);
        if (skv_bits(got) != skv_bits(want))
            fail_msg("skv_sqrt_soft(%a): got %a, want %a", (double)x, (double)got, (double)want);
    }
    rng_state = 2;
    for (int i = 0; i < SAMPLES; i++) {
        const float x = sample(FLT_MIN, FLT_MAX);
        assert_int_equal(skv_bits(skv_sqrt_soft(x)), skv_bits(sqrtf(x)));
    }
    assert_int_equal(skv_bits(skv_sqrt_soft(FLT_MIN)), skv_bits(sqrtf(FLT_MIN)));
    assert_int_equal(skv_bits(skv_sqrt_soft(FLT_MAX)), skv_bits(sqrtf(FLT_MAX)));
}

/// 2^x must not fall where n changes by more than its error, and must not fall at all across the floats around a seam
/// for the odd degrees, whose errors are alike at both ends of f.
static void exp2_seams(void **state) {
    (void)state;
    static const struct {
        const char *name;
        float (*f)(float);
        double step;
    } t[] = {
        {"skv_exp2f", skv_exp2f, 1.2e-7},
        {"skv_exp2f_d5", skv_exp2f_d5, 2.4e-7}, // one unit in the last place on either side
        {"skv_exp2f_d4", skv_exp2f_d4, 5.9e-6}, // twice the error of the polynomial
        {"skv_exp2f_d3", skv_exp2f_d3, 2.4e-7},
    };
    for (size_t i = 0; i < sizeof t / sizeof t[0]; i++) {
        double worst = 0;
        for (int n = -125; n < 127; n++) {
            float x = (float)n + 0.5f - 64 * FLT_EPSILON * 64;
            double before = (double)t[i].f(x);
            for (int k = 0; k < 400; k++) {
                x = nextafterf(x, 128.0f);
                const double now = (double)t[i].f(x), fall = (before - now) / before;
                worst = fall > worst ? fall : worst;
                before = now;
            }
        }
        check_at_most(t[i].name, worst, t[i].step);
    }
}

/// Angle and power of pairs.
static void pairs(void **state) {
    (void)state;
    rng_state = 3;
    double worst_angle = 0, worst_power = 0;
    for (int i = 0; i < 20 * SAMPLES; i++) {
        const float y = sample(-1e30f, 1e30f), x = rng() & 1u ? sample(-1e30f, 1e30f) : y * (float)uniform(-3, 3);
        const double angle = atan2((double)y, (double)x);
        const double e = fabs((double)skv_atan2f(y, x) - angle) / fmax(fabs(angle), 1e-6);
        worst_angle = e > worst_angle ? e : worst_angle;
        const float base = (float)exp(uniform(-40, 40)), p = (float)uniform(-3, 3);
        const double bits = fabs((double)p * log2((double)base)), want = pow((double)base, (double)p);
        if (bits < 125) {
            const double q = fabs((double)skv_powf(base, p) / want - 1) / (2e-7 + 1.6e-7 * bits);
            worst_power = q > worst_power ? q : worst_power;
        }
    }
    check_at_most("skv_atan2f, relative", worst_angle, 3.0e-7);
    check_at_most("skv_powf, error over its claim", worst_power, 1.0);
    print_message("figure: skv_atan2f: relative error %.3g\n", worst_angle);
    print_message("figure: skv_powf: %.2f of its claim\n", worst_power);
    assert_true(skv_atan2f(0.0f, 0.0f) == 0.0f);
    assert_true(skv_atan2f(0.0f, -1.0f) == 3.14159265f);
    assert_true(skv_atan2f(-0.0f, -1.0f) == -3.14159265f);
    assert_true(skv_atan2f(1.0f, 0.0f) == 1.57079633f);
    assert_true(skv_atan2f(INFINITY, INFINITY) == skv_atan2f(1.0f, 1.0f));
    const float odd[] = {NAN, INFINITY, -INFINITY, FLT_MAX, 1e-45f, -1e-45f, 0.0f, -0.0f, 1.0f, -FLT_MAX};
    for (int i = 0; i < 10; i++)
        for (int k = 0; k < 10; k++) {
            assert_true(skv_fabsf(skv_atan2f(odd[i], odd[k])) <= 3.1415928f);
            assert_true(skv_isfinite(skv_powf(odd[i], odd[k])) && skv_powf(odd[i], odd[k]) >= 0.0f);
        }
}

/// Every 4099th float, and those at the ends of the exponents, through everything: finite.
static void all_finite(const char *mode) {
    for (size_t i = 0; i < UNARY_CASES; i++) {
        const unary_case *const u = &unary_cases[i];
        if (strncmp(u->name, "skv_erfcx_p", 11) == 0)
            continue; // only for (0, 1]
        for (uint64_t b = 0; b < 0x100000000u; b += 65521) {
            const float x = skv_from_bits((uint32_t)b & (b % 3 == 0 ? 0xff800003u : 0xffffffffu));
            if (!skv_isfinite(u->f(x)) && !(u->f == skv_sqrtf && x > FLT_MAX))
                fail_msg("%s(%a), %s: %a", u->name, (double)x, mode, (double)u->f(x));
        }
    }
}

static void rounding_modes(void **state) {
    (void)state;
    static const struct {
        const char *name;
        int mode;
    } t[] = {
        {"to nearest", FE_TONEAREST}, {"upward", FE_UPWARD}, {"downward", FE_DOWNWARD}, {"to zero", FE_TOWARDZERO}};
    for (size_t i = 0; i < 4; i++) {
        assert_int_equal(fesetround(t[i].mode), 0);
        all_finite(t[i].name);
        fesetround(FE_TONEAREST);
    }
}

/// With flush-to-zero and denormals-are-zero: finite, and the same bits for every normal input that is not tiny.
static void flush_to_zero(void **state) {
    (void)state;
#if defined(__SSE__)
    const unsigned before = _mm_getcsr();
    rng_state = 4;
    for (int i = 0; i < SAMPLES; i++) {
        const float x = sample(-FLT_MAX, FLT_MAX);
        for (size_t k = 0; k < UNARY_CASES; k++) {
            if (skv_fabsf(x) < 0x1p-100f)
                continue; // x^3 or a result is subnormal there
            const float want = unary_cases[k].f(x);
            _mm_setcsr(before | 0x8040u);
            const float got = unary_cases[k].f(x);
            _mm_setcsr(before);
            if (skv_bits(got) != skv_bits(want) && skv_fabsf(want) >= FLT_MIN)
                fail_msg("%s(%a): %a, flushed %a", unary_cases[k].name, (double)x, (double)want, (double)got);
        }
    }
    _mm_setcsr(before | 0x8040u);
    all_finite("flush to zero");
    _mm_setcsr(before);
#else
    skip();
#endif
}

/// An N-point rule is exact for powers up to 2N-1; its nodes and weights are floats, hence 1e-7.
static void gauss_rules(void **state) {
    (void)state;
    for (int n = SKV_GAUSS_MIN; n <= SKV_GAUSS_MAX; n++) {
        const float *const x = &skv_gauss_node[skv_gauss_offset(n)], *const w = &skv_gauss_weight[skv_gauss_offset(n)];
        for (int power = 0; power < 2 * n; power++) {
            double sum = 0;
            for (int i = 0; i < n; i++)
                sum += (double)w[i] * pow((double)x[i], power);
            check_near("integral of x^k on [0, 1]", sum, 1.0 / (power + 1), 1.0e-7);
        }
        for (int i = 1; i < n; i++)
            assert_true(x[i] > x[i - 1]);
        assert_true(x[0] > 0.0f && x[n - 1] < 1.0f);
    }
    assert_int_equal(skv_gauss_offset(SKV_GAUSS_MIN), 0);
    assert_int_equal(skv_gauss_offset(SKV_GAUSS_MAX) + SKV_GAUSS_MAX, SKV_GAUSS_COUNT);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(claims_hold),    cmocka_unit_test(special_values), cmocka_unit_test(selects),
        cmocka_unit_test(soft_sqrt),      cmocka_unit_test(exp2_seams),     cmocka_unit_test(pairs),
        cmocka_unit_test(rounding_modes), cmocka_unit_test(flush_to_zero),  cmocka_unit_test(gauss_rules),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
