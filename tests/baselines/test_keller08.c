/// [Keller08] against the converged reference, the core's own variant, and limits in which the printed slips vanish.
#include "keller08.h"
#include "linan_sky.h"
#include "skyvert/radiance.h"

static void render(const skv_atmosphere *air, keller08_form form, const sky_dome *d, double (*got)[4]) {
    keller08 *state;
    baseline_cost cost;
    float radiance[SKY_RAYS][4];
    if (keller08_build(&state, air, &form, &cost) != 0)
        fail_msg("keller08_build failed");
    keller08_frame(state, &d->view);
    keller08_radiance(state, (size_t)d->n, (const float(*)[3])d->direction_f, radiance);
    for (int i = 0; i < d->n; i++)
        for (int b = 0; b < 4; b++)
            got[i][b] = (double)radiance[i][b];
    keller08_release(state);
}

static sky_error against_truth(const skv_atmosphere *air, keller08_form form, const sky_dome *d) {
    double got[SKY_RAYS][4];
    render(air, form, d, got);
    return sky_compare(d, (const double(*)[4])d->truth, (const double(*)[4])got);
}

/// Midpoints of smooth integrands: twice the samples, a quarter of the error.
static void samples_converge(void **state) {
    (void)state;
    const skv_atmosphere airs[] = {sky_clear(), sky_hazy()};
    for (int k = 0; k < 2; k++) {
        sky_dome d;
        sky_lay(&d, &airs[k], 1, 60, 0);
        double before = 0;
        for (int n = 32; n <= 256; n *= 2) {
            const sky_error e = against_truth(&airs[k], (keller08_form){.view_steps = n, .depth_steps = n}, &d);
            print_message("figure: keller08 %s, sun 30 deg up, %dx%d: mean %.4f %%, max %.3f %%\n",
                          k ? "hazy" : "clear", n, n, e.mean, e.max);
            // A quarter, with room for the tent's corners and rounding of the answers to float.
            if (n > 32)
                check_at_most("error over that of half the samples", e.mean / before, 0.35);
            before = e.mean;
        }
        check_at_most("mean error of 256 x 256 samples, %", before, 0.02); // a quarter of 64's three times
    }
}

/// Every sort of ray, and a sun below the horizon: the edge of the shadow leaves an error of first order.
static void all_rays_converge(void **state) {
    (void)state;
    static const double heights[] = {0, 12, 90}, suns[] = {40, 88.5, 94};
    const skv_atmosphere air = sky_clear();
    for (int h = 0; h < 3; h++)
        for (int s = 0; s < 3; s++) {
            sky_dome d;
            sky_lay(&d, &air, heights[h], suns[s], 0);
            const sky_error few = against_truth(&air, (keller08_form){.view_steps = 4, .depth_steps = 4}, &d);
            const sky_error many = against_truth(&air, (keller08_form){.view_steps = 500, .depth_steps = 60}, &d);
            print_message(
                "figure: keller08 %g km, sun zenith %g: 4x4 mean %.1f %%, max %.0f %%; 500x60 mean %.2f %%, max "
                "%.2f %%\n",
                heights[h], suns[s], few.mean, few.max, many.mean, many.max);
            // Steps at the far end are 3/500 of the ray; the one on the shadow's edge is lit by halves at random.
            check_at_most("mean error of 500 x 60 samples, %", many.mean, 1.0);
        }
}

