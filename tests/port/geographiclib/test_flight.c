/// The sample flight is one that could be flown, and its dusk is the one it promises: the sun by ERFA.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <erfa.h>

#include "check.h"
#include "port/geographiclib/skv_geo.h"
#include "wgs84.h"

typedef struct {
    int hour, minute, second;
    double lat_deg, lon_deg, height_m;
} row;

enum { MOST = 1000 };
static row rows[MOST];
static int n;

/// Geometric elevation, the observer on the ellipsoid: UT1 = UTC is .004 deg at most.
static double sun_elevation(const row *r) {
    double utc1, utc2, aob, zob, hob, dob, rob, eo;
    double pvh[2][3], pvb[2][3], ra, dec, tai1, tai2, tt1, tt2;
    assert_int_equal(eraDtf2d("UTC", 2024, 3, 20, r->hour, r->minute, r->second, &utc1, &utc2), 0);
    eraUtctai(utc1, utc2, &tai1, &tai2);
    eraTaitt(tai1, tai2, &tt1, &tt2);
    eraEpv00(tt1, tt2, pvh, pvb);
    const double to_sun[3] = {-pvh[0][0], -pvh[0][1], -pvh[0][2]};
    double p[3] = {to_sun[0], to_sun[1], to_sun[2]};
    eraC2s(p, &ra, &dec);
    // As a star at 1 au: eraAtco13 adds aberration, precession, nutation and the Earth's turn; no air.
    eraAtco13(ra, dec, 0, 0, 0, 0, utc1, utc2, 0, r->lon_deg * DEG, r->lat_deg * DEG, r->height_m, 0, 0, 0, 0, 0, .5,
              &aob, &zob, &hob, &dob, &rob, &eo);
    return 90 - zob / DEG;
}

static int load(void **unused) {
    (void)unused;
    FILE *f = fopen(TEST_FLIGHT, "r");
    char line[200];
    if (!f || !fgets(line, sizeof line, f) || strcmp(line, "utc,lat_deg,lon_deg,height_m\n") != 0)
        return -1;
    while (n < MOST && fgets(line, sizeof line, f)) {
        row *r = &rows[n++];
        char end = 0;
        if (sscanf(line, "2024-03-20T%2d:%2d:%2dZ,%lf,%lf,%lf%c", &r->hour, &r->minute, &r->second, &r->lat_deg,
                   &r->lon_deg, &r->height_m, &end) != 7 ||
            end != '\n')
            return -1;
    }
    fclose(f);
    return n > 100 ? 0 : -1;
}

static double seconds(const row *r) {
    return 3600.0 * r->hour + 60.0 * r->minute + r->second;
}

static void check_airport(const row *r, const char *reference_point, double elevation_m) {
    double lat, lon;
    skv_geo_way way;
    assert_int_equal(skv_geo_parse(reference_point, &lat, &lon, NULL, 0), SKV_OK);
    assert_int_equal(skv_geo_inverse(lat, lon, r->lat_deg, r->lon_deg, &way), SKV_OK);
    check_near("off the reference point, m", way.distance_m, 0, .2); // six decimals of a degree are .11 m
    check_near("elevation, m", r->height_m, elevation_m, .05);
}

static void test_airports(void **unused) {
    (void)unused;
    check_airport(&rows[0], "472729N 0083253E", 432);
    check_airport(&rows[n - 1], "480637N 0163411E", 183);
}

/// An airliner's limits: 250 m/s over ground, 15 m/s up or down, .3 g along, .12 g upwards (between rows of 10 s).
static void test_flyable(void **unused) {
    (void)unused;
    double speed = 0, climb = 0, top = 0, fastest = 0, steepest = 0, hardest = 0, bump = 0;
    for (int i = 1; i < n; i++) {
        const double dt = seconds(&rows[i]) - seconds(&rows[i - 1]);
        check_near("step, s", dt, 10, 0);
        skv_geo_way way;
        assert_int_equal(
            skv_geo_inverse(rows[i - 1].lat_deg, rows[i - 1].lon_deg, rows[i].lat_deg, rows[i].lon_deg, &way), SKV_OK);
        const double v = way.distance_m / dt, w = (rows[i].height_m - rows[i - 1].height_m) / dt;
        hardest = fmax(hardest, fabs(v - speed) / dt);
        bump = fmax(bump, fabs(w - climb) / dt);
        speed = v;
        climb = w;
        fastest = fmax(fastest, v);
        steepest = fmax(steepest, fabs(w));
        top = fmax(top, rows[i].height_m);
    }
    print_message("figure: sample flight: %d rows, top %.0f m, %.0f m/s, climb %.1f m/s, along %.2f, up %.2f m/s2\n", n,
                  top, fastest, steepest, hardest, bump);
    check_near("cruise, m", top, 11500, 500);
    check_at_most("ground speed, m/s", fastest, 250);
    check_at_most("climb or descent, m/s", steepest, 15);
    check_at_most("acceleration, m/s2", hardest, 3);
    check_at_most("vertical acceleration, m/s2", bump, 1.2);
}

static void test_dusk(void **unused) {
    (void)unused;
    const double first = sun_elevation(&rows[0]), last = sun_elevation(&rows[n - 1]);
    print_message("figure: sample flight: sun from %.2f to %.2f deg\n", first, last);
    check_near("sun at the start, deg", first, 6, .5);
    check_near("sun at the end, deg", last, -8.5, .6);
    for (int i = 1; i < n; i++)
        assert_true(sun_elevation(&rows[i]) < sun_elevation(&rows[i - 1]));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_airports),
        cmocka_unit_test(test_flyable),
        cmocka_unit_test(test_dusk),
    };
    return cmocka_run_group_tests(tests, load, NULL);
}
