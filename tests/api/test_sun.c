/// Calendar, sun, moon and refraction against published values; portable, runs on the boards too.
///
/// [Reda04]: the example of its appendix (DOI 10.1016/j.solener.2003.12.003).
/// [Reda10]: the example of its program, the eclipse of 2009-07-22 (DOI 10.2172/974908).
/// ERFA: tests/api/sun_vectors.h.
#include <math.h>
#include <string.h>

#include "check.h"
#include "skyvert/sun.h"
#include "sun_vectors.h"

#define RAD 0.017453292519943295

/// What include/skyvert/sun.h promises for 2020-2050; DUT1 (up to 0.004 deg) was 0.36 s or less in the published cases.
#define SUN_DEG  0.001
#define MOON_DEG 0.010

#if defined(SKV_TEST_SMALL)
enum { REFRACTION_STEPS = 100 }; // per degree
#else
enum { REFRACTION_STEPS = 1000 }; // per degree
#endif

static double angle_deg(const double a[3], const double b[3]) {
    const double x = a[1] * b[2] - a[2] * b[1], y = a[2] * b[0] - a[0] * b[2], z = a[0] * b[1] - a[1] * b[0];
    return atan2(sqrt(x * x + y * y + z * z), a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) / RAD;
}

static void to_double(double out[3], const float in[3]) {
    for (int i = 0; i < 3; i++)
        out[i] = (double)in[i];
}

static void from_horizon(double out[3], double azimuth_deg, double zenith_deg) {
    out[0] = sin(azimuth_deg * RAD) * sin(zenith_deg * RAD);
    out[1] = cos(azimuth_deg * RAD) * sin(zenith_deg * RAD);
    out[2] = cos(zenith_deg * RAD);
}

static skv_utc utc_of(int y, int mo, int d, int h, int mi, float s) {
    skv_utc utc = {0, 0.0f};
    assert_int_equal(skv_utc_from_calendar(&utc, y, mo, d, h, mi, s), SKV_OK);
    return utc;
}

static skv_sun sun_of(skv_utc utc, skv_position position) {
    skv_sun sun;
    assert_int_equal(skv_sun_at(&sun, &utc, &position), SKV_OK);
    return sun;
}

static skv_moon moon_of(skv_utc utc, skv_position position) {
    skv_moon moon;
    assert_int_equal(skv_moon_at(&moon, &utc, &position), SKV_OK);
    return moon;
}

/// Days from Julian day numbers: 2000-01-01 begins at JD 2451544.5.
static void calendar_days(void **state) {
    (void)state;
    assert_int_equal(utc_of(2000, 1, 1, 0, 0, 0.0f).day, 0);
    assert_int_equal(utc_of(1900, 1, 1, 0, 0, 0.0f).day, 2415021 - 2451545);
    assert_int_equal(utc_of(1957, 10, 4, 0, 0, 0.0f).day, 2436116 - 2451545); // [Meeus98] ch. 7: 2436116.31
    assert_int_equal(utc_of(1999, 12, 31, 0, 0, 0.0f).day, -1);
    assert_int_equal(utc_of(2003, 10, 17, 0, 0, 0.0f).day, 2452930 - 2451545); // [Reda04]: 2452930.312847
    assert_int_equal(utc_of(2024, 2, 29, 0, 0, 0.0f).day, 60369 - 51544);      // modified Julian days
    assert_int_equal(utc_of(2100, 12, 31, 0, 0, 0.0f).day, 36889);
    const skv_utc utc = utc_of(2003, 10, 17, 19, 30, 30.0f);
    check_near("seconds", (double)utc.seconds, 70230.0, 0.0);
}

