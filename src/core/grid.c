#include "core/grid.h"

#include <string.h>

#include "core/stages.h"

#if SKV_TERM_DIFFUSE

size_t skv_grid_size(const skv_frame *frame) {
    if (!frame || frame->layout != SKV_LAYOUT || !frame->model)
        return 0;
    return sizeof(float) * (size_t)(SKV_GRID_ROWS * SKV_GRID_AZIMUTHS * frame->lights * skv_bands(frame->model));
}

/// Direction of a point of the grid about a light; the two rows at the horizon lie a trace above and below it.
static void skv_grid_direction(const skv_frame *frame, int light, int row, int azimuth, float v[3]) {
    const skv_grid_span span = skv_grid_range(frame);
    const float *const s = frame->light[light].direction_enu;
    const float flat = skv_sqrtf(s[0] * s[0] + s[1] * s[1]);
    const float lx = flat > 1e-6f ? s[0] / flat : 1.0f, ly = flat > 1e-6f ? s[1] / flat : 0.0f;
    const int up = row < SKV_GRID_UP, i = up ? row : row - SKV_GRID_UP;
    const float t = (float)i / (float)((up ? SKV_GRID_UP : SKV_GRID_DOWN) - 1);
    const float range = up ? span.high - span.horizon : -1.0f - span.horizon;
    const float mu = span.horizon + range * skv_maxf(t * t, 1e-6f);
    const float sin_theta = skv_sqrtf(skv_maxf((1.0f - mu) * (1.0f + mu), 0.0f));
    const float half = (float)azimuth / (float)(SKV_GRID_AZIMUTHS - 1);
    const float c = 1.0f - 2.0f * half * half, d = 2.0f * half * skv_sqrtf((1.0f - half) * (1.0f + half));
    v[0] = sin_theta * (c * lx - d * ly);
    v[1] = sin_theta * (c * ly + d * lx);
    v[2] = mu;
}

/// One row of a light's grid.
static void skv_grid_row(const skv_frame *frame, int light, int row, float *out) {
    const int bands = skv_bands(frame->model);
    float v[SKV_GRID_AZIMUTHS][3], amount[SKV_GRID_AZIMUTHS * SKV_BANDS_MAX];
    for (int i = 0; i < SKV_GRID_AZIMUTHS; i++)
        skv_grid_direction(frame, light, row, i, v[i]);
    const skv_rays rays = {v[0], 0, NULL, 0};
    const skv_sky sky = {out, 0, NULL, 0};
    memset(out, 0, sizeof(float) * (size_t)(SKV_GRID_AZIMUTHS * bands));
    skv_diffuse_add(frame, light, SKV_GRID_AZIMUTHS, &rays, &sky);
    skv_grid_amounts_of(frame, SKV_GRID_AZIMUTHS, &rays, amount);
    for (int i = 0; i < SKV_GRID_AZIMUTHS * bands; i++)
        out[i] = amount[i] > 1e-12f ? out[i] / amount[i] : 0.0f;
}

skv_status skv_frame_grid(skv_frame *frame, float *grid, size_t n) {
    if (!frame || !grid)
        return SKV_ERR_NULL;
    if (frame->layout != SKV_LAYOUT || !frame->model || frame->model->layout != SKV_LAYOUT || !frame->diffuse.table)
        return SKV_ERR_LAYOUT;
    if (n < skv_grid_size(frame) || (uintptr_t)grid % sizeof(float) != 0)
        return SKV_ERR_SIZE;
    frame->diffuse.grid = NULL;
    const int row_floats = SKV_GRID_AZIMUTHS * skv_bands(frame->model);
    for (int light = 0; light < frame->lights; light++)
        for (int row = 0; row < SKV_GRID_ROWS; row++)
            skv_grid_row(frame, light, row, grid + (light * SKV_GRID_ROWS + row) * row_floats);
    frame->diffuse.grid = grid;
    return SKV_OK;
}

#else

size_t skv_grid_size(const skv_frame *frame) {
    (void)frame;
    return 0;
}

skv_status skv_frame_grid(skv_frame *frame, float *grid, size_t n) {
    (void)n;
    return frame && grid ? SKV_ERR_UNSUPPORTED : SKV_ERR_NULL;
}

#endif
