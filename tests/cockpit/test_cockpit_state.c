// What the bus's frames come to: tools/cockpit/cockpit_state.c. And the knob and lamps on fake lines.
#include <math.h>
#include <string.h>

#include "check.h"
#include "port/gpiod/fake.h"
#include "tools/cockpit/cockpit_panel.h"
#include "tools/cockpit/cockpit_state.h"

static const int64_t second = 1000000000;
static skv_cas_sender sender = {.node = 1};

static void number(cockpit_state *s, skv_cas_index index, double value, int64_t t) {
    skv_can_frame frame[2];
    const int n = skv_cas_encode(&sender, index, 0, value, frame);
    if (n < 1)
        fail_msg("%s = %g cannot be encoded", skv_cas_table[index].name, value);
    for (int i = 0; i < n; i++)
        (void)cockpit_state_frame(s, &frame[i], t);
}

static void bytes(cockpit_state *s, skv_cas_index index, int a, int b, int c, int d, int64_t t) {
    const uint8_t four[4] = {(uint8_t)a, (uint8_t)b, (uint8_t)c, (uint8_t)d};
    skv_can_frame frame;
    if (skv_cas_encode_bytes(&sender, index, four, &frame) != 1)
        fail_msg("%s cannot be encoded", skv_cas_table[index].name);
    (void)cockpit_state_frame(s, &frame, t);
}

static void position(cockpit_state *s, double lat, double lon, int64_t t) {
    number(s, SKV_CAS_LATITUDE, lat, t);
    number(s, SKV_CAS_LONGITUDE, lon, t);
}

// 2003-10-17 19:30:30 UTC, 39.742476 -105.1786, 1830.14 m: zenith 50.127954, azimuth 194.340241 by [Reda04]'s example,
// at the geometric place, less .0009 deg of its delta T and the .004 deg that skv_sun_at() says of itself.
static void sun_of_a_published_example(void **state) {
    (void)state;
    cockpit_state s;
    cockpit_now now;
    cockpit_state_begin(&s, 60);
    for (int i = 0; i <= 10; i++) {
        const int64_t t = second * i;
        bytes(&s, SKV_CAS_DATE, 17, 10, 20, 3, t);
        bytes(&s, SKV_CAS_UTC, 19, 30, 20 + i, 0, t);
        for (int k = 0; k < 10; k++) {
            position(&s, 39.742476, -105.1786, t + k * second / 10);
            number(&s, SKV_CAS_TRUE_ALTITUDE, 1830.14, t + k * second / 10);
        }
    }
    cockpit_state_now(&s, 10 * second, &now);
    assert_true(now.has_sun && !now.sun_by_bus && !now.position_stale && !now.time_stale && !now.height_stale &&
                !now.held);
    check_near("elevation, deg", (double)now.sun.elevation_deg, 90 - 50.127954, 0.005);
    check_near("azimuth, deg", (double)now.sun.azimuth_deg, 194.340241,
               0.007); // .005 on the sphere at 40 deg elevation
    // Between two frames time goes on: .4 s are .0017 deg of the sky's turning.
    cockpit_state_now(&s, 10 * second + 400000000, &now);
    check_near("seconds of the day", (double)now.utc.seconds, 19 * 3600 + 30 * 60 + 30.4,
               0.02); // a float's steps are .008 s
}