/// The core's rule, written by others from the same notes, in float. Its answers to the same question agree.
static void as_the_core(void **state) {
    (void)state;
    static const double suns[] = {30, 80, 93};
    const skv_atmosphere air = sky_clear();
    static skv_model model;
    if (skv_model_build(&model, &air) != SKV_OK)
        fail_msg("skv_model_build");
    double worst = 0;
    for (int s = 0; s < 3; s++) {
        sky_dome d;
        double got[SKY_RAYS][4], want[SKY_RAYS][4];
        float core[SKY_RAYS][4], sun[3];
        sky_lay(&d, &air, 2, suns[s], 0);
        render(&air, (keller08_form){.view_steps = 4, .depth_steps = 4}, &d, got);
        for (int i = 0; i < 3; i++)
            sun[i] = (float)d.view.sun_enu[i];
        skv_light light;
        static skv_frame frame;
        const skv_quality quality = {SKV_KELLER, SKV_DEPTH_BY_INNER, 4, 4, SKV_WITH_ALL & ~(uint32_t)SKV_WITH_GROUND};
        if (skv_light_sun(&light, &model, sun) != SKV_OK ||
            skv_frame_begin(&frame, &model, &quality, 2, 0, &light, 1) != SKV_OK)
            fail_msg("skv_frame_begin");
        const skv_rays rays = {d.direction_f[0], 0, NULL, 0};
        const skv_sky sky = {core[0], sizeof core[0], NULL, 0};
        if (skv_radiance(&frame, (size_t)d.n, &rays, &sky) != SKV_OK)
            fail_msg("skv_radiance");
        for (int i = 0; i < d.n; i++)
            for (int b = 0; b < 4; b++)
                want[i][b] = (double)core[i][b];
        const sky_error e = sky_compare(&d, (const double(*)[4])want, (const double(*)[4])got);
        worst = fmax(worst, e.max);
    }
    print_message("figure: keller08 4x4 against the core's own --rule keller: at most %.3f %%\n", worst);
    check_at_most("difference to the core's rule, %", worst, 0.1); // single precision, 1e-7 of 6360 km in altitude
}

/// Nothing that the paper lacks: all terms are its own terms.
static void own_terms_are_all(void **state) {
    (void)state;
    const skv_atmosphere air = sky_plain(0.76);
    sky_dome d;
    double all[SKY_RAYS][4], own[SKY_RAYS][4];
    sky_lay(&d, &air, 1, 70, 0);
    render(&air, (keller08_form){.view_steps = 4, .depth_steps = 4}, &d, all);
    render(&air, (keller08_form){.view_steps = 4, .depth_steps = 4, .own_terms = 1}, &d, own);
    check_near("largest difference, %", sky_compare(&d, (const double(*)[4])all, (const double(*)[4])own).max, 0,
               1e-12);
}

/// What is left out: ozone, a layer, absorption; profiles become exponential with the same columns.
static void own_terms_leave_out(void **state) {
    (void)state;
    skv_atmosphere air = sky_clear();
    air.rayleigh.kind = SKV_PROFILE_US76;
    air.rayleigh.us76_a = .07771971f;
    air.rayleigh.us76_b = 1.16364243f;
    sky_dome d;
    double all[SKY_RAYS][4], own[SKY_RAYS][4];
    sky_lay(&d, &air, 1, 70, 0);
    render(&air, (keller08_form){.view_steps = 64, .depth_steps = 64}, &d, all);
    render(&air, (keller08_form){.view_steps = 64, .depth_steps = 64, .own_terms = 1}, &d, own);
    const sky_error e = sky_compare(&d, (const double(*)[4])all, (const double(*)[4])own);
    print_message("figure: keller08-table1, its terms alone against all terms (US 1976 air, ozone): mean %.1f %%, max "
                  "%.0f %%\n",
                  e.mean, e.max);
    check_at_most("the paper's terms do matter, -mean %", -e.mean, -1.0);       // ozone dims red by more
    check_at_most("the paper's terms are no other planet, mean %", e.mean, 15); // and changes no band by a factor
}

/// With thin air depths vanish, with g = 0 the phase function does: the slips must make no difference there, and do
/// elsewhere.
static void slips(void **state) {
    (void)state;
    sky_dome d;
    double good[SKY_RAYS][4], printed[SKY_RAYS][4];
    const keller08_form right = {.view_steps = 4, .depth_steps = 4, .own_terms = 1};
    const keller08_form literal = {.view_steps = 4, .depth_steps = 4, .own_terms = 1, .literal = 1};
    const skv_atmosphere thin = sky_times(sky_plain(0), 1e-6);
    sky_lay(&d, &thin, 1, 60, 0);
    render(&thin, right, &d, good);
    render(&thin, literal, &d, printed);
    // Depths of 1e-6 times some ten.
    check_near("thin, isotropic: difference, %",
               sky_compare(&d, (const double(*)[4])good, (const double(*)[4])printed).max, 0, 2e-3);
    static const double gs[] = {0, 0.76};
    for (int k = 0; k < 2; k++)
        for (int s = 0; s < 2; s++) {
            const skv_atmosphere air = sky_plain(gs[k]);
            sky_lay(&d, &air, 1, s ? 60 : 85, 0);
            render(&air, right, &d, good);
            render(&air, literal, &d, printed);
            const sky_error e = sky_compare(&d, (const double(*)[4])good, (const double(*)[4])printed);
            print_message(
                "figure: keller08-literal against keller08-table1, g %g, sun zenith %d: mean %.1f %%, max %.0f "
                "%%\n",
                gs[k], s ? 60 : 85, e.mean, e.max);
            check_at_most("the slips matter, -mean %", -e.mean, -1.0); // depth of 0.3 and more along low rays
        }
}

