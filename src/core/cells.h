/// The cells of a diffuse-light table: where they lie, and what stands between them.
///
/// Axes: altitude by its square root, sun by u/(.15+|u|) + .6 u, u = mu_s + .05. A cell has per band log2 of the mean
/// radiance c0 and ratios to it: degree 1 (2), degree 2 (3), and in detailed rows the fine ones (fine.h, 7).
#ifndef SKV_CORE_CELLS_H
#define SKV_CORE_CELLS_H

#include "skyvert/table.h"

#include "core/lanes.h"

#define SKV_TABLE_MAGIC 0x534B5654u
#define SKV_CELLS_KNEE  0.15f
#define SKV_CELLS_SLOPE 0.6f
/// log2 of the least radiance that is kept; codes of 16 bits count from it in steps of 1/1024.
#define SKV_CELLS_FLOOR -50.0f
#define SKV_CELLS_STEPS 1024.0f
#define SKV_CELLS_LEAST 8.8817842e-16f // 2^-50

/// Columns crowd where the sun is near the horizon.
SKV_INLINE float skv_cells_warp(float mu_s) {
    const float u = mu_s + 0.05f;
    return u / (SKV_CELLS_KNEE + skv_fabsf(u)) + SKV_CELLS_SLOPE * u;
}

/// Column coordinate of mu_s, [0, suns - 1]; below the first column's the first one counts.
SKV_INLINE float skv_cells_column(const skv_table *t, float mu_s) {
    const float first = skv_cells_warp(t->mu_first), last = skv_cells_warp(1.0f), most = (float)(t->suns - 1);
    return skv_clampf((skv_cells_warp(mu_s) - first) * (most / (last - first)), 0.0f, most);
}

/// mu_s of a column: the inverse.
static inline float skv_cells_mu_s(const skv_table *t, int column) {
    const float first = skv_cells_warp(t->mu_first), last = skv_cells_warp(1.0f);
    const float x = first + (last - first) * (float)column / (float)(t->suns - 1), a = skv_fabsf(x);
    const float half = 0.5f * (SKV_CELLS_SLOPE * SKV_CELLS_KNEE + 1.0f - a);
    const float u = a * SKV_CELLS_KNEE / (half + skv_sqrtf(half * half + SKV_CELLS_SLOPE * SKV_CELLS_KNEE * a));
    // Not the zenith itself: what is divided by the sine of the distance from it has its limit there.
    return skv_clampf(skv_copysignf(u, x) - 0.05f, -1.0f, 0.998f);
}

static inline float skv_cells_altitude(const skv_table *t, int row) {
    const float x = (float)row / (float)(t->altitudes - 1);
    return t->ground_km + t->span_km * x * x;
}

static inline size_t skv_cells_count(const skv_table *t) {
    return (size_t)t->altitudes * t->suns;
}

/// Ratios before a cell's.
static inline size_t skv_cells_ratios(const skv_table *t, int row, int column) {
    const size_t suns = t->suns, full = (size_t)(row < t->detailed ? row : t->detailed), rest = (size_t)row - full;
    const size_t here = (size_t)column * (row < t->detailed ? SKV_TABLE_TERMS - 1u : 5u);
    return (suns * (full * (SKV_TABLE_TERMS - 1u) + rest * 5u) + here) * t->bands;
}

/// Both formats: [suns][bands] log2 of the ground's irradiance, [altitudes][suns][bands] log2 of c0, ratios.
static inline size_t skv_cells_bytes(const skv_table *t) {
    const size_t logs = (skv_cells_count(t) + t->suns) * t->bands, ratios = skv_cells_ratios(t, t->altitudes, 0);
    const size_t bytes = t->format == SKV_TABLE_FLOAT ? 4u * (logs + ratios) : 2u * logs + ratios;
    return sizeof(skv_table) + ((bytes + 3u) & ~(size_t)3u);
}

SKV_INLINE const uint16_t *skv_cells_codes(const skv_table *t) {
    return (const uint16_t *)(const void *)(t + 1);
}

SKV_INLINE const float *skv_cells_floats(const skv_table *t) {
    return (const float *)(const void *)(t + 1);
}

/// Weights of the four cells around a point, and where they are.
typedef struct skv_cells_place {
    int row, column;
    float w00, w01, w10, w11; ///< [row][column]
} skv_cells_place;

SKV_INLINE skv_cells_place skv_cells_find(const skv_table *t, float x, float y) {
    skv_cells_place p;
    p.row = (int)x;
    p.row = p.row > t->altitudes - 2 ? t->altitudes - 2 : p.row;
    p.column = (int)y;
    p.column = p.column > t->suns - 2 ? t->suns - 2 : p.column;
    const float wx = x - (float)p.row, wy = y - (float)p.column;
    p.w11 = wx * wy;
    p.w10 = wx - p.w11;
    p.w01 = wy - p.w11;
    p.w00 = 1.0f - wx - p.w01;
    return p;
}

/// Most ratios of a cell.
#define SKV_CELLS_VALUES ((SKV_TABLE_TERMS - 1) * SKV_BANDS_MAX)

