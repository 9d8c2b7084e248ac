/// Jobs of the path tracer: the same bits for any number of threads and after an interruption; states that do not fit.
#include <math.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "check.h"
#include "orders.h"

enum { RAYS = 6 };

static const ref_query rays[RAYS] = {{0, 30, 60, 40, 2},  {2, 75, 89, 10, 3},  {10, 85, 100, 120, 4},
                                     {40, 90, 95, 20, 5}, {0.3, 93, 70, 0, 6}, {100, 60, 20, 0, 7}};
static ref_tracer tracer;
static char state[512];

static ref_atmosphere air(void) {
    return (ref_atmosphere){.bands = 3,
                            .radius_km = 6360,
                            .top_km = 60,
                            .irradiance = {1, 2, 0},
                            .albedo = {0.3, 0.2, 0.1},
                            .rayleigh_scattering = {0.029, 0.0146, 0.0082},
                            .rayleigh = {.kind = REF_US76, .us76_a = .07771971, .us76_b = 1.16364243},
                            .aerosol_scattering = {0.0514, 0.045, 0.0401},
                            .aerosol_extinction = {0.0643, 0.0562, 0.0502},
                            .aerosol = {.kind = REF_EXP_BACKGROUND, .scale_km = 1.2, .background = 2e-3},
                            .phase = REF_HENYEY_GREENSTEIN,
                            .g = 0.8};
}

static int run(const ref_job *job, ref_total *totals) {
    return ref_orders_run(&tracer, job, rays, RAYS, totals);
}

static int same(const ref_total *a, const ref_total *b) {
    for (int i = 0; i < RAYS; i++)
        if (memcmp(a[i].radiance, b[i].radiance, sizeof a[i].radiance) != 0 ||
            memcmp(a[i].error, b[i].error, sizeof a[i].error) != 0 || a[i].tally.batches != b[i].tally.batches)
            return 0;
    return 1;
}

static void threads_do_not_matter(void **unused) {
    (void)unused;
    ref_job job = {.target = 0.02, .max_paths = 100000, .seed = 5, .threads = 1, .lit_ground = 1};
    ref_total one[RAYS], other[RAYS];
    assert_int_equal(run(&job, one), 0);
    for (job.threads = 2; job.threads <= 5; job.threads += 3) {
        assert_int_equal(run(&job, other), 0);
        if (!same(one, other))
            fail_msg("1 and %d threads differ in bits", job.threads);
    }
    job.seed = 6;
    assert_int_equal(run(&job, other), 0);
    if (same(one, other))
        fail_msg("another seed gives the same bits");
}

static void errors_are_met(void **unused) {
    (void)unused;
    const ref_job job = {.target = 0.01, .max_paths = 10000000, .seed = 9, .threads = 2, .lit_ground = 1};
    ref_total totals[RAYS];
    assert_int_equal(run(&job, totals), 0);
    for (int i = 0; i < RAYS; i++) {
        assert_true(totals[i].done);
        assert_true(totals[i].radiance[2] == 0 && totals[i].error[2] == 0); // a band without sun
        for (int k = 0; k < 2; k++)
            check_at_most("standard error", totals[i].error[k], job.target * totals[i].radiance[k]);
    }
    // From above the top and looking away there is nothing.
    assert_true(totals[5].radiance[0] == 0);
}

// Once the state is there the job is under way.
static void *send_interrupt(void *unused) {
    const struct timespec moment = {0, 1000000}, pause = {0, 50000000};
    while (access(state, F_OK) != 0)
        nanosleep(&moment, NULL);
    nanosleep(&pause, NULL);
    kill(getpid(), SIGINT);
    return unused;
}

static void interrupted_jobs_go_on(void **unused) {
    (void)unused;
    ref_job job = {.target = 1e-6, .max_paths = 64 * 300, .seed = 5, .threads = 2, .lit_ground = 0};
    ref_total whole[RAYS], parts[RAYS];
    pthread_t thread;
    assert_int_equal(run(&job, whole), 0);
    job.state = state;
    remove(state);
    assert_int_equal(pthread_create(&thread, NULL, send_interrupt, NULL), 0);
    const int status = run(&job, parts);
    pthread_join(thread, NULL);
    if (status != 1)
        fail_msg("interrupted: got status %d, want 1", status);
    uint64_t batches = 0;
    for (int i = 0; i < RAYS; i++)
        batches += parts[i].tally.batches;
    print_message("figure: interrupted after %d of %d batches\n", (int)batches, 5 * 300);
    assert_int_equal(run(&job, parts), 0);
    if (!same(whole, parts))
        fail_msg("an interrupted job and a whole one differ in bits");
    // A tighter target goes on from what there is.
    ref_total tight[RAYS], at_once[RAYS];
    job.max_paths = 64 * 350;
    assert_int_equal(run(&job, tight), 0);
    job.state = NULL;
    assert_int_equal(run(&job, at_once), 0);
    if (!same(tight, at_once))
        fail_msg("a job that was extended and a whole one differ in bits");
}

static void put(const char *text) {
    FILE *out = fopen(state, "w");
    if (!out || fputs(text, out) < 0 || fclose(out) != 0)
        fail_msg("%s: cannot be written", state);
}

static void states_that_do_not_fit_are_refused(void **unused) {
    (void)unused;
    ref_job job = {.target = 0.1, .max_paths = 64 * 24, .seed = 5, .threads = 1, .state = state};
    ref_total totals[RAYS];
    char first[256] = "", text[1024];
    remove(state);
    assert_int_equal(run(&job, totals), 0);
    FILE *in = fopen(state, "r");
    if (!in || !fgets(first, sizeof first, in))
        fail_msg("%s: cannot be read", state);
    fclose(in);
    job.seed = 6;
    assert_int_equal(run(&job, totals), 2);
    job.seed = 5;
    job.lit_ground = 1;
    assert_int_equal(run(&job, totals), 2);
    job.lit_ground = 0;
    static const char *const damaged[] = {"",
                                          "something else\n",
                                          "0 24 1 2 3",
                                          "9 24 0 0 0 0 0 0 0 0 .\n",
                                          "0 24 0x1p-3 0 0 0 0 0 0\n",
                                          "0 x 0 0 0 0 0 0 0 0 .\n"};
    for (int i = 0; i < 6; i++) {
        snprintf(text, sizeof text, "%s%s", i < 2 ? "" : first, damaged[i]);
        put(text);
        if (run(&job, totals) != 2)
            fail_msg("damaged state %d was taken", i);
    }
    job.state = "no such folder/state";
    assert_int_equal(run(&job, totals), 1);
}

static int set_up(void **unused) {
    static ref_atmosphere a;
    (void)unused;
    a = air();
    const char *folder = getenv("B");
    snprintf(state, sizeof state, "%s/path-job-state-%ld", folder ? folder : "build", (long)getpid());
    return ref_tracer_make(&tracer, &a, 2);
}

static int tear_down(void **unused) {
    (void)unused;
    remove(state);
    ref_tracer_free(&tracer);
    return 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(threads_do_not_matter),
        cmocka_unit_test(errors_are_met),
        cmocka_unit_test(interrupted_jobs_go_on),
        cmocka_unit_test(states_that_do_not_fit_are_refused),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
