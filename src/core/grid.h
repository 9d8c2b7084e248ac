/// The diffuse light of a frame on a grid of directions: rows over the elevation, split at the geometric horizon and
/// crowding there with t^2, columns over half the azimuth from each light, evenly in sin(phi/2).
///
/// The grid holds the light over n(tau), tau the optical depth of the whole ray: what is left varies little even where
/// the path changes fast. n(tau) = 1 - 1/(1 + tau + tau^2/2 + tau^3/6) stands for 1 - exp(-tau): no cancellation where
/// the air is thin, no exponential.
#ifndef SKV_CORE_GRID_H
#define SKV_CORE_GRID_H

#include "skyvert/table.h"

#include "core/rays.h"

#define SKV_GRID_UP       24
#define SKV_GRID_DOWN     12
#define SKV_GRID_ROWS     (SKV_GRID_UP + SKV_GRID_DOWN)
#define SKV_GRID_AZIMUTHS 13

SKV_INLINE float skv_grid_amount(float tau) {
    const float t = tau * (1.0f + tau * (0.5f + tau * (1.0f / 6.0f)));
    return t / (1.0f + t);
}

/// Cosines of the zenith angles of the geometric horizon and of the highest ray that meets air.
typedef struct skv_grid_span {
    float horizon, high;
} skv_grid_span;

SKV_INLINE skv_grid_span skv_grid_range(const skv_frame *frame) {
    const float h = frame->height_km, top = frame->top_km, r = frame->radius_km + h;
    const float inv = 1.0f / r;
    const skv_grid_span s = {-skv_sqrtf(h * (frame->radius_km + r)) * inv,
                             h > top ? -skv_sqrtf((h - top) * (frame->radius_km + top + r)) * inv : 1.0f};
    return s;
}

/// Optical depth of the air along whole rays, per band, times log2(e): to the ground, or past the top as the closed
/// form counts it.
SKV_INLINE void skv_grid_columns(const skv_frame *frame, unsigned has, const skv_block *block, const skv_columns k[2],
                                 skv_columns *out) {
    uint32_t hits = 0;
    SKV_EACH_LANE(l) hits |= skv_bits(block->meets_ground.v[l]);
    for (int s = 0; s < SKV_SPECIES; s++)
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
        for (int s = 0; s < SKV_SPECIES; s++)
            if (SKV_PRESENT(has, s))
                SKV_EACH_LANE(l) {
                    const float to = k[0].of[s].v[l] + up.of[s].v[l];
                    // leg[0].h_km is 0 for rays to the ground only.
                    out->of[s].v[l] = block->meets_ground.v[l] > 0.0f ? to : out->of[s].v[l];
                }
    }
    for (int s = 0; s < SKV_SPECIES; s++)
        if (SKV_PRESENT(has, s))
            SKV_EACH_LANE(l) out->of[s].v[l] = skv_maxf(out->of[s].v[l], 0.0f);
}

/// n(tau) of a band, lanes.
SKV_INLINE void skv_grid_amounts(const skv_frame *frame, unsigned has, const skv_columns *c, int b, skv_lanes *amount) {
    const float ln2 = 0.693147181f;
    const float kr = frame->rayleigh_log2e_per_km[b] * ln2, ka = frame->aerosol_log2e_per_km[b] * ln2;
    const float ko = frame->ozone_log2e_per_km[b] * ln2;
    SKV_EACH_LANE(l) {
        float tau = 0.0f;
        if (SKV_PRESENT(has, SKV_RAYLEIGH))
            tau += kr * c->of[SKV_RAYLEIGH].v[l];
        if (SKV_PRESENT(has, SKV_AEROSOL))
            tau += ka * c->of[SKV_AEROSOL].v[l];
        if (SKV_PRESENT(has, SKV_OZONE))
            tau += ko * c->of[SKV_OZONE].v[l];
        amount->v[l] = skv_grid_amount(skv_minf(tau, 1e4f));
    }
}

/// Where directions lie in the grid.
typedef struct skv_grid_place {
    int32_t at[SKV_LANES]; ///< of the first of four corners: row * azimuths + azimuth
    skv_lanes wx, wy;      ///< towards the next azimuth, the next row
} skv_grid_place;

SKV_INLINE void skv_grid_find(const skv_frame *frame, int light, const skv_block *block, skv_grid_place *p) {
    const skv_grid_span span = skv_grid_range(frame);
    const float *const s = frame->light[light].direction_enu;
    const float flat = skv_sqrtf(s[0] * s[0] + s[1] * s[1]), inv_flat = flat > 1e-6f ? 1.0f / flat : 0.0f;
    const float lx = flat > 1e-6f ? s[0] * inv_flat : 1.0f, ly = flat > 1e-6f ? s[1] * inv_flat : 0.0f;
    const float inv_up = 1.0f / skv_maxf(span.high - span.horizon, 1e-9f), inv_down = 1.0f / (1.0f + span.horizon);
    SKV_EACH_LANE(l) {
        const float x = block->view[0].v[l], y = block->view[1].v[l], mu = block->view[2].v[l];
        const float inv = 1.0f / skv_root(skv_maxf(x * x + y * y, 1e-24f));
        const float dx = x * inv - lx, dy = y * inv - ly;
        const float u = skv_minf(0.5f * skv_root(dx * dx + dy * dy), 1.0f) * (float)(SKV_GRID_AZIMUTHS - 1);
        const int down = block->meets_ground.v[l] > 0.0f;
        const float t = down ? (span.horizon - mu) * inv_down : (mu - span.horizon) * inv_up;
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
static SKV_NOINLINE void skv_grid_add(const skv_frame *frame, int light, size_t first, const skv_block *block,
                                      const skv_columns k[2], const skv_sky *sky) {
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

#endif
