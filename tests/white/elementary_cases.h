/// The unary functions of src/core/elementary.h, double references for them, and the error each one claims in its
/// comment.
#ifndef TESTS_WHITE_ELEMENTARY_CASES_H
#define TESTS_WHITE_ELEMENTARY_CASES_H

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include "core/elementary.h"

#define CASE_PI 3.14159265358979323846

/// exp(y^2) erfc(y); beyond 5 the asymptotic series, whose 13th term is below 1e-9 of double's rounding there.
static double ref_erfcx(double y) {
    if (y < 5)
        return exp(y * y) * erfc(y);
    double term = 1, sum = 1;
    for (int k = 1; k < 14; k++) {
        term *= -(2 * k - 1) / (2 * y * y);
        sum += term;
    }
    return sum / (y * sqrt(CASE_PI));
}

/// p(t) for which erfcx(y) = t p(t), t = 1/(1 + c y).
static double ref_poly(double t) {
    return ref_erfcx((1 / t - 1) / (double)SKV_ERFCX_C) / t;
}
static double ref_poly6(double t) {
    return ref_erfcx((1 / t - 1) / (double)SKV_ERFCX6_C) / t;
}

static double ref_one_minus_exp2(double y) {
    return -expm1(-y * 0.693147180559945309);
}

typedef struct unary_case {
    const char *name;
    float (*f)(float);
    double (*ref)(double);
} unary_case;

static const unary_case unary_cases[] = {
    {"skv_sqrtf", skv_sqrtf, sqrt},
    {"skv_exp2f", skv_exp2f, exp2},
    {"skv_exp2f_d5", skv_exp2f_d5, exp2},
    {"skv_exp2f_d4", skv_exp2f_d4, exp2},
    {"skv_exp2f_d3", skv_exp2f_d3, exp2},
    {"skv_expf", skv_expf, exp},
    {"skv_one_minus_exp2f", skv_one_minus_exp2f, ref_one_minus_exp2},
    {"skv_log2f", skv_log2f, log2},
    {"skv_logf", skv_logf, log},
    {"skv_log1pf", skv_log1pf, log1p},
    {"skv_erfcxf", skv_erfcxf, ref_erfcx},
    {"skv_erfcx_poly", skv_erfcx_poly, ref_poly},
    {"skv_erfcx_poly6", skv_erfcx_poly6, ref_poly6},
    {"skv_sinf", skv_sinf, sin},
    {"skv_cosf", skv_cosf, cos},
    {"skv_tanf", skv_tanf, tan},
    {"skv_asinf", skv_asinf, asin},
    {"skv_acosf", skv_acosf, acos},
};
#define UNARY_CASES (sizeof unary_cases / sizeof unary_cases[0])

/// One line "Error: rel|abs BOUND on [LO, HI], worst at X" of a function's comment.
typedef struct claim {
    bool relative;
    double bound;
    float lo, hi, worst;
} claim;

/// Claims of a function, at most `room`: the Error lines since the last line that is no comment, before its definition.
static int read_claims(const char *path, const char *function, claim *claims, int room) {
    FILE *file = fopen(path, "r");
    char line[256], head[80], kind[4];
    int found = 0;
    bool defined = false;
    snprintf(head, sizeof head, "float %s(float", function);
    while (file && !defined && fgets(line, sizeof line, file)) {
        defined = strncmp(line, "///", 3) != 0 && strstr(line, head) != NULL;
        if (defined)
            break;
        if (strncmp(line, "///", 3) != 0)
            found = 0;
        claim c;
        if (found < room &&
            sscanf(line, "/// Error: %3s %lf on [%f, %f], worst at %f", kind, &c.bound, &c.lo, &c.hi, &c.worst) == 5) {
            c.relative = strcmp(kind, "rel") == 0;
            claims[found++] = c;
        }
    }
    if (file)
        fclose(file);
    return defined ? found : 0;
}

static int find_claims(const char *function, claim *claims, int room) {
    static const char *const files[] = {"src/core/elementary.h", "src/core/exp_log.h", "src/core/erfcx.h",
                                        "src/core/trig.h"};
    int found = 0;
    for (size_t i = 0; i < sizeof files / sizeof files[0] && found == 0; i++)
        found = read_claims(files[i], function, claims, room);
    return found;
}

static double case_error(const unary_case *u, bool relative, float x) {
    const double want = u->ref((double)x), error = fabs((double)u->f(x) - want);
    return relative ? (error == 0 ? 0 : error / fabs(want)) : error;
}

#endif