static void calendar_refuses(void **state) {
    (void)state;
    static const int bad[][5] = {{1899, 12, 31, 0, 0}, {2101, 1, 1, 0, 0},   {2000, 0, 1, 0, 0},  {2000, 13, 1, 0, 0},
                                 {2000, 1, 0, 0, 0},   {2000, 4, 31, 0, 0},  {2001, 2, 29, 0, 0}, {1900, 2, 29, 0, 0},
                                 {2100, 2, 29, 0, 0},  {2000, 1, 1, 24, 0},  {2000, 1, 1, -1, 0}, {2000, 1, 1, 0, 60},
                                 {2000, 1, 1, 0, -1},  {2000, -1, -1, 0, 0}, {2000, 2, 30, 0, 0}};
    skv_utc utc = {77, 7.0f};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++)
        assert_int_equal(skv_utc_from_calendar(&utc, bad[i][0], bad[i][1], bad[i][2], bad[i][3], bad[i][4], 0.0f),
                         SKV_ERR_RANGE);
    static const float seconds[] = {-1.0f, 60.0f, 61.0f, INFINITY, -INFINITY, NAN};
    for (size_t i = 0; i < sizeof seconds / sizeof seconds[0]; i++)
        assert_int_equal(skv_utc_from_calendar(&utc, 2000, 1, 1, 0, 0, seconds[i]), SKV_ERR_RANGE);
    assert_int_equal(skv_utc_from_calendar(&utc, 2000, 1, 1, 23, 59, 61.0f), SKV_ERR_RANGE);
    assert_int_equal(skv_utc_from_calendar(NULL, 2000, 1, 1, 0, 0, 0.0f), SKV_ERR_NULL);
    assert_int_equal(utc.day, 77);
    check_near("seconds kept", (double)utc.seconds, 7.0, 0.0);
}

/// A time never rolls over to the next day or into a leap second that was not asked for.
static void calendar_end_of_day(void **state) {
    (void)state;
    const skv_utc late = utc_of(2021, 6, 30, 23, 59, 59.9999f);
    assert_int_equal(late.day, utc_of(2021, 6, 30, 0, 0, 0.0f).day);
    assert_true(late.seconds < 86400.0f);
    const skv_utc leap = utc_of(2016, 12, 31, 23, 59, 60.9999f);
    assert_true(leap.seconds >= 86400.0f && leap.seconds < 86401.0f);
    skv_calendar c;
    assert_int_equal(skv_utc_to_calendar(&c, &leap), SKV_OK);
    assert_true(c.year == 2016 && c.month == 12 && c.day == 31 && c.hour == 23 && c.minute == 59);
    check_near("leap second", (double)c.second, 60.9921875, 0.0);
}

static void calendar_back(void **state) {
    (void)state;
    int year = 1900, month = 1, day = 1;
    for (int32_t d = -36524; d <= 36889; d++) {
        skv_calendar c;
        const skv_utc utc = {d, (float)((d & 0xff) * 337) + 0.5f};
        assert_int_equal(skv_utc_to_calendar(&c, &utc), SKV_OK);
        if (c.year != year || c.month != month || c.day != day)
            fail_msg("day %d: got %d-%d-%d, want %d-%d-%d", (int)d, (int)c.year, (int)c.month, (int)c.day, year, month,
                     day);
        const skv_utc again = utc_of(c.year, c.month, c.day, c.hour, c.minute, c.second);
        assert_true(again.day == d && !(again.seconds < utc.seconds) && !(again.seconds > utc.seconds));
        // The next date is the first of these that exists.
        skv_utc next;
        if (skv_utc_from_calendar(&next, year, month, ++day, 0, 0, 0.0f) != SKV_OK) {
            day = 1;
            if (++month > 12) {
                month = 1;
                year++;
            }
        }
    }
    skv_calendar c = {0, 0, 0, 0, 0, 0.0f};
    const skv_utc bad = {36891, 0.0f}, before = {-36525, 86399.0f};
    assert_int_equal(skv_utc_to_calendar(&c, &bad), SKV_ERR_RANGE);
    assert_int_equal(skv_utc_to_calendar(&c, &before), SKV_OK);
    assert_true(c.year == 1899 && c.month == 12 && c.day == 31 && c.hour == 23 && c.minute == 59);
}

