/// The command's moments, numbers, angles and output files.
#define _XOPEN_SOURCE 700
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <signal.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "tests/check.h"

#include "tools/skyvert/answers.h"
#include "tools/skyvert/command.h"

#define EPOCH_2000 946684800 // 2000-01-01 in the C library's seconds since 1970

/// Every day of 1900 to 2100 as the C library's gmtime_r() has it, there and back.
static void test_calendar(void **state) {
    (void)state;
    int days = 0;
    for (int32_t day = -36524; day < 36890; day++, days++) {
        const time_t t = EPOCH_2000 + (time_t)86400 * day + day * 7919 % 86400 + (day * 7919 % 86400 < 0 ? 86400 : 0);
        struct tm tm;
        char want[40], got[UTC_TEXT_SIZE];
        gmtime_r(&t, &tm);
        strftime(want, sizeof want, "%Y-%m-%dT%H:%M:%SZ", &tm);
        utc_time utc;
        if (utc_parse(want, &utc))
            fail_msg("%s: refused: %s", want, utc_parse(want, &utc));
        if (EPOCH_2000 + (double)86400 * utc.day + utc.seconds != (double)t)
            fail_msg("%s: got day %d + %g s", want, (int)utc.day, utc.seconds);
        if (strcmp(utc_text(&utc, got), want) != 0)
            fail_msg("%s: came back as %s", want, got);
    }
    print_message("figure: calendar: %d days equal to gmtime_r()\n", days);
}

static void check_text(const char *text, int32_t day, double seconds, const char *back) {
    utc_time utc;
    char got[UTC_TEXT_SIZE];
    const char *const wrong = utc_parse(text, &utc);
    if (wrong)
        fail_msg("%s: refused: %s", text, wrong);
    assert_int_equal(utc.day, day);
    check_near(text, utc.seconds, seconds, 1e-9); // decimal fractions are not exact in binary
    if (strcmp(utc_text(&utc, got), back) != 0)
        fail_msg("%s: text: got %s, want %s", text, got, back);
}

static void test_forms(void **state) {
    (void)state;
    check_text("2000-01-01", 0, 0, "2000-01-01T00:00:00Z");
    check_text(" 2000-01-01T00:00Z ", 0, 0, "2000-01-01T00:00:00Z");
    check_text("2000-01-01T00:30:00+01:00", -1, 84600, "1999-12-31T23:30:00Z");
    check_text("1999-12-31T23:30:00-0100", 0, 1800, "2000-01-01T00:30:00Z");
    check_text("2000-01-01 00:00:00.125", 0, .125, "2000-01-01T00:00:00.125Z");
    check_text("2000-02-29T23:59:59.9999Z", 59, 86399.9999, "2000-03-01T00:00:00Z");
    check_text("2016-12-31T23:59:60.5Z", 6209, 86400.5, "2016-12-31T23:59:60.500Z");
    check_text("2017-01-01T00:59:60+01:00", 6209, 86400, "2016-12-31T23:59:60Z");
}

static void test_sums(void **state) {
    (void)state;
    utc_time a;
    assert_true(utc_parse("2021-08-17T23:59:30Z", &a) == NULL);
    const utc_time b = utc_add(&a, 60), c = utc_add(&b, -86400. * 366);
    assert_int_equal(b.day, a.day + 1);
    check_near("seconds", b.seconds, 30, 0);
    check_near("difference", utc_difference(&b, &a), 60, 0);
    check_near("difference back", utc_difference(&c, &b), -86400. * 366, 0);
    assert_int_equal(utc_to_skv(&b).day, b.day);
    check_near("core seconds", (double)utc_to_skv(&b).seconds, 30, 0);
}

static void test_numbers(void **state) {
    (void)state;
    static const char *const good[] = {"0", "-0", "+1", "1.", ".5", "1e5", "1E-5", " 2 ", "1e-400", "000123.25"};
    static const char *const bad[] = {"",    " ",        "-",   ".",   "e5",          "1e",    "1e+",
                                      "0x1", "inf",      "nan", "1 2", "1,5",         "1e999", "--1",
                                      "1f",  "INFINITY", "1_0", "1'0", "\xef\xbc\x91"};
    double v = 0;
    for (size_t i = 0; i < sizeof good / sizeof good[0]; i++)
        if (!parse_number(good[i], &v) || v != strtod(good[i], NULL))
            fail_msg("'%s': got %g, want %g", good[i], v, strtod(good[i], NULL));
    v = 42;
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++)
        if (parse_number(bad[i], &v) || v != 42)
            fail_msg("'%s' was taken for a number: %g", bad[i], v);
}

/// Against the C library's long double functions; multiples of 30 and 90 where they are known without it.
static void test_angles(void **state) {
    (void)state;
    static const double exact[][3] = {{0, 0, 1},    {90, 1, 0},   {180, 0, -1},     {270, -1, 0},
                                      {360, 0, 1},  {-90, -1, 0}, {-180, 0, -1},    {450, 1, 0},
                                      {3600, 0, 1}, {-270, 1, 0}, {1e300, NAN, NAN}};
    double s, c, worst = 0;
    for (size_t i = 0; i < sizeof exact / sizeof exact[0]; i++) {
        sin_cos_deg(exact[i][0], &s, &c);
        if (!isnan(exact[i][1]) && (s != exact[i][1] || c != exact[i][2] || signbit(s) != signbit(exact[i][1]) ||
                                    signbit(c) != signbit(exact[i][2])))
            fail_msg("%g deg: got %g %g, want %g %g", exact[i][0], s, c, exact[i][1], exact[i][2]);
        check_near("sin^2 + cos^2", s * s + c * c, 1, 3e-16);
    }
    for (int i = -72000; i <= 72000; i++) {
        const double deg = .01 * i;
        const long double rad = (long double)deg * 3.14159265358979323846264338328L / 180;
        sin_cos_deg(deg, &s, &c);
        const double error = fmax(fabs(s - (double)sinl(rad)), fabs(c - (double)cosl(rad)));
        worst = fmax(worst, error);
    }
    // Half a unit in the last place of sin() and cos(), of the reduced angle and of the result.
    check_at_most("sin_cos_deg against sinl, cosl", worst, 3e-16);
}

