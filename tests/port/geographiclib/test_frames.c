/// Frames, the local sphere and geodesics against the textbook formulas in wgs84.h.
#include "check.h"
#include "port/geographiclib/skv_geo.h"
#include "wgs84.h"

static double worst_of_3(const double a[3], const double b[3]) {
    double worst = 0;
    for (int i = 0; i < 3; i++)
        worst = fmax(worst, fabs(a[i] - b[i]));
    return worst;
}

static void test_local_sphere(void **unused) {
    (void)unused;
    uint64_t seed = 1;
    for (int i = 0; i < 2000; i++) {
        const double lat = i < 3 ? 90.0 * (i - 1) : draw(&seed, -90, 90);
        const double want = sqrt(radius_m(lat) * radius_n(lat)) / 1e3;
        double got = -1;
        assert_int_equal(skv_geo_local_sphere(lat, &got), SKV_OK);
        check_near("local sphere, km", got, want, 1e-10 * want); // rounding of pow and sqrt
    }
    // a (1 - e^2)^(1/2) = b on the equator and a^2 / b at a pole: NIMA TR8350.2's derived constants, to .1 mm
    double equator = 0, pole = 0;
    assert_int_equal(skv_geo_local_sphere(0, &equator), SKV_OK);
    assert_int_equal(skv_geo_local_sphere(-90, &pole), SKV_OK);
    check_near("equator", equator, 6356.7523142, 1e-7);
    check_near("pole", pole, 6399.5936258, 1e-7);
}

static void test_ecef(void **unused) {
    (void)unused;
    uint64_t seed = 2;
    for (int i = 0; i < 5000; i++) {
        const double lat = draw(&seed, -90, 90), lon = draw(&seed, -180, 360), h = draw(&seed, -10e3, 500e3);
        double want[3], got[3], lat2, lon2, h2, again[3];
        to_ecef(lat, lon, h, want);
        assert_int_equal(skv_geo_ecef_from_geodetic(lat, lon, h, got), SKV_OK);
        check_near("ECEF, m", worst_of_3(got, want), 0, 1e-8); // some last bits of 7e6
        assert_int_equal(skv_geo_geodetic_from_ecef(want, &lat2, &lon2, &h2), SKV_OK);
        assert_true(fabs(lat2) <= 90 && fabs(lon2) <= 180);
        to_ecef(lat2, lon2, h2, again);
        check_near("ECEF there and back, m", worst_of_3(again, want), 0, 1e-8);
        check_near("height there and back, m", h2, h, 1e-8);
    }
}

static void test_enu(void **unused) {
    (void)unused;
    uint64_t seed = 3;
    for (int i = 0; i < 3000; i++) {
        const skv_geo_position o = {draw(&seed, -90, 90), draw(&seed, -180, 180), draw(&seed, -500, 20e3)};
        const skv_geo_position t = {fmax(-90, fmin(90, o.lat_deg + draw(&seed, -2, 2))),
                                    fmax(-180, fmin(180, o.lon_deg + draw(&seed, -2, 2))), draw(&seed, -500, 20e3)};
        double a[3], b[3], rows[3][3], basis[3][3], enu[3], enu2[3];
        to_ecef(o.lat_deg, o.lon_deg, o.height_m, a);
        to_ecef(t.lat_deg, t.lon_deg, t.height_m, b);
        enu_rows(o.lat_deg, o.lon_deg, rows);
        assert_int_equal(skv_geo_enu_basis(o.lat_deg, o.lon_deg, basis), SKV_OK);
        for (int k = 0; k < 3; k++)
            check_near("basis", worst_of_3(basis[k], rows[k]), 0, 1e-14); // rounding of sin and cos in degrees
        assert_int_equal(skv_geo_enu_from_geodetic(&o, &t, enu), SKV_OK);
        for (int k = 0; k < 3; k++)
            check_near("ENU, m", enu[k],
                       rows[k][0] * (b[0] - a[0]) + rows[k][1] * (b[1] - a[1]) + rows[k][2] * (b[2] - a[2]), 2e-8);
        skv_geo_position back;
        assert_int_equal(skv_geo_geodetic_from_enu(&o, enu, &back), SKV_OK);
        assert_int_equal(skv_geo_enu_from_geodetic(&o, &back, enu2), SKV_OK);
        check_near("ENU there and back, m", worst_of_3(enu, enu2), 0, 2e-8);
    }
}

