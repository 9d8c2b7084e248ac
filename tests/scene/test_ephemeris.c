/// Sun and moon against ERFA, continuity, and floating-point environments of a host.
#include <fenv.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#if defined(__SSE__)
#include <xmmintrin.h>
#endif

#include "api/sun_vectors.h"
#include "check.h"
#include "erfa_oracle.h"
#include "skyvert/sun.h"

#define DEG 57.295779513082321

static uint64_t seed;

/// xorshift64*, [0, 1)
static double uniform(double low, double high) {
    seed ^= seed >> 12;
    seed ^= seed << 25;
    seed ^= seed >> 27;
    return low + (high - low) * ((double)((seed * UINT64_C(2685821657736338717)) >> 11) * 0x1p-53);
}

typedef struct worst {
    double max, squares;
} worst;

static void note(worst *w, double error) {
    w->max = error > w->max ? error : w->max;
    w->squares += error * error;
}

static double direction_error(const float got[3], const double want[3]) {
    const double g[3] = {(double)got[0], (double)got[1], (double)got[2]};
    return oracle_angle(g, want) * DEG;
}

/// Every fiftieth at a pole, else even on the sphere.
static skv_position random_place(int i) {
    const double lat = i % 50 == 0 ? 90.0 : i % 50 == 1 ? -90.0 : asin(uniform(-1, 1)) * DEG;
    return (skv_position){(float)lat, (float)uniform(-360, 360), (float)uniform(-0.4, 20)};
}

typedef struct errors {
    worst sun, moon, au, km, phase;
} errors;

static errors measure(int n, int first_day, int last_day) {
    errors e;
    memset(&e, 0, sizeof e);
    for (int i = 0; i < n; i++) {
        const skv_utc utc = {(int32_t)uniform(first_day, last_day + 1), (float)uniform(0, 86399.9)};
        const skv_position p = random_place(i);
        skv_sun sun;
        skv_moon moon;
        assert_int_equal(skv_sun_at(&sun, &utc, &p), SKV_OK);
        assert_int_equal(skv_moon_at(&moon, &utc, &p), SKV_OK);
        const oracle_sky want = oracle_at(&utc, &p);
        note(&e.sun, direction_error(sun.direction_enu, want.sun.enu));
        note(&e.moon, direction_error(moon.direction_enu, want.moon.enu));
        note(&e.au, fabs((double)sun.distance_au - want.sun.distance_km / 149597870.7));
        note(&e.km, fabs((double)moon.distance_km - want.moon.distance_km));
        note(&e.phase, fabs((double)moon.phase_angle_deg - want.phase_angle_rad * DEG));
        check_near("lit", (double)moon.illuminated_fraction, 0.5 + 0.5 * cos(want.phase_angle_rad), 0.0002);
    }
    e.sun.squares = sqrt(e.sun.squares / n);
    e.moon.squares = sqrt(e.moon.squares / n);
    return e;
}

static void report(const char *when, const errors *e) {
    print_message("figure: sun against ERFA, %s: max %.5f deg, rms %.5f deg, distance %.1e au\n", when, e->sun.max,
                  e->sun.squares, e->au.max);
    print_message("figure: moon against ERFA, %s: max %.4f deg, rms %.4f deg, distance %.0f km, phase angle %.4f deg\n",
                  when, e->moon.max, e->moon.squares, e->km.max, e->phase.max);
}

/// The bounds are those of include/skyvert/sun.h.
static void accuracy_2020_2050(void **state) {
    (void)state;
    seed = 20201;
    const errors e = measure(20000, 7305, 18627);
    report("20,000 times and places 2020-2050", &e);
    check_at_most("sun, deg", e.sun.max, 0.001);
    check_at_most("moon, deg", e.moon.max, 0.010);
    check_at_most("sun, au", e.au.max, 3e-5);
    check_at_most("moon, km", e.km.max, 40);
    check_at_most("phase angle, deg", e.phase.max, 0.015);
}

