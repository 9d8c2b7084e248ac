/// Water: Fresnel, mirror geometry, rough seas and glitter against double, by other formulas and by integration.
#include "scene_sky.h"

#include "skyvert/water.h"

/// By Snell's law and the two polarisations.
static double fresnel(double c, double n) {
    const double s = sqrt(fmax(1 - c * c, 0)) / n, t = sqrt(1 - s * s);
    const double rs = (c - n * t) / (c + n * t), rp = (n * c - t) / (n * c + t);
    return (rs * rs + rp * rp) / 2;
}

static void fresnel_is_exact(void **state) {
    (void)state;
    double worst = 0, schlick = 0, mean = 0, at = 0;
    const int steps = CASES(20000);
    for (int i = 0; i <= steps; i++) {
        const float c = (float)i / (float)steps;
        const double want = fresnel((double)c, 1.333);
        worst = fmax(worst, fabs((double)skv_fresnel(c, 1.333f) - want));
        const double off = fabs((double)skv_fresnel_schlick(c, 1.333f) - want);
        mean += off / steps;
        at = off > schlick ? (double)c : at;
        schlick = fmax(schlick, off);
        check_near("Fresnel", (double)skv_fresnel(c, 1.333f), want, 2e-6);
    }
    print_message("figure: Fresnel, n = 1.333: exact call within %.1e; Schlick within %.4f (at %.1f deg), mean %.4f\n",
                  worst, schlick, acos(at) * 180 / PI, mean);
    for (int i = 0; i < CASES(1000); i++) {
        const double c = random_in(0, 1), n = random_in(1.001, 5);
        check_near("Fresnel", (double)skv_fresnel((float)c, (float)n), fresnel((double)(float)c, (double)(float)n),
                   4e-6);
    }
    assert_true(skv_fresnel(0, 1.333f) == 1.0f && skv_fresnel(1, 1) == 0.0f);
    random_state = 71;
    for (int i = 0; i < CASES(50000); i++) {
        const float a = skv_fresnel(odd_float(i), odd_float(i + 1)),
                    b = skv_fresnel_schlick(odd_float(i), odd_float(i + 1));
        assert_true(a >= 0 && a <= 1 && b >= 0 && b <= 1);
    }
}

static skv_water_hit hit_of(const skv_water *water, const skv_frame *frame, const float v[3]) {
    skv_water_hit hit;
    const skv_rays rays = {.direction_enu = v};
    assert_int_equal(skv_water_mirror(water, frame, 1, &rays, &hit), SKV_OK);
    return hit;
}

/// The mirrored ray from the sphere itself: intersection and normal in double, in Earth-centred axes.
static void mirror_is_the_spheres(void **state) {
    (void)state;
    skv_water water;
    assert_int_equal(skv_water_flat(&water), SKV_OK);
    const double radius = 6371, height[] = {0.002, 0.1, 1, 12, 100, 400, 2000};
    double worst = 0;
    random_state = 72;
    for (int i = 0; i < CASES(7000); i++) {
        const double h = height[i % 7];
        const skv_frame frame = frame_at(earth(), (float)h, NULL);
        const double horizon = acos(radius / (radius + h)), below = pow(random_in(0, 1), 3);
        const double zenith = PI / 2 + horizon + 1e-5 + below * (PI / 2 - horizon - 1e-5),
                     azimuth = random_in(0, 2 * PI);
        float v[3];
        unit_of(zenith, azimuth, v);
        const double d[3] = {(double)v[0], (double)v[1], (double)v[2]}, r = radius + (double)(float)h;
        const double rm = r * d[2], root2 = rm * rm - (r * r - radius * radius);
        if (root2 < 1) // within some metres of the horizon the float direction decides
            continue;
        const skv_water_hit hit = hit_of(&water, &frame, v);
        const double s = -rm - sqrt(root2);
        const double n[3] = {s * d[0] / radius, s * d[1] / radius, (r + s * d[2]) / radius};
        const double vn = d[0] * n[0] + d[1] * n[1] + d[2] * n[2];
        double error = 0;
        for (int k = 0; k < 3; k++)
            error = fmax(error, fabs((double)hit.mirror_enu[k] - (d[k] - 2 * vn * n[k])));
        worst = fmax(worst, error);
        // Where the ray grazes, the sine of its angle is a root of a difference: 1e-7/sqrt.
        check_at_most("mirror", error, 4e-6 + 3e-7 / -vn);
        check_near("local up", (double)hit.local_enu[2], -vn, 2e-6 + 3e-7 / -vn);
        check_near("cosine", (double)hit.cos_incidence, -vn, 2e-6 + 3e-7 / -vn);
        check_near("distance", (double)hit.distance_km, s, 1e-6 * s * (1 + 1 / (vn * vn)) + 1e-6 * h);
        check_near("reflectance", (double)hit.reflectance, fresnel(-vn, 1.333), 2e-6 + 3e-6 / -vn);
        const double level = sqrt(d[0] * d[0] + d[1] * d[1]);
        if (level > 0.01) { // the azimuth is carried along
            const double cross = (double)hit.local_enu[0] * d[1] - (double)hit.local_enu[1] * d[0];
            check_near("azimuth", cross / level, 0, 2e-6);
        }
    }
    print_message("figure: mirror direction from 2 m to 2000 km: largest error %.1e\n", worst);
}

