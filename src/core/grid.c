/// The diffuse light of a frame on a grid of directions: rows over the elevation, split at the geometric horizon and
/// crowding there with t^2, columns over half the azimuth from each light, evenly in sin(phi/2).
///
/// The grid holds the light over n(tau), tau the optical depth of the whole ray: what is left varies little even where
/// the path changes fast. n(tau) = 1 - 1/(1 + tau + tau^2/2 + tau^3/6) stands for 1 - exp(-tau): no cancellation where
/// the air is thin, no exponential.
#include "skyvert/table.h"

#include <string.h>

#include "core/rays.h"
#include "core/stages.h"

#if SKV_TERM_DIFFUSE

#define SKV_GRID_UP   24
#define SKV_GRID_DOWN 12
#define SKV_GRID_ROWS (SKV_GRID_UP + SKV_GRID_DOWN)
/// With 8, one block of lanes, the horizon of a high sun shows a line of 1 %.
#define SKV_GRID_AZIMUTHS 13

SKV_INLINE float skv_grid_amount(float tau) {
    const float t = tau * (1.0f + tau * (0.5f + tau * (1.0f / 6.0f)));
    return t / (1.0f + t);
}

/// What of the grid's axes is the same for all rays.
static void skv_grid_axes(skv_frame *frame) {
    skv_frame_diffuse *const d = &frame->diffuse;
    const float h = frame->height_km, r = frame->radius_km + h;
    d->grid_horizon = -skv_sqrtf(h * (frame->radius_km + r)) / r;
    d->grid_up = 1.0f / (1.0f - d->grid_horizon);
    d->grid_down = 1.0f / (1.0f + d->grid_horizon);
    for (int32_t i = 0; i < frame->lights; i++) {
        const float *const s = frame->light[i].direction_enu, flat = skv_sqrtf(s[0] * s[0] + s[1] * s[1]);
        d->grid_flat[i][0] = flat > 1e-6f ? s[0] / flat : 1.0f;
        d->grid_flat[i][1] = flat > 1e-6f ? s[1] / flat : 0.0f;
        d->grid_left[i][0] = -d->grid_flat[i][1];
        d->grid_left[i][1] = d->grid_flat[i][0];
    }
}

/// Optical depth of the air along whole rays, per band, times log2(e): to the ground, or past the top as the closed
/// form counts it.
SKV_INLINE void skv_grid_columns(const skv_frame *frame, unsigned has, const skv_block *block, const skv_columns k[2],
                                 skv_columns *out) {
    uint32_t hits = 0;
    SKV_EACH_LANE(l) hits |= skv_bits(block->meets_ground.v[l]);
    SKV_EACH_SPECIES(s)
    if (SKV_PRESENT(has, s))
        SKV_EACH_LANE(l) {
            const float far = block->parts == 2 ? k[1].of[s].v[l] : 0.0f, near = k[0].of[s].v[l];
            out->of[s].v[l] = block->leg[0].dir.v[l] < 0.0f ? far : near;
        }
    if (hits != 0) {
        skv_points p;
        skv_columns up;
        skv_lanes mu, sin_chi, zero;
        SKV_EACH_LANE(l) zero.v[l] = 0.0f;
        skv_points_above(frame, has, &zero, &p);
        SKV_EACH_LANE(l) {
            mu.v[l] = skv_minf(block->leg[0].rm.v[l] * p.inv_r.v[l], 1.0f);
            sin_chi.v[l] = skv_minf(block->p_km.v[l] * p.inv_r.v[l], 1.0f);
        }
        skv_columns_up(frame, has, &p, &mu, &sin_chi, &up);
        SKV_EACH_SPECIES(s)
        if (SKV_PRESENT(has, s))
            SKV_EACH_LANE(l) {
                const float to = k[0].of[s].v[l] + up.of[s].v[l];
                // leg[0].h_km is 0 for rays to the ground only.
                out->of[s].v[l] = block->meets_ground.v[l] > 0.0f ? to : out->of[s].v[l];
            }
    }
    SKV_EACH_SPECIES(s)
    if (SKV_PRESENT(has, s))
        SKV_EACH_LANE(l) out->of[s].v[l] = skv_maxf(out->of[s].v[l], 0.0f);
}

/// n(tau) of a band, lanes.
SKV_INLINE void skv_grid_amounts(const skv_frame *frame, unsigned has, const skv_columns *c, int b, skv_lanes *amount) {
    const float ln2 = 0.693147181f;
    SKV_EACH_LANE(l)
    amount->v[l] = skv_grid_amount(skv_minf(ln2 * skv_optical_depth_log2e(frame, has, c, b, l), 1e4f));
}