/// Thin aerosol alone: the sky is its phase function, as printed (g taken with the square of the cosine) and as it
/// should be.
static void printed_phase(void **state) {
    (void)state;
    const double g = 0.6;
    skv_atmosphere air = sky_times(sky_plain(g), 1e-6);
    air.rayleigh.kind = SKV_PROFILE_NONE;
    sky_dome d;
    double good[SKY_RAYS][4], printed[SKY_RAYS][4];
    sky_lay(&d, &air, 0, 40, 0);
    render(&air, (keller08_form){.view_steps = 4, .depth_steps = 4, .own_terms = 1}, &d, good);
    render(&air, (keller08_form){.view_steps = 4, .depth_steps = 4, .own_terms = 1, .literal = 1}, &d, printed);
    for (int i = 0; i < d.n; i++) {
        const double *const v = d.direction[i], *const s = d.view.sun_enu, c = v[0] * s[0] + v[1] * s[1] + v[2] * s[2];
        const double want = pow((1 + g * g - 2 * g * c) / (1 + g * g - 2 * g * c * c), 1.5);
        // Depths of 1e-5 along the longest rays, and directions rounded to float.
        check_near("printed over right", printed[i][0] / good[i][0] / want, 1, 1e-4);
    }
}

/// "Half the samples": how many even steps, with as many for the depths, have the error of 8 x 8 growing ones. Errors
/// fall with the square of the number, so from the error of 16 x 16 the number follows.
static void half_the_samples(void **state) {
    (void)state;
    static const struct {
        const char *name;
        double height_km, sun_zenith;
    } scenes[] = {{"ground, day", 0, 50}, {"ground, sun 1.5 deg up", 0, 88.5}, {"ground, twilight", 0, 94},
                  {"12 km, day", 12, 50}, {"12 km, twilight", 12, 94},         {"40 km, day", 40, 50}};
    const skv_atmosphere airs[] = {sky_clear(), sky_hazy()};
    for (int a = 0; a < 2; a++)
        for (size_t k = 0; k < sizeof scenes / sizeof *scenes; k++) {
            sky_dome d;
            sky_lay(&d, &airs[a], scenes[k].height_km, scenes[k].sun_zenith, 0);
            const sky_error grown = against_truth(&airs[a], (keller08_form){.view_steps = 8, .depth_steps = 8}, &d);
            const sky_error even =
                against_truth(&airs[a], (keller08_form){.view_steps = 16, .depth_steps = 16, .even = 1}, &d);
            const double worth = 16 * sqrt(even.mean / grown.mean);
            print_message(
                "figure: half the samples, %s, %s: 8x8 growing mean %.2f %%, 16x16 even mean %.2f %%: worth %.1f "
                "even ones\n",
                a ? "hazy" : "clear", scenes[k].name, grown.mean, even.mean, worth);
            // The paper's claim is 16. The rule of the square holds within some 10 % at such numbers.
            if (k == 0)
                check_at_most("even samples for 8, ground by day, wanted many", -worth, -14.0);
            if (k == 5) // DESIGN: the other way round up there
                check_at_most("even samples for 8, 40 km by day, wanted few", worth, 8.0);
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(samples_converge),  cmocka_unit_test(all_rays_converge),   cmocka_unit_test(as_the_core),
        cmocka_unit_test(own_terms_are_all), cmocka_unit_test(own_terms_leave_out), cmocka_unit_test(slips),
        cmocka_unit_test(half_the_samples),  cmocka_unit_test(printed_phase),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