/// Distance on the sphere: an azimuth alone is blown up near the zenith.
static void sun_published(void **state) {
    (void)state;
    const skv_sun a = sun_of(utc_of(2003, 10, 17, 19, 30, 30.0f), (skv_position){39.742476f, -105.1786f, 1.83014f});
    double want[3], got[3];
    from_horizon(want, 194.340241, 50.127954); // [Reda04], geometric
    to_double(got, a.direction_enu);
    check_at_most("2003-10-17, deg", angle_deg(got, want), SUN_DEG);
    const float refracted = a.elevation_deg + skv_refraction_deg(a.elevation_deg, 820.0f, 11.0f);
    check_near("2003-10-17 refracted zenith", 90.0 - (double)refracted, 50.111622, SUN_DEG);
    // Southern summer noon, the sun north of the observer.
    const skv_sun b = sun_of(utc_of(2012, 12, 22, 12, 0, 0.0f), (skv_position){-41.0f, 0.0f, 0.1f});
    check_near("2012-12-22 azimuth", (double)b.azimuth_deg, 359.08592, SUN_DEG / cos((double)b.elevation_deg * RAD));
}

/// [Reda10]: geometric places refracted by 1000 hPa, 11 C. 1 s of time is 0.004 deg of the sky for both.
static void eclipse_published(void **state) {
    (void)state;
    const skv_utc utc = utc_of(2009, 7, 22, 1, 33, 0.0f);
    const skv_position where = {24.61167f, 143.36167f, 0.0f};
    const skv_sun sun = sun_of(utc, where);
    const skv_moon moon = moon_of(utc, where);
    double got[3], want[3], to_moon[3];
    from_horizon(want, 104.387917, 14.512686);
    from_horizon(got, (double)sun.azimuth_deg,
                 90.0 - (double)(sun.elevation_deg + skv_refraction_deg(sun.elevation_deg, 1000.0f, 11.0f)));
    check_at_most("eclipse, sun, deg", angle_deg(got, want), SUN_DEG);
    from_horizon(to_moon, (double)moon.azimuth_deg,
                 90.0 - (double)(moon.elevation_deg + skv_refraction_deg(moon.elevation_deg, 1000.0f, 11.0f)));
    check_near("eclipse, sun to moon, deg", angle_deg(got, to_moon), 0.374760, MOON_DEG);
    // Its disc of 0.283341 deg; the radius it takes is 1737.9 km. Its own distance formula is of the second order in
    // the parallax: 3e-4.
    check_near("eclipse, distance", (double)moon.distance_km, 1737.9 / sin(0.283341 * RAD), 150.0);
    check_at_most("eclipse, lit", (double)moon.illuminated_fraction, 1e-4);
}

static void vectors(void **state) {
    (void)state;
    for (int i = 0; i < SUN_VECTORS; i++) {
        const sun_vector *v = &sun_vectors[i];
        const skv_sun sun = sun_of(v->utc, v->position);
        const skv_moon moon = moon_of(v->utc, v->position);
        double got[3];
        to_double(got, sun.direction_enu);
        check_at_most("sun, deg", angle_deg(got, v->sun_enu), SUN_DEG);
        to_double(got, moon.direction_enu);
        check_at_most("moon, deg", angle_deg(got, v->moon_enu), MOON_DEG);
        check_near("moon, km", (double)moon.distance_km, v->moon_km, 40.0);
        check_near("phase angle", (double)moon.phase_angle_deg, v->phase_angle_deg, 0.015);
        check_near("lit", (double)moon.illuminated_fraction, (1.0 + cos(v->phase_angle_deg * RAD)) / 2.0, 0.0002);
    }
}

/// Angles and vector are the same direction, by libm. 1e-5 deg: three roundings of a float below 180.
static void angles_agree(void **state) {
    (void)state;
    for (int i = 0; i < 500; i++) {
        const skv_utc utc = {7305 + 21 * i, (float)(i * 172)};
        const skv_position p = {(float)(i % 181 - 90), (float)(i * 7 % 721 - 360), 0.1f};
        const skv_sun sun = sun_of(utc, p);
        double v[3], w[3];
        to_double(v, sun.direction_enu);
        from_horizon(w, (double)sun.azimuth_deg, 90.0 - (double)sun.elevation_deg);
        check_at_most("angles against vector, deg", angle_deg(v, w), 3e-5);
        check_near("unit", v[0] * v[0] + v[1] * v[1] + v[2] * v[2], 1.0, 3e-7);
        assert_true(sun.azimuth_deg >= 0.0f && sun.azimuth_deg < 360.0f);
        check_near("distance", (double)sun.distance_au, 1.0, 0.0172);
    }
}

