/// Points of a scene's ranges: frames (air, height, sun) and what is drawn in each. Everything follows from a seed.
#ifndef TOOLS_PLAN_SAMPLE_H
#define TOOLS_PLAN_SAMPLE_H

#include "tools/plan/scene.h"

typedef struct plan_frame {
    int air; ///< of plan_air()
    double height_km, sun_deg;
} plan_frame;

/// The sun stands in the north; azimuths count from it.
typedef struct plan_ray {
    double elevation_deg, azimuth_deg;
    double length_km; ///< INFINITY: none
} plan_ray;

/// Frame i of a sequence that covers the ranges evenly, however many are taken [Halton64].
plan_frame plan_frame_at(const plan_scene *scene, unsigned seed, int i);
/// Direction j of n in frame i, even in elevation as a dome's vertices are.
plan_ray plan_view_at(const plan_scene *scene, unsigned seed, int i, int j, int n);
/// Ray j of n in frame i that ends on terrain: near the horizon, its length even in the logarithm.
plan_ray plan_terrain_at(const plan_scene *scene, unsigned seed, int i, int j, int n);
/// Vertex i of n of the dome that costs are counted with: rings even in elevation, twice as many azimuths.
plan_ray plan_dome_at(const plan_scene *scene, int i, int n);

/// East, north, up.
void plan_direction(const plan_ray *ray, float direction[3]);
void plan_sun_direction(const plan_frame *frame, float direction[3]);

/// Vertices without and with a length of a dome of `vertices`.
typedef struct plan_vertices {
    int dome, terrain;
} plan_vertices;
plan_vertices plan_share(const plan_scene *scene, int vertices);

#endif
