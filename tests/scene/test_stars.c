/// Limiting magnitude and visibility of stars against published formulas and well-known skies.
#include "scene_sky.h"

#include "skyvert/stars.h"

static double limit_at(double luminance, double factor) {
    float m = 99;
    assert_int_equal(skv_limiting_magnitude(&m, (float)luminance, (float)factor), SKV_OK);
    return (double)m;
}

/// cd/m2 of a surface brightness in magnitudes per square second of arc, [Crumey14] eq. 13.
static double luminance_of(double mu) {
    return pow(10, 0.4 * (12.58 - mu));
}

/// [Garstang00] as in [Cinzano01] eq. 19 to 21 for a point: nanolamberts in, lux out, m = -13.98 - 2.5 log i.
static double garstang(double luminance) {
    const double b = luminance * PI * 1e5; // 1 nL = 1e-5/pi cd/m2
    const double i1 = 3.451e-9 * pow(1 + 0.109 * sqrt(b), 2), i2 = 4.276e-8 * pow(1 + 1.51e-3 * sqrt(b), 2);
    return -13.98 - 2.5 * log10(i1 * i2 / (i1 + i2));
}

static void limits_are_the_published_ones(void **state) {
    (void)state;
    // [Crumey14] eq. 54, his straight line for 20 < mu < 22: m = 0.4260 mu - 2.3650 - 2.5 log F; it bends by .08, the
    // hyperbola by .03 more.
    for (double mu = 20; mu <= 22; mu += 0.25)
        check_near("[Crumey14] straight line", limit_at(luminance_of(mu), 1.4), 0.4260 * mu - 2.3650 - 2.5 * log10(1.4),
                   0.12);
    double worst = 0;
    for (double e = -4; e <= 4; e += 0.25) {
        // Garstang's threshold is that of the trials at 98 %: F = 2.
        const double off = limit_at(pow(10, e), 2) - garstang(pow(10, e));
        worst = fmax(worst, fabs(off));
    }
    print_message(
        "figure: limiting magnitude, F = 2: %.2f at 22.0, %.2f at 21.0, %.2f at 18.0 mag/arcsec2, %.2f before "
        "the blue sky of 5000 cd/m2; within %.2f of Garstang from 1e-4 to 1e4 cd/m2\n",
        limit_at(luminance_of(22), 2), limit_at(luminance_of(21), 2), limit_at(luminance_of(18), 2), limit_at(5000, 2),
        worst);
    check_at_most("against Garstang", worst, 0.8);
}

/// What everyone knows: sixth magnitude under a dark sky, fourth or fifth under the full moon (18 mag/arcsec2), fourth
/// in a town (16), none but Venus by day.
static void limits_are_the_known_ones(void **state) {
    (void)state;
    const double dark = limit_at(luminance_of(21.8), 2), moon = limit_at(luminance_of(18), 2),
                 city = limit_at(luminance_of(16), 2), day = limit_at(4000, 2);
    assert_true(dark > 6.0 && dark < 6.8);
    assert_true(moon > 4.0 && moon < 5.2);
    assert_true(city > 3.0 && city < 4.9);
    assert_true(day > -4.4 && day < -1.5);
}

static void limit_is_smooth(void **state) {
    (void)state;
    double last = limit_at(0, 2);
    assert_true(last == limit_at(1e-5, 2));
    for (double e = -5; e <= 6; e += 0.001) {
        const double m = limit_at(pow(10, e), 2);
        // 2.5 mag per decade at most (Weber's law), and rounding.
        assert_true(m <= last + 2e-6 && last - m < 0.0027);
        last = m;
    }
}

static skv_stars stars_of(const float *magnitude) {
    skv_stars stars = {.magnitude = magnitude, .bands = 4, .sky_luminance = 2e-4f, .field_factor = 2.0f};
    for (int b = 0; b < 4; b++)
        stars.band_weight[b] = 0.25f;
    return stars;
}

static double weight_of(const skv_stars *stars, double *lux) {
    float w = 9, e = 9;
    assert_int_equal(skv_star_weight(stars, 1, &w, 0, &e, 0), SKV_OK);
    *lux = (double)e;
    return (double)w;
}

static void weight_is_the_observers(void **state) {
    (void)state;
    const double limit = limit_at(2e-4, 2);
    double worst = 0, last = 2;
    for (double d = -3; d <= 4; d += 0.05) {
        const float m = (float)(limit + d);
        const skv_stars stars = stars_of(&m);
        double lux;
        const double w = weight_of(&stars, &lux);
        // [Blackwell46]: normal in contrast, sigma .48 of the threshold.
        const double want = 0.5 * erfc(-(pow(10, -0.4 * d) - 1) / 0.48 / sqrt(2));
        worst = fmax(worst, fabs(w - want));
        check_near("probability", w, want, 0.05);
        check_near("lux", lux, 2.54e-6 * pow(10, -0.4 * (limit + d)), 1e-5 * lux); // float magnitude: 4e-7 mag
        assert_true(w <= last);
        last = w;
        if (fabs(d) < 1e-9)
            check_near("weight at the limit", w, 0.5, 1e-4);
    }
    print_message("figure: star weight within %.3f of Blackwell's observers\n", worst);
    assert_true(last < 0.002);
}