/// ERFA has no TAI before 1960; its TT is then 37 s behind ours, 0.006 deg of the moon.
static void accuracy_1900_2100(void **state) {
    (void)state;
    seed = 1900;
    const errors e = measure(3000, -36524, 36889);
    report("3,000 times and places 1900-2100", &e);
    check_at_most("sun, deg", e.sun.max, 0.001);
    check_at_most("moon, deg", e.moon.max, 0.015);
}

/// Parallax far from the ground: to the geostationary orbit and half way to the moon.
static void accuracy_in_orbit(void **state) {
    (void)state;
    seed = 36;
    worst sun = {0, 0}, moon = {0, 0};
    for (int i = 0; i < 1000; i++) {
        const skv_utc utc = {(int32_t)uniform(7305, 18627), (float)uniform(0, 86399.9)};
        skv_position p = random_place(i);
        p.height_km = (float)(i & 1 ? uniform(400, 36000) : uniform(36000, 190000));
        skv_sun s;
        skv_moon m;
        assert_int_equal(skv_sun_at(&s, &utc, &p), SKV_OK);
        assert_int_equal(skv_moon_at(&m, &utc, &p), SKV_OK);
        const oracle_sky want = oracle_at(&utc, &p);
        note(&sun, direction_error(s.direction_enu, want.sun.enu));
        note(&moon, direction_error(m.direction_enu, want.moon.enu));
    }
    print_message("figure: from 400 to 190,000 km up: sun max %.5f deg, moon max %.4f deg\n", sun.max, moon.max);
    // ERFA moves the observer with the Earth's turning (aberration by up to 14 km/s, 0.0027 deg), this code with the
    // ground's. The moon is up to twice as near as from the ground, and so is its error.
    check_at_most("sun, deg", sun.max, 0.004);
    check_at_most("moon, deg", moon.max, 0.025);
}

static void vectors_are_erfas(void **state) {
    (void)state;
    for (int i = 0; i < SUN_VECTORS; i++) {
        const sun_vector *v = &sun_vectors[i];
        const oracle_sky sky = oracle_at(&v->utc, &v->position);
        // Printed with nine decimals, 1e-7 deg; other versions of ERFA differ by less than 1e-6 deg.
        check_at_most("sun row, deg", oracle_angle(v->sun_enu, sky.sun.enu) * DEG, 2e-6);
        check_at_most("moon row, deg", oracle_angle(v->moon_enu, sky.moon.enu) * DEG, 2e-6);
        check_near("moon row, km", v->moon_km, sky.moon.distance_km, 0.1);
        check_near("phase row", v->phase_angle_deg, sky.phase_angle_rad * DEG, 1e-5);
    }
}

typedef struct bodies {
    float v[6];
} bodies;

static bodies bodies_at(int32_t day, float seconds, const skv_position *p) {
    skv_sun s;
    skv_moon m;
    const skv_utc utc = {day, seconds};
    assert_int_equal(skv_sun_at(&s, &utc, p), SKV_OK);
    assert_int_equal(skv_moon_at(&m, &utc, p), SKV_OK);
    bodies b;
    memcpy(b.v, s.direction_enu, sizeof s.direction_enu);
    memcpy(b.v + 3, m.direction_enu, sizeof m.direction_enu);
    return b;
}

