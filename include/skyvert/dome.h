/// Meshes for the sky dome, and a frustum test that says which vertices need a colour. The caller's buffers.
///
/// Vertices are unit directions, east-north-up. Rings run from the zenith (one vertex) down to `lowest_rad`, each ring
/// has `azimuths` vertices starting at `azimuth0_rad` (clockwise from north); without a seam (the last column joins the first).
#ifndef SKYVERT_DOME_H
#define SKYVERT_DOME_H

#include <stddef.h>
#include <stdint.h>

#include "skyvert/status.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum skv_dome_kind {
    SKV_DOME_EVEN = 0,     ///< rings evenly spaced in elevation
    SKV_DOME_HORIZON = 1,  ///< ring elevations above the horizon ~ t^3 (dense at the horizon), mirrored below it
    SKV_DOME_ADAPTIVE = 2, ///< as HORIZON, columns drawn together around the sun's azimuth and rings moved to the sun's
                           ///< elevation and, with the sun low, to the edge of the planet's shadow
} skv_dome_kind;

typedef struct skv_dome {
    skv_dome_kind kind;
    int32_t rings;        ///< [2, 4096] above the horizon, the horizon's own included, the zenith vertex not
    int32_t rings_below;  ///< [0, 4096] below it; the last is one vertex at the nadir when lowest is -pi/2
    int32_t azimuths;     ///< [3, 16384]
    float horizon_rad;    ///< elevation of the geometric horizon, [-pi/2 + .01, 0]; -acos(R/(R+h))
    float lowest_rad;     ///< elevation of the lowest ring, [-pi/2, horizon_rad]
    float sun_enu[3];     ///< ADAPTIVE only; any length but 0
    float height_km, radius_km, top_km; ///< ADAPTIVE only: observer and planet, for the shadow's edge
} skv_dome;

/// Number of vertices and of triangle indices (three a triangle).
skv_status skv_dome_size(const skv_dome *dome, size_t *vertices, size_t *indices);

/// Writes directions [vertices][3] and indices [indices], counter-clockwise seen from inside.
/// @param stride  bytes from one direction to the next, 0 = packed. indices may be NULL.
/// @return SKV_OK; SKV_ERR_NULL; SKV_ERR_RANGE; SKV_ERR_SIZE iff capacity is smaller than skv_dome_size() says. On error nothing is written.
skv_status skv_dome_build(const skv_dome *dome, float *direction_enu, size_t stride, size_t vertex_capacity,
                          uint32_t *indices, size_t index_capacity);

/// A symmetric or asymmetric pyramid of view.
typedef struct skv_frustum {
    float forward_enu[3];
    float up_enu[3];
    float tan_left, tan_right, tan_down, tan_up; ///< of the half angles, > 0, [1e-4, 1e4]
    float margin_rad;                            ///< widens it on all sides, [0, 1.5]
} skv_frustum;

/// Writes the indices of the directions inside to `visible` and their number to `count`.
/// @param[out] visible [n] room for all.
skv_status skv_frustum_select(const skv_frustum *frustum, size_t n, const float *direction_enu, size_t stride,
                              uint32_t *visible, size_t *count);

#ifdef __cplusplus
}
#endif
#endif