/// Mean over the slopes that face the viewer, both ways, by double sums.
static double rough(double mu, double along, double across, double n, double *tilt, double *area) {
    const double s = sqrt(1 - mu * mu), sa = sqrt(along), sc = sqrt(across), step = SMALL_TARGET ? 0.2 : 0.05;
    double sum = 0, whole = 0, lean = 0;
    for (double a = -6 + step / 2; a < 6; a += step)
        for (double b = -6 + step / 2; b < 6; b += step) {
            const double x = a * sa, y = b * sc, facing = mu + x * s; // slope toward the viewer
            if (facing <= 0)
                continue;
            const double w = facing * exp(-(a * a + b * b) / 2);
            sum += w * fresnel(facing / sqrt(1 + x * x + y * y), n);
            whole += w;
            lean += w * x;
        }
    *tilt = lean / whole;
    *area = whole * step * step / (2 * PI);
    return sum / whole;
}

static double bruneton(double mu, double sigma2) {
    const double s = sqrt(sigma2);
    return 0.02 + 0.98 * pow(1 - mu, 5 * exp(-2.69 * s)) / (1 + 22.7 * pow(s, 1.5));
}

static void rough_sea_is_the_mean_over_slopes(void **state) {
    (void)state;
    const float wind[] = {0, 2, 5, 10, 20, 40};
    double worst = 0, worst_tilt = 0, other = 0;
    const skv_frame frame = frame_at(earth(), 0.0f, NULL);
    for (int w = 0; w < 6; w += SMALL_TARGET ? 5 : 1)
        for (int side = 0; side < 2; side++)
            for (double deg = 0.05; deg <= 90; deg = deg * (SMALL_TARGET ? 4 : 1.4) + 0.05) {
                skv_water water;
                float v[3];
                double tilt, area;
                assert_int_equal(skv_water_wind(&water, wind[w], side ? 0.0f : 90.0f), SKV_OK);
                unit_of((90 + deg) * PI / 180, 0, v); // north
                const skv_water_hit hit = hit_of(&water, &frame, v);
                const double along = side ? (double)water.slope2_along : (double)water.slope2_across;
                const double across = side ? (double)water.slope2_across : (double)water.slope2_along;
                const double mu = -(double)v[2], want = rough(mu, along, across, 1.333, &tilt, &area);
                worst = fmax(worst, fabs((double)hit.reflectance - want));
                other = fmax(other, fabs(bruneton(mu, (along + across) / 2) - want));
                check_near("mean reflectance", (double)hit.reflectance, want, 5e-3);
                // Mirrored in the mean facet.
                const double s = sqrt(1 - mu * mu), f = 2 * (mu + tilt * s) / (1 + tilt * tilt);
                worst_tilt = fmax(worst_tilt, fabs((double)hit.local_enu[2] - (f - mu)));
                check_near("mirror's elevation", (double)hit.local_enu[2], f - mu, 2e-3);
            }
    print_message(
        "figure: rough sea, wind 0 to 40 m/s, from the horizon to below: mean reflectance within %.4f of double "
        "integration, the mirror's sine within %.4f; Bruneton's formula %.3f\n",
        worst, worst_tilt, other);
}

