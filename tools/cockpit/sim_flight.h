/// A flight as messages: what each frame holds at each moment, and when each is sent. Pitch and roll, which no track
/// has, are those of a coordinated turn without wind along it: see sim_attitude_at().
#ifndef SIM_FLIGHT_H
#define SIM_FLIGHT_H

#include "port/canaerospace/skv_canaerospace.h"
#include "sim_motion.h"

/// How to read a flight.
typedef struct sim_flight_options {
    bool ellipsoid;        ///< a CSV's heights are above the ellipsoid
    igc_altitude altitude; ///< of an IGC file
    double visibility_m;   ///< sent as it is; [1, 1e6]
} sim_flight_options;

typedef struct sim_flight {
    flight track;
    double duration_s;
    double visibility_m;
    sim_posture *posture; ///< [fixes]
    bool knows_ellipsoid;
    size_t hint[SKV_CAS_MESSAGES][3];
    double last_s[SKV_CAS_MESSAGES];
} sim_flight;

/// Reads a flight. @return 0, or a status after an error line; on error nothing has to be freed.
int sim_flight_open(sim_flight *f, const char *path, const sim_flight_options *options);
void sim_flight_close(sim_flight *f);

/// One frame of a message as it is `after_s` after the first fix; behind the last fix the aircraft stands there and
/// time goes on.
/// @return 1; 0 iff the message cannot say it (a height beyond its range, no geoid grid): then nothing is sent.
int sim_flight_frame(sim_flight *f, skv_cas_sender *sender, skv_cas_index index, double after_s, skv_can_frame *frame);

/// A message's place in time.
typedef struct sim_slot {
    skv_cas_index index;
    int64_t phase_ns; ///< of the first frame, after the start
    int64_t period_ns;
} sim_slot;

/// The messages of a flight: fast ones every 100 ms, slow ones every second, spread so that no two are due within 2 ms.
/// The UTC goes out 8 ms after the second changes.
/// @param[out] slots  [SKV_CAS_MESSAGES], by rising id.
/// @return how many.
int sim_flight_slots(const sim_flight *f, double start_s, sim_slot *slots);

/// Share of a bus of this bit rate that the messages take at most, stuff bits at their worst. [0, 1] and above.
double sim_slots_load(const sim_slot *slots, int n, double bitrate);

#endif