// At 1 and at 60 times the pace.
static void midnight_in_either_order(void **state) {
    (void)state;
    for (int kind = 0; kind < 4; kind++) {
        const bool date_first = kind % 2 == 1;
        const int pace = kind < 2 ? 1 : 60;
        cockpit_state s;
        cockpit_now now;
        cockpit_state_begin(&s, 60);
        for (int i = 0; i < 20; i++) {
            const int64_t t = second * i, later = t + 400000000;
            const int of_day = (86400 - 10 * pace + pace * i + pace / 3) % 86400, day = i < 10 ? 31 : 1,
                      month = i < 10 ? 12 : 1, year = i < 10 ? 24 : 25;
            if (date_first)
                bytes(&s, SKV_CAS_DATE, day, month, 20, year, t);
            bytes(&s, SKV_CAS_UTC, of_day / 3600, of_day / 60 % 60, of_day % 60, 0, t);
            cockpit_state_now(&s, t, &now);
            if (i > (pace == 1 ? 0 : 3)) { // the pace is found out first
                const double got = 86400.0 * now.utc.day + (double)now.utc.seconds;
                const double want = 86400.0 * 9132 + pace * (i - 10) + pace / 3; // 2025-01-01 is day 9132
                check_near("across midnight, s", got, want, pace == 1 ? 0.1 : 0.5);
            }
            if (!date_first)
                bytes(&s, SKV_CAS_DATE, day, month, 20, year, later);
        }
    }
}

static void heights_in_their_order(void **state) {
    (void)state;
    cockpit_state s;
    cockpit_now now;
    cockpit_state_begin(&s, 60);
    number(&s, SKV_CAS_STANDARD_ALTITUDE, 900, 0);
    cockpit_state_now(&s, 0, &now);
    check_near("pressure altitude", now.height_m, 900, 1e-9);
    assert_int_equal(now.datum, SKV_CAS_PRESSURE);
    number(&s, SKV_CAS_TRUE_ALTITUDE, 1000, 1000);
    for (int i = 0; i < 40; i++) {
        number(&s, SKV_CAS_TRUE_ALTITUDE, 1000, second / 10 * (i + 1));
        number(&s, SKV_CAS_GPS_HEIGHT, 1050, second / 10 * (i + 1));
    }
    cockpit_state_now(&s, 4 * second, &now);
    assert_int_equal(now.datum, SKV_CAS_SEA);
    check_near("above the sea", now.height_m, 1000, 0.01); // what is left of the way from 900: exp(-4/.25)
}

// A climb at 15 m/s; the sea is 47.3 m above the ellipsoid. GPS heights come 40 ms before the other ones, so each is of
// another moment.
static void climb(cockpit_state *s, int from, int until, bool sea, bool gps) {
    for (int i = from; i < until; i++) {
        const int64_t t = second / 10 * i;
        if (gps)
            number(s, SKV_CAS_GPS_HEIGHT, 1047.3 + 1.5 * i, t);
        if (sea)
            number(s, SKV_CAS_TRUE_ALTITUDE, 1000 + 15 * (0.1 * i + 0.04), t + 40000000);
    }
}

static void check_height(cockpit_state *s, int at, double want, double tolerance) {
    cockpit_now now;
    cockpit_state_now(s, second / 10 * at, &now);
    check_near("height, m", now.height_m, want, tolerance);
}

// Above the ellipsoid alone: what the file says of the geoid is taken off.
static void ellipsoid_heights(void **state) {
    (void)state;
    cockpit_state s;
    cockpit_now now;
    cockpit_state_begin(&s, 60);
    s.geoid_m = 47.3;
    climb(&s, 0, 100, false, true);
    cockpit_state_now(&s, 99 * second / 10, &now);
    assert_int_equal(now.datum, SKV_CAS_ELLIPSOID);
    check_near("geoid, m", now.geoid_m, 47.3, 1e-9);
    check_height(&s, 99, 1000 + 1.5 * 99, 0.01); // floats of 1148 m have steps of 1e-4
}

