/// The cells of a diffuse-light table: where they lie, and what stands between them.
///
/// Axes: altitude by its square root, sun by u/(.09+|u|) + .6 u, u = mu_s + .07. A cell has per band log2 of the mean
/// radiance c0 and ratios to it: degree 1 (2), degree 2 (3), and in detailed rows the fine ones (fine.h, 7).
#ifndef SKV_CORE_CELLS_H
#define SKV_CORE_CELLS_H

#include "skyvert/table.h"

#include "core/lanes.h"

#define SKV_TABLE_MAGIC  0x534B5654u
#define SKV_CELLS_CENTRE 0.07f
#define SKV_CELLS_KNEE   0.09f
#define SKV_CELLS_SLOPE  0.6f
/// log2 of the least radiance that is kept; codes of 16 bits count from it in steps of 1/1024.
#define SKV_CELLS_FLOOR -50.0f
#define SKV_CELLS_STEPS 1024.0f
#define SKV_CELLS_LEAST 8.8817842e-16f // 2^-50

/// Columns crowd where the sun is near the horizon.
SKV_INLINE float skv_cells_warp(float mu_s) {
    const float u = mu_s + SKV_CELLS_CENTRE;
    return u / (SKV_CELLS_KNEE + skv_fabsf(u)) + SKV_CELLS_SLOPE * u;
}

/// Column coordinate of mu_s in [-1, 1]: [0, suns - 1] but for rounding; below the first column's the first one counts.
SKV_INLINE float skv_cells_column(const skv_frame_diffuse *d, float mu_s) {
    return skv_maxf((skv_cells_warp(mu_s) - d->column_first) * d->column_scale, 0.0f);
}

/// mu_s of a column: the inverse.
static inline float skv_cells_mu_s(const skv_table *t, int column) {
    const float first = skv_cells_warp(t->mu_first), last = skv_cells_warp(1.0f);
    const float x = first + (last - first) * (float)column / (float)(t->suns - 1), a = skv_fabsf(x);
    const float half = 0.5f * (SKV_CELLS_SLOPE * SKV_CELLS_KNEE + 1.0f - a);
    const float u = a * SKV_CELLS_KNEE / (half + skv_sqrtf(half * half + SKV_CELLS_SLOPE * SKV_CELLS_KNEE * a));
    // Not the zenith itself: what is divided by the sine of the distance from it has its limit there.
    return skv_clampf(skv_copysignf(u, x) - SKV_CELLS_CENTRE, -1.0f, 0.998f);
}

/// Row coordinate of an altitude, given over the span and within it.
SKV_INLINE float skv_cells_row(const skv_table *t, float over_span) {
    return skv_root(over_span) * (float)(t->altitudes - 1);
}

/// Altitude of a row: the inverse.
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

/// Most ratios of a cell.
#define SKV_CELLS_RATIOS ((SKV_TABLE_TERMS - 1) * SKV_BANDS_MAX)

/// Points in a table, per lane: squares of four cells [row][column] around them.
typedef struct skv_cells_places {
    int32_t mean[SKV_LANES];     ///< index of the first cell's mean radiance, behind the ground's
    int32_t ratio[2][SKV_LANES]; ///< index of the first ratio of the first cell of each row
    int32_t step[2][SKV_LANES];  ///< ratios of a cell of each row
    skv_lanes weight[4];
} skv_cells_places;

/// @param x  row, y  column coordinate, within the table.
SKV_INLINE void skv_cells_find(const skv_table *t, int bands, const skv_lanes *x, const skv_lanes *y,
                               skv_cells_places *restrict p) {
    const int32_t rows = t->altitudes - 2, columns = t->suns - 2, suns = t->suns, detailed = t->detailed;
    const int32_t all = (SKV_TABLE_TERMS - 1) * bands, few = 5 * bands, more = (all - few) * suns;
    SKV_EACH_LANE(l) {
        int32_t i = (int32_t)x->v[l], j = (int32_t)y->v[l];
        i = i > rows ? rows : i;
        j = j > columns ? columns : j;
        const float wx = x->v[l] - (float)i, wy = y->v[l] - (float)j, low = 1.0f - wx;
        const int32_t full = i < detailed ? i : detailed, next = i + 1 < detailed ? i + 1 : detailed;
        const int32_t first = i < detailed ? all : few, second = i + 1 < detailed ? all : few;
        p->weight[1].v[l] = low * wy;
        p->weight[0].v[l] = low - p->weight[1].v[l];
        p->weight[3].v[l] = wx * wy;
        p->weight[2].v[l] = wx - p->weight[3].v[l];
        p->mean[l] = ((i + 1) * suns + j) * bands;
        p->ratio[0][l] = i * suns * few + full * more + j * first;
        p->ratio[1][l] = (i + 1) * suns * few + next * more + j * second;
        p->step[0][l] = first;
        p->step[1][l] = second;
    }
}

