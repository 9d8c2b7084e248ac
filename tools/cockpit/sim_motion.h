/// How a flight moves: ways, courses, and the attitude that goes with them.
#ifndef SIM_MOTION_H
#define SIM_MOTION_H

#include "tools/skyvert/flight.h"

/// A way, m, or a speed, m/s.
typedef struct sim_motion {
    double north_m, east_m, up_m;
} sim_motion;

/// The straight way from a to b by the compass at `at`, which should be near: at the poles too. Up: the heights alone.
sim_motion sim_way(const fix *a, const fix *b, const fix *at);
double sim_course_deg(const sim_motion *m);

/// At a fix.
typedef struct sim_posture {
    float course_deg;          ///< of the way from here on; where it stands still, of the way that follows
    float pitch_deg, roll_deg; ///< see sim_attitude_at()
} sim_posture;

/// @return [fixes], to be freed; NULL iff memory ran out.
sim_posture *sim_postures(const flight *track);

/// Pitch and roll at a moment behind fix i. A track has neither: pitch is the angle of the flight path, roll that of a
/// coordinated turn without wind, tan roll = speed * turn rate / g, both from the ways before and behind each fix (3 s
/// or as far apart as the fixes are) and straight between the fixes. Within 45 and 60 deg; from 10 down to 5 m/s over
/// the ground they go to 0.
void sim_attitude_at(const flight *track, const sim_posture *postures, size_t i, double after_s, double *pitch_deg,
                     double *roll_deg);

#endif