/// The last second of the day, the leap second's place and the next day are one line, and so is an hour of seconds. The
/// curve bends by 5e-9 a second squared; the rest is rounding: a component below 1 is the end of some ten roundings of
/// 6e-8, and a second difference weighs three of them 1, 2, 1.
static void steps_are_even(void **state) {
    (void)state;
    const skv_position p = {47.0f, 8.5f, 0.5f};
    double jitter = 0, midnight = 0;
    bodies a = bodies_at(8000, 84600.0f, &p), b = bodies_at(8000, 84601.0f, &p);
    for (int i = 2; i < 3600; i++) {
        const int s = 84600 + i;
        const bodies c = bodies_at(s < 86400 ? 8000 : 8001, (float)(s < 86400 ? s : s - 86400), &p);
        for (int k = 0; k < 6; k++)
            jitter = fmax(jitter, fabs((double)a.v[k] - 2 * (double)b.v[k] + (double)c.v[k]));
        a = b;
        b = c;
    }
    for (int day = 7000; day < 8000; day++) {
        const bodies end = bodies_at(day, 86400.0f, &p), start = bodies_at(day + 1, 0.0f, &p);
        for (int k = 0; k < 6; k++)
            midnight = fmax(midnight, fabs((double)end.v[k] - (double)start.v[k]));
    }
    print_message("figure: steps of 1 s over midnight: jitter %.1e of a unit vector (%.6f deg); 24:00 against 0:00: "
                  "%.1e\n",
                  jitter, jitter * DEG, midnight);
    check_at_most("jitter", jitter, 1e-6);
    check_at_most("midnight", midnight, 3e-7);
}

static float any_float(void) {
    const double kind = uniform(0, 8);
    if (kind < 2) {
        const uint32_t bits = (uint32_t)uniform(0, 4294967296.0);
        float f;
        memcpy(&f, &bits, sizeof f);
        return f;
    }
    static const float corners[] = {0.0f,   -0.0f,      90.0f,  -90.0f,         360.0f,    -360.0f,        180.0f,
                                    1e-45f, -1e-45f,    1e-38f, 86399.9921875f, 86400.0f,  86400.9921875f, 86401.0f,
                                    -12.0f, 1000000.0f, NAN,    INFINITY,       -INFINITY, 384400.0f};
    return kind < 4 ? corners[(int)uniform(0, sizeof corners / sizeof corners[0])] : (float)uniform(-400, 400);
}

static int is_sound(const skv_sun *s, const skv_moon *m) {
    float length[2] = {0, 0};
    for (int k = 0; k < 3; k++) {
        length[0] += s->direction_enu[k] * s->direction_enu[k];
        length[1] += m->direction_enu[k] * m->direction_enu[k];
    }
    return fabsf(length[0] - 1) < 1e-6f && fabsf(length[1] - 1) < 1e-6f && s->azimuth_deg >= 0 &&
           s->azimuth_deg < 360 && m->azimuth_deg >= 0 && m->azimuth_deg < 360 && fabsf(s->elevation_deg) <= 90 &&
           fabsf(m->elevation_deg) <= 90 && s->distance_au > 0.97f && s->distance_au < 1.03f && m->distance_km > 1737 &&
           m->distance_km < 1.5e6f && m->phase_angle_deg >= 0 && m->phase_angle_deg <= 180 &&
           m->illuminated_fraction >= 0 && m->illuminated_fraction <= 1;
}

/// Anything in: either an error and nothing written, or every output finite and in its range.
static int one_extreme(void) {
    static const int32_t days[] = {-36526, -36525, -1, 0, 1, 36890, 36891, INT32_MAX, INT32_MIN};
    const int32_t odd = days[(int)uniform(0, sizeof days / sizeof days[0])];
    const skv_utc utc = {uniform(0, 4) < 3 ? (int32_t)uniform(-36525, 36890) : odd,
                         uniform(0, 4) < 3 ? (float)uniform(0, 86400) : any_float()};
    const skv_position p = {any_float(), any_float(), uniform(0, 4) < 2 ? (float)uniform(-12, 9) : any_float()};
    skv_sun sun, sun_before;
    skv_moon moon, moon_before;
    memset(&sun_before, 0x5a, sizeof sun_before);
    memset(&moon_before, 0x5a, sizeof moon_before);
    sun = sun_before;
    moon = moon_before;
    const skv_status status = skv_sun_at(&sun, &utc, &p), moon_status = skv_moon_at(&moon, &utc, &p);
    const float r = skv_refraction_deg(any_float(), any_float(), any_float());
    const int kept[2] = {memcmp(&sun, &sun_before, sizeof sun) == 0, memcmp(&moon, &moon_before, sizeof moon) == 0};
    const int refused = status == SKV_ERR_RANGE && moon_status == SKV_ERR_RANGE && kept[0] && kept[1];
    const int in_moon = status == SKV_OK && moon_status == SKV_ERR_RANGE && kept[1] && p.height_km > 3e5f;
    const int ok = status == SKV_OK && moon_status == SKV_OK;
    const int right = ok ? is_sound(&sun, &moon) : refused || in_moon;
    if (!right || !(r >= 0 && r < 3))
        fail_msg("day %d, %a s, at %a, %a, %a: status %d, %d", (int)utc.day, (double)utc.seconds, (double)p.lat_deg,
                 (double)p.lon_deg, (double)p.height_km, (int)status, (int)moon_status);
    return ok;
}

