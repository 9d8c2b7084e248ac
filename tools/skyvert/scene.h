/// The core set up for one moment: model, table, frame, what is around the sky, colours.
#ifndef SKYVERT_SCENE_H
#define SKYVERT_SCENE_H

#include "all_orders.h"
#include "around.h"
#include "moment.h"
#include "other_model.h"
#include "sky_options.h"

/// Processor time since the scene was zeroed, seconds, and rays.
typedef struct scene_cost {
    size_t rays, sampled; ///< all; those whose light scattered once was timed apart
    double radiance_s, once_s, around_s, colour_s, grid_s;
    size_t grids;
} scene_cost;

typedef struct scene {
    const sky_options *options;
    const other_model *other; ///< draws instead of the core; NULL: the core. Set after scene_begin()
    bool progress;            ///< set before scene_begin(): a bar where building the table takes long
    skv_model model;
    bool has_model;
    all_orders orders;
    double observer_km; ///< above the sea
    int lights;
    skv_light light[2]; ///< sun, moon
    skv_frame frame;    ///< points to model, table and grid: a scene is not copied
    skv_frame once;     ///< the same without a table, for --timing
    surroundings around;
    float *grid[2]; ///< of frame and of around.at_sea
    scene_cost cost;
} scene;

/// What pictures want of a scene beside the moment.
typedef struct scene_plan {
    size_t rays;      ///< that will be asked for: decides whether a grid pays
    float sample_rad; ///< angle between neighbouring rays: what discs are spread over
} scene_plan;

/// Prepares a moment; call it again on the same scene for the next one. Zero it before the first. With an Earth preset
/// the sphere is the local one of the latitude and the sun's irradiance follows its distance.
/// @return 0, or a status after an error line.
int scene_begin(scene *view, const sky_options *options, const moment *now, const scene_plan *plan);
void scene_end(scene *view);

/// Linear RGB (1 = SKV_WHITE_LUMINANCE cd/m2) and, where not NULL, luminance (cd/m2) towards n directions.
/// @param[out] radiance  [n][4], for working.
/// @return false iff the core refused (a defect).
bool scene_colours(scene *view, size_t n, const float *direction_enu, float *radiance, float *rgb, float *luminance);

/// Luminance of the zenith without discs, cd/m2, and the catalogue magnitude of a star that is just seen there.
typedef struct scene_zenith_light {
    double luminance, limiting_magnitude;
} scene_zenith_light;
scene_zenith_light scene_zenith(scene *view);

/// Elevation of the geometric horizon, degrees, <= 0.
double scene_horizon_deg(const scene *view);

/// What table and rays cost, two lines. @return text
char *scene_timing(const scene *view, char *text, size_t size);

#endif
