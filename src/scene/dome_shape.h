/// Where the vertices of a dome lie: azimuth of a column, elevation of a ring in it.
#ifndef SKV_SCENE_DOME_SHAPE_H
#define SKV_SCENE_DOME_SHAPE_H

#include "scene/vector.h"
#include "skyvert/dome.h"

/// Draws the ring coordinate t of a column together around `at`.
typedef struct skv_pull {
    float at;       ///< [0, 1]
    float strength; ///< [0, 1): the density there is 1/(1 - strength)
    float width;
    float end0, end1; ///< displacements that the ends must not suffer
} skv_pull;

typedef struct skv_column {
    float sin_az, cos_az;
    skv_pull shadow, sun;
} skv_column;

/// What all columns share.
typedef struct skv_dome_shape {
    const skv_dome *dome;
    bool adaptive;
    skv_vec3 sun;                     ///< its horizontal part faded out in the night
    float night;                      ///< 1 by day and in twilight, 0 in the night
    float sun_at;                     ///< ring coordinate of the sun
    float linear_above, linear_below; ///< share of the linear term in the spacing of the rings
} skv_dome_shape;

/// The dome is a valid one; sun is its unit vector, used for ADAPTIVE only.
skv_dome_shape skv_dome_shape_of(const skv_dome *dome, skv_vec3 sun);

/// Column j of the dome.
skv_column skv_dome_column(const skv_dome_shape *shape, int32_t j);

/// Unit vector of ring i (0 is the one next to the zenith) in a column.
skv_vec3 skv_dome_vertex(const skv_dome_shape *shape, const skv_column *column, int32_t ring);

#endif
