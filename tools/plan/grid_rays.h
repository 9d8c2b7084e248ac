/// Directions like those that skv_frame_grid() integrates (src/core/grid.c), for counting what it costs: rows that
/// crowd at the geometric horizon, azimuths of a half circle. Float only: it runs on every target.
#ifndef TOOLS_PLAN_GRID_RAYS_H
#define TOOLS_PLAN_GRID_RAYS_H

#include <math.h>

#include "skyvert/work.h"

enum { PLAN_GRID_UP = 24, PLAN_GRID_ROWS = 36, PLAN_GRID_AZIMUTHS = 13 };

static inline void plan_grid_row(const skv_frame *frame, int row, float v[PLAN_GRID_AZIMUTHS][3]) {
    const float h = frame->height_km, r = frame->radius_km + h, horizon = -sqrtf(h * (frame->radius_km + r)) / r;
    const float *const s = frame->light[0].direction_enu, flat = sqrtf(s[0] * s[0] + s[1] * s[1]);
    const float lx = flat > 1e-6f ? s[0] / flat : 1.0f, ly = flat > 1e-6f ? s[1] / flat : 0.0f;
    const int up = row < PLAN_GRID_UP, i = up ? row : row - PLAN_GRID_UP;
    const float t = (float)i / (float)((up ? PLAN_GRID_UP : PLAN_GRID_ROWS - PLAN_GRID_UP) - 1);
    const float mu = horizon + (up ? 1.0f - horizon : -1.0f - horizon) * fmaxf(t * t, 1e-6f);
    const float sine = sqrtf(fmaxf((1.0f - mu) * (1.0f + mu), 0.0f));
    for (int a = 0; a < PLAN_GRID_AZIMUTHS; a++) {
        const float half = (float)a / (float)(PLAN_GRID_AZIMUTHS - 1);
        const float c = 1.0f - 2.0f * half * half, d = 2.0f * half * sqrtf((1.0f - half) * (1.0f + half));
        v[a][0] = sine * (c * lx - d * ly);
        v[a][1] = sine * (c * ly + d * lx);
        v[a][2] = mu;
    }
}

/// Adds what one call of skv_radiance_work() says, or those of single rays, to the sum.
static inline void plan_work_add(const skv_frame *frame, size_t n, const skv_rays *rays, int one_lane, skv_work *sum) {
    const size_t step = one_lane ? 1 : n;
    for (size_t i = 0; i < n; i += step) {
        const skv_rays part = {rays->direction_enu + 3 * i, 0, rays->length_km ? rays->length_km + i : 0, 0};
        skv_work w;
        if (skv_radiance_work(frame, step, &part, &w) != SKV_OK)
            return;
        if (one_lane) { // lanes repeat the ray; every lit leg is a run of its own and waits for none
            w.runs = w.legs;
            w.low_runs = w.low_legs;
            w.copies = 0;
            w.diffuse_fine /= SKV_LANES;
            w.diffuse_fading /= SKV_LANES;
        }
        uint32_t *const to = &sum->blocks;
        const uint32_t *const from = &w.blocks;
        for (size_t k = 0; k < sizeof w / sizeof *from; k++)
            to[k] += from[k];
    }
}

/// The work of building a frame's grid: the diffuse counts of its directions. The frame has a table and no grid.
static inline void plan_grid_work(const skv_frame *frame, int one_lane, skv_work *sum) {
    for (int row = 0; row < PLAN_GRID_ROWS; row++) {
        float v[PLAN_GRID_AZIMUTHS][3];
        const skv_rays rays = {v[0], 0, 0, 0};
        plan_grid_row(frame, row, v);
        plan_work_add(frame, PLAN_GRID_AZIMUTHS, &rays, one_lane, sum);
    }
}

#endif