static void test_rotate(void **unused) {
    (void)unused;
    uint64_t seed = 4;
    for (int i = 0; i < 2000; i++) {
        const double lat = draw(&seed, -90, 90), lon = draw(&seed, -180, 180);
        const double enu[3] = {draw(&seed, -1, 1), draw(&seed, -1, 1), draw(&seed, -1, 1)};
        const double ned_want[3] = {enu[1], enu[0], -enu[2]};
        double rows[3][3], ecef_want[3], got[3];
        enu_rows(lat, lon, rows);
        for (int k = 0; k < 3; k++)
            ecef_want[k] = enu[0] * rows[0][k] + enu[1] * rows[1][k] + enu[2] * rows[2][k];
        const double *const v[3] = {enu, ned_want, ecef_want};
        for (int from = 0; from < 3; from++)
            for (int to = 0; to < 3; to++) {
                assert_int_equal(skv_geo_rotate((skv_geo_frame)from, (skv_geo_frame)to, lat, lon, v[from], got),
                                 SKV_OK);
                // No sum is made between ENU and NED or within a frame, so those are exact.
                check_near("rotated", worst_of_3(got, v[to]), 0,
                           (from == SKV_GEO_ECEF) == (to == SKV_GEO_ECEF) ? 0 : 2e-15);
            }
        double in_place[3] = {enu[0], enu[1], enu[2]};
        assert_int_equal(skv_geo_rotate(SKV_GEO_ENU, SKV_GEO_ECEF, lat, lon, in_place, in_place), SKV_OK);
        check_near("in place", worst_of_3(in_place, ecef_want), 0, 2e-15);
    }
}

static void test_angles(void **unused) {
    (void)unused;
    uint64_t seed = 5;
    for (int i = 0; i < 2000; i++) {
        const double az = draw(&seed, 0, 360), el = draw(&seed, -90, 90);
        double enu[3], az2, el2;
        const double want[3] = {cos(el * DEG) * sin(az * DEG), cos(el * DEG) * cos(az * DEG), sin(el * DEG)};
        assert_int_equal(skv_geo_enu_from_angles(az, el, enu), SKV_OK);
        check_near("ENU of angles", worst_of_3(enu, want), 0, 1e-15 * 2);
        assert_int_equal(skv_geo_angles_from_enu(want, &az2, &el2), SKV_OK);
        check_near("elevation", el2, el, 1e-12);
        check_near("azimuth", (az2 - az) * cos(el * DEG), 0, 1e-12);
        assert_true(az2 >= 0 && az2 < 360);
    }
    const double north_less[3] = {-1e-300, 1, 0}, up[3] = {0, 0, 3}, zero[3] = {0, 0, 0};
    double az = -1, el = -1;
    assert_int_equal(skv_geo_angles_from_enu(north_less, &az, &el), SKV_OK);
    assert_true(az >= 0 && az < 360); // not 360
    assert_int_equal(skv_geo_angles_from_enu(up, &az, &el), SKV_OK);
    assert_true(az == 0 && el == 90);
    assert_int_equal(skv_geo_angles_from_enu(zero, &az, &el), SKV_ERR_DIRECTION);
}

