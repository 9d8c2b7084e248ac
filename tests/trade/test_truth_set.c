/// The committed truth: whole, precise enough, and physically possible.
#include <math.h>

#include "check.h"
#include "tools/trade/truth.h"

static trade_truth truth;

static void check_ray(const trade_scene *s, int i, double *noise) {
    double largest = 0, its_noise = 0;
    for (int b = 0; b < truth.bands; b++) {
        const double full = s->radiance[TRADE_FULL][i][b], single = s->radiance[TRADE_SINGLE][i][b];
        // Light scattered again is added to light scattered once; five standard errors, a billionth of the sun.
        if (!(full >= single - 5 * s->noise[i][b] - 1e-9))
            fail_msg("%s, %s, ray %d, band %d: full %.6g, single %.6g", truth.air, s->name, i, b, full, single);
        if (full > largest) {
            largest = full;
            its_noise = s->noise[i][b] / full;
        }
    }
    if (!(largest > 0))
        fail_msg("%s, %s, ray %d is black", truth.air, s->name, i);
    *noise = fmax(*noise, its_noise);
}

static void check_air(const char *air) {
    double noise = 0;
    assert_int_equal(trade_truth_load(&truth, ".", air), 0);
    for (int k = 0; k < TRADE_SCENES; k++) {
        const trade_scene *const s = &truth.scene[k];
        int to_ground = 0;
        assert_int_equal(s->n, TRADE_RAYS);
        assert_int_equal(s->sun, k % TRADE_SUNS);
        for (int i = 0; i < s->n; i++) {
            check_ray(s, i, &noise);
            to_ground += s->to_ground[i];
            // A float's rounding of each component.
            const float *const d = s->direction[i];
            check_near("length of a direction", (double)(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]), 1, 1e-6);
        }
        assert_int_equal(to_ground, s->height == TRADE_GROUND ? 0 : 6); // truth.awk: to_the_ground(6)
    }
    check_at_most("standard error of a ray's largest band", noise, 0.002); // the target, .0015, is met by every band
    print_message("figure: %s: largest standard error %.3f %%\n", air, 100 * noise);
}

static void both_airs(void **state) {
    (void)state;
    for (int i = 0; trade_airs[i]; i++)
        check_air(trade_airs[i]);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(both_airs)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