// --- output files ---

static char folder[100];

static void path_of(const char *name, char path[200]) {
    snprintf(path, 200, "%s/%s", folder, name);
}

/// @return the file's bytes as text, "" where there is none
static const char *contents(const char *name) {
    static char text[100];
    char path[200];
    path_of(name, path);
    FILE *const f = fopen(path, "rb");
    text[f ? fread(text, 1, sizeof text - 1, f) : 0] = '\0';
    if (f)
        fclose(f);
    return text;
}

static int files_in_folder(void) {
    char command[140], count[20] = "";
    snprintf(command, sizeof command, "ls -A %s | wc -l", folder);
    FILE *const f = popen(command, "r");
    if (!f || !fgets(count, sizeof count, f))
        fail_msg("ls failed");
    pclose(f);
    return atoi(count);
}

static void test_output(void **state) {
    (void)state;
    char path[200];
    output out;
    path_of("a", path);
    assert_int_equal(output_open(&out, path), 0);
    fputs("one", out.stream);
    fflush(out.stream);
    assert_true(access(path, F_OK) != 0); // not there before it is whole
    assert_int_equal(output_commit(&out), 0);
    assert_true(strcmp(contents("a"), "one") == 0);
    assert_int_equal(output_open(&out, path), 0);
    fputs("two", out.stream);
    output_discard(&out);
    output_discard(&out);
    assert_true(strcmp(contents("a"), "one") == 0); // given up: the old one stays
    assert_int_equal(output_reserve(&out, path), 0);
    FILE *const f = fopen(output_name(&out), "wb");
    fputs("three", f);
    fclose(f);
    assert_true(strcmp(contents("a"), "one") == 0);
    assert_int_equal(output_commit(&out), 0);
    assert_true(strcmp(contents("a"), "three") == 0);
    assert_int_equal(files_in_folder(), 1);
}

static void test_output_link(void **state) {
    (void)state;
    char path[200], link[200];
    struct stat status;
    output out;
    path_of("a", path);
    path_of("link", link);
    assert_int_equal(symlink(path, link), 0);
    assert_int_equal(output_open(&out, link), 0);
    fputs("four", out.stream);
    assert_int_equal(output_commit(&out), 0);
    assert_true(lstat(link, &status) == 0 && S_ISLNK(status.st_mode)); // written through, not replaced
    assert_true(strcmp(contents("a"), "four") == 0);
    unlink(link);
}

static void test_output_refused(void **state) {
    (void)state;
    output out;
    char path[200];
    assert_int_equal(output_open(&out, folder), EXIT_USAGE);
    path_of("no/such", path);
    assert_int_equal(output_open(&out, path), EXIT_USAGE);
    assert_int_equal(output_reserve(&out, path), EXIT_USAGE);
    assert_int_equal(output_open(&out, "/dev/full"), 0);
    fputs("x", out.stream);
    assert_int_equal(output_commit(&out), EXIT_JOB);
    assert_int_equal(files_in_folder(), 1);
}

/// A child that is interrupted while it writes leaves nothing and dies of the signal.
static void test_output_signal(void **state) {
    (void)state;
    int ready[2];
    char path[200], byte = 0;
    path_of("b", path);
    assert_int_equal(pipe(ready), 0);
    const pid_t child = fork();
    if (child == 0) {
        alarm(30);
        output first, second;
        if (output_open(&first, path) != 0 || output_reserve(&second, path) != 0) // one name twice at a time
            _exit(9);
        fputs("half", first.stream);
        fflush(first.stream);
        if (write(ready[1], "x", 1) == 1)
            for (;;)
                pause();
        _exit(9);
    }
    assert_true(read(ready[0], &byte, 1) == 1);
    assert_int_equal(files_in_folder(), 3);
    kill(child, SIGINT);
    int status = 0;
    waitpid(child, &status, 0);
    assert_true(WIFSIGNALED(status) && WTERMSIG(status) == SIGINT);
    assert_int_equal(files_in_folder(), 1);
}

static int make_folder(void **state) {
    (void)state;
    signal(SIGINT, SIG_DFL); // a shell's background jobs inherit that it is ignored
    const char *const place = getenv("TMPDIR");
    snprintf(folder, sizeof folder, "%.60s/skyvert-test-XXXXXX", place ? place : P_tmpdir);
    return mkdtemp(folder) ? 0 : -1;
}

static int remove_folder(void **state) {
    (void)state;
    char path[200];
    path_of("a", path);
    unlink(path);
    return rmdir(folder);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_calendar),    cmocka_unit_test(test_forms),          cmocka_unit_test(test_sums),
        cmocka_unit_test(test_numbers),     cmocka_unit_test(test_angles),         cmocka_unit_test(test_output),
        cmocka_unit_test(test_output_link), cmocka_unit_test(test_output_refused), cmocka_unit_test(test_output_signal),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