/// At a pole the elevation is the declination whatever the longitude, and azimuth turns with it: degree by degree.
static void poles(void **state) {
    (void)state;
    const skv_utc utc = utc_of(2024, 6, 20, 20, 51, 0.0f); // solstice: declination 23.4355 (obliquity of date) +- 0.001
    const skv_sun north = sun_of(utc, (skv_position){90.0f, 0.0f, 0.0f});
    const skv_sun south = sun_of(utc, (skv_position){-90.0f, 0.0f, 0.0f});
    check_near("north pole", (double)north.elevation_deg, 23.4355 + 0.0009, 0.004); // its parallax is 0.0022
    check_near("south pole", (double)south.elevation_deg, -23.4355 - 0.0024, 0.004);
    for (int lon = -360; lon <= 360; lon += 15) {
        const skv_sun s = sun_of(utc, (skv_position){90.0f, (float)lon, 0.0f});
        check_near("elevation", (double)s.elevation_deg, (double)north.elevation_deg, 1e-5);
        const double turned = (double)s.azimuth_deg - (double)north.azimuth_deg - lon;
        check_near("azimuth", turned - 360.0 * floor(turned / 360.0 + 0.5), 0.0, 5e-5);
    }
}

static void range_errors(void **state) {
    (void)state;
    const skv_utc good_utc = {8000, 0.0f};
    const skv_position good = {1.0f, 2.0f, 0.0f};
    static const skv_utc utcs[] = {{-36526, 0.0f}, {36891, 0.0f}, {INT32_MAX, 0.0f}, {INT32_MIN, 0.0f}, {0, -0.01f},
                                   {0, 86401.0f},  {0, NAN},      {0, INFINITY},     {0, -INFINITY}};
    static const skv_position places[] = {{90.01f, 0.0f, 0.0f},   {-90.01f, 0.0f, 0.0f},   {NAN, 0.0f, 0.0f},
                                          {INFINITY, 0.0f, 0.0f}, {0.0f, 360.1f, 0.0f},    {0.0f, -360.1f, 0.0f},
                                          {0.0f, NAN, 0.0f},      {0.0f, -INFINITY, 0.0f}, {0.0f, 0.0f, -12.1f},
                                          {0.0f, 0.0f, 1.1e6f},   {0.0f, 0.0f, NAN},       {0.0f, 0.0f, INFINITY}};
    skv_sun sun, sun_before;
    skv_moon moon, moon_before;
    memset(&sun_before, 0x5a, sizeof sun_before);
    memset(&moon_before, 0x5a, sizeof moon_before);
    sun = sun_before;
    moon = moon_before;
    for (size_t i = 0; i < sizeof utcs / sizeof utcs[0]; i++) {
        assert_int_equal(skv_sun_at(&sun, &utcs[i], &good), SKV_ERR_RANGE);
        assert_int_equal(skv_moon_at(&moon, &utcs[i], &good), SKV_ERR_RANGE);
    }
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++) {
        assert_int_equal(skv_sun_at(&sun, &good_utc, &places[i]), SKV_ERR_RANGE);
        assert_int_equal(skv_moon_at(&moon, &good_utc, &places[i]), SKV_ERR_RANGE);
    }
    assert_int_equal(skv_sun_at(NULL, &good_utc, &good), SKV_ERR_NULL);
    assert_int_equal(skv_sun_at(&sun, NULL, &good), SKV_ERR_NULL);
    assert_int_equal(skv_sun_at(&sun, &good_utc, NULL), SKV_ERR_NULL);
    assert_int_equal(skv_moon_at(NULL, &good_utc, &good), SKV_ERR_NULL);
    assert_int_equal(skv_moon_at(&moon, NULL, &good), SKV_ERR_NULL);
    assert_int_equal(skv_moon_at(&moon, &good_utc, NULL), SKV_ERR_NULL);
    assert_true(memcmp(&sun, &sun_before, sizeof sun) == 0);
    assert_true(memcmp(&moon, &moon_before, sizeof moon) == 0);
}