/// A fine sweep over the horizon: no jump, no flicker, the rough sea darker than the mirror there.
static void horizon_is_steady(void **state) {
    (void)state;
    const float height[] = {0.002f, 0.1f, 3.0f, 12.0f, 400.0f};
    for (int i = 0; i < 5; i++)
        for (int w = 0; w < 3; w++) {
            const skv_frame frame = frame_at(earth(), height[i], NULL);
            const double dip = acos(6371 / (6371 + (double)height[i]));
            skv_water water;
            assert_int_equal(skv_water_wind(&water, 5.0f * (float)w, 30.0f), SKV_OK);
            double last = -1, last_up = 0;
            for (int k = 0; k < 3000; k++) {
                float v[3];
                unit_of(PI / 2 + dip + 1e-7 * pow(k, 1.7) - 3e-6, 0.7, v);
                const skv_water_hit hit = hit_of(&water, &frame, v);
                if (hit.reflectance == 0)
                    continue;
                assert_true(hit.local_enu[2] > 0 && hit.reflectance < 1);
                // Steps of 1e-7 to 5e-5 rad: F and the mirror move by less than .004 where the horizon's root is steep.
                if (last >= 0) {
                    check_near("reflectance from step to step", (double)hit.reflectance, last, 0.006);
                    check_near("mirror from step to step", (double)hit.local_enu[2], last_up, 0.006);
                }
                last = (double)hit.reflectance;
                last_up = (double)hit.local_enu[2];
            }
            assert_true(last > 0);
        }
    const skv_frame frame = frame_at(earth(), 0.01f, NULL);
    skv_water water;
    float v[3];
    for (int w = 0; w < 3; w++) {
        assert_int_equal(skv_water_wind(&water, 5.0f * (float)w, 30.0f), SKV_OK);
        unit_of(PI / 2 + acos(6371 / 6371.01) + 2e-6, 0.7, v);
        const skv_water_hit hit = hit_of(&water, &frame, v);
        print_message("figure: the sea at the horizon, wind %d m/s: reflectance %.2f, mirrors the sky %.0f deg up\n",
                      5 * w, (double)hit.reflectance, asin((double)hit.local_enu[2]) * 180 / PI);
    }
}

static double glint_of(const skv_water *water, const skv_frame *frame, const float v[3]) {
    float radiance[4] = {0, 0, 0, 0};
    const skv_rays rays = {.direction_enu = v};
    const skv_sky sky = {.radiance = radiance};
    assert_int_equal(skv_water_glint(water, frame, 0, NULL, 1, &rays, &sky), SKV_OK);
    return (double)radiance[1];
}

