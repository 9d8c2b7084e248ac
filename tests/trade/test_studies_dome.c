/// White box of the dome study: the triangle that a direction falls into, and light taken apart by what scatters it.
#include "tools/trade/dome_study.c"

#include "check.h"

static study s;

static const double heights[] = {0, 12, 40}, suns[] = {10, 60, 88.5, 94};

/// A point of a flat triangle is the sum of its corners by its shares: that alone defines them.
static void shares_give_the_direction_back(void **state) {
    skv_atmosphere air;
    int tried = 0;
    (void)state;
    assert_int_equal(skv_atmosphere_preset(&air, SKV_PRESET_EARTH_CLEAR, 4), SKV_OK);
    for (int k = 0; k < 3 * 4 * KINDS * SIZES; k += 5) {
        const double height = heights[k % 3];
        trade_direction(s.sun, suns[k / 3 % 4], 20.0 * k);
        assert_int_equal(lay_dome(&s, k / 12 % KINDS, k / 36, &air, height), TRADE_STUDY_DONE);
        for (int i = 1; i < 150; i++, tried++) {
            float v[3];
            double share[3] = {0, 0, 0}, at[3] = {0, 0, 0}, length = 0;
            trade_direction(v, 0.9999 * study_horizon_deg(&air, height) * study_halton(i, 2), 360 * study_halton(i, 3));
            const uint32_t *const corner = s.dome.index + 3 * find_triangle(&s.dome, v, share);
            for (int c = 0; c < 3; c++)
                for (int j = 0; j < 3; j++)
                    at[j] += share[c] * (double)s.dome.at.direction[corner[c]][j];
            for (int j = 0; j < 3; j++)
                length += at[j] * at[j];
            length = sqrt(length);
            for (int c = 0; c < 3; c++)
                assert_true(share[c] > -1e-5); // floats of the mesh: 3e-7 of triangles down to 1 % wide
            for (int j = 0; j < 3; j++)
                check_near("direction", at[j] / length, (double)v[j], 1e-6);
        }
    }
    print_message("figure: %d directions in flat triangles\n", tried);
}

/// Light scattered once is the sum of what each kind of matter scatters through all of them.
static void parts_add_up(void **state) {
    static float whole[64][4], part[64][4];
    skv_atmosphere air;
    double worst = 0;
    (void)state;
    assert_int_equal(skv_atmosphere_preset(&air, SKV_PRESET_EARTH_SMOKE, 4), SKV_OK); // gas, haze, smoke, ozone
    static light l;
    assert_int_equal(make_light(&l, &air), TRADE_STUDY_DONE);
    for (int k = 0; k < 12; k++) {
        float sun[3], direction[64][3];
        study_sky once = l.all;
        once.table = NULL;
        trade_direction(sun, suns[k % 4], 0);
        for (int i = 0; i < 64; i++)
            trade_direction(direction[i], study_horizon_deg(&air, heights[k / 4]) * study_halton(i + 1, 2),
                            360 * study_halton(i + 1, 3));
        assert_int_equal(study_radiance(&once, heights[k / 4], sun, 64, (const float(*)[3])direction, whole), 0);
        double sum[64][4] = {{0}};
        for (int m = 0; m < MATTERS; m++) {
            assert_int_equal(l.matters[m], 1);
            assert_int_equal(study_radiance(&l.once[m], heights[k / 4], sun, 64, (const float(*)[3])direction, part),
                             0);
            for (int i = 0; i < 64; i++)
                for (int b = 0; b < 4; b++)
                    sum[i][b] += (double)part[i][b];
        }
        for (int i = 0; i < 64; i++)
            for (int b = 0; b < 4; b++)
                if (whole[i][b] > 1e-12f)
                    worst = fmax(worst, fabs(sum[i][b] / (double)whole[i][b] - 1));
    }
    free_light(&l);
    // The same nodes and exponentials: what float rounding leaves.
    check_at_most("parts against the whole", worst, 2e-5);
    print_message("figure: light taken apart adds up within %.1e\n", worst);
}

/// Henyey and Greenstein's function from its formula, Rayleigh's 3/(16 pi) (1 + nu^2).
static void phases_are_the_airs(void **state) {
    const double pi = 3.14159265358979323846;
    static light l;
    skv_atmosphere air;
    (void)state;
    assert_int_equal(skv_atmosphere_preset(&air, SKV_PRESET_EARTH_SMOKE, 4), SKV_OK);
    ref_from_skyvert(&air, 0, &l.phases);
    const double g = (double)air.dust_g;
    for (int i = 0; i <= 18; i++) {
        float d[3];
        const float up[3] = {0, 0, 1};
        trade_direction(d, 10.0 * i, 33);
        const double nu = cos(10.0 * i * STUDY_DEGREE), rayleigh = 3 / (16 * pi) * (1 + nu * nu),
                     dust = (1 - g * g) / (4 * pi * pow(1 + g * g - 2 * g * nu, 1.5));
        check_near("Rayleigh", phase_of(&l, 0, d, up), rayleigh, 1e-6 * rayleigh);
        check_near("dust", phase_of(&l, 2, d, up), dust, 1e-5 * dust);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shares_give_the_direction_back),
        cmocka_unit_test(parts_add_up),
        cmocka_unit_test(phases_are_the_airs),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