static void extremes(void **state) {
    (void)state;
    seed = 99;
    int good = 0;
    for (int i = 0; i < 1000000; i++)
        good += one_extreme();
    print_message("figure: 1,000,000 extreme inputs, %d of them valid: all outputs finite and in range\n", good);
}

/// The host's rounding may be anything. The sine's own reduction then ends up to an octant away from its best range.
static void rounding_modes(void **state) {
    (void)state;
    static const int modes[] = {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};
    double max[2] = {0, 0};
    for (int i = 0; i < 3000; i++) {
        const skv_utc utc = {(int32_t)uniform(7305, 18627), (float)uniform(0, 86399.9)};
        const skv_position p = random_place(i);
        skv_sun sun;
        skv_moon moon;
        fesetround(modes[i % 3]);
        const skv_status status = skv_sun_at(&sun, &utc, &p), moon_status = skv_moon_at(&moon, &utc, &p);
        fesetround(FE_TONEAREST);
        assert_true(status == SKV_OK && moon_status == SKV_OK && is_sound(&sun, &moon));
        const oracle_sky want = oracle_at(&utc, &p);
        max[0] = fmax(max[0], direction_error(sun.direction_enu, want.sun.enu));
        max[1] = fmax(max[1], direction_error(moon.direction_enu, want.moon.enu));
    }
    print_message("figure: rounding up, down, to zero: sun max %.4f deg, moon max %.4f deg\n", max[0], max[1]);
    check_at_most("sun, deg", max[0], 0.004);
    check_at_most("moon, deg", max[1], 0.012);
}

/// Flush-to-zero and denormals-are-zero change nothing that is not itself below 1e-38.
static void flush_to_zero(void **state) {
    (void)state;
#if defined(__SSE__)
    seed = 7;
    for (int i = 0; i < 20000; i++) {
        const skv_position p = {i & 1 ? 1e-40f : (float)uniform(-90, 90), i & 2 ? -1e-42f : (float)uniform(-360, 360),
                                i & 4 ? 1e-45f : 0.1f};
        const int32_t day = (int32_t)uniform(-36525, 36890);
        const float seconds = i & 8 ? 1e-41f : (float)uniform(0, 86400);
        const bodies a = bodies_at(day, seconds, &p);
        const unsigned csr = _mm_getcsr();
        _mm_setcsr(csr | 0x8040u);
        const bodies b = bodies_at(day, seconds, &p);
        _mm_setcsr(csr);
        assert_true(memcmp(&a, &b, sizeof a) == 0);
    }
#else
    print_message("flush_to_zero: not an x86 host\n");
    skip();
#endif
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(accuracy_2020_2050), cmocka_unit_test(accuracy_1900_2100), cmocka_unit_test(accuracy_in_orbit),
        cmocka_unit_test(vectors_are_erfas),  cmocka_unit_test(steps_are_even),     cmocka_unit_test(extremes),
        cmocka_unit_test(rounding_modes),     cmocka_unit_test(flush_to_zero),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