/// Distance and course by [Vincenty75]: another method than GeographicLib's, .1 mm where it converges.
static void vincenty(double lat1, double lon1, double lat2, double lon2, double *s, double *az1, double *az2) {
    const double b = WGS84_A * (1 - WGS84_F), l = (lon2 - lon1) * DEG;
    const double u1 = atan((1 - WGS84_F) * tan(lat1 * DEG)), u2 = atan((1 - WGS84_F) * tan(lat2 * DEG));
    const double s1 = sin(u1), c1 = cos(u1), s2 = sin(u2), c2 = cos(u2);
    double lambda = l, ss = 0, cs = 0, sigma = 0, ca2 = 0, c2m = 0;
    for (int i = 0; i < 50; i++) {
        const double sl = sin(lambda), cl = cos(lambda);
        ss = hypot(c2 * sl, c1 * s2 - s1 * c2 * cl);
        cs = s1 * s2 + c1 * c2 * cl;
        sigma = atan2(ss, cs);
        const double sa = c1 * c2 * sl / ss;
        ca2 = 1 - sa * sa;
        c2m = cs - 2 * s1 * s2 / ca2;
        const double c = WGS84_F / 16 * ca2 * (4 + WGS84_F * (4 - 3 * ca2));
        lambda = l + (1 - c) * WGS84_F * sa * (sigma + c * ss * (c2m + c * cs * (2 * c2m * c2m - 1)));
    }
    const double k = ca2 * (WGS84_A * WGS84_A - b * b) / (b * b);
    const double big_a = 1 + k / 16384 * (4096 + k * (-768 + k * (320 - 175 * k)));
    const double big_b = k / 1024 * (256 + k * (-128 + k * (74 - 47 * k)));
    const double ds =
        big_b * ss *
        (c2m + big_b / 4 * (cs * (2 * c2m * c2m - 1) - big_b / 6 * c2m * (4 * ss * ss - 3) * (4 * c2m * c2m - 3)));
    *s = b * big_a * (sigma - ds);
    *az1 = atan2(c2 * sin(lambda), c1 * s2 - s1 * c2 * cos(lambda)) / DEG;
    *az2 = atan2(c1 * sin(lambda), c1 * s2 * cos(lambda) - s1 * c2) / DEG;
}

static double turn(double a, double b) {
    return fabs(remainder(a - b, 360));
}

static void test_geodesics(void **unused) {
    (void)unused;
    uint64_t seed = 6;
    for (int i = 0; i < 3000; i++) {
        const double lat1 = draw(&seed, -80, 80), lon1 = draw(&seed, -180, 180), reach = i % 2 ? 90 : .5;
        const double lat2 = fmax(-80, fmin(80, lat1 + draw(&seed, -reach, reach)));
        const double lon2 = lon1 + draw(&seed, -reach, reach);
        double s, az1, az2, lat, lon, az;
        vincenty(lat1, lon1, lat2, lon2, &s, &az1, &az2);
        skv_geo_way way;
        assert_int_equal(skv_geo_inverse(lat1, lon1, lat2, remainder(lon2, 360), &way), SKV_OK);
        check_near("distance, m", way.distance_m, s, 3e-4); // Vincenty's own error
        const double by_m = 5e-4 / s / DEG + 1e-10;         // .5 mm sideways
        check_near("course at the start", turn(way.azimuth1_deg, az1), 0, by_m);
        check_near("course at the end", turn(way.azimuth2_deg, az2), 0, by_m);
        assert_int_equal(skv_geo_direct(lat1, lon1, way.azimuth1_deg, way.distance_m, &lat, &lon, &az), SKV_OK);
        double a[3], b[3];
        to_ecef(lat, lon, 0, a);
        to_ecef(lat2, lon2, 0, b);
        check_near("direct after inverse, m", worst_of_3(a, b), 0, 1e-7); // nanometres and rounding of degrees
    }
    // A quarter of a meridian of WGS 84 is 10001965.729 m, a degree of the equator a pi / 180.
    skv_geo_way way;
    assert_int_equal(skv_geo_inverse(0, 20, 90, 20, &way), SKV_OK);
    check_near("quarter meridian, m", way.distance_m, 10001965.729, 1e-3);
    assert_int_equal(skv_geo_inverse(0, 20, 0, 21, &way), SKV_OK);
    check_near("a degree of the equator, m", way.distance_m, WGS84_A * DEG, 1e-8);
    check_near("due east", way.azimuth1_deg, 90, 1e-12);
}