// Both kinds, then the one above the ellipsoid alone: no step, and what was learnt fades to the file's in ten minutes.
static void change_over_makes_no_step(void **state) {
    (void)state;
    cockpit_state s;
    cockpit_now now;
    double before = 1000 + 1.5 * 99;
    cockpit_state_begin(&s, 60);
    climb(&s, 0, 100, true, true);
    check_height(&s, 100, 1000 + 1.5 * 100, 0.01);
    assert_true(s.learnt > 0);
    check_near("learnt, m", s.learnt_m, 47.3, 0.05); // the first ones are of 15 m/s that it does not know yet
    for (int i = 100; i < 160; i++) {
        cockpit_state_now(&s, second / 10 * i, &now);
        climb(&s, i, i + 1, false, true);
        cockpit_state_now(&s, second / 10 * i, &now);
        check_near("step of a climb of 1.5 m", now.height_m - before, 1.5, 1.6); // it waits a frame

        before = now.height_m;
    }
    assert_int_equal(now.datum, SKV_CAS_ELLIPSOID);
    check_height(&s, 159, 1000 + 1.5 * 159, 0.5); // 47.3 * 6/600
    climb(&s, 160, 6100, false, true);
    check_height(&s, 6099, 1000 + 1.5 * 6099 + 47.3 * (1 - 0.36788), 0.5); // exp(-1) of it is left
    climb(&s, 6100, 6200, true, true);
    cockpit_state_now(&s, 620 * second, &now);
    assert_int_equal(now.datum, SKV_CAS_SEA);
    check_height(&s, 6200, 1000 + 1.5 * 6200, 0.1);
}

// One of the two is put elsewhere a frame before the other: nothing is learnt from that.
static void elsewhere_is_not_learnt(void **state) {
    (void)state;
    cockpit_state s;
    cockpit_state_begin(&s, 60);
    climb(&s, 0, 50, true, true);
    number(&s, SKV_CAS_GPS_HEIGHT, 9047.3, 5 * second);
    check_near("learnt, m", s.learnt_m, 47.3, 0.1);
}

static void stale_is_held_and_said(void **state) {
    (void)state;
    cockpit_state s;
    cockpit_now now, later;
    char text[100];
    cockpit_state_begin(&s, 60);
    cockpit_state_now(&s, 0, &now);
    assert_true(!now.has_sun && !now.held && now.stale == 0);
    for (int i = 0; i <= 50; i++) {
        position(&s, 47 + 1e-4 * i, 8, second / 10 * i);
        number(&s, SKV_CAS_TRUE_ALTITUDE, 5000 + i, second / 10 * i);
        if (i % 10 == 0) {
            bytes(&s, SKV_CAS_DATE, 20, 3, 20, 26, second / 10 * i);
            bytes(&s, SKV_CAS_UTC, 12, 0, i / 10, 0, second / 10 * i);
        }
    }
    cockpit_state_now(&s, 5 * second + second / 5, &now);
    assert_true(now.has_sun && now.stale == 0 && !now.held);
    cockpit_state_now(&s, 6 * second, &now); // position and height are, time is not
    assert_true(now.position_stale && now.height_stale && !now.time_stale && !now.held);
    assert_int_equal(now.stale, 3);
    assert_true(strcmp(cockpit_state_stale(&s, text, sizeof text), "TrueAltitude Latitude Longitude") == 0);
    assert_true(strcmp(cockpit_state_stale(&s, text, 20), "TrueAltitude ...") == 0);
    cockpit_state_now(&s, 9 * second, &now);
    assert_true(now.time_stale && now.held && now.has_sun);
    cockpit_state_now(&s, 900 * second, &later);
    check_near("the sun stands", (double)later.sun.elevation_deg, (double)now.sun.elevation_deg, 0);
    check_near("the place stands", later.latitude_deg, now.latitude_deg, 1e-9); // what fades is gone
    position(&s, 47.006, 8, 901 * second);                                      // it comes again
    cockpit_state_now(&s, 901 * second, &now);
    assert_true(!now.held && !now.position_stale && now.time_stale);
    check_near("no jump", now.latitude_deg, later.latitude_deg, 1e-9);
    cockpit_state_now(&s, 901 * second + second / 5, &now);
    cockpit_state_now(&s, 902 * second, &now);
    check_near("and it is right", now.latitude_deg, 47.006, 1e-4); // faded by exp(-1/.25)
}

