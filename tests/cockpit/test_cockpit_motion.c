// Smoothing, extrapolation, holding: tools/cockpit/cockpit_motion.c.
#include <math.h>

#include "check.h"
#include "tools/cockpit/cockpit_motion.h"

static const cockpit_motion_kind kind = {
    .alpha = .5, .beta = .2, .jump = 5, .speed = 100, .period_s = .1, .hold_s = .3, .blend_s = .25};
static const cockpit_motion_kind angle = {
    .alpha = .5, .beta = .2, .jump = 5, .speed = 100, .period_s = .1, .hold_s = .3, .blend_s = .25, .wrap = 360};

static int64_t at(double s) {
    return (int64_t)llround(1e9 * s) + 1000;
}

// A straight line is shown without error once it has been followed for a while, also between its frames.
static void line_is_followed(void **state) {
    (void)state;
    cockpit_motion m = {0};
    for (int i = 0; i <= 100; i++)
        cockpit_motion_frame(&m, &kind, 7 + 3 * 0.1 * i, at(0.1 * i));
    for (double t = 10.0; t < 10.29; t += 0.013) // rounding, and the rest of what fades: exp(-10/.25)
        check_near("on the line", cockpit_motion_at(&m, &kind, at(t)), 7 + 3 * t, 1e-6);
}

// Nothing comes any more: three periods on, then it stands.
static void it_holds(void **state) {
    (void)state;
    cockpit_motion m = {0};
    for (int i = 0; i <= 100; i++)
        cockpit_motion_frame(&m, &kind, 3 * 0.1 * i, at(0.1 * i));
    check_near("held 1 s later", cockpit_motion_at(&m, &kind, at(11)), 30 + 0.9, 1e-6);
    check_near("held a day later", cockpit_motion_at(&m, &kind, at(86400)), 30 + 0.9, 1e-6);
}

static double largest_step;

// Shows it at 60 Hz while frames of a turning aircraft come late, in heaps, or not at all for 2 s: no step of what is
// shown is larger than the motion and the fading of what was missed allow.
static void steps(const double *arrive, const double *stamp, const double *value, int n, double until) {
    cockpit_motion m = {0};
    int next = 0;
    double before = NAN;
    largest_step = 0;
    for (double t = 0; t < until; t += 1 / 60.0) {
        while (next < n && arrive[next] <= t) {
            cockpit_motion_frame(&m, &kind, value[next], at(stamp[next]));
            next++;
        }
        const double shown = cockpit_motion_at(&m, &kind, at(t));
        if (m.frames > 0 && before == before)
            largest_step = fmax(largest_step, fabs(shown - before));
        before = m.frames > 0 ? shown : NAN;
    }
}

static void late_frames_do_not_jump(void **state) {
    (void)state;
    enum { N = 100 };
    double arrive[N], stamp[N], value[N];
    for (int i = 0; i < N; i++) {
        stamp[i] = 0.1 * i;
        value[i] = 2 * stamp[i]; // 2 a second
        arrive[i] = stamp[i];
        if (i >= 40 && i < 60) // two seconds of frames come together
            arrive[i] = stamp[i] = 6.0 + 1e-4 * (i - 40);
    }
    steps(arrive, stamp, value, N, 10.0);
    // Held .3 s behind the last frame: 3.4 to catch up with, by a share of 1/60/.25 at first, while it moves on by
    // 1/30.
    const double allowed = 3.6 / 60 / 0.25 + 2.5 * 2 / 60;
    print_message("figure: motion: largest step after 2 s without frames: %.3f of 3.4 to catch up with\n",
                  largest_step);
    check_at_most("largest step", largest_step, allowed);
    if (largest_step < 0.05)
        fail_msg("nothing was caught up with: %g", largest_step);
}

static void jitter_does_not_shake(void **state) {
    (void)state;
    enum { N = 300 };
    double arrive[N], stamp[N], value[N];
    for (int i = 0; i < N; i++) { // each frame up to 40 ms late, its stamp with it
        stamp[i] = arrive[i] = 0.1 * i + 0.04 * ((i * 7919) % 100) / 100.0;
        value[i] = 2 * 0.1 * i;
    }
    steps(arrive, stamp, value, N, 29.0);
    // The motion is 1/30 a step; 40 ms are .08 of wrong place, which is faded in .25 s, and some wrong speed.
    check_at_most("largest step", largest_step, 0.055);
}

static void elsewhere_is_taken_at_once(void **state) {
    (void)state;
    cockpit_motion m = {0};
    for (int i = 0; i <= 20; i++)
        cockpit_motion_frame(&m, &kind, 0.3 * i, at(0.1 * i));
    cockpit_motion_frame(&m, &kind, 100, at(2.1));
    check_near("put elsewhere", cockpit_motion_at(&m, &kind, at(2.1)), 100, 0);
    check_near("and stands there", cockpit_motion_at(&m, &kind, at(2.3)), 100, 0);
}

static void angles_go_round(void **state) {
    (void)state;
    cockpit_motion m = {0};
    for (int i = 0; i <= 200; i++)
        cockpit_motion_frame(&m, &angle, remainder(179 + 0.1 * i * 2, 360), at(0.1 * i));
    for (double t = 20.0; t < 20.3; t += 0.05)
        check_near("across 180 deg", cockpit_motion_at(&m, &angle, at(t)), remainder(179 + 2 * t, 360), 1e-6);
}

static void nonsense_changes_nothing(void **state) {
    (void)state;
    cockpit_motion m = {0};
    check_near("nothing known", cockpit_motion_at(&m, &kind, at(3)), 0, 0);
    cockpit_motion_frame(&m, &kind, NAN, at(0));
    assert_int_equal(m.frames, 0);
    cockpit_motion_frame(&m, &kind, 4, at(1));
    cockpit_motion_frame(&m, &kind, INFINITY, at(2));
    cockpit_motion_frame(&m, &kind, 4.5, at(0.5)); // older
    cockpit_motion_frame(&m, &kind, 4.5, at(1));   // of the same moment
    check_near("as it was", cockpit_motion_at(&m, &kind, at(1)), 4, 0);
    check_near("before its first frame", cockpit_motion_at(&m, &kind, at(0)), 4, 0);
}

// Whatever comes: finite, and no step without a frame larger than the speed allows.
static void anything_is_finite(void **state) {
    (void)state;
    cockpit_motion m = {0};
    uint64_t r = 1;
    int64_t t = 0;
    for (int i = 0; i < 200000; i++) {
        r = r * 6364136223846793005u + 1442695040888963407u;
        t += (int64_t)(r >> 34);
        const double value = (double)(int64_t)(r ^ (r << 21)) * ((r >> 7) % 3 ? 1e-18 : 1e250);
        cockpit_motion_frame(&m, (r >> 5) & 1 ? &kind : &angle, value, t);
        const double shown = cockpit_motion_at(&m, &kind, t + (int64_t)(r >> 30));
        if (!isfinite(shown))
            fail_msg("frame %d: shown %g", i, shown);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(line_is_followed),           cmocka_unit_test(it_holds),
        cmocka_unit_test(late_frames_do_not_jump),    cmocka_unit_test(jitter_does_not_shake),
        cmocka_unit_test(elsewhere_is_taken_at_once), cmocka_unit_test(angles_go_round),
        cmocka_unit_test(nonsense_changes_nothing),   cmocka_unit_test(anything_is_finite),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
