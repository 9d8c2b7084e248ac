/// Every float through the unary functions that the core is made of (src/core/elementary.h): finite whatever goes in,
/// largest error over the documented domain and where. Without arguments a sample: every 40,009th float and the
/// documented worst input, which must still be the worst; `unary all [FUNCTION]`: all 2^32, minutes a function.
#include <stdlib.h>

#include "table.h"
#include "white/elementary_cases.h"

typedef struct naive {
    const char *name;
    float (*f)(float);
} naive;

/// The plain product, as one writes it.
static float naive_erfcx(float y) {
    return expf(y * y) * erfcf(y);
}
static float naive_acos_of(float x) {
    return atan2f(sqrtf(1 - x * x), x);
}

static const naive of[] = {{"skv_exp2f", exp2f}, {"skv_log2f", log2f}, {"skv_erfcxf", naive_erfcx},
                           {"skv_sinf", sinf},   {"skv_cosf", cosf},   {"skv_acosf", naive_acos_of}};

static const char *only;
static uint64_t stride = 40009;

typedef struct worst {
    double error[3], naive[3];
    float at[3];
    int naive_bad;
} worst;

static void at_input(const unary_case *u, const naive *n, const claim *claims, int count, float x, worst *w) {
    const float y = u->f(x);
    if (!skv_isfinite(y))
        fail_msg("%s(%a) is not finite", u->name, (double)x);
    for (int i = 0; i < count; i++) {
        if (!(x >= claims[i].lo && x <= claims[i].hi))
            continue;
        const double e = case_error(u, claims[i].relative, x);
        if (!(e <= w->error[i]))
            w->error[i] = e, w->at[i] = x;
        const double want = u->ref((double)x), d = fabs((double)n->f(x) - want);
        const double by = claims[i].relative ? (d == 0 ? 0 : d / fabs(want)) : d;
        if (by < 1e30)
            w->naive[i] = fmax(w->naive[i], by);
        else
            w->naive_bad = 1;
    }
}

static void functions(void **state) {
    char line[900] = "", plain[400] = "", number[16], other[16];
    (void)state;
    for (size_t k = 0; k < sizeof of / sizeof *of; k++) {
        const unary_case *u = NULL;
        claim claims[3];
        worst w = {{0}, {0}, {0}, 0};
        const int count = find_claims(of[k].name, claims, 3);
        for (size_t i = 0; i < UNARY_CASES; i++)
            u = strcmp(unary_cases[i].name, of[k].name) == 0 ? &unary_cases[i] : u;
        assert_true(u != NULL && count > 0);
        if (only && strcmp(only, of[k].name) != 0)
            continue;
        for (uint64_t b = 0; b < 0x100000000u; b += stride)
            at_input(u, &of[k], claims, count, skv_from_bits((uint32_t)b), &w);
        for (int i = 0; i < count; i++)
            at_input(u, &of[k], claims, count, claims[i].worst, &w);
        for (int i = 0; i < count; i++) {
            printf("figure: %s: %s error %.3g at %a on [%g, %g], documented %.3g\n", u->name,
                   claims[i].relative ? "relative" : "absolute", w.error[i], (double)w.at[i], (double)claims[i].lo,
                   (double)claims[i].hi, claims[i].bound);
            check_at_most(u->name, w.error[i], claims[i].bound);
        }
        const int last = count - 1;
        const size_t end = strlen(line), there = strlen(plain);
        snprintf(number, sizeof number, "%.1e", w.error[last]);
        snprintf(other, sizeof other, "%.1e", w.naive[last]);
        snprintf(line + end, sizeof line - end, "%s%.*s %s at %.9g", end ? "; " : "", (int)strlen(u->name) - 5,
                 u->name + 4, number, (double)w.at[last]);
        snprintf(plain + there, sizeof plain - there, "%s%s%s", there ? "; " : "", other, w.naive_bad ? ", NaN" : "");
    }
    if (!only)
        table_line(15, "largest error of a function over all floats and its input (sin, cos absolute)", plain, line,
                   "libm");
}

int main(int argc, char **argv) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(functions)};
    stride = argc > 1 ? 1 : stride;
    only = argc > 2 ? argv[2] : NULL;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
