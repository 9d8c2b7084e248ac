/// Checks that print case, got, want, error and tolerance. For cmocka, or its stand-in on bare metal.
#ifndef TESTS_CHECK_H
#define TESTS_CHECK_H

// clang-format off
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>
// clang-format on

static inline void check_near(const char *what, double got, double want, double tolerance) {
    const double error = got > want ? got - want : want - got;
    if (!(error <= tolerance))
        fail_msg("%s: got %.9g, want %.9g, error %.3g, tolerance %.3g", what, got, want, error, tolerance);
}

static inline void check_at_most(const char *what, double got, double limit) {
    if (!(got <= limit))
        fail_msg("%s: got %.9g, allowed at most %.9g", what, got, limit);
}

#endif