/// Every number of every call, one after the other, set to NaN, infinity and just out of range.
static void test_refusals(void **unused) {
    (void)unused;
    const double bad[] = {NAN, INFINITY, -INFINITY, 1e300, -1e300};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        const double x = bad[i];
        double v[3] = {7, 7, 7}, b[3][3] = {{7}}, a = 7, c = 7, d = 7;
        skv_geo_position p = {0, 0, 0}, q = {x, 0, 0}, r = {0, 0, x}, out = {7, 7, 7};
        skv_geo_way way = {7, 7, 7};
        const double e0[3] = {x, 0, 0}, e2[3] = {0, 0, x};
        assert_int_equal(skv_geo_local_sphere(x, &a), SKV_ERR_RANGE);
        assert_int_equal(skv_geo_ecef_from_geodetic(x, 0, 0, v), SKV_ERR_RANGE);
        assert_int_equal(skv_geo_ecef_from_geodetic(0, x, 0, v), SKV_ERR_RANGE);
        assert_int_equal(skv_geo_ecef_from_geodetic(0, 0, x, v), SKV_ERR_RANGE);
        assert_int_equal(skv_geo_geodetic_from_ecef(e0, &a, &c, &d), SKV_ERR_RANGE);
        assert_int_equal(skv_geo_geodetic_from_ecef(e2, &a, &c, &d), SKV_ERR_RANGE);
        assert_int_equal(skv_geo_enu_from_geodetic(&p, &q, v), SKV_ERR_RANGE);
        assert_int_equal(skv_geo_enu_from_geodetic(&r, &p, v), SKV_ERR_RANGE);
        assert_int_equal(skv_geo_geodetic_from_enu(&q, v, &out), SKV_ERR_RANGE);
        assert_int_equal(skv_geo_geodetic_from_enu(&p, e2, &out), SKV_ERR_RANGE);
        assert_int_equal(skv_geo_enu_basis(x, 0, b), SKV_ERR_RANGE);
        assert_int_equal(skv_geo_enu_basis(0, x, b), SKV_ERR_RANGE);
        assert_int_equal(skv_geo_enu_from_angles(x, 0, v), SKV_ERR_RANGE);
        assert_int_equal(skv_geo_enu_from_angles(0, x, v), SKV_ERR_RANGE);
        assert_int_equal(skv_geo_inverse(x, 0, 0, 0, &way), SKV_ERR_RANGE);
        assert_int_equal(skv_geo_inverse(0, 0, 0, x, &way), SKV_ERR_RANGE);
        assert_int_equal(skv_geo_direct(0, x, 0, 1, &a, &c, &d), SKV_ERR_RANGE);
        assert_int_equal(skv_geo_direct(0, 0, x, 1, &a, &c, &d), SKV_ERR_RANGE);
        assert_int_equal(skv_geo_direct(0, 0, 0, x, &a, &c, &d), SKV_ERR_RANGE);
        if (!isfinite(x)) {
            assert_int_equal(skv_geo_rotate(SKV_GEO_ENU, SKV_GEO_ECEF, 0, 0, e0, v), SKV_ERR_RANGE);
            assert_int_equal(skv_geo_angles_from_enu(e2, &a, &c), SKV_ERR_RANGE);
        }
        assert_true(a == 7 && c == 7 && d == 7 && v[0] == 7 && b[0][0] == 7 && out.lat_deg == 7 && way.distance_m == 7);
    }
    double v[3] = {1, 2, 3}, a;
    const double huge[3] = {1.7e308, 1.7e308, 1.7e308}, middle[3] = {0, 0, 0};
    assert_int_equal(skv_geo_rotate(SKV_GEO_ENU, SKV_GEO_ECEF, 45, 45, huge, v), SKV_ERR_RANGE);
    assert_int_equal(skv_geo_rotate((skv_geo_frame)9, SKV_GEO_ENU, 0, 0, v, v), SKV_ERR_UNSUPPORTED);
    assert_int_equal(skv_geo_geodetic_from_ecef(middle, &a, &a, &a), SKV_ERR_RANGE);
    assert_int_equal(skv_geo_local_sphere(91, &a), SKV_ERR_RANGE);
    assert_int_equal(skv_geo_local_sphere(0, NULL), SKV_ERR_NULL);
    assert_int_equal(skv_geo_enu_basis(0, 0, NULL), SKV_ERR_NULL);
    assert_int_equal(skv_geo_rotate(SKV_GEO_ENU, SKV_GEO_NED, 0, 0, NULL, v), SKV_ERR_NULL);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_local_sphere), cmocka_unit_test(test_ecef),   cmocka_unit_test(test_enu),
        cmocka_unit_test(test_rotate),       cmocka_unit_test(test_angles), cmocka_unit_test(test_geodesics),
        cmocka_unit_test(test_refusals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
