/// The baselines by marching through the common calls: finite and not negative wherever one looks, the same with any
/// number of threads, stopped by progress; their cost.
#include <time.h>

#include "linan_sky.h"

static const char *const names[] = {"keller08",   "keller08-table1", "keller08-literal",
                                    "hillaire20", "linan23",         "linan23-literal"};
enum { MODELS = sizeof names / sizeof *names };

static double seconds(void) {
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static const baseline *find(const char *name) {
    const baseline *const b = baseline_find(name);
    if (!b)
        fail_msg("%s: not in the list", name);
    return b;
}

/// Everything an atmosphere can have: dust from a table, a log-normal layer, gas that absorbs, three bands, a phase
/// function with a peak of 1.6e7.
static skv_atmosphere odd_air(void) {
    static const float km[] = {0, 2.8f, 3, 4.5f, 5, 10}, density[] = {0, 0, 1, 1, 0, 0};
    skv_atmosphere a = sky_clear();
    a.bands = 3;
    a.rayleigh.kind = SKV_PROFILE_US76;
    a.rayleigh.us76_a = .07771971f;
    a.rayleigh.us76_b = 1.16364243f;
    fill(a.rayleigh_absorption_per_km, 0, 0.01, 0.1, 0);
    a.ozone.kind = SKV_PROFILE_LOGNORMAL;
    a.ozone.lognormal_mu = 3.22261f;
    a.ozone.lognormal_k = 5.55555555f;
    fill(a.dust_scattering_per_km, 0.15, 0.115, 0.09, 0);
    fill(a.dust_extinction_per_km, 0.16, 0.12, 0.095, 0);
    a.dust.kind = SKV_PROFILE_TABLE;
    a.dust.table_altitude_km = km;
    a.dust.table_density = density;
    a.dust.table_rows = 6;
    a.dust_g = -0.6f;
    a.aerosol_g = 0.9999f;
    return a;
}

static void look_around(const baseline *b, const skv_atmosphere *air, int all) {
    static const double heights[] = {0, 1e-6, 12, 60, 60.001, 36000}, suns[] = {0, 89.9999, 97, 180};
    enum { N = 61 };
    const baseline_wants wants = {.all = all, .lit_ground = 1, .threads = 1};
    baseline_cost cost;
    const char *why = "";
    void *state;
    assert_int_equal(b->build(&state, air, &wants, &cost, &why), 0);
    for (size_t h = 0; h < 6; h++)
        for (size_t s = 0; s < 4; s++) {
            if (s != h % 4) // every height and every sun, not every pair: a frame takes a while
                continue;
            const baseline_view view = sky_view(heights[h], suns[s]);
            float direction[N][3], radiance[N][4];
            for (int i = 0; i < N; i++) {
                double d[3];
                sky_direction(d, i == 60 ? 90 : 3 * i, 37 * i);
                for (int k = 0; k < 3; k++)
                    direction[i][k] = (float)d[k];
                for (int k = 0; k < 4; k++)
                    radiance[i][k] = -1;
            }
            assert_int_equal(b->frame(state, &view, &why), 0);
            b->radiance(state, N, (const float(*)[3])direction, radiance);
            for (int i = 0; i < N; i++)
                for (int k = 0; k < 4; k++)
                    if (!((double)radiance[i][k] >= 0 && (double)radiance[i][k] < 2e7) ||
                        (k >= air->bands && (double)radiance[i][k] != 0))
                        fail_msg("%s, %g km, sun zenith %g, ray %d, band %d: %g", b->name, heights[h], suns[s], i, k,
                                 (double)radiance[i][k]);
        }
    b->release(state);
}

static void anywhere(void **state) {
    (void)state;
    const skv_atmosphere odd = odd_air();
    for (int m = 0; m < MODELS - 1; m++) // the literal form of the last has the same maps
        look_around(find(names[m]), &odd, 1);
}

static int stop(void *context, double done) {
    (void)context;
    return done > 0.3;
}

/// Two threads give the same bits as one; a build that is stopped says so.
static void threads_and_progress(void **state) {
    (void)state;
    const skv_atmosphere air = sky_hazy();
    const baseline *const b = find("hillaire20");
    float got[2][SKY_RAYS][4];
    sky_dome d;
    sky_lay(&d, &air, 1, 80, 0);
    for (int k = 0; k < 2; k++) {
        const baseline_wants wants = {.all = 1, .threads = k + 1};
        baseline_cost cost;
        const char *why;
        void *model;
        assert_int_equal(b->build(&model, &air, &wants, &cost, &why), 0);
        assert_int_equal(b->frame(model, &d.view, &why), 0);
        b->radiance(model, SKY_RAYS, (const float(*)[3])d.direction_f, got[k]);
        b->release(model);
    }
    assert_int_equal(memcmp(got[0], got[1], sizeof got[0]), 0);
    const baseline_wants stopped = {.all = 1, .threads = 1, .progress = stop};
    baseline_cost cost;
    const char *why;
    void *model;
    assert_int_equal(b->build(&model, &air, &stopped, &cost, &why), 1);
}

/// What each costs here, in double on one thread: not the speed of the papers' shaders.
static void costs(void **state) {
    (void)state;
    const skv_atmosphere air = sky_clear();
    enum { N = 2000 };
    static float direction[N][3], radiance[N][4];
    for (int i = 0; i < N; i++) {
        double d[3];
        sky_direction(d, 90 * sky_halton(i + 1, 2), 360 * sky_halton(i + 1, 3));
        for (int k = 0; k < 3; k++)
            direction[i][k] = (float)d[k];
    }
    for (int m = 0; m < MODELS; m++) {
        const baseline *const b = find(names[m]);
        const baseline_wants wants = {.all = 1, .lit_ground = 1, .threads = 1};
        const baseline_view view = sky_view(1, 60);
        baseline_cost cost;
        const char *why;
        void *model;
        assert_int_equal(b->build(&model, &air, &wants, &cost, &why), 0);
        const double start = seconds();
        assert_int_equal(b->frame(model, &view, &why), 0);
        const double framed = seconds();
        b->radiance(model, N, (const float(*)[3])direction, radiance);
        double sum = 0;
        for (int i = 0; i < N; i++)
            sum += (double)radiance[i][0];
        print_message(
            "figure: %s: tables %zu bytes, built in %.0f ms, a frame %.0f ms, %.0f ns a vertex (checksum %.4f)\n",
            b->name, cost.table_bytes, 1e3 * cost.build_s, 1e3 * (framed - start), 1e9 * (seconds() - framed) / N, sum);
        check_at_most("a sky has light, -sum", -sum, -1);
        b->release(model);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(anywhere), cmocka_unit_test(threads_and_progress),
                                       cmocka_unit_test(costs)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