/// The numbers of four cells as floats: those of a packed table are kept for the next ray, which often needs the same.
typedef struct skv_cells_square {
    int32_t at; ///< mean index of the first cell; -1: none yet
    const float *mean[4], *ratio[4];
    float means[4][SKV_BANDS_MAX], ratios[4][SKV_CELLS_RATIOS];
} skv_cells_square;

SKV_INLINE void skv_cells_load(const skv_table *t, int bands, const skv_cells_places *p, int l,
                               skv_cells_square *square) {
    const int32_t row = t->suns * bands, logs = (t->altitudes + 1) * row;
    square->at = p->mean[l];
    for (int i = 0; i < 4; i++) {
        const int32_t step = p->step[i / 2][l], ratio = p->ratio[i / 2][l] + i % 2 * step;
        const int32_t mean = square->at + i / 2 * row + i % 2 * bands;
        if (t->format == SKV_TABLE_FLOAT) {
            square->mean[i] = skv_cells_floats(t) + mean;
            square->ratio[i] = skv_cells_floats(t) + logs + ratio;
            continue;
        }
        const uint16_t *const code = skv_cells_codes(t);
        const int8_t *const packed = (const int8_t *)(const void *)(code + logs) + ratio;
        square->mean[i] = square->means[i];
        square->ratio[i] = square->ratios[i];
        SKV_EACH_OF(b, bands) square->means[i][b] = (float)code[mean + b];
        if (step > 5 * bands)
            SKV_EACH_OF(k, (SKV_TABLE_TERMS - 1) * bands) square->ratios[i][k] = (float)packed[k];
        else
            SKV_EACH_OF(k, 5 * bands) square->ratios[i][k] = (float)packed[k];
    }
}

/// Weighted sums of n numbers of four cells, or of the first two. The numbers of a cell stand side by side: vectors run
/// over them, whatever squares the rays of a block are in. n is a constant for the compiler.
SKV_INLINE void skv_cells_mix(const float *const number[4], int first, int n, const float w[4], float *restrict out) {
    const float *const a = number[0] + first, *const b = number[1] + first;
    const float *const c = number[2] + first, *const d = number[3] + first;
    const float wa = w[0], wb = w[1], wc = w[2], wd = w[3];
    SKV_EACH_OF(k, n) out[first + k] = wa * a[k] + wb * b[k] + wc * c[k] + wd * d[k];
}

SKV_INLINE void skv_cells_mix_row(const float *const number[4], int first, int n, const float w[4],
                                  float *restrict out) {
    const float *const a = number[0] + first, *const b = number[1] + first;
    const float wa = w[0], wb = w[1];
    SKV_EACH_OF(k, n) out[first + k] = wa * a[k] + wb * b[k];
}

/// What stands at a place: log2 of the mean radiance, [bands] (of a packed table a code), and ratios [terms - 1][bands]
/// to it; of a packed table these are still to be multiplied by ratio_scale.
/// @return whether there are fine ratios: they fade out towards the first row that has none, and are not written
/// beyond.
SKV_INLINE int skv_cells_at(const skv_table *t, int bands, const skv_cells_places *p, int l, skv_cells_square *square,
                            float *restrict mean, float *restrict ratio) {
    const int few = 5 * bands, all = (SKV_TABLE_TERMS - 1) * bands;
    const float w[4] = {p->weight[0].v[l], p->weight[1].v[l], p->weight[2].v[l], p->weight[3].v[l]};
    if (p->mean[l] != square->at)
        skv_cells_load(t, bands, p, l, square);
    skv_cells_mix(square->mean, 0, bands, w, mean);
    if (p->step[1][l] == all) {
        skv_cells_mix(square->ratio, 0, all, w, ratio);
        return 1;
    }
    skv_cells_mix(square->ratio, 0, few, w, ratio);
    if (p->step[0][l] == few)
        return 0;
    skv_cells_mix_row(square->ratio, few, SKV_TABLE_FINE * bands, w, ratio);
    return 1;
}

/// log2 of a mean radiance from what the cells of a table give.
SKV_INLINE float skv_cells_log2(const skv_table *t, float mean) {
    return t->format == SKV_TABLE_FLOAT ? mean : mean * (1.0f / SKV_CELLS_STEPS) + SKV_CELLS_FLOOR;
}

/// log2 of the diffuse irradiance of the ground per unit of the light's, at a column coordinate.
SKV_INLINE float skv_ground_log2(const skv_table *t, float y, int b) {
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
