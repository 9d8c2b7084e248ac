/// Stages of skv_radiance() that other files of the core call.
#ifndef SKV_CORE_STAGES_H
#define SKV_CORE_STAGES_H

#include "skyvert/radiance.h"

/// Adds light of one light that was scattered at least twice, by integration.
void skv_diffuse_add(const skv_frame *frame, int light, size_t n, const skv_rays *rays, const skv_sky *sky);

/// n(tau) of whole rays (grid.h), [n][bands].
void skv_grid_amounts_of(const skv_frame *frame, size_t n, const skv_rays *rays, float *amount);

#endif