/// [Meeus98] example 16.a: 24.618' at 0.5541 deg, standard air. [Saemundsson86] at 0 deg: 1.02'/tan(2.01566 deg).
static void refraction_published(void **state) {
    (void)state;
    check_near("16.a", (double)skv_refraction_deg(0.5541f, 1010.0f, 10.0f) * 60.0, 24.618, 0.002);
    check_near("horizon", (double)skv_refraction_deg(0.0f, 1010.0f, 10.0f) * 60.0, 28.982, 0.002);
    check_near("[Reda04]", (double)skv_refraction_deg(39.872046f, 820.0f, 11.0f), 0.016332, 1e-5);
}

/// Thinnest to densest air: total elevation rises, in steps no larger than they should be, and ends at 90 or below.
static void refraction_properties(void **state) {
    (void)state;
    static const float air[][2] = {
        {1010.0f, 10.0f}, {2000.0f, -100.0f}, {2000.0f, 100.0f}, {6.0f, -60.0f}, {0.0f, 0.0f}};
    for (size_t k = 0; k < sizeof air / sizeof air[0]; k++) {
        double last = -90.0; // of the total elevation
        for (int i = -90 * REFRACTION_STEPS; i <= 90 * REFRACTION_STEPS; i++) {
            const float h = (float)i / (float)REFRACTION_STEPS;
            const float r = skv_refraction_deg(h, air[k][0], air[k][1]);
            const double total = (double)h + (double)r;
            assert_true(r >= 0.0f && r < 3.0f);
            // 2e-5: two float steps at 90 deg.
            if (!(total >= last - 2e-5) || !((total - last) * REFRACTION_STEPS < 3.0) || !(total <= 90.0))
                fail_msg("refraction at %g deg, %g hPa: total %.9g after %.9g", (double)h, (double)air[k][0], total,
                         last);
            last = total;
            if (h <= -5.0f)
                check_near("far below", (double)r, 0.0, 0.0);
        }
    }
    static const float bad[][3] = {{90.1f, 1000.0f, 10.0f},    {-90.1f, 1000.0f, 10.0f}, {NAN, 1000.0f, 10.0f},
                                   {0.0f, -1.0f, 10.0f},       {0.0f, 2001.0f, 10.0f},   {0.0f, NAN, 10.0f},
                                   {0.0f, 1000.0f, -101.0f},   {0.0f, 1000.0f, 101.0f},  {0.0f, 1000.0f, NAN},
                                   {INFINITY, 1000.0f, 10.0f}, {0.0f, INFINITY, 10.0f},  {0.0f, 1000.0f, -INFINITY}};
    for (size_t k = 0; k < sizeof bad / sizeof bad[0]; k++)
        check_near("out of range", (double)skv_refraction_deg(bad[k][0], bad[k][1], bad[k][2]), 0.0, 0.0);
}

/// The moon is in the way of no one: only inside it there is no direction.
static void inside_the_moon(void **state) {
    (void)state;
    const skv_utc utc = utc_of(2009, 7, 22, 2, 35, 0.0f);
    skv_position p = {24.2f, 144.1f, 0.0f};
    for (int i = 0; i < 6; i++) { // walk to the point under the moon
        const skv_moon m = moon_of(utc, p);
        p.lat_deg += m.direction_enu[1] / m.direction_enu[2] * 57.0f;
        p.lon_deg += m.direction_enu[0] / m.direction_enu[2] * 60.0f;
    }
    p.height_km = moon_of(utc, p).distance_km;
    skv_moon moon;
    assert_int_equal(skv_moon_at(&moon, &utc, &p), SKV_ERR_RANGE);
    p.height_km += 4000.0f;
    assert_int_equal(skv_moon_at(&moon, &utc, &p), SKV_OK);
    check_near("moon from behind", (double)moon.elevation_deg, -90.0, 3.0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(calendar_days),
        cmocka_unit_test(calendar_refuses),
        cmocka_unit_test(calendar_end_of_day),
        cmocka_unit_test(calendar_back),
        cmocka_unit_test(sun_published),
        cmocka_unit_test(eclipse_published),
        cmocka_unit_test(vectors),
        cmocka_unit_test(angles_agree),
        cmocka_unit_test(poles),
        cmocka_unit_test(range_errors),
        cmocka_unit_test(refraction_published),
        cmocka_unit_test(refraction_properties),
        cmocka_unit_test(inside_the_moon),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
