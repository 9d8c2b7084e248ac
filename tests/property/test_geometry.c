/// Paths, altitudes and horizon decisions against double at the same float inputs.
#include "air.h"
#include "core/geometry.h"

static uint64_t state_of_random = 0x2545F4914F6CDD1DULL;

static double even(double low, double high) {
    return low + (high - low) * random_unit(&state_of_random);
}

static double column_of(const air *a, ref_ray ray, double length_km) {
    double column[3];
    ref_column(&a->truth.atmosphere, &ray, length_km, column);
    return column[1];
}

// What the 1 m layer adds: its share is known to 2 % only, the altitude's 1e-5 km against its 1e-3 km.
static double layer_of(const air *a, ref_ray ray, double length_km) {
    static const double km[2] = {0, 1}, half[2] = {0.5, 0.5};
    air even = *a;
    even.truth.atmosphere.aerosol = (ref_profile){.kind = REF_TABLE, .table_km = km, .table_density = half, .rows = 2};
    return column_of(a, ray, length_km) - column_of(&even, ray, length_km);
}

// A path length seen through the whole library: absorbing air of constant density (its exponential part is 1 m thick),
// so that -log(T)/k is the length, in the band whose optical depth is nearest to 1.
static void path_lengths(void **state) {
    static air a;
    static float view[20000][3], length[20000], radiance[20000][4], through[20000][4];
    skv_atmosphere thin = air_none(4);
    double worst = 0;
    (void)state;
    thin.aerosol.kind = SKV_PROFILE_EXP_BACKGROUND;
    thin.aerosol.scale_height_km = 0.001f;
    thin.aerosol.background = 1;
    fill(thin.aerosol_extinction_per_km, 0.002, 0.01, 0.05, 0.25);
    air_make(&a, "uniform", thin, 0);
    for (int n = 0; n < 12; n++) {
        static const float heights[] = {0, 0.001f, 0.1f, 2, 12, 59.999f, 60, 60.5f, 80, 99};
        static const float sun[3] = {0, 0, 1};
        const float h = n < 10 ? heights[n] : (float)even(0, 100);
        const double horizon = 90 + acos(6360 / (6360 + (double)h)) / DEGREE;
        skv_frame frame;
        const skv_quality q = quality_of(SKV_GAUSS_EXP, SKV_DEPTH_BY_CHAPMAN, 2, 1);
        for (int i = 0; i < 20000; i++) {
            direction_of(view[i], i % 2 ? even(0, 180) : horizon + even(-3, 3), even(0, 360));
            length[i] = i % 4 ? INFINITY : (float)even(0, 1500);
        }
        frame_of(&frame, &a, &q, h, sun);
        const skv_rays rays = {view[0], 0, length, 0};
        const skv_sky sky = {radiance[0], sizeof radiance[0], through[0], sizeof through[0]};
        must(skv_radiance(&frame, 20000, &rays, &sky), "skv_radiance");
        for (int i = 0; i < 20000; i++) {
            const double v[3] = {(double)view[i][0], (double)view[i][1], (double)view[i][2]};
            ref_ray ray = ref_ray_from_vectors((double)h, v, (double[3]){0, 0, 1});
            // Within 1e-4 rad of tangency one rounding of the direction moves the end of the ray by kilometres; so does
            // the altitude's within 100 m of the top.
            const double tangent_km = ray.mu < 0 ? (6360 + (double)h) * sqrt(1 - ray.mu * ray.mu) - 6360 : 0;
            if (fabs(acos(ray.mu) - horizon * DEGREE) < 1e-4 || fabs(tangent_km - 60) < 0.1)
                continue;
            const double column = column_of(&a, ray, (double)length[i]);
            ref_ray up = ray;
            up.mu = fabs(ray.mu);
            for (int b = 0; b < 4; b++) {
                const double k = (double)thin.aerosol_extinction_per_km[b], want = k * column;
                if (want < 0.4 || want > 2.5)
                    continue;
                if (length[i] > 1e4f && fabs(ray.mu) > 0.2)
                    worst = fmax(worst, fabs(-log((double)through[i][b]) - want) / want);
                // 1e-6 of the path (the design's number) and 5e-7 for T's rounding and exp2's. The depth of a given
                // length is a difference of two columns to the top, of which it has 2e-7. An altitude's last bit
                // (4e-6 km at the top) shifts each end by 1/mu of that, and one from the tangent point by R/path. Two
                // roundings of mu (the direction is made a unit vector) count by what they do to the true path.
                const double error = fabs(-log((double)through[i][b]) - want), limit = 1.5e-6 * want;
                if (error <= limit)
                    continue;
                const double bit = tangent_km > 0 && ray.mu < 0 ? 4 * 6420 * 4e-6 / fmax(column, 1)
                                   : length[i] < 1e4f           ? 1e-5 / fmax(fabs(ray.mu), 1e-2)
                                                                : 0;
                ref_ray turned = ray;
                turned.mu *= 1 + 2.4e-7;
                const double turn = fabs(column_of(&a, turned, (double)length[i]) - column);
                const double layer = layer_of(&a, ray, (double)length[i]);
                if (error > limit + 2e-7 * k * column_of(&a, up, INFINITY) + 0.02 * k * layer + k * (bit + turn))
                    fail_msg("height %g, mu %.9g, length %g: path %.9g, want %.9g km", (double)h, ray.mu,
                             (double)length[i], -log((double)through[i][b]) / k, column);
            }
        }
    }
    printf(
        "figure: path length through the library, 12 deg from the horizontal and more, largest relative error %.1e\n",
        worst);
}

