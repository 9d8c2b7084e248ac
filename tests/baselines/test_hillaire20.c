/// [Hillaire20] against the converged reference (single scattering), and its table of multiple scattering against sums
/// over the reference and against successive orders in thin, isotropic air.
#include "hillaire20.h"
#include "linan_sky.h"
#include "march.h"
#include "successive.h"

static hillaire20 *build(const skv_atmosphere *air, const hillaire20_sizes *sizes, int all, int lit_ground,
                         baseline_cost *cost) {
    static baseline_wants wants;
    hillaire20 *state;
    const char *why;
    wants = (baseline_wants){.all = all, .lit_ground = lit_ground, .threads = 1};
    if (hillaire20_build(&state, air, &wants, sizes, cost, &why) != 0)
        fail_msg("hillaire20_build failed");
    return state;
}

static void direct(const hillaire20 *state, const sky_dome *d, double (*got)[4]) {
    for (int i = 0; i < d->n; i++)
        hillaire20_direct(state, &d->view, d->direction[i], got[i]);
}

static sky_error pictured(hillaire20 *state, const sky_dome *d, double (*got)[4]) {
    float radiance[SKY_RAYS][4];
    hillaire20_frame(state, &d->view);
    hillaire20_radiance(state, (size_t)d->n, (const float(*)[3])d->direction_f, radiance);
    for (int i = 0; i < d->n; i++)
        for (int b = 0; b < 4; b++)
            got[i][b] = (double)radiance[i][b];
    return sky_compare(d, (const double(*)[4])d->truth, (const double(*)[4])got);
}

/// Larger tables and more steps lead to the reference, the ground's light included, from everywhere.
static void single_converges(void **state) {
    (void)state;
    static const struct { double height_km, sun_zenith; } scenes[] = {{0.5, 50}, {0, 88.5}, {12, 94}, {90, 60}};
    hillaire20_sizes large = HILLAIRE20_SIZES;
    large.transmittance_width = 512;
    large.transmittance_height = 128;
    large.transmittance_steps = 200;
    large.sky_steps = 800;
    const skv_atmosphere air = sky_clear();
    baseline_cost cost;
    hillaire20 *few = build(&air, &HILLAIRE20_SIZES, 0, 1, &cost), *many = build(&air, &large, 0, 1, &cost);
    for (size_t k = 0; k < sizeof scenes / sizeof *scenes; k++) {
        sky_dome d;
        double got[SKY_RAYS][4];
        sky_lay(&d, &air, scenes[k].height_km, scenes[k].sun_zenith, 1);
        direct(few, &d, got);
        const sky_error coarse = sky_compare(&d, (const double(*)[4])d.truth, (const double(*)[4])got);
        direct(many, &d, got);
        const sky_error fine = sky_compare(&d, (const double(*)[4])d.truth, (const double(*)[4])got);
        double marched[SKY_RAYS][4];
        direct(few, &d, marched);
        const sky_error picture = pictured(few, &d, got);
        // Cells of .9 % of each axis: bilinear, but for the peak around the sun.
        check_at_most("picture of the sky over what it holds, mean %",
                      sky_compare(&d, (const double(*)[4])marched, (const double(*)[4])got).mean, 0.3);
        print_message(
            "figure: hillaire20 single, %g km, sun zenith %g: mean/max %% %.2f/%.1f; through the picture of the "
            "sky %.2f/%.1f; 27 times the steps %.3f/%.2f\n",
            scenes[k].height_km, scenes[k].sun_zenith, coarse.mean, coarse.max, picture.mean, picture.max, fine.mean,
            fine.max);
        // Points at .3 of their steps are of first order: 27 times fewer, and the table's cells 4 times.
        check_at_most("mean error with many steps, %", fine.mean, 0.3);
        check_at_most("of few steps over many, -", -coarse.mean / fine.mean, -5);
    }
    hillaire20_release(few);
    hillaire20_release(many);
}

/// Mean over all directions of the light that the reference says comes to a point, its ground lit (the second order's
/// source), and of 1 - T, the share of a uniform unit radiance that air which only scatters sends back.
static void mean_light(const skv_atmosphere *air, double height_km, double sun_zenith, double light[4],
                       double back[4]) {
    enum { POLAR = 24, AROUND = 8 };
    ref_file file;
    ref_from_skyvert(air, 0, &file);
    const double radius = (double)air->radius_km;
    const double horizon = acos(-sqrt(height_km * (2 * radius + height_km)) / (radius + height_km));
    for (int b = 0; b < 4; b++)
        light[b] = back[b] = 0;
    for (int i = 0; i < 2 * POLAR; i++) {
        // Polar angles crowd at the horizon on both sides: midpoints of t^2.
        const int below = i >= POLAR;
        const double t = (i % POLAR + 0.5) / POLAR, span = below ? acos(-1) - horizon : horizon;
        const double zenith = below ? horizon + span * t * t : horizon - span * t * t;
        const double weight = sin(zenith) * t * span / POLAR;
        for (int j = 0; j < AROUND; j++) {
            ref_answer answer;
            const ref_ray ray = ref_ray_from_angles(height_km, sun_zenith, zenith / DEGREE, 180 * (j + 0.5) / AROUND);
            if (ref_single(&file.atmosphere, &ray, 1, NULL, &answer) != 0)
                fail_msg("the reference did not converge");
            for (int b = 0; b < 4; b++) {
                light[b] += weight * answer.radiance[b] / AROUND;
                back[b] += weight * (1 - answer.transmittance[b]) / AROUND;
            }
        }
    }
}