/// Where directions lie in the grid.
typedef struct skv_grid_place {
    int32_t at[SKV_LANES]; ///< of the first of four corners: row * azimuths + azimuth
    skv_lanes wx, wy;      ///< towards the next azimuth, the next row
} skv_grid_place;

SKV_INLINE void skv_grid_find(const skv_frame *frame, int light, const skv_block *block, skv_grid_place *p) {
    const float horizon = frame->diffuse.grid_horizon;
    const float inv_up = frame->diffuse.grid_up, inv_down = frame->diffuse.grid_down;
    const float lx = frame->diffuse.grid_flat[light][0], ly = frame->diffuse.grid_flat[light][1];
    SKV_EACH_LANE(l) {
        const float x = block->view[0].v[l], y = block->view[1].v[l], mu = block->view[2].v[l];
        const float inv = 1.0f / skv_root(skv_maxf(x * x + y * y, 1e-24f));
        const float dx = x * inv - lx, dy = y * inv - ly;
        const float u = skv_minf(0.5f * skv_root(dx * dx + dy * dy), 1.0f) * (float)(SKV_GRID_AZIMUTHS - 1);
        const int down = block->meets_ground.v[l] > 0.0f;
        const float t = down ? (horizon - mu) * inv_down : (mu - horizon) * inv_up;
        const float v = skv_root(skv_clampf(t, 0.0f, 1.0f)) * (float)((down ? SKV_GRID_DOWN : SKV_GRID_UP) - 1);
        int32_t i = (int32_t)u, j = (int32_t)v;
        i = i > SKV_GRID_AZIMUTHS - 2 ? SKV_GRID_AZIMUTHS - 2 : i;
        const int32_t most = (down ? SKV_GRID_DOWN : SKV_GRID_UP) - 2;
        j = j > most ? most : j;
        p->wx.v[l] = u - (float)i;
        p->wy.v[l] = v - (float)j;
        p->at[l] = (j + (down ? SKV_GRID_UP : 0)) * SKV_GRID_AZIMUTHS + i;
    }
}

/// Adds the diffuse light of one light to a block's rays.
void skv_grid_add(const skv_frame *frame, int light, size_t first, const skv_block *block, const skv_columns k[2],
                  const skv_sky *sky) {
    const unsigned has = frame->has & SKV_HAS_BUILT;
    const int bands = SKV_BANDS_OF(has);
    const float *const grid = frame->diffuse.grid + light * SKV_GRID_ROWS * SKV_GRID_AZIMUTHS * bands;
    skv_columns c;
    skv_grid_place p;
    skv_lanes amount[SKV_BANDS_MAX];
    skv_grid_columns(frame, has, block, k, &c);
    skv_grid_find(frame, light, block, &p);
    for (int b = 0; b < bands; b++)
        skv_grid_amounts(frame, has, &c, b, &amount[b]);
    const size_t stride = sky->radiance_stride ? sky->radiance_stride : (size_t)bands * sizeof(float);
    char *at = (char *)sky->radiance + first * stride;
    for (int l = 0; l < block->count; l++, at += stride) {
        float *const out = (float *)(void *)at;
        const float *const g = grid + p.at[l] * bands, *const next = g + SKV_GRID_AZIMUTHS * bands;
        const float wx = p.wx.v[l], wy = p.wy.v[l], w11 = wx * wy, w10 = wy - w11, w01 = wx - w11;
        const float w00 = 1.0f - wy - w01, scale = block->valid.v[l];
        for (int b = 0; b < bands; b++) {
            const float x = w00 * g[b] + w01 * g[bands + b] + w10 * next[b] + w11 * next[bands + b];
            out[b] = skv_minf(out[b] + scale * x * amount[b].v[l], SKV_RADIANCE_MAX);
        }
    }
}

/// Divides the light of whole rays, [n][bands], by n(tau).
static void skv_grid_divide(const skv_frame *frame, size_t n, const skv_rays *rays, float *light) {
    const unsigned has = frame->has & SKV_HAS_BUILT;
    const size_t bands = (size_t)SKV_BANDS_OF(has);
    for (size_t first = 0; first < n; first += SKV_LANES) {
        skv_block block;
        skv_columns k[2], c;
        skv_lanes of;
        skv_block_load(frame, n, first, rays, &block);
        skv_block_columns(frame, has, &block, k);
        skv_grid_columns(frame, has, &block, k, &c);
        for (size_t b = 0; b < bands; b++) {
            skv_grid_amounts(frame, has, &c, (int)b, &of);
            for (int l = 0; l < block.count; l++) {
                float *const at = &light[(first + (size_t)l) * bands + b];
                *at = of.v[l] > 1e-12f ? *at / of.v[l] : 0.0f;
            }
        }
    }
}

