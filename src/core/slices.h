/// Where one map does not fit a whole leg it is cut into slices:
/// - at corners of a tabulated density, and at the upper end of a layer that is thin against the map;
/// - on legs towards the observer through opaque air, whose map crowds at a far end that nobody sees: at the altitude
/// where
///   a horizontal ray has an optical depth of about 1, and, from within fog, at the optical depth that can be seen.
#ifndef SKV_CORE_SLICES_H
#define SKV_CORE_SLICES_H

#include "core/gauss.h"

#if SKV_RULE_GAUSS_EXP

/// Optical depths from the observer where a leg in fog is cut, and from which on it is.
#define SKV_FOG_NEAR 6.0f
#define SKV_FOG_FROM 12.0f

/// Number of slices of every leg; most are empty for most lanes.
SKV_INLINE int skv_slices(const skv_frame *frame) {
    return frame->breaks + (frame->fog_per_km > 0.0f ? 2 : 1);
}

/// Far end of slice i: what fog hides comes first, then each break's altitude as a distance from the leg's origin;
/// `from`, the near end, where a cut does not apply to the lane.
SKV_INLINE void skv_slice_end(const skv_frame *frame, const skv_legs *leg, int i, const skv_lanes *from,
                              skv_lanes *to) {
    const int fog = frame->fog_per_km > 0.0f, at = i - fog;
    if (at < 0) {
        const float near = SKV_FOG_NEAR / frame->fog_per_km, least = SKV_FOG_FROM / frame->fog_per_km;
        SKV_EACH_LANE(l) {
            const int cut = (leg->sigma.v[l] > 0.0f) & (leg->end.v[l] > least);
            to->v[l] = cut ? skv_maxf(leg->end.v[l] - near, from->v[l]) : from->v[l];
        }
    } else if (at < frame->breaks) {
        const float z = frame->break_km[at], radius = frame->radius_km;
        const float inbound = (frame->break_inbound >> at & 1u) != 0 ? 0.0f : -2.0f;
        SKV_EACH_LANE(l) {
            const float s = skv_to_top(radius, z, leg->h_km.v[l], leg->rm.v[l]);
            to->v[l] = leg->sigma.v[l] > inbound ? skv_maxf(s, from->v[l]) : from->v[l];
        }
    } else {
        SKV_EACH_LANE(l) to->v[l] = SKV_FAR_KM;
    }
}

#endif

#endif