static void sun_by_the_bus(void **state) {
    (void)state;
    cockpit_state s;
    cockpit_now now;
    cockpit_state_begin(&s, 60);
    number(&s, SKV_CAS_SUN_AZIMUTH, 350, 0);
    cockpit_state_now(&s, 0, &now);
    assert_true(!now.has_sun);
    number(&s, SKV_CAS_SUN_ELEVATION, 30, 0);
    cockpit_state_now(&s, 0, &now);
    assert_true(now.has_sun && now.sun_by_bus && !now.has_position);
    check_near("azimuth", (double)now.sun.azimuth_deg, 350, 1e-4);
    const double c = 0.8660254037844386; // cos 30 deg
    check_near("east", (double)now.sun.direction_enu[0], -c * 0.17364817766693033, 1e-6);
    check_near("north", (double)now.sun.direction_enu[1], c * 0.984807753012208, 1e-6);
    check_near("up", (double)now.sun.direction_enu[2], 0.5, 1e-6);
    cockpit_state_now(&s, 10 * second, &now);
    assert_true(now.time_stale && now.held);
}

static cockpit_options knobs(void) {
    cockpit_options o;
    memset(&o, 0, sizeof o);
    o.minutes_per_click = 10;
    o.visibility_per_click = 1.25;
    o.night_below_deg = -0.833;
    o.night_width_deg = 1;
    skv_gpio_defaults(&o.gpio);
    return o;
}

static void knob_button_toggle(void **state) {
    (void)state;
    const cockpit_options o = knobs();
    cockpit_panel p = {0};
    cockpit_state s;
    cockpit_now now;
    cockpit_state_begin(&s, 60);
    cockpit_panel_turn(&p, &o, &s, &(skv_gpio_input){.clicks = 3}, 60);
    check_near("time offset, s", s.time_offset_s, 1800, 0);
    cockpit_panel_turn(&p, &o, &s, &(skv_gpio_input){.clicks = -5}, 60);
    check_near("time offset, s", s.time_offset_s, -1200, 0);
    cockpit_panel_turn(&p, &o, &s, &(skv_gpio_input){.clicks = -1000}, 60);
    check_near("no more than a day", s.time_offset_s, -86400, 0);
    cockpit_panel_turn(&p, &o, &s, &(skv_gpio_input){.clicks = -2, .toggle = true, .toggled = true}, 60);
    check_near("visibility, km", s.visibility_km, 60 / 1.25 / 1.25, 1e-9);
    cockpit_state_now(&s, 0, &now);
    check_near("wanted, km", now.visibility_km, 60 / 1.25 / 1.25, 1e-9);
    cockpit_panel_turn(&p, &o, &s, &(skv_gpio_input){.presses = 1}, 60);
    check_near("reset", s.time_offset_s + s.visibility_km, 0, 0);
    number(&s, SKV_CAS_VISIBILITY, 12000, 0);
    cockpit_state_now(&s, 0, &now);
    check_near("visibility of the bus, km", now.visibility_km, 12, 1e-6);
    // The offset moves the time, over midnight too.
    position(&s, 47, 8, 0);
    bytes(&s, SKV_CAS_DATE, 1, 1, 20, 26, 0);
    bytes(&s, SKV_CAS_UTC, 0, 5, 0, 0, 0);
    cockpit_panel_turn(&p, &o, &s, &(skv_gpio_input){.clicks = -1}, 60);
    cockpit_state_now(&s, 0, &now);
    assert_int_equal(now.utc.day, 9496); // 2025-12-31
    check_near("seconds", (double)now.utc.seconds, 86400 - 300, 0.01);
}

