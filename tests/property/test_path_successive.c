/// Two ways to the light of all orders agree: random paths, and successive orders on a grid.
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "check.h"
#include "paths.h"
#include "successive.h"

static ref_tracer tracer;
static ref_view view;

static ref_atmosphere hazy(void) {
    return (ref_atmosphere){.bands = 4,
                            .radius_km = 6360,
                            .top_km = 60,
                            .irradiance = {1, 1, 1, 2},
                            .albedo = {0.03, 0.055, 0.5, 0.035},
                            .rayleigh_scattering = {0.02900713, 0.01461732, 0.008156124, 0.004908462},
                            .rayleigh = {.kind = REF_EXPONENTIAL, .scale_km = 8},
                            .aerosol_scattering = {0.05142882, 0.04499519, 0.04012802, 0.03630459},
                            .aerosol_extinction = {0.06428603, 0.05624398, 0.05016003, 0.04538074},
                            .aerosol = {.kind = REF_EXPONENTIAL, .scale_km = 1.2},
                            .phase = REF_CORNETTE_SHANKS,
                            .g = 0.7};
}

static ref_atmosphere dusty(void) {
    ref_atmosphere a = hazy();
    for (int k = 0; k < 4; k++) {
        a.aerosol_scattering[k] *= 0.1;
        a.aerosol_extinction[k] *= 0.1;
        a.ozone_absorption[k] = 0.001 * k;
        a.rayleigh_absorption[k] = 0.0005 * k;
        a.dust_scattering[k] = 0.01;
        a.dust_extinction[k] = 0.012;
    }
    a.phase = REF_HENYEY_GREENSTEIN;
    a.ozone = (ref_profile){.kind = REF_TENT, .peak_km = 25, .half_width_km = 15};
    a.dust = (ref_profile){.kind = REF_TENT, .peak_km = 3, .half_width_km = 2};
    a.dust_g = 0.5;
    return a;
}

typedef struct trial {
    const char *name;
    double sun_deg, around_deg;
    int suns;
    double stated; // error of the grid
} trial;

static void compare(const ref_atmosphere *a, const trial *t) {
    static const double rays[10][3] = {{0, 60, 40},  {0, 85, 90},  {1, 95, 30},    {3, 80, 120},   {5, 120, 60},
                                       {12, 45, 90}, {12, 94, 60}, {30, 100, 100}, {0.2, 100, 60}, {2, 170, 0}};
    const ref_grid grid = {.heights = 26,
                           .suns = t->suns,
                           .sun_low_deg = t->sun_deg - t->around_deg,
                           .sun_high_deg = t->sun_deg + t->around_deg,
                           .thetas = 23,
                           .turns = 16,
                           .polars = 8,
                           .azimuths = 8,
                           .cells = 5,
                           .orders = 12};
    ref_successive solver;
    double worst = 0, mean = 0;
    assert_int_equal(ref_tracer_make(&tracer, a, 2), 0);
    assert_int_equal(ref_successive_make(&solver, &tracer.air, &grid), 0);
    for (int i = 0; i < 10; i++) {
        double grid_light[4], light[4], error[4];
        ref_tally tally = {0};
        const double *q = rays[i];
        assert_int_equal(ref_view_make(&view, &tracer, q[0], t->sun_deg, q[1], q[2], i % 2, 1), 0);
        assert_int_equal(ref_successive_radiance(&solver, q[0], t->sun_deg, q[1], q[2], i % 2, grid_light), 0);
        while (tally.batches < 24 || (ref_view_error(&view, &tally) > 0.004 && tally.batches < 1000))
            ref_view_batch(&view, &tally);
        ref_view_result(&view, &tally, light, error);
        for (int k = 0; k < 4; k++) {
            const double apart = grid_light[k] / light[k] - 1;
            if (!(fabs(apart) <= t->stated + 4 * error[k] / light[k]))
                fail_msg("%s, ray %g,%g,%g band %d: orders %.5e, paths %.5e +- %.1e: apart by %.2f %%, allowed %.2f %%",
                         t->name, q[0], q[1], q[2], k, grid_light[k], light[k], error[k], 100 * apart,
                         100 * (t->stated + 4 * error[k] / light[k]));
            worst = fmax(worst, fabs(apart));
            mean += fabs(apart) / 40;
        }
    }
    printf("figure: successive orders and paths, %s: apart by %.2f %% in the mean, %.2f %% at most\n", t->name,
           100 * mean, 100 * worst);
    ref_successive_free(&solver);
    ref_tracer_free(&tracer);
}

// The grid's own error: going to 40 heights, 33 thetas, 12 Gauss points and 8 cells changes rays by .5 % at most.
static void by_day_in_haze(void **state) {
    (void)state;
    const ref_atmosphere a = hazy();
    compare(&a, &(trial){"hazy air, sun at 60 deg", 60, 10, 5, 0.006});
}

static void low_sun_in_dust(void **state) {
    (void)state;
    const ref_atmosphere a = dusty();
    compare(&a, &(trial){"clear air under dust, sun at 87 deg", 87, 4, 7, 0.006});
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(by_day_in_haze), cmocka_unit_test(low_sun_in_dust)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
