#include "core/table_pack.h"

#include <string.h>

#include "core/cells.h"

#if SKV_TERM_DIFFUSE

static uint16_t skv_table_code(float log2) {
    const float x = (log2 - SKV_CELLS_FLOOR) * SKV_CELLS_STEPS + 0.5f;
    return (uint16_t)(int32_t)skv_clampf(x, 0.0f, 65535.0f);
}

static int8_t skv_table_ratio(float x, float scale) {
    const float y = skv_clampf(x / scale, -127.0f, 127.0f);
    return (int8_t)(int32_t)(y + (y < 0.0f ? -0.5f : 0.5f));
}

static void skv_table_pack_header(const skv_table *work, skv_table *table, const float largest[], int format) {
    *table = *work;
    table->format = (uint8_t)format;
    if (format == SKV_TABLE_PACKED)
        for (int k = 0; k < SKV_TABLE_TERMS - 1; k++)
            table->ratio_scale[k] = skv_maxf(largest[k], 1e-6f) * (1.0f / 127.0f);
    table->bytes = (uint32_t)skv_cells_bytes(table);
    // The padding at the end, too: the checksum is of all bytes.
    memset((char *)table + table->bytes - sizeof(uint32_t), 0, sizeof(uint32_t));
}

void skv_table_pack_row(const skv_table *work, skv_table *table, int row, const float largest[SKV_TABLE_TERMS - 1],
                        int format) {
    if (row == 0)
        skv_table_pack_header(work, table, largest, format);
    const float *const log = skv_cells_floats(work);
    const size_t bands = work->bands, suns = work->suns, logs = (skv_cells_count(work) + suns) * bands;
    // The ground's irradiance stands before the cells of row 0.
    const size_t from = row == 0 ? 0 : (size_t)(row + 1) * suns * bands, to = (size_t)(row + 2) * suns * bands;
    const size_t begin = skv_cells_ratios(work, row, 0), end = skv_cells_ratios(work, row + 1, 0);
    if (format == SKV_TABLE_FLOAT) {
        float *const out = (float *)(void *)(table + 1);
        memcpy(out + from, log + from, (to - from) * sizeof(float));
        memcpy(out + logs + begin, log + logs + begin, (end - begin) * sizeof(float));
        return;
    }
    uint16_t *const code = (uint16_t *)(void *)(table + 1);
    int8_t *const ratio = (int8_t *)(void *)(code + logs);
    const size_t terms = (size_t)(row < work->detailed ? SKV_TABLE_TERMS - 1 : 5);
    for (size_t i = from; i < to; i++)
        code[i] = skv_table_code(log[i]);
    for (size_t i = begin; i < end; i++)
        ratio[i] = skv_table_ratio(log[logs + i], table->ratio_scale[(i - begin) / bands % terms]);
}

/// [Fletcher82] over 32-bit words, in the machine's byte order.
static uint32_t skv_table_sum(const skv_table *t) {
    const uint32_t *const word = (const uint32_t *)(const void *)t;
    uint32_t a = 1, b = 0;
    for (size_t i = offsetof(skv_table, model) / sizeof(uint32_t); i < t->bytes / sizeof(uint32_t); i++) {
        a += word[i];
        b += a;
    }
    return a ^ (b << 16 | b >> 16);
}

void skv_table_seal(skv_table *table) {
    table->checksum = skv_table_sum(table);
}

static int skv_table_finite(const skv_table *t) {
    int ok = t->ground_km >= -12.0f && t->ground_km <= 12.0f && t->span_km > 0.0f && t->span_km <= 1e4f &&
             t->mu_first >= -0.95f && t->mu_first < 0.0f;
    for (int k = 0; k < SKV_TABLE_TERMS - 1; k++)
        ok = ok && t->ratio_scale[k] > 0.0f && t->ratio_scale[k] <= 1.0f;
    if (t->format == SKV_TABLE_PACKED || !ok)
        return ok;
    const float *const f = skv_cells_floats(t);
    for (size_t i = 0; i < (t->bytes - sizeof *t) / sizeof(float); i++)
        ok = ok && f[i] >= -64.0f && f[i] <= 64.0f;
    return ok;
}

skv_status skv_table_check(const void *bytes, size_t n, const skv_model *model) {
    const skv_table *const t = bytes;
    if (!bytes)
        return SKV_ERR_NULL;
    if ((uintptr_t)bytes % sizeof(float) != 0 || n < sizeof *t)
        return SKV_ERR_SIZE;
    if (t->magic != SKV_TABLE_MAGIC || t->version != SKV_TABLE_VERSION || t->format > SKV_TABLE_FLOAT ||
        (t->bands != 3 && t->bands != 4) || t->altitudes < 4 || t->altitudes > 32 || t->detailed > t->altitudes ||
        t->suns < 8 || t->suns > 64 || t->reserved != 0 || t->bytes != skv_cells_bytes(t))
        return SKV_ERR_LAYOUT;
    if (n < t->bytes)
        return SKV_ERR_SIZE;
    if (t->checksum != skv_table_sum(t) || !skv_table_finite(t))
        return SKV_ERR_DAMAGED;
    if (model && model->layout != SKV_LAYOUT)
        return SKV_ERR_LAYOUT;
    return model && (model->hash != t->model || skv_bands(model) != t->bands) ? SKV_ERR_MODEL : SKV_OK;
}

#endif
