/// From the caller's rays to blocks of lanes, and from those to legs: pieces on which the altitude only grows with the
/// distance from their origin.
///
///     up       one leg from the observer                       dir = +1
///     tangent  one from the tangent point to the observer,     dir = -1
///              one from the tangent point onwards              dir = +1 (part 1)
///     ground   one from the ground to the observer             dir = -1
#ifndef SKV_CORE_RAYS_H
#define SKV_CORE_RAYS_H

#include "skyvert/radiance.h"

#include "core/column.h"

/// Longer than any ray through air.
#define SKV_FAR_KM 1e9f

typedef struct skv_block {
    int count;              ///< lanes in use; the others repeat an empty ray
    int parts;              ///< 2 iff some lane has a tangent point
    int bad;                ///< some direction or length was refused
    skv_lanes valid;        ///< 0: this one, else 1
    skv_lanes view[3];      ///< unit
    skv_lanes start_km;     ///< from the observer to where the air begins
    skv_lanes p_km;         ///< r sin(zenith angle)
    skv_lanes rm;           ///< r mu at the start
    skv_lanes h_km;         ///< altitude of the start
    skv_lanes length_km;    ///< from the start to the end
    skv_lanes meets_ground; ///< 1: the end is on the ground
    struct {
        skv_lanes h_km, rm; ///< at the origin; rm >= 0
        skv_lanes from_km;  ///< from the observer to the origin
        skv_lanes dir;
        skv_lanes a, b; ///< range, km from the origin
    } leg[2];
} skv_block;

static inline const float *skv_at(const float *base, size_t stride, size_t fields, size_t i) {
    return (const float *)(const void *)((const char *)base + i * (stride ? stride : fields * sizeof(float)));
}

static inline float *skv_at_mutable(float *base, size_t stride, size_t fields, size_t i) {
    return (float *)(void *)((char *)base + i * (stride ? stride : fields * sizeof(float)));
}

/// What a light means to the rays of a block.
typedef struct skv_block_light {
    skv_lanes nu;     ///< cos(view, light)
    skv_lanes cross2; ///< 1 - nu^2, from the difference of the directions
    skv_lanes climb;  ///< (view - nu light) . up
    skv_lanes phase[SKV_SCATTERERS];
} skv_block_light;

/// Rays [first, first + SKV_LANES) of n; lanes beyond the last one repeat it.
void skv_block_load(const skv_frame *frame, size_t n, size_t first, const skv_rays *rays, skv_block *restrict b);

/// Constants K of the view columns K + sigma col(P): up col(O), towards the observer -col(O), past the tangent point
/// 2 col(T) - col(O), each column taken upward from the start of the air.
void skv_block_columns(const skv_frame *frame, unsigned has, const skv_block *b, skv_columns k[restrict 2]);

void skv_block_toward(const skv_frame *frame, unsigned has, int light, const skv_block *b,
                      skv_block_light *restrict out);

#endif