static void lamps_on_lines(void **state) {
    (void)state;
    cockpit_options o = knobs();
    cockpit_panel p;
    char why[SKV_GPIO_WHY];
    fake_reset();
    fake_line("NIGHT", false);
    fake_line("BUS", false);
    assert_int_equal(skv_gpio_set(&o.gpio, "lamp_night", "NIGHT", why), 0);
    assert_int_equal(skv_gpio_set(&o.gpio, "lamp_bus", "BUS", why), 0);
    assert_int_equal(skv_gpio_set(&o.gpio, "button", "NOT_THERE", why), 0); // said in a line, and it goes on
    cockpit_panel_open(&p, &o);
    static const struct {
        double sun;
        bool lit;
    } way[] = {{5, false},    {-0.8, false},  {-0.84, true},        {-0.5, true}, {0.16, true},
               {0.17, false}, {-0.83, false}, {(double)NAN, false}, {-1, true},   {(double)NAN, true}};
    for (size_t i = 0; i < sizeof way / sizeof way[0]; i++) {
        cockpit_panel_lamps(&p, &o, way[i].sun, i % 2 == 1);
        if (fake_level("NIGHT") != way[i].lit)
            fail_msg("sun %g deg: night lamp %d, want %d", way[i].sun, fake_level("NIGHT"), way[i].lit);
        assert_int_equal(fake_level("BUS"), i % 2 == 1);
    }
    cockpit_panel_close(&p);
    assert_true(!fake_level("NIGHT") && !fake_level("BUS"));
    assert_int_equal(fake_open(), 0);
}

static void without_lines(void **state) {
    (void)state;
    const cockpit_options o = knobs();
    cockpit_panel p;
    cockpit_state s;
    cockpit_state_begin(&s, 60);
    cockpit_panel_open(&p, &o);
    assert_int_equal(cockpit_panel_fd(&p), -1);
    cockpit_panel_read(&p, &o, &s);
    cockpit_panel_lamps(&p, &o, -5, true);
    assert_true(p.night && p.bus);
    cockpit_panel_close(&p);
}

// 200,000 random frames of the ids it hears: what is shown is finite and the core takes it.
static void anything_on_the_bus(void **state) {
    (void)state;
    cockpit_state s;
    cockpit_now now;
    uint32_t ids[64];
    const int n = cockpit_state_ids(ids, 64);
    uint64_t r = 7;
    int64_t t = 0;
    cockpit_state_begin(&s, 60);
    for (int i = 0; i < 200000; i++) {
        skv_can_frame frame = {.length = 8};
        r = r * 6364136223846793005u + 1442695040888963407u;
        frame.id = ids[(r >> 40) % (uint64_t)n];
        t += (int64_t)(r >> 37);
        for (int k = 0; k < 8; k++)
            frame.data[k] = (uint8_t)(r >> (k * 7));
        const int row = skv_cas_find(frame.id);
        frame.data[1] = row >= 0 ? skv_cas_table[row].type : frame.data[1];
        frame.data[2] = 0;
        (void)cockpit_state_frame(&s, &frame, t);
        cockpit_state_now(&s, t, &now);
        if (!isfinite(now.latitude_deg) || !isfinite(now.longitude_deg) || !isfinite(now.height_m) ||
            !isfinite((double)now.sun.elevation_deg) || !isfinite(now.visibility_km) || !(now.visibility_km > 0) ||
            !isfinite(now.exposure) || !(now.exposure >= 0))
            fail_msg("frame %d: %g %g %g %g %g %g", i, now.latitude_deg, now.longitude_deg, now.height_m,
                     (double)now.sun.elevation_deg, now.visibility_km, now.exposure);
    }
    assert_true(s.accepted > 1000);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sun_of_a_published_example),
        cmocka_unit_test(midnight_in_either_order),
        cmocka_unit_test(heights_in_their_order),
        cmocka_unit_test(ellipsoid_heights),
        cmocka_unit_test(change_over_makes_no_step),
        cmocka_unit_test(elsewhere_is_not_learnt),
        cmocka_unit_test(stale_is_held_and_said),
        cmocka_unit_test(sun_by_the_bus),
        cmocka_unit_test(knob_button_toggle),
        cmocka_unit_test(lamps_on_lines),
        cmocka_unit_test(without_lines),
        cmocka_unit_test(anything_on_the_bus),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