/// [Cox54] as printed: L = E F p/(4 cos^4(tilt) cos(view)), isotropic, high above the horizon.
static void glint_is_cox_and_munks(void **state) {
    (void)state;
    skv_light light = {{0, 0, 0}, {1, 1, 1, 1}};
    double worst = 0;
    random_state = 73;
    for (int i = 0; i < CASES(20000); i++) {
        const double sun = random_in(0, 60) * PI / 180, view = random_in(0, 60) * PI / 180, turn = random_in(0, 2 * PI);
        const double s2 = random_in(0.01, 0.03), wind = random_in(0, 360);
        const double ratio = random_in(0.5, 1), va = s2 * ratio, vc = s2 * (1 - ratio) + 0.003;
        unit_of(sun, 0.4, light.direction_enu);
        const skv_frame frame = frame_at(earth(), 0.0f, &light);
        const skv_water water = {1.333f, (float)va, (float)vc, (float)wind};
        float v[3];
        unit_of(PI - view, turn, v);
        const double l[3] = {(double)light.direction_enu[0], (double)light.direction_enu[1],
                             (double)light.direction_enu[2]};
        const double h[3] = {l[0] - (double)v[0], l[1] - (double)v[1], l[2] - (double)v[2]};
        const double zx = h[0] / h[2], zy = h[1] / h[2], a = wind * PI / 180;
        const double along = zx * sin(a) + zy * cos(a), across = zx * cos(a) - zy * sin(a);
        const double p = exp(-(along * along / va + across * across / vc) / 2) / (2 * PI * sqrt(va * vc));
        const double half = sqrt(h[0] * h[0] + h[1] * h[1] + h[2] * h[2]) / 2, sec2 = 1 + zx * zx + zy * zy;
        const double want = fresnel(half, 1.333) * p * sec2 * sec2 / (4 * cos(view)), got = glint_of(&water, &frame, v);
        if (want < 1e-6)
            continue;
        worst = fmax(worst, fabs(got / want - 1));
        // Shadowing takes up to .1 % of it at 60 deg and slopes of 10 deg; the exponent of the density rounds.
        check_near("glint", got, want, 0.015 * want);
    }
    print_message("figure: glint against Cox and Munk's formula, sun and view within 60 deg of the zenith: %.4f\n",
                  worst);
}

/// Light that is reflected: over all directions of view, no more than falls in, and what the facets reflect of it.
static void glint_keeps_the_energy(void **state) {
    (void)state;
    const int steps = SMALL_TARGET ? 40 : 300;
    for (double deg = 2; deg < 90; deg *= 1.8)
        for (int w = 0; w < 3; w++) {
            skv_light light = {{0, 0, 0}, {1, 1, 1, 1}};
            unit_of((90 - deg) * PI / 180, 0, light.direction_enu);
            const skv_frame frame = frame_at(earth(), 0.0f, &light);
            skv_water water;
            assert_int_equal(skv_water_wind(&water, 4.0f + 6.0f * (float)w, 20.0f), SKV_OK);
            double sum = 0, tilt, area;
            for (int i = 0; i < steps; i++)
                for (int k = 0; k < steps; k++) {
                    const double mu = (i + 0.5) / steps, phi = 2 * PI * (k + 0.5) / steps;
                    float v[3];
                    unit_of(PI - acos(mu), phi, v);
                    sum += glint_of(&water, &frame, v) * mu * 2 * PI / steps / steps;
                }
            const double falls = sin(deg * PI / 180);
            const double s2 = (double)(water.slope2_along + water.slope2_across) / 2;
            const double want = rough(falls, s2, s2, 1.333, &tilt, &area);
            if (w == 1)
                print_message(
                    "figure: glint over all directions, wind 10 m/s, sun %.1f deg up: %.4f of the light, the facets' "
                    "mean reflectance %.4f\n",
                    deg, sum / falls, want);
            // Never more than the facets reflect; less by what leaves downward to meet another wave, which is not
            // followed.
            assert_true(sum <= (SMALL_TARGET ? 1.2 : 1.02) * want * falls);
            if (!SMALL_TARGET)
                assert_true(sum >= 0.6 * want * falls);
            if (deg > (w ? 60 : 30) && !SMALL_TARGET)
                check_near("reflected light", sum / falls, want, 0.02 * want);
        }
}

static void glint_is_steady_at_the_horizon(void **state) {
    (void)state;
    skv_light light = {{0, 1, 0.03f}, {1, 1, 1, 1}};
    double most = 0;
    for (int up = 0; up < 4; up++) {
        const float elevation[] = {0.5f, 0.03f, 0.001f, -0.01f};
        light.direction_enu[2] = elevation[up];
        const skv_frame frame = frame_at(earth(), 0.1f, &light);
        skv_water water;
        assert_int_equal(skv_water_wind(&water, 5, 45), SKV_OK);
        const double dip = acos(6371 / 6371.1);
        double last = -1;
        for (int k = 0; k < 2000; k++) {
            float v[3];
            unit_of(PI / 2 + dip + 2e-6 + 1e-7 * k * k / 40.0, 0, v);
            const double got = glint_of(&water, &frame, v);
            // Never more than a mirror would show of the sun, 1/(pi radius^2).
            assert_true(got >= 0 && got < 14800);
            if (last >= 0)
                check_near("glint from step to step", got, last, 0.05 * fmax(last, 0.05));
            last = got;
            most = fmax(most, got);
        }
    }
    print_message("figure: glint at the horizon, brightest %.1f per sr of the irradiance\n", most);
}

