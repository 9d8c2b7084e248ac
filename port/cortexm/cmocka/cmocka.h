/// Stand-in for cmocka where there is no operating system: the subset that tests/api uses, with cmocka's output.
#ifndef SKV_CMOCKA_STAND_IN_H
#define SKV_CMOCKA_STAND_IN_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

typedef struct CMUnitTest {
    const char *name;
    void (*test_func)(void **state);
} CMUnitTest;

enum { SKV_TEST_PASSED, SKV_TEST_FAILED, SKV_TEST_SKIPPED };

static jmp_buf skv_test_end;

#define cmocka_unit_test(f)                                                                                            \
    { #f, f }
#define cmocka_run_group_tests(tests, setup, teardown)                                                                 \
    skv_run_group(#tests, (tests), sizeof(tests) / sizeof((tests)[0]), (setup), (teardown))
#define assert_true(c)         skv_assert((c) ? 1 : 0, #c, __FILE__, __LINE__)
#define assert_int_equal(a, b) skv_assert_equal((long long)(a), (long long)(b), #a, #b, __FILE__, __LINE__)
#define fail_msg(...)          skv_fail(__FILE__, __LINE__, __VA_ARGS__)
#define print_message(...)     printf(__VA_ARGS__)
#define skip()                 longjmp(skv_test_end, 1 + SKV_TEST_SKIPPED)

__attribute__((noreturn, format(printf, 3, 4), unused)) static void skv_fail(const char *file, int line,
                                                                             const char *format, ...) {
    va_list rest;
    va_start(rest, format);
    printf("[  ERROR   ] --- ");
    vprintf(format, rest);
    printf("\n%s:%d: error: Failure!\n", file, line);
    va_end(rest);
    longjmp(skv_test_end, 1 + SKV_TEST_FAILED);
}

__attribute__((unused)) static void skv_assert(int holds, const char *what, const char *file, int line) {
    if (!holds)
        skv_fail(file, line, "%s", what);
}

__attribute__((unused)) static void skv_assert_equal(long long a, long long b, const char *what_a, const char *what_b,
                                                     const char *file, int line) {
    if (a != b)
        skv_fail(file, line, "%s = %ld, %s = %ld", what_a, (long)a, what_b, (long)b);
}

static int skv_run_one(const CMUnitTest *test, void **state) {
    static const char *const outcome[] = {"[       OK ]", "[  FAILED  ]", "[  SKIPPED ]"};
    printf("[ RUN      ] %s\n", test->name);
    const int result = setjmp(skv_test_end);
    if (result == 0)
        test->test_func(state);
    const int what = result == 0 ? SKV_TEST_PASSED : result - 1;
    printf("%s %s\n", outcome[what], test->name);
    return what;
}

__attribute__((unused)) static int skv_run_group(const char *name, const CMUnitTest *test, size_t n,
                                                 int (*setup)(void **), int (*teardown)(void **)) {
    int count[3] = {0, 0, 0};
    void *state = NULL;
    printf("[==========] %s: Running %d test(s).\n", name, (int)n);
    if (setup != NULL && setup(&state) != 0)
        count[SKV_TEST_FAILED]++;
    for (size_t i = 0; i < n; ++i)
        count[skv_run_one(&test[i], &state)]++;
    if (teardown != NULL && teardown(&state) != 0)
        count[SKV_TEST_FAILED]++;
    printf("[  PASSED  ] %d test(s).\n", count[SKV_TEST_PASSED]);
    if (count[SKV_TEST_SKIPPED] > 0)
        printf("[  SKIPPED ] %d test(s).\n", count[SKV_TEST_SKIPPED]);
    if (count[SKV_TEST_FAILED] > 0)
        printf("[  FAILED  ] %d test(s).\n", count[SKV_TEST_FAILED]);
    return count[SKV_TEST_FAILED];
}

#endif