/// Air of isotropic scattering alone: an aerosol with g = 0. Optical depths by band .02, .05, .1, .2.
static skv_atmosphere isotropic(void) {
    skv_atmosphere a = sky_plain(0);
    a.rayleigh.kind = SKV_PROFILE_NONE;
    fill(a.rayleigh_scattering_per_km, 0, 0, 0, 0);
    a.aerosol.scale_height_km = 8;
    fill(a.aerosol_scattering_per_km, 0.02 / 8, 0.05 / 8, 0.1 / 8, 0.2 / 8);
    fill(a.aerosol_extinction_per_km, 0.02 / 8, 0.05 / 8, 0.1 / 8, 0.2 / 8);
    fill(a.albedo, 0, 0, 0.3, 0);
    return a;
}

/// The formula L2/(1 - f) with L2 and f from the reference. @return largest relative error.
static double table_error(const hillaire20 *s, const skv_atmosphere *air, const char *name, double height_km,
                          double sun_zenith) {
    double light[4], back[4], got[4], worst = 0, ratio[4];
    mean_light(air, height_km, sun_zenith, light, back);
    hillaire20_multiple(s, height_km, cos(sun_zenith * DEGREE), got);
    for (int b = 0; b < 4; b++) {
        ratio[b] = got[b] / (light[b] / (1 - back[b]));
        worst = fmax(worst, fabs(ratio[b] - 1));
    }
    print_message("figure: hillaire20 multiple, %s, %g km, sun zenith %g: table over its formula %.3f %.3f %.3f %.3f "
                  "(isotropic, depths .02 .05 .1 .2)\n",
                  name, height_km, sun_zenith, ratio[0], ratio[1], ratio[2], ratio[3]);
    return worst;
}

static void table_of_multiple_scattering(void **state) {
    (void)state;
    static const double places[][2] = {{0, 30}, {5, 60}, {20, 80}, {1, 88}};
    const skv_atmosphere air = isotropic();
    hillaire20_sizes corners = HILLAIRE20_SIZES;
    corners.multiple_width = corners.multiple_height = 2; // read at its corners only
    corners.multiple_side = 40;
    corners.multiple_steps = 150;
    baseline_cost cost;
    hillaire20 *paper = build(&air, &HILLAIRE20_SIZES, 1, 0, &cost), *many = build(&air, &corners, 1, 0, &cost);
    for (size_t k = 0; k < sizeof places / sizeof *places; k++) // 8 polar angles miss most of the long rays
        check_at_most("the paper's table over its formula, less 1",
                      table_error(paper, &air, "32x32, 8x8 directions, 20 steps", places[k][0], places[k][1]), 0.3);
    // 40 even cosines leave about 1/5 of 8's error in what comes from near the horizon.
    check_at_most("at the ground", table_error(many, &air, "40x40 directions, 150 steps", 0, 0), 0.03);
    check_at_most("at the top", table_error(many, &air, "40x40 directions, 150 steps", 60, 0), 0.06);
    hillaire20_release(paper);
    hillaire20_release(many);
}

/// Light of the orders after the first along rays, over that of a successive-orders solver; largest error by band.
static void orders_error(const hillaire20_sizes *sizes, const ref_successive *solver, const ref_file *file,
                         const char *name, double worst[4]) {
    static const double rays[][3] = {{0, 30, 40}, {0, 75, 120}, {2, 60, 90}, {12, 45, 30}, {3, 120, 60}};
    const skv_atmosphere air = isotropic();
    baseline_cost cost;
    hillaire20 *all = build(&air, sizes, 1, 0, &cost);
    hillaire20 *single = build(&air, sizes, 0, 0, &cost);
    for (int b = 0; b < 4; b++)
        worst[b] = 0;
    for (size_t k = 0; k < sizeof rays / sizeof *rays; k++) {
        double total[4], with[4], without[4], direction[3];
        ref_answer first;
        const baseline_view view = sky_view(rays[k][0], 50);
        const ref_ray ray = ref_ray_from_angles(rays[k][0], 50, rays[k][1], rays[k][2]);
        assert_int_equal(ref_single(&file->atmosphere, &ray, 0, NULL, &first), 0);
        assert_int_equal(ref_successive_radiance(solver, rays[k][0], 50, rays[k][1], rays[k][2], 0, total), 0);
        sky_direction(direction, rays[k][1], rays[k][2]);
        hillaire20_direct(all, &view, direction, with);
        hillaire20_direct(single, &view, direction, without);
        for (int b = 0; b < 4; b++)
            worst[b] = fmax(worst[b], fabs((with[b] - without[b]) / (total[b] - first.radiance[b]) - 1));
    }
    print_message(
        "figure: hillaire20 (%s), orders after the first against successive orders, isotropic air of depth .02 "
        ".05 .1 .2: off by at most %.1f %.1f %.1f %.1f %%\n",
        name, 100 * worst[0], 100 * worst[1], 100 * worst[2], 100 * worst[3]);
    hillaire20_release(all);
    hillaire20_release(single);
}

