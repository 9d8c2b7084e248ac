/// Where one map does not fit a whole leg it is cut into slices: at corners of a tabulated density; at the upper end of
/// a layer that is thin against the map; and, on legs towards the observer through opaque air, whose map crowds at a
/// far end that nobody sees, where a horizontal ray has an optical depth of about 1 and, from within fog, at the
/// optical depth that can be seen.
#ifndef SKV_CORE_SLICES_H
#define SKV_CORE_SLICES_H

#include "core/legs.h"

/// Number of slices of these legs; most are empty for most lanes. 1 where every cut is for legs towards the observer
/// and none of these is.
SKV_INLINE int skv_slices(const skv_frame *frame, const skv_legs *leg) {
    const int cuts = frame->breaks + (frame->fog_km > 0.0f);
    uint32_t outbound = ~0u;
    if (cuts == 0)
        return 1;
    SKV_EACH_LANE(l) outbound &= skv_bits(leg->sigma.v[l]);
    const int none = (outbound & 0x80000000u) != 0 && frame->break_inbound + 1u == 1u << frame->breaks;
    return none ? 1 : cuts + 1;
}

/// Far end b of slice i but the last, whose near end is a: what fog hides comes first, then each break's altitude as a
/// distance from the leg's origin; a, where a cut does not apply to the lane, and never beyond `last`.
SKV_INLINE void skv_slice_end(const skv_frame *frame, skv_legs *leg, int i, const skv_lanes *last) {
    const float fog = frame->fog_km;
    const int at = i - (fog > 0.0f);
    if (at < 0) {
        SKV_EACH_LANE(l) {
            const float s = leg->sigma.v[l] > 0.0f ? leg->end.v[l] - fog : 0.0f;
            leg->b.v[l] = skv_minf(skv_maxf(s, leg->a.v[l]), last->v[l]);
        }
        return;
    }
    const float z = frame->break_km[at], radius = frame->radius_km;
    const float inbound = (frame->break_inbound >> at & 1u) != 0 ? 0.0f : -2.0f;
    SKV_EACH_LANE(l) {
        const float to = skv_to_top(radius, z, leg->h_km.v[l], leg->rm.v[l]);
        const float s = leg->sigma.v[l] > inbound ? to : 0.0f;
        leg->b.v[l] = skv_minf(skv_maxf(s, leg->a.v[l]), last->v[l]);
    }
}

#endif
