/// What skyvert-sim makes of a flight: speeds and attitude of flights whose motion is known from a formula.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "check.h"
#include "tools/cockpit/sim_flight.h"

static const double degree = 3.14159265358979323846 / 180.0;

// ---- flights

/// Metres north and east of 47 N 8.5 E, and the height, at a time.
typedef struct point {
    double north_m, east_m, height_m;
} point;

typedef point (*motion)(double t, double speed, double radius);

static point circle(double t, double speed, double radius) { // to the right
    return (point){radius * sin(speed * t / radius), -radius * cos(speed * t / radius), 500};
}

static point climb(double t, double speed, double radius) { // by a radius-th of the way
    return (point){speed * t * 0.6, speed * t * 0.8, 500 + speed * t / radius};
}

static point hover(double t, double speed, double radius) { // straight up, then it stands
    (void)speed;
    return (point){0, 0, 500 + radius * fmin(t, 60)};
}

static point creep(double t, double speed, double radius) { // north by inches, then east in a hurry
    const double on = fmax(0, t - 60);
    return (point){radius * fmin(t, 60), speed * on, 500};
}

static point corner(double t, double speed, double radius) { // 120 s north, then `radius` degrees to the right
    const double on = fmax(0, t - 120);
    return (point){speed * (fmin(t, 120) + on * cos(radius * degree)), speed * on * sin(radius * degree), 500};
}

/// A degree's length at 47 deg, by the usual series of the ellipsoid (111,175 m and 76,056 m there), at 500 m.
static void place(const point *p, double *lat, double *lon) {
    const double f = 47 * degree, up = 1 + p->height_m / 6.37e6;
    *lat = 47 + p->north_m / up / (111132.954 - 559.822 * cos(2 * f) + 1.175 * cos(4 * f));
    *lon = 8.5 + p->east_m / up / (111412.84 * cos(*lat * degree) - 93.5 * cos(3 * *lat * degree));
}

static sim_flight open_flight(motion at, double speed, double radius, double step_s, double until_s) {
    char path[] = "/tmp/skyvert-sim-test-XXXXXX";
    const int fd = mkstemp(path);
    FILE *const file = fd >= 0 ? fdopen(fd, "w") : NULL;
    sim_flight f;
    assert_true(file != NULL);
    fputs("utc,lat_deg,lon_deg,height_m\n", file);
    for (int i = 0; i * step_s <= until_s; i++) {
        const double t = i * step_s;
        const int ms = (int)lround(1e3 * t);
        const point p = at(t, speed, radius);
        double lat, lon;
        place(&p, &lat, &lon);
        fprintf(file, "2024-03-20T16:%02d:%02d.%03dZ,%.10f,%.10f,%.3f\n", ms / 60000, ms / 1000 % 60, ms % 1000, lat,
                lon, p.height_m);
    }
    fclose(file);
    assert_int_equal(sim_flight_open(&f, path, &(sim_flight_options){.visibility_m = 12000}), 0);
    unlink(path);
    return f;
}

/// What the frame of a message says at a moment, by its bytes.
static double said(sim_flight *f, skv_cas_index index, double t) {
    skv_cas_sender sender = {.node = 7};
    skv_can_frame frame;
    assert_int_equal(sim_flight_frame(f, &sender, index, t, &frame), 1);
    const uint8_t *const d = frame.data + 4;
    const uint32_t bits = (uint32_t)d[0] << 24 | (uint32_t)d[1] << 16 | (uint32_t)d[2] << 8 | d[3];
    float value;
    memcpy(&value, &bits, sizeof value);
    return (double)value;
}

// ---- attitude

/// tan roll = v^2/(g r). The ways before and behind a fix are chords: of 3 s, or 10 s, which makes them shorter by up
/// to (v t/r)^2/24, and the roll with them; place() bends a circle of 20 km by .3 %.
static void test_circle(void **state) {
    (void)state;
    static const struct {
        double speed, radius, step_s, tolerance;
    } cases[] = {
        {60, 1500, 1, 0.02}, {60, -1500, 1, 0.02}, {25, 90, 1, 1.0}, {250, 20000, 10, 0.08}, {120, 3000, 0.2, 0.03}};
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
        sim_flight f = open_flight(circle, cases[k].speed, cases[k].radius, cases[k].step_s, 300);
        const double want = atan(cases[k].speed * cases[k].speed / (9.80665 * cases[k].radius)) / degree;
        for (double t = 0; t < 300; t += 0.7) {
            check_near("roll deg", said(&f, SKV_CAS_ROLL, t), want, cases[k].tolerance);
            check_near("pitch deg", said(&f, SKV_CAS_PITCH, t), 0, 1e-6);
        }
        sim_flight_close(&f);
    }
}

