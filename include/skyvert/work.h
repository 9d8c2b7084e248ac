/// What a call of skv_radiance() will do, counted without doing it: for planners that predict its cost (`skyvert
/// plan`).
#ifndef SKYVERT_WORK_H
#define SKYVERT_WORK_H

#include <stddef.h>
#include <stdint.h>

#include "skyvert/radiance.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Events of a call, for the SKV_LANES of this build. With one ray a call they are those of a build with one lane.
typedef struct skv_work {
    uint32_t blocks;   ///< of SKV_LANES rays, per light
    uint32_t parts;    ///< of blocks: one each, or two where some ray has a tangent point
    uint32_t shadows;  ///< parts in which the planet's shadow is looked for
    uint32_t copies;   ///< lit legs that wait for others to fill their lanes
    uint32_t legs;     ///< lit legs
    uint32_t runs;     ///< of the integral over light scattered once, SKV_LANES legs each
    uint32_t low_runs; ///< of these where a light may be below the horizontal of a sample: dearer
    uint32_t low_legs; ///< lit legs of that kind
    uint32_t grounds;  ///< rays that end on the ground, per light
    /// Light scattered more than once, integrated ray by ray (a frame with a table and no grid, or rays with a length):
    uint32_t diffuse_parts;
    uint32_t diffuse_slices; ///< pieces of legs
    uint32_t diffuse_nodes;  ///< of these, SKV_LANES samples each
    uint32_t diffuse_fine;   ///< samples where the table has fine numbers
    uint32_t diffuse_fading; ///< samples between rows with and without them
    uint32_t diffuse_loads;  ///< squares of four cells that are read
} skv_work;

/// @param[in]  frame, n, rays  as for skv_radiance(); the rule gauss-exp only.
/// @param[out] work
/// @return SKV_OK; SKV_ERR_NULL; SKV_ERR_LAYOUT; SKV_ERR_UNSUPPORTED iff the rule is another one or left out. On error
///         nothing is written.
/// Cost:   some hundred instructions a ray, more with diffuse light. No allocation. Thread-safe.
skv_status skv_radiance_work(const skv_frame *frame, size_t n, const skv_rays *rays, skv_work *work);

#ifdef __cplusplus
}
#endif
#endif