static void add_is_the_product(void **state) {
    (void)state;
    const skv_frame frame = frame_at(earth(), 1.0f, NULL);
    const skv_water_hit hits[3] = {
        {{0, 0, 1}, {0, 0, 1}, 1, 1, 0.25f}, {{0, 0, 1}, {0, 0, 1}, 1, 1, 1}, {{0, 0, 1}, {0, 0, 1}, 0, 1, 0}};
    const float from[3][5] = {{1, 2, 3, 4, 9}, {-1, NAN, INFINITY, 1, 9}, {7, 7, 7, 7, 9}},
                t[3][4] = {{1, 0.5f, 1, 1}, {1, 1, 1, 1}, {1, 1, 1, 1}};
    float radiance[3][4] = {{1, 1, 1, 1}, {1, 1, 1, 1}, {1, 1, 1, 1}}, through[3][4];
    memcpy(through, t, sizeof t);
    const skv_sky sky = {radiance[0], 0, through[0], 0};
    assert_int_equal(skv_water_add(&frame, 3, hits, from[0], sizeof from[0], &sky), SKV_OK);
    assert_true(radiance[0][0] == 1.25f && radiance[0][1] == 1.25f && radiance[0][2] == 1.75f && radiance[0][3] == 2);
    assert_true(radiance[1][0] == 1 && radiance[1][1] == 1 && radiance[1][2] <= SKV_RADIANCE_MAX &&
                radiance[1][3] == 2);
    assert_true(radiance[2][0] == 1 && radiance[2][3] == 1);
    assert_int_equal(skv_water_add(NULL, 3, hits, from[0], 0, &sky), SKV_ERR_NULL);
    assert_int_equal(skv_water_add(&frame, 3, NULL, from[0], 0, &sky), SKV_ERR_NULL);
    assert_int_equal(skv_water_add(&frame, 3, hits, NULL, 0, &sky), SKV_ERR_NULL);
    assert_int_equal(skv_water_add(&frame, 3, hits, from[0], 7, &sky), SKV_ERR_SIZE);
}

