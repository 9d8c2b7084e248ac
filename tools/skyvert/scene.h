/// The core set up for one moment: model, frame, colours.
#ifndef SKYVERT_SCENE_H
#define SKYVERT_SCENE_H

#include "moment.h"
#include "sky_options.h"

typedef struct scene {
    const sky_options *options;
    skv_model model;
    bool has_model;
    double observer_km; ///< above the sea
    skv_frame frame;    ///< points to model: a scene is not copied
    size_t rays;        ///< evaluated since the scene was zeroed
    double core_s;      ///< and the processor time that took, radiance and colour
} scene;

/// Prepares a moment; call it again on the same scene for the next one. Zero it before the first. With an Earth preset
/// the sphere is the local one of the latitude and the sun's irradiance follows its distance.
/// @return 0, or a status after an error line.
int scene_begin(scene *view, const sky_options *options, const moment *now);

/// Linear RGB (1 = SKV_WHITE_LUMINANCE cd/m2) and, where not NULL, luminance (cd/m2) towards n directions.
/// @param[out] radiance  [n][4], for working.
/// @return false iff the core refused (a defect).
bool scene_colours(scene *view, size_t n, const float *direction_enu, float *radiance, float *rgb, float *luminance);

/// Luminance of the zenith, cd/m2.
double scene_zenith_luminance(scene *view);

/// Elevation of the geometric horizon, degrees, <= 0.
double scene_horizon_deg(const scene *view);

/// "262144 rays, 412 ns of processor time each (radiance and colour)" @return text
char *scene_timing(const scene *view, char *text, size_t size);

#endif
