#include "cockpit_motion.h"

#include <math.h>

static double seconds(int64_t ns) {
    return 1e-9 * (double)ns;
}

static double wrapped(double x, double wrap) {
    return wrap > 0 ? remainder(x, wrap) : x;
}

static double clamp(double x, double limit) {
    return x > limit ? limit : x < -limit ? -limit : x;
}

/// Estimate without what fades.
static double estimate(const cockpit_motion *m, const cockpit_motion_kind *kind, int64_t now_ns) {
    return m->value + m->speed * fmax(0.0, fmin(seconds(now_ns - m->time_ns), kind->hold_s));
}

static void put(cockpit_motion *m, const cockpit_motion_kind *kind, double value, int64_t time_ns) {
    *m = (cockpit_motion){.value = value, .speed = kind->first_speed, .time_ns = time_ns, .frames = 1};
}

/// Value and speed after a frame that surprises by this much.
static void follow(cockpit_motion *m, const cockpit_motion_kind *kind, double value, double surprise, int64_t time_ns) {
    const double after_s = seconds(time_ns - m->time_ns);
    if (after_s > kind->hold_s) { // too long ago to tell a speed
        m->value = value;
        m->speed = kind->first_speed;
        m->frames = 1;
    } else if (after_s <
               0.5 * kind->period_s) { // held up and come in one heap: the newest counts, no speed can be told
        m->value = value;
    } else if (m->frames == 1) {
        m->speed = clamp(wrapped(value - m->value, kind->wrap) / after_s, kind->speed);
        m->value = value;
        m->frames = 2;
    } else {
        m->value = estimate(m, kind, time_ns) + kind->alpha * surprise;
        m->speed = clamp(m->speed + kind->beta * surprise / after_s, kind->speed);
    }
}

void cockpit_motion_frame(cockpit_motion *m, const cockpit_motion_kind *kind, double value, int64_t time_ns) {
    if (!isfinite(value))
        return;
    if (m->frames == 0) {
        put(m, kind, value, time_ns);
        return;
    }
    if (time_ns <= m->time_ns)
        return;
    const double surprise = wrapped(value - estimate(m, kind, time_ns), kind->wrap);
    if (fabs(surprise) > kind->jump) {
        put(m, kind, value, time_ns);
        return;
    }
    const double shown = cockpit_motion_at(m, kind, time_ns);
    follow(m, kind, value, surprise, time_ns);
    m->time_ns = time_ns;
    m->value = wrapped(m->value, kind->wrap);
    m->offset = wrapped(shown - m->value, kind->wrap);
}

double cockpit_motion_at(const cockpit_motion *m, const cockpit_motion_kind *kind, int64_t now_ns) {
    if (m->frames == 0)
        return 0.0;
    const double fade = exp(-fmax(0.0, seconds(now_ns - m->time_ns)) / kind->blend_s);
    return wrapped(estimate(m, kind, now_ns) + m->offset * fade, kind->wrap);
}