static void statuses_and_any_float(void **state) {
    (void)state;
    skv_light light = {{0, 1, 1}, {1, 1, 1, 1}};
    const skv_frame frame = frame_at(earth(), 1.0f, &light);
    skv_water water;
    assert_int_equal(skv_water_flat(NULL), SKV_ERR_NULL);
    assert_int_equal(skv_water_wind(NULL, 1, 0), SKV_ERR_NULL);
    const float bad_wind[] = {-1, 41, NAN, INFINITY}, bad_azimuth[] = {361, -361, NAN, INFINITY};
    for (int i = 0; i < 4; i++) {
        assert_int_equal(skv_water_wind(&water, bad_wind[i], 0), SKV_ERR_RANGE);
        assert_int_equal(skv_water_wind(&water, 1, bad_azimuth[i]), SKV_ERR_RANGE);
    }
    assert_int_equal(skv_water_wind(&water, 5, 0), SKV_OK);
    const float down[2][3] = {{0, 1, -1}, {0, NAN, 0}}, bad_share[4] = {1, 1, 1.1f, 1};
    float radiance[2][4] = {{1, 1, 1, 1}, {1, 1, 1, 1}};
    skv_water_hit hits[2];
    const skv_rays rays = {.direction_enu = down[0]};
    const skv_sky sky = {.radiance = radiance[0]};
    assert_int_equal(skv_water_mirror(NULL, &frame, 1, &rays, hits), SKV_ERR_NULL);
    assert_int_equal(skv_water_mirror(&water, NULL, 1, &rays, hits), SKV_ERR_NULL);
    assert_int_equal(skv_water_mirror(&water, &frame, 1, NULL, hits), SKV_ERR_NULL);
    assert_int_equal(skv_water_mirror(&water, &frame, 1, &rays, NULL), SKV_ERR_NULL);
    assert_int_equal(skv_water_mirror(&water, &frame, 2, &rays, hits), SKV_ERR_DIRECTION);
    assert_true(hits[0].reflectance > 0 && hits[1].reflectance == 0 && hits[1].local_enu[2] == 1);
    assert_int_equal(skv_water_glint(&water, &frame, 1, NULL, 1, &rays, &sky), SKV_ERR_RANGE);
    assert_int_equal(skv_water_glint(&water, &frame, -1, NULL, 1, &rays, &sky), SKV_ERR_RANGE);
    assert_int_equal(skv_water_glint(&water, &frame, 0, bad_share, 1, &rays, &sky), SKV_ERR_RANGE);
    assert_int_equal(skv_water_glint(&water, &frame, 0, NULL, 2, &rays, &sky), SKV_ERR_DIRECTION);
    assert_int_equal(skv_water_glint(&water, &frame, 0, NULL, 1, &rays, NULL), SKV_ERR_NULL);
    assert_true(radiance[1][0] == 1);
    water.refractive_index = NAN;
    assert_int_equal(skv_water_mirror(&water, &frame, 1, &rays, hits), SKV_ERR_RANGE);
    assert_int_equal(skv_water_glint(&water, &frame, 0, NULL, 1, &rays, &sky), SKV_ERR_RANGE);
    random_state = 74;
    for (int i = 0; i < CASES(50000); i++) {
        const float heights[] = {0.0f, 1e-3f, 0.5f, 12.0f, 400.0f, 4e4f, 1e6f};
        float v[3], length = fabsf(odd_float(i));
        for (int k = 0; k < 3; k++) {
            v[k] = odd_float(i + k);
            light.direction_enu[k] = (float)random_in(-1, 1);
        }
        if (i % 2)
            v[2] = -fabsf(v[2]);
        const skv_frame at = frame_at(earth(), heights[i % 7], &light);
        const skv_water any = {(float)random_in(1.01, 3), i % 5 ? (float)random_in(0, 0.25) : 0,
                               i % 3 ? (float)random_in(0, 0.25) : 0, (float)random_in(-360, 360)};
        const skv_rays ray = {v, 0, i % 3 ? &length : NULL, 0};
        radiance[0][0] = odd_float(i);
        radiance[0][1] = 1;
        const skv_status one = skv_water_mirror(&any, &at, 1, &ray, hits),
                         two = skv_water_glint(&any, &at, 0, NULL, 1, &ray, &sky);
        assert_true((one == SKV_OK || one == SKV_ERR_DIRECTION) && one == two);
        const float *const m = hits[0].local_enu, *const o = hits[0].mirror_enu;
        assert_true(m[2] > 0 && hits[0].reflectance >= 0 && hits[0].reflectance <= 1 && hits[0].distance_km >= 0);
        check_near("unit", (double)(m[0] * m[0] + m[1] * m[1] + m[2] * m[2]), 1, 1e-5);
        check_near("unit", (double)(o[0] * o[0] + o[1] * o[1] + o[2] * o[2]), 1, 1e-5);
        assert_true(radiance[0][1] >= 1 && radiance[0][1] <= SKV_RADIANCE_MAX);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fresnel_is_exact),
        cmocka_unit_test(mirror_is_the_spheres),
        cmocka_unit_test(rough_sea_is_the_mean_over_slopes),
        cmocka_unit_test(horizon_is_steady),
        cmocka_unit_test(glint_is_cox_and_munks),
        cmocka_unit_test(glint_keeps_the_energy),
        cmocka_unit_test(glint_is_steady_at_the_horizon),
        cmocka_unit_test(add_is_the_product),
        cmocka_unit_test(statuses_and_any_float),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
