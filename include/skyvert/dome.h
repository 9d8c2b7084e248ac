/// Meshes for the sky dome, and a frustum test that says which vertices need a colour. The caller's buffers.
///
/// Vertices are unit directions, east-north-up. First the zenith, then ring after ring down to `lowest_rad`, each with
/// `azimuths` vertices, clockwise seen from above, the first near north. There is no seam: the last column joins the
/// first. All vertices of a column have one azimuth, and within a column every vertex lies below the one before: no
/// triangle ever folds over another one, whatever the sun does.
#ifndef SKYVERT_DOME_H
#define SKYVERT_DOME_H

#include <stddef.h>
#include <stdint.h>

#include "skyvert/status.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum skv_dome_kind {
    SKV_DOME_EVEN = 0,    ///< rings evenly spaced in elevation, columns in azimuth
    SKV_DOME_HORIZON = 1, ///< ring elevations from the horizon ~ t^3 (dense at the horizon), mirrored below it
    /// As HORIZON, with the columns drawn together around the sun's azimuth (twice as dense there) and the rings,
    /// column by column, around the sun's elevation and, with the sun low, along the edge of the planet's shadow.
    /// Vertices move continuously with the sun, through the zenith and the horizon too: nothing pops. Next to the sun
    /// the sky between vertices is a third nearer to the true one than HORIZON's; over the whole sky the two are alike.
    SKV_DOME_ADAPTIVE = 2,
} skv_dome_kind;

typedef struct skv_dome {
    skv_dome_kind kind;
    int32_t rings;       ///< [2, 4096] above the horizon, the horizon's own included, the zenith vertex not
    int32_t rings_below; ///< [0, 4096] below it; the last is one vertex at the nadir where lowest_rad is -pi/2
    int32_t azimuths;    ///< [3, 16384]
    float horizon_rad;   ///< elevation of the geometric horizon, [-pi/2 + .01, 0]; -acos(R/(R+h))
    float lowest_rad;    ///< elevation of the lowest ring, [-pi/2, horizon_rad]; unused where rings_below is 0, else at
                         ///< least 4e-6 rad a ring below the horizon
    float sun_enu[3];    ///< ADAPTIVE only; any length but 0
    float height_km;     ///< ADAPTIVE only: observer above the ground, [0, 1e6]
    float radius_km;     ///< ADAPTIVE only: of the planet, [1, 1e5]
    float top_km;        ///< ADAPTIVE only: of the air, [.1, 1000], at most radius_km
} skv_dome;

/// Number of vertices and of triangle indices (three a triangle). Either pointer may be NULL.
/// @return SKV_OK; SKV_ERR_NULL iff dome is NULL; SKV_ERR_RANGE iff a field that is used is out of range or NaN;
///         SKV_ERR_DIRECTION iff the sun of an ADAPTIVE dome is zero, infinite or NaN; SKV_ERR_UNSUPPORTED iff there is
///         no such kind. On error nothing is written.
skv_status skv_dome_size(const skv_dome *dome, size_t *vertices, size_t *indices);

/// Writes directions [vertices][3] and indices [indices], triangles counter-clockwise seen from inside.
/// @param[out] direction_enu
/// @param[in]  stride           bytes from one direction to the next, 0 = packed; a multiple of 4.
/// @param[in]  vertex_capacity  vertices that direction_enu has room for.
/// @param[out] indices          NULL: not wanted (they depend on rings, rings_below, azimuths and whether there is a
/// nadir).
/// @param[in]  index_capacity   indices that `indices` has room for.
/// @return as skv_dome_size(); SKV_ERR_NULL iff direction_enu is NULL too; SKV_ERR_SIZE iff a capacity is smaller than
///         skv_dome_size() says or the stride is shorter than three floats or no multiple of 4. On error nothing is
///         written.
/// Error:  lengths 1 within 3e-7.
/// Cost:   O(vertices), two dozen operations and a sine each. No allocation. Thread-safe.
skv_status skv_dome_build(const skv_dome *dome, float *direction_enu, size_t stride, size_t vertex_capacity,
                          uint32_t *indices, size_t index_capacity);

/// A symmetric or asymmetric pyramid of view.
typedef struct skv_frustum {
    float forward_enu[3]; ///< any length but 0
    float up_enu[3];      ///< any length but 0, not along forward; need not be perpendicular to it
    float tan_left, tan_right, tan_down, tan_up; ///< of the half angles, > 0, [1e-4, 1e4]
    float margin_rad;                            ///< widens it on all sides, [0, 1.5]
} skv_frustum;

/// Writes the indices of the directions inside, ascending, to `visible` and their number to `count`.
///
/// Inside is what lies within margin_rad of each of the four planes' inner sides: everything within margin_rad of the
/// pyramid, and a little more at its edges. A triangle that is seen may have its corners outside: with margin_rad at
/// least the longest edge of the mesh every vertex of every seen triangle is selected.
/// @param[in]  direction_enu [n][3], any length but 0 (the position of a dome's vertex will do).
/// @param[in]  stride        bytes, 0 = packed; a multiple of 4.
/// @param[out] visible       [n] room for all.
/// @param[out] count
/// @return SKV_OK; SKV_ERR_NULL; SKV_ERR_RANGE iff a tangent or the margin is out of range or NaN; SKV_ERR_SIZE iff the
///         stride is shorter than three floats or no multiple of 4; SKV_ERR_DIRECTION iff forward or up is zero,
///         infinite or NaN, or up lies along forward within 1e-3 rad: nothing is written. SKV_ERR_DIRECTION iff some
///         direction is zero (shorter than 1.2e-38), infinite or NaN: it is left out, all others are answered and count
///         is written.
/// Error:  a direction within 1e-6 rad of the border may fall on either side.
skv_status skv_frustum_select(const skv_frustum *frustum, size_t n, const float *direction_enu, size_t stride,
                              uint32_t *visible, size_t *count);

#ifdef __cplusplus
}
#endif
#endif
