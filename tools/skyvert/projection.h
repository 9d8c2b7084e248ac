/// From pixels to directions (east-north-up).
///
///     fisheye      equidistant, the zenith in the centre, north up and EAST LEFT: the sky as an all-sky camera that
///     lies
///                  on its back sees it. The circle of radius min(W,H)/2 is fov/2 from the zenith.
///     latlong      OpenEXR's latitude-longitude environment map, ends included: column 0 and the last one are south,
///                  north is the centre, east right of it; row 0 is the zenith, the last row the nadir.
///     perspective  a pinhole; the horizontal field of view is fov.
#ifndef SKYVERT_PROJECTION_H
#define SKYVERT_PROJECTION_H

#include <stdbool.h>

typedef enum projection_kind { PROJECTION_FISHEYE, PROJECTION_LATLONG, PROJECTION_PERSPECTIVE } projection_kind;

typedef struct projection {
    projection_kind kind;
    int width, height;
    double fov_deg;                       ///< fisheye, perspective
    double azimuth_deg, elevation_deg;    ///< perspective: of the centre
    double forward[3], right[3], down[3]; ///< perspective; right and down are steps of one pixel
} projection;

/// Derives the rest from kind, width, height, fov_deg, azimuth_deg, elevation_deg.
void projection_prepare(projection *map);

/// Direction of the point (x, y) of the picture, where (0, 0) is the centre of the first pixel of the first row.
/// @return how much of a pixel there is covered by the picture, [0, 1]; 0: the direction is not written.
double projection_direction(const projection *map, double x, double y, float direction_enu[3]);

/// Angle between neighbouring pixels where it is widest, radians.
double projection_spacing(const projection *map);

/// Solid angle of a pixel there, relative to others of the same picture.
double projection_weight(const projection *map, double x, double y);

#endif
