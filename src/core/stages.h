/// Stages of skv_radiance(), each in a file of its own.
#ifndef SKV_CORE_STAGES_H
#define SKV_CORE_STAGES_H

#include "core/rays.h"

/// diffuse.c: adds light of one light that was scattered at least twice, by integration.
void skv_diffuse_add(const skv_frame *frame, int light, size_t n, const skv_rays *rays, const skv_sky *sky);

/// grid.c: adds the same to a block's rays from the frame's grid.
void skv_grid_add(const skv_frame *frame, int light, size_t first, const skv_block *block, const skv_columns k[2],
                  const skv_sky *sky);

/// Whether rays take their diffuse light from the grid.
SKV_INLINE int skv_grid_used(const skv_frame *frame, const skv_rays *rays) {
    return SKV_TERM_DIFFUSE && frame->diffuse.grid && !rays->length_km;
}

/// ends.c: what stands at the end of the rays; for the midpoint rules the grid's light on the way. @return whether any
/// ray was refused.
int skv_ends(const skv_frame *frame, size_t n, const skv_rays *rays, const skv_sky *sky);

#endif