size_t skv_grid_size(const skv_frame *frame) {
    if (!frame || frame->layout != SKV_LAYOUT || !frame->model)
        return 0;
    return sizeof(float) * (size_t)(SKV_GRID_ROWS * SKV_GRID_AZIMUTHS * frame->lights * skv_bands(frame->model));
}

/// Direction of a point of the grid about a light; the two rows at the horizon lie a trace above and below it.
static void skv_grid_direction(const skv_frame *frame, int light, int row, int azimuth, float v[3]) {
    const float horizon = frame->diffuse.grid_horizon;
    const float *const flat = frame->diffuse.grid_flat[light], *const left = frame->diffuse.grid_left[light];
    const int up = row < SKV_GRID_UP, i = up ? row : row - SKV_GRID_UP;
    const float t = (float)i / (float)((up ? SKV_GRID_UP : SKV_GRID_DOWN) - 1);
    const float range = up ? 1.0f - horizon : -1.0f - horizon;
    const float mu = horizon + range * skv_maxf(t * t, 1e-6f);
    const float sin_theta = skv_sqrtf(skv_maxf((1.0f - mu) * (1.0f + mu), 0.0f));
    const float half = (float)azimuth / (float)(SKV_GRID_AZIMUTHS - 1);
    const float c = 1.0f - 2.0f * half * half, d = 2.0f * half * skv_sqrtf((1.0f - half) * (1.0f + half));
    // Sums only: of a difference beside a sum gcc 12 makes a vfmaddsub, contraction off or not.
    v[0] = sin_theta * (c * flat[0] + d * left[0]);
    v[1] = sin_theta * (c * flat[1] + d * left[1]);
    v[2] = mu;
}

/// Rows worked on at a time: they fill blocks of lanes all but for a few.
#if SKV_LANES < 8
#define SKV_GRID_AT_ONCE 1
#else
#define SKV_GRID_AT_ONCE 4
#endif

/// Some rows of a light's grid, from `row` on.
static SKV_NOINLINE void skv_grid_rows(const skv_frame *frame, int light, int row, float *out) {
    const int bands = skv_bands(frame->model), left = SKV_GRID_ROWS - row;
    const int n = SKV_GRID_AZIMUTHS * (left < SKV_GRID_AT_ONCE ? left : SKV_GRID_AT_ONCE);
    float v[SKV_GRID_AT_ONCE * SKV_GRID_AZIMUTHS][3];
    for (int i = 0; i < n; i++)
        skv_grid_direction(frame, light, row + i / SKV_GRID_AZIMUTHS, i % SKV_GRID_AZIMUTHS, v[i]);
    const skv_rays rays = {v[0], 0, NULL, 0};
    const skv_sky sky = {out, 0, NULL, 0};
    memset(out, 0, sizeof(float) * (size_t)(n * bands));
    skv_diffuse_add(frame, light, (size_t)n, &rays, &sky);
    skv_grid_divide(frame, (size_t)n, &rays, out);
}

skv_status skv_frame_grid(skv_frame *frame, float *grid, size_t n) {
    if (!frame || !grid)
        return SKV_ERR_NULL;
    if (frame->layout != SKV_LAYOUT || !frame->model || frame->model->layout != SKV_LAYOUT || !frame->diffuse.table)
        return SKV_ERR_LAYOUT;
    if (frame->height_km > 0.5f * frame->top_km)
        return SKV_ERR_RANGE;
    if (n < skv_grid_size(frame) || (uintptr_t)grid % sizeof(float) != 0)
        return SKV_ERR_SIZE;
    frame->diffuse.grid = NULL;
    skv_grid_axes(frame);
    const int row_floats = SKV_GRID_AZIMUTHS * skv_bands(frame->model);
    for (int light = 0; light < frame->lights; light++)
        for (int row = 0; row < SKV_GRID_ROWS; row += SKV_GRID_AT_ONCE)
            skv_grid_rows(frame, light, row, grid + (light * SKV_GRID_ROWS + row) * row_floats);
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
