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
    return skv_clampf(skv_copysignf(u, x) - SKV_CELLS_CENTRE, -1.0f, 0.998f);
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

/// Most ratios of a cell.
#define SKV_CELLS_RATIOS ((SKV_TABLE_TERMS - 1) * SKV_BANDS_MAX)

/// What stands at a point per lane: log2 of the mean radiance, ratios [terms - 1][bands] to it.
typedef struct skv_cells_values {
    skv_lanes log2_mean[SKV_BANDS_MAX];
    skv_lanes ratio[SKV_CELLS_RATIOS];
} skv_cells_values;

/// Whole and broken part of coordinates; `most` is the last whole part.
SKV_INLINE void skv_cells_split(const skv_lanes *x, int most, int32_t whole[], skv_lanes *rest, int range[2]) {
    range[0] = most;
    range[1] = 0;
    SKV_EACH_LANE(l) {
        int32_t i = (int32_t)x->v[l];
        i = i > most ? most : i;
        whole[l] = i;
        rest->v[l] = x->v[l] - (float)i;
        range[0] = i < range[0] ? i : range[0];
        range[1] = i > range[1] ? i : range[1];
    }
}

/// Weights of four cells [row][column], per lane.
typedef struct skv_cells_weights {
    skv_lanes of[4];
} skv_cells_weights;

/// out += the weighted sum of n numbers of four cells; of the first row's two where there is no second one.
SKV_INLINE void skv_cells_weigh(const float *const number[4], int n, const skv_cells_weights *restrict w,
                                skv_lanes *restrict out) {
    for (int i = 0; i < n; i++) {
        const float a = number[0][i], b = number[1][i], c = number[2][i], d = number[3][i];
        SKV_EACH_LANE(l)
        out[i].v[l] += w->of[0].v[l] * a + w->of[1].v[l] * b + w->of[2].v[l] * c + w->of[3].v[l] * d;
    }
}

SKV_INLINE void skv_cells_weigh_row(const float *const number[4], int n, const skv_cells_weights *restrict w,
                                    skv_lanes *restrict out) {
    for (int i = 0; i < n; i++) {
        const float a = number[0][i], b = number[1][i];
        SKV_EACH_LANE(l) out[i].v[l] += w->of[0].v[l] * a + w->of[1].v[l] * b;
    }
}

/// Adds the cells [row][column] to [row + 1][column + 1]; packed numbers become floats first, many at a time.
SKV_INLINE void skv_cells_add(const skv_table *t, int bands, int row, int column, const skv_cells_weights *w,
                              skv_cells_values *restrict out) {
    const size_t wide = (size_t)bands, ratios = (skv_cells_count(t) + t->suns) * wide;
    const int n = 5 * bands, all = (SKV_TABLE_TERMS - 1) * bands;
    const float *mean[4], *ratio[4];
    float means[4][SKV_BANDS_MAX], unpacked[4][SKV_CELLS_RATIOS];
    for (int i = 0; i < 4; i++) {
        const int r = row + i / 2, c = column + i % 2, count = r < t->detailed ? all : n;
        const size_t at = ((size_t)(r + 1) * t->suns + (size_t)c) * wide, from = ratios + skv_cells_ratios(t, r, c);
        mean[i] = means[i];
        ratio[i] = unpacked[i];
        if (t->format == SKV_TABLE_FLOAT) {
            mean[i] = skv_cells_floats(t) + at;
            ratio[i] = skv_cells_floats(t) + from;
            continue;
        }
        const uint16_t *const code = skv_cells_codes(t) + at;
        const int8_t *const packed = (const int8_t *)(const void *)(skv_cells_codes(t) + ratios) + (from - ratios);
        for (int b = 0; b < bands; b++)
            means[i][b] = (float)code[b];
        SKV_EACH_OF(k, count) unpacked[i][k] = (float)packed[k];
    }
    skv_cells_weigh(mean, bands, w, out->log2_mean);
    skv_cells_weigh(ratio, n, w, out->ratio);
    for (int i = 0; i < 4; i++)
        ratio[i] += n;
    if (row + 1 < t->detailed)
        skv_cells_weigh(ratio, all - n, w, out->ratio + n);
    else if (row < t->detailed)
        skv_cells_weigh_row(ratio, all - n, w, out->ratio + n);
}

/// Bilinear values at points, per lane. It goes over the cells that some lane touches, not over lanes: neighbouring
/// rays share most of them, and a weight of 0 changes no bit.
/// @param x  row, y  column coordinate.
/// @return whether some lane has fine ratios; if none, these are 0.
SKV_INLINE int skv_cells_values_at(const skv_table *t, int bands, const skv_lanes *x, const skv_lanes *y,
                                   skv_cells_values *out) {
    int32_t row[SKV_LANES], column[SKV_LANES];
    int rows[2], columns[2];
    skv_lanes wx, wy;
    skv_cells_split(x, t->altitudes - 2, row, &wx, rows);
    skv_cells_split(y, t->suns - 2, column, &wy, columns);
    const int fine = rows[0] < t->detailed, n = (fine ? SKV_TABLE_TERMS - 1 : 5) * bands;
    for (int b = 0; b < bands; b++)
        SKV_EACH_LANE(l) out->log2_mean[b].v[l] = 0.0f;
    for (int i = 0; i < n; i++)
        SKV_EACH_LANE(l) out->ratio[i].v[l] = 0.0f;
    for (int r = rows[0]; r <= rows[1]; r++)
        for (int c = columns[0]; c <= columns[1]; c++) {
            skv_cells_weights w;
            uint32_t any = 0;
            SKV_EACH_LANE(l) {
                const float here = row[l] == r && column[l] == c ? 1.0f : 0.0f;
                const float high = here * wx.v[l], low = here - high;
                w.of[1].v[l] = low * wy.v[l];
                w.of[0].v[l] = low - w.of[1].v[l];
                w.of[3].v[l] = high * wy.v[l];
                w.of[2].v[l] = high - w.of[3].v[l];
                any |= skv_bits(here);
            }
            if (any != 0)
                skv_cells_add(t, bands, r, c, &w, out);
        }
    if (t->format == SKV_TABLE_PACKED) {
        for (int b = 0; b < bands; b++)
            SKV_EACH_LANE(l)
        out->log2_mean[b].v[l] = out->log2_mean[b].v[l] * (1.0f / SKV_CELLS_STEPS) + SKV_CELLS_FLOOR;
        for (int i = 0; i < n; i++) {
            const float scale = t->ratio_scale[i / bands];
            SKV_EACH_LANE(l) out->ratio[i].v[l] *= scale;
        }
    }
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