static void against_successive_orders(void **state) {
    (void)state;
    const skv_atmosphere air = isotropic();
    ref_file file;
    ref_from_skyvert(&air, 0, &file);
    static ref_air table;
    const ref_grid grid = {.heights = 16,
                           .suns = 3,
                           .sun_low_deg = 40,
                           .sun_high_deg = 60,
                           .thetas = 13,
                           .turns = 6,
                           .polars = 8,
                           .azimuths = 6,
                           .cells = 4,
                           .orders = 8};
    ref_successive solver;
    assert_int_equal(ref_air_make(&table, &file.atmosphere, 256, 64, 1), 0);
    assert_int_equal(ref_successive_make(&solver, &table, &grid), 0);
    hillaire20_sizes fine = HILLAIRE20_SIZES;
    fine.multiple_width = 11; // the sun's cosine, cells of .2: only -.2 to 1 matter, and there it is near to linear
    fine.multiple_height = 32;
    fine.multiple_side = 20;
    fine.multiple_steps = 50;
    fine.sky_steps = 100;
    double paper[4], finer[4];
    orders_error(&HILLAIRE20_SIZES, &solver, &file, "the paper's sizes", paper);
    orders_error(&fine, &solver, &file, "20x20 directions, 50 steps", finer);
    for (int b = 0; b < 4; b++) {
        check_at_most("orders after the first, paper's sizes", paper[b], 0.3); // the table's own error as above
        // That falls with the number of polar angles; what the same light everywhere around a point costs stays.
        check_at_most("orders after the first, finer", finer[b], fmin(0.15, 0.8 * paper[b]));
    }
    ref_successive_free(&solver);
    ref_air_free(&table);
}

/// No absorption and a white ground: what goes in comes out. The share f must stay under 1, and the light finite.
static void stays_bounded(void **state) {
    (void)state;
    skv_atmosphere air = sky_times(sky_plain(0.76), 25);
    fill(air.albedo, 1, 1, 1, 1);
    baseline_cost cost;
    hillaire20_sizes small = HILLAIRE20_SIZES;
    small.multiple_width = small.multiple_height = 16;
    hillaire20 *s = build(&air, &small, 1, 1, &cost);
    for (int i = 0; i <= 20; i++)
        for (int j = 0; j <= 20; j++) {
            double light[4];
            hillaire20_multiple(s, 60.0 * i / 20, 0.1 * j - 1, light);
            for (int b = 0; b < 4; b++) // isotropic light within cannot exceed the sun's 1/pi times a few passes
                check_near("multiple scattering in dense air", light[b], 0.5, 0.5);
        }
    hillaire20_release(s);
}

static void one_everywhere(const void *model, const march_ray *ray, double radiance[4]) {
    (void)model, (void)ray;
    for (int b = 0; b < 4; b++)
        radiance[b] = b + 1;
}

static void sun_and_turn(const void *model, const march_ray *ray, double radiance[4]) {
    (void)model;
    for (int b = 0; b < 4; b++)
        radiance[b] = ray->mu_s + ray->nu;
}

/// The sky's light on the ground: a uniform sky sends pi; one of mu_s + nu sends pi mu_s + 2/3 pi mu_s.
static void ground_under_a_sky(void **state) {
    (void)state;
    static march_ground ground;
    double e[4];
    march_ground_make(&ground, one_everywhere, NULL);
    march_ground_at(&ground, 0.3, e);
    check_near("uniform sky", e[1], 2 * acos(-1), 1e-12); // midpoints are exact for a line
    march_ground_make(&ground, sun_and_turn, NULL);
    march_ground_at(&ground, 0.7, e);
    check_near("sky that rises with the sun", e[2], acos(-1) * 0.7 * 5 / 3, 0.01); // midpoints of mu^2, 10 of them
    march_ground_at(&ground, -0.5, e);
    check_near("night", e[0], 0, 0);
}

static void sizes(void **state) {
    (void)state;
    const skv_atmosphere air = sky_clear();
    baseline_cost cost;
    hillaire20 *s = build(&air, &HILLAIRE20_SIZES, 1, 0, &cost);
    print_message("figure: hillaire20 tables %zu bytes (half floats), built in %.2f s of one thread\n",
                  cost.table_bytes, cost.build_s);
    assert_int_equal(cost.table_bytes, (256 * 64 + 32 * 32 + 192 * 108) * 4 * 2);
    hillaire20_release(s);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(single_converges),          cmocka_unit_test(table_of_multiple_scattering),
        cmocka_unit_test(against_successive_orders), cmocka_unit_test(stays_bounded),
        cmocka_unit_test(ground_under_a_sky),        cmocka_unit_test(sizes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
