#include "sim_motion.h"

#include <math.h>
#include <stdlib.h>

static const double degree = 3.14159265358979323846 / 180.0;

/// WGS 84 [NIMA00].
#define EARTH_RADIUS_M       6378137.0
#define EARTH_ECCENTRICITY_2 6.69437999014e-3
#define GRAVITY_M_S2         9.80665

static void to_centre(const fix *at, double p[3]) {
    const double lat = at->lat_deg * degree, lon = at->lon_deg * degree;
    const double prime = EARTH_RADIUS_M / sqrt(1.0 - EARTH_ECCENTRICITY_2 * sin(lat) * sin(lat));
    p[0] = (prime + at->height_m) * cos(lat) * cos(lon);
    p[1] = (prime + at->height_m) * cos(lat) * sin(lon);
    p[2] = (prime * (1.0 - EARTH_ECCENTRICITY_2) + at->height_m) * sin(lat);
}

sim_motion sim_way(const fix *a, const fix *b, const fix *at) {
    const double lat = at->lat_deg * degree, lon = at->lon_deg * degree;
    double p[3], q[3];
    to_centre(a, p);
    to_centre(b, q);
    const double x = q[0] - p[0], y = q[1] - p[1], z = q[2] - p[2];
    const double out = x * cos(lon) + y * sin(lon); // from the axis
    return (sim_motion){z * cos(lat) - out * sin(lat), y * cos(lon) - x * sin(lon), b->height_m - a->height_m};
}

double sim_course_deg(const sim_motion *m) {
    return atan2(m->east_m, m->north_m) / degree;
}

static double level_m(const sim_motion *m) {
    return hypot(m->north_m, m->east_m);
}

/// Beginning with the last: a way of under a metre takes the course of the one behind it.
static void find_courses(const flight *track, sim_posture *p) {
    const size_t n = track->count;
    bool known = false;
    size_t last = n; // fixes from here on stand still at the end
    for (size_t i = n - 1; i-- > 0;) {
        const fix *const a = &track->fixes[i];
        const sim_motion m = sim_way(a, a + 1, a);
        const bool moves = level_m(&m) >= 1.0;
        p[i].course_deg = moves ? (float)sim_course_deg(&m) : known ? p[i + 1].course_deg : 0.0f;
        if (moves && !known)
            last = i + 1;
        known = known || moves;
    }
    for (size_t i = last; i < n; i++)
        p[i].course_deg = p[last - 1].course_deg;
}

static float limited(double deg, double most, double share) {
    return (float)(share * fmax(-most, fmin(most, deg)));
}

/// From the ways of `span_s` before and behind a moment.
static void find_attitude(sim_posture *p, const fix around[3], double span_s) {
    const sim_motion to = sim_way(&around[0], &around[1], &around[1]), on = sim_way(&around[1], &around[2], &around[1]);
    const double before = level_m(&to) / span_s, behind = level_m(&on) / span_s;
    const double speed = 0.5 * (before + behind);
    const double turn = atan2(to.north_m * on.east_m - to.east_m * on.north_m,
                              to.north_m * on.north_m + to.east_m * on.east_m); // to the right, rad
    const double share = fmax(0.0, fmin(1.0, 0.2 * (fmin(before, behind) - 5.0)));
    p->pitch_deg = limited(atan2(to.up_m + on.up_m, 2.0 * speed * span_s) / degree, 45.0, share);
    p->roll_deg = limited(atan(speed * turn / span_s / GRAVITY_M_S2) / degree, 60.0, share);
}

/// Seconds from fix i to the next; 0 at the last.
static double step_s(const flight *track, size_t i) {
    return i + 1 < track->count ? utc_difference(&track->fixes[i + 1].utc, &track->fixes[i].utc) : 0.0;
}

static fix fix_at(const flight *track, double after_s) {
    size_t before = 0, behind = track->count - 1;
    while (behind - before > 1) {
        const size_t middle = (before + behind) / 2;
        if (utc_difference(&track->fixes[middle].utc, &track->fixes[0].utc) <= after_s)
            before = middle;
        else
            behind = middle;
    }
    return flight_at(track, after_s, &before);
}

static void find_attitudes(const flight *track, sim_posture *p) {
    const double all_s = flight_duration_s(track);
    double after_s = 0.0, before_s = 0.0;
    if (all_s <= 0.0)
        return;
    for (size_t i = 0; i < track->count; i++) {
        const double on_s = step_s(track, i);
        const double span_s = fmin(0.5 * all_s, fmax(3.0, fmax(before_s, on_s)));
        const double middle_s = fmax(span_s, fmin(all_s - span_s, after_s)); // the flight's ends are as their next
        fix around[3];
        for (int k = 0; k < 3; k++)
            around[k] = fix_at(track, middle_s + (k - 1) * span_s);
        find_attitude(&p[i], around, span_s);
        after_s += on_s;
        before_s = on_s;
    }
}

sim_posture *sim_postures(const flight *track) {
    sim_posture *const p = calloc(track->count, sizeof *p);
    if (!p)
        return NULL;
    find_courses(track, p);
    find_attitudes(track, p);
    return p;
}

void sim_attitude_at(const flight *track, const sim_posture *postures, size_t i, double after_s, double *pitch_deg,
                     double *roll_deg) {
    const double step = step_s(track, i), into_s = after_s - utc_difference(&track->fixes[i].utc, &track->fixes[0].utc);
    const double share = step > 0.0 ? fmax(0.0, fmin(1.0, into_s / step)) : 0.0;
    const sim_posture *const a = &postures[i], *const b = a + (step > 0.0);
    *pitch_deg = (1.0 - share) * (double)a->pitch_deg + share * (double)b->pitch_deg;
    *roll_deg = (1.0 - share) * (double)a->roll_deg + share * (double)b->roll_deg;
}