/// Weighted sums of n numbers of four cells; two pairs of neighbours, `step` apart within a pair.
#define SKV_CELLS_MIX(type, base, r0, step0, r1, step1, first, last, out)                                              \
    do {                                                                                                               \
        const type *const a = (base) + (r0) + (first), *const b = a + (step0);                                         \
        const type *const c = (base) + (r1) + (first), *const d = c + (step1);                                         \
        SKV_EACH_OF(k, (last) - (first))                                                                               \
        (out)[k + (first)] =                                                                                           \
            p->w00 * (float)a[k] + p->w01 * (float)b[k] + p->w10 * (float)c[k] + p->w11 * (float)d[k];                 \
    } while (0)

/// The same of one pair.
#define SKV_CELLS_MIX_LOW(type, base, r0, step0, first, last, out)                                                     \
    do {                                                                                                               \
        const type *const a = (base) + (r0) + (first), *const b = a + (step0);                                         \
        SKV_EACH_OF(k, (last) - (first))                                                                               \
        (out)[k + (first)] = p->w00 * (float)a[k] + p->w01 * (float)b[k];                                              \
    } while (0)

/// Ratios of degrees 1 and 2, and the fine ones where the lower row has them (they fade out towards the first row that
/// has none).
#define SKV_CELLS_RATIOS(type, base)                                                                                   \
    do {                                                                                                               \
        SKV_CELLS_MIX(type, base, r0, step0, r1, step1, 0, n, ratio);                                                  \
        if (fine && step1 == step0)                                                                                    \
            SKV_CELLS_MIX(type, base, r0, step0, r1, step1, n, all, ratio);                                            \
        else if (fine)                                                                                                 \
            SKV_CELLS_MIX_LOW(type, base, r0, step0, n, all, ratio);                                                   \
    } while (0)

/// log2 of the mean radiance, per band.
SKV_INLINE void skv_cells_mean(const skv_table *t, int bands, const skv_cells_place *p, float log2_mean[]) {
    const size_t wide = (size_t)bands, row = t->suns * wide;
    const size_t low = (size_t)(p->row + 1) * row + (size_t)p->column * wide;
    if (t->format == SKV_TABLE_FLOAT) {
        const float *const a = skv_cells_floats(t) + low, *const b = a + wide, *const c = a + row, *const d = c + wide;
        SKV_EACH_OF(i, bands)
        log2_mean[i] = p->w00 * a[i] + p->w01 * b[i] + p->w10 * c[i] + p->w11 * d[i];
        return;
    }
    const uint16_t *const a = skv_cells_codes(t) + low, *const b = a + wide, *const c = a + row, *const d = c + wide;
    SKV_EACH_OF(i, bands)
    log2_mean[i] = (p->w00 * (float)a[i] + p->w01 * (float)b[i] + p->w10 * (float)c[i] + p->w11 * (float)d[i]) *
                       (1.0f / SKV_CELLS_STEPS) +
                   SKV_CELLS_FLOOR;
}

/// Ratios [terms - 1][bands] to the mean radiance.
/// @return whether there are fine ones; if not these are not written.
SKV_INLINE int skv_cells_read(const skv_table *t, int bands, const skv_cells_place *p, float ratio[]) {
    const size_t logs = (skv_cells_count(t) + t->suns) * (size_t)bands;
    const size_t r0 = skv_cells_ratios(t, p->row, p->column), r1 = skv_cells_ratios(t, p->row + 1, p->column);
    const int fine = p->row < t->detailed, n = 5 * bands, all = (SKV_TABLE_TERMS - 1) * bands;
    const int step0 = fine ? all : n, step1 = p->row + 1 < t->detailed ? all : n;
    if (t->format == SKV_TABLE_FLOAT) {
        const float *const f = skv_cells_floats(t) + logs;
        SKV_CELLS_RATIOS(float, f);
        return fine;
    }
    const int8_t *const q = (const int8_t *)(const void *)(skv_cells_codes(t) + logs);
    SKV_CELLS_RATIOS(int8_t, q);
    for (int k = 0; k < (fine ? SKV_TABLE_TERMS - 1 : 5); k++)
        for (int b = 0; b < bands; b++)
            ratio[k * bands + b] *= t->ratio_scale[k];
    return fine;
}

/// log2 of the diffuse irradiance of the ground per unit of the light's, at mu_s.
SKV_INLINE float skv_ground_log2(const skv_table *t, float mu_s, int b) {
    const float y = skv_cells_column(t, mu_s);
    int i = (int)y;
    i = i > t->suns - 2 ? t->suns - 2 : i;
    const float w = y - (float)i;
    const size_t at = (size_t)i * t->bands + (size_t)b;
    if (t->format == SKV_TABLE_FLOAT) {
        const float *f = skv_cells_floats(t);
        return f[at] + w * (f[at + t->bands] - f[at]);
    }
    const uint16_t *c = skv_cells_codes(t);
    return SKV_CELLS_FLOOR + ((float)c[at] + w * ((float)c[at + t->bands] - (float)c[at])) * (1.0f / SKV_CELLS_STEPS);
}

#endif
