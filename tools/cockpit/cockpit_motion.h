/// A value that comes in frames and is shown between them: smoothed, extrapolated, held. Pure.
///
/// Tracked by an alpha-beta filter. What is shown never jumps: where a frame moves the estimate, the difference to what
/// was shown fades away. Only a step larger than `jump` (the aircraft was put elsewhere) is taken at once.
#ifndef COCKPIT_MOTION_H
#define COCKPIT_MOTION_H

#include <stdint.h>

typedef struct cockpit_motion_kind {
    double alpha, beta; ///< shares of a frame's surprise that go into value and speed, (0, 1]
    double jump;        ///< larger steps are no motion
    double speed;       ///< largest speed, per second
    double first_speed; ///< per second, before there are two frames
    double period_s;    ///< of the frames
    double hold_s;      ///< after so long without a frame the value stands still
    double blend_s;     ///< time constant of the fading
    double wrap;        ///< 360 for angles that go round; 0
} cockpit_motion_kind;

typedef struct cockpit_motion {
    double value, speed; ///< at time_ns
    double offset;       ///< shown minus estimated, at time_ns
    int64_t time_ns;     ///< of the last frame
    uint32_t frames;     ///< since it was put there; 0: nothing is known
} cockpit_motion;

/// A frame. One that is not newer than the last is passed over, and so is NaN.
void cockpit_motion_frame(cockpit_motion *m, const cockpit_motion_kind *kind, double value, int64_t time_ns);

/// What is shown at a time; 0 where nothing is known. Angles that wrap are within +-wrap/2.
double cockpit_motion_at(const cockpit_motion *m, const cockpit_motion_kind *kind, int64_t now_ns);

#endif