static void test_climb(void **state) {
    (void)state;
    static const double slope[] = {14, -20, 7.5};
    for (int k = 0; k < 3; k++) {
        sim_flight f = open_flight(climb, 70, slope[k], k == 2 ? 30 : 1, 240);
        for (double t = 0; t <= 240; t += 0.9) {
            check_near("pitch deg", said(&f, SKV_CAS_PITCH, t), atan(1 / slope[k]) / degree,
                       0.006); // .15 % of the speed: place() is a flat map
            check_near("roll deg", said(&f, SKV_CAS_ROLL, t), 0, 0.02);
        }
        check_near("behind the end: pitch", said(&f, SKV_CAS_PITCH, 300), 0, 0);
        sim_flight_close(&f);
    }
}

/// Slow: none; at 7.5 m/s half of it. A balloon does not stand on its tail, a jet not on its ear.
static void test_limits(void **state) {
    (void)state;
    sim_flight f = open_flight(circle, 4, 20, 1, 120);
    check_near("taxiing: roll", said(&f, SKV_CAS_ROLL, 60), 0, 0);
    sim_flight_close(&f);
    f = open_flight(circle, 7.5, 60, 1, 120);
    check_near("slow: roll", said(&f, SKV_CAS_ROLL, 60), atan(7.5 * 7.5 / 9.80665 / 60) / degree / 2, 0.1); // chords
    sim_flight_close(&f);
    f = open_flight(hover, 0, 5, 1, 120);
    for (double t = 0; t < 120; t += 0.5)
        check_near("straight up: pitch", said(&f, SKV_CAS_PITCH, t), 0, 0);
    sim_flight_close(&f);
    f = open_flight(climb, 300, 0.5, 1, 60);
    check_near("steep: pitch", said(&f, SKV_CAS_PITCH, 30), 45, 0);
    sim_flight_close(&f);
    f = open_flight(circle, 300, 600, 0.5, 60);
    check_near("steep: roll", said(&f, SKV_CAS_ROLL, 30), 60, 0);
    sim_flight_close(&f);
    f = open_flight(creep, 100, 0.01, 1, 120);
    for (double t = 0; t <= 120; t += 0.5)
        check_near("from a stand: roll", said(&f, SKV_CAS_ROLL, t), 0, 1);
    sim_flight_close(&f);
    f = open_flight(corner, 50, 30, 1, 0); // one fix
    check_near("one fix: roll", said(&f, SKV_CAS_ROLL, 0), 0, 0);
    sim_flight_close(&f);
}

/// Few fixes and a corner: it rolls in and out again, and what it rolls turns it by as much as the track does.
static void test_corner(void **state) {
    (void)state;
    for (int k = 0; k < 2; k++) {
        const double turn_deg = k ? -20 : 30, step_s = k ? 5 : 60, speed = 120;
        sim_flight f = open_flight(corner, speed, turn_deg, step_s, 240);
        double turned = 0, before = 0, step = 0;
        for (double t = 0; t <= 240; t += 0.1) {
            const double roll = said(&f, SKV_CAS_ROLL, t);
            turned += 0.1 * 9.80665 * tan(roll * degree) / speed / degree;
            step = fmax(step, fabs(roll - before));
            before = roll;
        }
        check_near("turned deg", turned, turn_deg, 2); // roll is straight between fixes, its tangent is not
        check_at_most("largest step of roll in .1 s, deg", step, k ? 0.9 : 0.02); // 41 deg in 5 s, 6 in 60 s
        sim_flight_close(&f);
    }
}

/// Past a pole at 300 m, straight on: no turn, though the course goes round by 180 degrees; the speed stays.
static void test_pole(void **state) {
    (void)state;
    char path[] = "/tmp/skyvert-sim-test-XXXXXX";
    const int fd = mkstemp(path);
    FILE *const file = fd >= 0 ? fdopen(fd, "w") : NULL;
    sim_flight f;
    assert_true(file != NULL);
    fputs("utc,lat_deg,lon_deg,height_m\n", file);
    for (int t = 0; t <= 140; t++) { // 111,694 m a degree at the pole
        const double x = 70.0 * (t - 70), y = 300;
        fprintf(file, "2024-03-20T16:%02d:%02dZ,%.11f,%.11f,0\n", t / 60, t % 60, -90 + hypot(x, y) / 111693.98,
                atan2(y, x) / degree);
    }
    fclose(file);
    assert_int_equal(sim_flight_open(&f, path, &(sim_flight_options){.visibility_m = 12000}), 0);
    unlink(path);
    for (double t = 1; t < 139; t += 0.37) {
        check_near("ground speed m/s", said(&f, SKV_CAS_GROUND_SPEED, t), 70, 0.02);
        check_near("roll deg", said(&f, SKV_CAS_ROLL, t), 0, 0.02);
        const double want = atan2(-300, 70 * (t - 70)) / degree; // north is away from this pole
        check_near("track deg", remainder(said(&f, SKV_CAS_TRACK, t) - want, 360), 0, 0.5);
    }
    sim_flight_close(&f);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_circle), cmocka_unit_test(test_climb), cmocka_unit_test(test_limits),
        cmocka_unit_test(test_corner), cmocka_unit_test(test_pole),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
