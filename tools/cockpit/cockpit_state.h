/// What the bus has said, and what it means at a moment: position, time, sun, and what of it is stale. No I/O.
#ifndef COCKPIT_STATE_H
#define COCKPIT_STATE_H

#include <stdbool.h>

#include "cockpit_motion.h"
#include "port/canaerospace/skv_canaerospace.h"
#include "skyvert/skyvert.h"

typedef struct cockpit_state {
    skv_cas_receiver cas;
    cockpit_motion latitude, longitude, height, clock, sun_azimuth, sun_elevation;
    skv_cas_index height_from;
    double learnt_m;           ///< height above the ellipsoid less that above the sea, while both came
    uint32_t learnt;           ///< frames of it; 0: none
    int64_t learnt_ns;         ///< of the last one
    int64_t first_ns, last_ns; ///< of accepted frames; last_ns 0: none
    uint64_t accepted;
    // Knobs of this cockpit.
    double time_offset_s;
    double visibility_km;         ///< 0: as the bus says
    double default_visibility_km; ///< where the bus says nothing
    double geoid_m;               ///< height of the sea above the ellipsoid here; 0 unless set after the beginning
} cockpit_state;

/// A moment as it is shown.
typedef struct cockpit_now {
    bool has_position, has_height, has_time, has_sun; ///< was ever known
    bool sun_by_bus;
    bool position_stale, height_stale, time_stale; ///< of what was ever known
    bool held;                                     ///< nothing of it is fresh
    double latitude_deg, longitude_deg;
    double height_m;     ///< above the sea; by pressure where the bus says nothing better
    skv_cas_datum datum; ///< what the bus's own height is above
    double geoid_m;      ///< with SKV_CAS_ELLIPSOID: what was taken from it
    skv_utc utc;
    double time_offset_s;
    skv_sun sun;
    bool has_moon;
    skv_moon moon;
    double visibility_km; ///< wanted
    double exposure;      ///< m2/cd by the bus; 0: it says none
    int stale;            ///< values that went stale
} cockpit_now;

void cockpit_state_begin(cockpit_state *s, double default_visibility_km);

/// Takes a frame. @return what became of it
skv_cas_count cockpit_state_frame(cockpit_state *s, const skv_can_frame *frame, int64_t time_ns);

/// What is to be shown at a moment; ages the values.
void cockpit_state_now(cockpit_state *s, int64_t now_ns, cockpit_now *now);

/// Ids that the cockpit listens to: the values it needs, and identification requests. @return how many, at most `room`
int cockpit_state_ids(uint32_t *ids, int room);

/// Names of stale values, separated by blanks; "..." where they do not fit. @return text
const char *cockpit_state_stale(const cockpit_state *s, char *text, size_t size);

#endif