// The forms themselves at their own float inputs, against long double.
static void stable_forms(void **state) {
    double worst_path = 0, worst_altitude = 0;
    (void)state;
    for (int i = 0; i < 1000000; i++) {
        const float radius = 6360, top = 60, h = (float)(i % 3 ? even(0, 60) : pow(10, even(-4, 1.7)));
        const float mu = (float)(i % 2 ? even(-1, 1) : even(-0.2, 0.2)), rm = (radius + h) * mu;
        const long double c = ((long double)top - h) * (2 * (long double)radius + h + top);
        const long double root = sqrtl((long double)rm * rm + c);
        const long double want = rm > 0 ? c / (rm + root) : root - (long double)rm;
        const float got = skv_to_top(radius, top, h, rm);
        worst_path = fmax(worst_path, (double)fabsl(((long double)got - want) / (want > 0 ? want : 1)));
        // Altitude of a point on the way, as the core forms it: from the lower end of a leg, rm >= 0.
        const float up = rm < 0 ? -rm : rm, s = got * (float)even(0, 1);
        const float e = h * (2.0f * radius + h) + s * (2.0f * up + s);
        const long double el =
            (long double)h * (2 * (long double)radius + h) + (long double)s * (2 * (long double)up + s);
        float r;
        if (el > 62 * 12782.0L)
            continue;
        const long double altitude = el / (radius + sqrtl((long double)radius * radius + el));
        worst_altitude = fmax(worst_altitude, (double)fabsl(skv_altitude(radius, e, &r) - altitude));
    }
    printf("figure: distance to the top, relative %.1e; altitude of a point %.1e km\n", worst_path, worst_altitude);
    // The design's numbers: 1e-6 of the path, .06 m.
    check_at_most("distance to the top", worst_path, 1e-6);
    check_at_most("altitude, km", worst_altitude, 6e-5);
}

// Without air a ray shows the white ground or black: which, against double, outside 1e-6 rad of tangency (float
// directions are that coarse); a light overhead far around, the ray's foot on the lit side.
static void horizon_hit_or_miss(void **state) {
    static const float heights[] = {-5, 0, 0.001f, 0.1f, 1, 10, 59, 61, 400, 3000};
    static const float grounds[] = {0, -0.43f, 2.4f};
    skv_atmosphere none = air_none(3);
    (void)state;
    fill(none.albedo, 1, 1, 1, 1);
    for (int n = 0; n < 30; n++) {
        air a;
        skv_frame frame;
        skv_quality q = quality_of(SKV_GAUSS_EXP, SKV_DEPTH_BY_CHAPMAN, 2, 1);
        const float h = heights[n % 10], sun[3] = {0, 0, 1};
        const double radius = 6360 + (double)grounds[n / 10], y = fmax(0, (double)h - (double)grounds[n / 10]);
        const double sine = radius / (radius + y);
        q.terms |= SKV_WITH_GROUND;
        air_make(&a, "none", none, grounds[n / 10]);
        frame_of(&frame, &a, &q, h, sun);
        for (int i = 0; i < 4000; i++) {
            float view[3], radiance[4], through[4];
            const double tangent = 180 - asin(sine) / DEGREE;
            direction_of(view, i % 2 ? even(0, 180) : tangent + pow(10, even(-5, 0)) * (i % 4 ? 1 : -1), even(0, 360));
            const double across = hypot((double)view[0], (double)view[1]), zenith = atan2(across, (double)view[2]);
            const skv_rays rays = {view, 0, NULL, 0};
            const skv_sky sky = {radiance, 0, through, 0};
            if (fabs(zenith - tangent * DEGREE) < 1e-6)
                continue;
            must(skv_radiance(&frame, 1, &rays, &sky), "skv_radiance");
            const int want = zenith > tangent * DEGREE;
            if ((radiance[0] > 0) != want)
                fail_msg("observer %g, ground %g: zenith angle %.9g, tangent %.9g deg: ground %d, want %d", (double)h,
                         (double)grounds[n / 10], zenith / DEGREE, tangent, radiance[0] > 0, want);
            check_near("transmittance without air", (double)through[1], 1, 0);
        }
    }
}

// A horizontal ray at altitude 0 is a sky ray (mu = 0 exactly), one ulp below it meets the ground at once.
static void level_ray_on_the_ground_sees_the_sky(void **state) {
    air a;
    skv_frame frame;
    const skv_quality q = quality_of(SKV_GAUSS_EXP, SKV_DEPTH_BY_CHAPMAN, 8, 1);
    const float sun[3] = {0, -0.8f, 0.6f}, view[2][3] = {{0, -1, 0}, {0, -1, -1e-7f}};
    float radiance[2][4], through[2][4];
    ref_answer truth;
    (void)state;
    air_make(&a, "clear", air_clear(4), 0);
    frame_of(&frame, &a, &q, 0, sun);
    const skv_rays rays = {view[0], 0, NULL, 0};
    const skv_sky sky = {radiance[0], 0, through[0], 0};
    must(skv_radiance(&frame, 2, &rays, &sky), "skv_radiance");
    truth_of(&a, 0, view[0], sun, INFINITY, 0, &truth);
    check_near("level ray", (double)radiance[0][0], truth.radiance[0], 3e-3 * truth.radiance[0]);
    check_near("down ray, radiance", (double)radiance[1][0], 0, 0);
    check_near("down ray, transmittance", (double)through[1][0], 1, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(path_lengths), cmocka_unit_test(stable_forms),
                                       cmocka_unit_test(horizon_hit_or_miss),
                                       cmocka_unit_test(level_ray_on_the_ground_sees_the_sky)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