static void air_dims_and_luminance_hides(void **state) {
    (void)state;
    const float magnitude[4] = {3, 3, 3, 3}, luminance[4] = {2e-4f, 0.5f, NAN, 50};
    const float t[4][5] = {{1, 1, 1, 1, 9}, {0.5f, 0.5f, 0.5f, 0.5f, 9}, {1, 1, 1, 1, 9}, {-1, 2, NAN, 0.4f, 9}};
    skv_stars stars = stars_of(magnitude);
    stars.transmittance = t[0];
    stars.transmittance_stride = sizeof t[0];
    stars.luminance = luminance;
    float w[4][2], e[4];
    assert_int_equal(skv_star_weight(&stars, 4, w[0], sizeof w[0], e, 0), SKV_OK);
    const double zero = 2.54e-6 * pow(10, -1.2);
    check_near("no air", (double)e[0], zero, 1e-6 * zero);
    check_near("half the light", (double)e[1], zero / 2, 1e-6 * zero);
    check_near("out of range counts as the end, NaN as 0", (double)e[3], zero * 1.4 / 4, 1e-6 * zero);
    assert_true(w[0][0] > 0.99f && w[1][0] > 0.01f && w[1][0] < 0.99f && w[2][0] == 0 && w[3][0] < 0.02f);
}

/// The share of each band adds up; a grey filter dims by its own factor.
static void bands_add_up(void **state) {
    (void)state;
    for (int bands = 3; bands <= 4; bands++) {
        skv_atmosphere a;
        skv_colour_matrix matrix;
        float weight[4], sum = 0;
        assert_int_equal(skv_atmosphere_clear(&a, bands), SKV_OK);
        assert_int_equal(skv_colour_matrix_for(&matrix, bands, a.wavelength_nm, a.solar_irradiance), SKV_OK);
        assert_int_equal(skv_star_bands(weight, &matrix, bands, a.solar_irradiance), SKV_OK);
        for (int b = 0; b < 4; b++)
            sum += weight[b];
        check_near("sum", (double)sum, 1, 1e-6);
        // Vision is in the green: bands at 520 to 570 nm have most of it.
        assert_true(weight[1] + weight[2] > 0.6f);
        assert_int_equal(skv_star_bands(weight, &matrix, 5, a.solar_irradiance), SKV_ERR_RANGE);
        const float dark[4] = {0, 0, 0, 0}, bad[4] = {NAN, 1, 1, 1};
        assert_int_equal(skv_star_bands(weight, &matrix, bands, dark), SKV_ERR_RANGE);
        assert_int_equal(skv_star_bands(weight, &matrix, bands, bad), SKV_ERR_RANGE);
        assert_int_equal(skv_star_bands(NULL, &matrix, bands, dark), SKV_ERR_NULL);
    }
}

static void statuses_and_any_float(void **state) {
    (void)state;
    float m = 5, w = 5, e;
    assert_int_equal(skv_limiting_magnitude(NULL, 1, 2), SKV_ERR_NULL);
    const float bad_l[] = {-1e-9f, NAN, INFINITY, 1.1e6f}, bad_f[] = {0, -1, NAN, INFINITY, 101};
    for (int i = 0; i < 4; i++)
        assert_int_equal(skv_limiting_magnitude(&m, bad_l[i], 2), SKV_ERR_RANGE);
    for (int i = 0; i < 5; i++)
        assert_int_equal(skv_limiting_magnitude(&m, 1, bad_f[i]), SKV_ERR_RANGE);
    assert_true(m == 5);
    skv_stars stars = stars_of(&m);
    assert_int_equal(skv_star_weight(NULL, 1, &w, 0, NULL, 0), SKV_ERR_NULL);
    assert_int_equal(skv_star_weight(&stars, 1, NULL, 0, NULL, 0), SKV_ERR_NULL);
    assert_int_equal(skv_star_weight(&stars, 1, &w, 3, NULL, 0), SKV_ERR_SIZE);
    assert_int_equal(skv_star_weight(&stars, 0, NULL, 0, NULL, 0), SKV_OK);
    stars.field_factor = NAN;
    assert_int_equal(skv_star_weight(&stars, 1, &w, 0, NULL, 0), SKV_ERR_RANGE);
    stars = stars_of(&m);
    stars.transmittance = &e;
    stars.bands = 5;
    assert_int_equal(skv_star_weight(&stars, 1, &w, 0, NULL, 0), SKV_ERR_RANGE);
    stars.bands = 4;
    stars.band_weight[2] = NAN;
    assert_int_equal(skv_star_weight(&stars, 1, &w, 0, NULL, 0), SKV_ERR_RANGE);
    assert_true(w == 5);
    random_state = 51;
    for (int i = 0; i < CASES(100000); i++) {
        float t[4], l = odd_float(i + 1);
        m = odd_float(i);
        for (int b = 0; b < 4; b++)
            t[b] = odd_float(i + b);
        stars = stars_of(&m);
        stars.transmittance = t;
        stars.luminance = &l;
        stars.field_factor = (float)pow(10, random_in(-1, 2));
        assert_int_equal(skv_star_weight(&stars, 1, &w, 0, &e, 0), SKV_OK);
        assert_true(w >= 0 && w <= 1 && e >= 0 && e < 3e38f);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(limits_are_the_published_ones),
        cmocka_unit_test(limits_are_the_known_ones),
        cmocka_unit_test(limit_is_smooth),
        cmocka_unit_test(weight_is_the_observers),
        cmocka_unit_test(air_dims_and_luminance_hides),
        cmocka_unit_test(bands_add_up),
        cmocka_unit_test(statuses_and_any_float),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
