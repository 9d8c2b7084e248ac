/// A baked model and table (baked.h, from `skyvert bake --what model --name baked`), used where they lie, and the same
/// built at run time: every bit must agree. Prints a checksum of the radiance, the same on every machine. The
/// microcontroller builds nothing (SKV_TEST_SMALL).
#include <stdio.h>
#include <string.h>

#include "baked.h"

enum { RAYS = 33, SUNS = 3, HEIGHTS = 2 };

static int failed(const char *what) {
    printf("FAILED: %s\n", what);
    return 1;
}

/// Radiance, transmittance and luminance of a few frames, one after the other into a checksum [FNV].
static skv_status checksum(const skv_model *model, const skv_table *table, const skv_colour_matrix *matrix,
                           uint32_t *sum) {
    static const float suns[SUNS][3] = {{0.3f, 0.1f, 0.9f}, {0.9f, 0.1f, 0.05f}, {1.0f, 0.0f, -0.08f}};
    static const float heights_km[HEIGHTS] = {0.002f, 11.0f};
    *sum = 2166136261u;
    for (int f = 0; f < SUNS * HEIGHTS; f++) {
        float direction[RAYS][3], out[3][RAYS][4], rgb[RAYS][3];
        skv_frame frame;
        skv_light sun;
        memset(out, 0, sizeof out);
        for (int i = 0; i < RAYS; i++) {
            direction[i][0] = 1.0f;
            direction[i][1] = 0.1f * (float)(i % 7) - 0.3f;
            direction[i][2] = 0.07f * (float)(i - RAYS / 2);
        }
        skv_status status = skv_light_sun(&sun, model, suns[f % SUNS]);
        if (status == SKV_OK)
            status = skv_frame_begin(&frame, model, NULL, heights_km[f / SUNS], 0.0f, &sun, 1);
        if (status == SKV_OK)
            status = skv_frame_table(&frame, table);
        const skv_rays rays = {direction[0], 0, NULL, 0};
        const skv_sky sky = {out[0][0], 16, out[1][0], 16};
        if (status == SKV_OK)
            status = skv_radiance(&frame, RAYS, &rays, &sky);
        if (status == SKV_OK)
            status = skv_colour(matrix, model->bands, RAYS, out[0][0], 16, rgb[0], 0, out[2][0], 16);
        if (status != SKV_OK)
            return status;
        for (int i = 0; i < 3 * RAYS * 4; i++) {
            uint32_t word;
            memcpy(&word, &out[i / (4 * RAYS)][i / 4 % RAYS][i % 4], sizeof word);
            *sum = (*sum ^ word) * 16777619u;
        }
    }
    return SKV_OK;
}

#ifndef SKV_TEST_SMALL
#include <stdlib.h>

/// What was baked, built here: earth-hazy, four bands, accurate table, ground at the sea.
static int compare_with_built(uint32_t sum) {
    static skv_model model;
    skv_atmosphere air;
    skv_table_spec spec;
    skv_colour_matrix matrix;
    uint32_t built = 0;
    if (skv_atmosphere_preset(&air, SKV_PRESET_EARTH_HAZY, 4) != SKV_OK || skv_model_build(&model, &air) != SKV_OK ||
        skv_table_spec_kind(&spec, SKV_TABLE_ACCURATE) != SKV_OK)
        return failed("building a model");
    const size_t size = skv_table_size(&spec, 4), work_size = skv_table_work_size(&spec, 4);
    void *const table = calloc(1, size), *const work = malloc(work_size);
    if (!table || !work || skv_table_build(table, size, work, work_size, &model, &spec) != SKV_OK ||
        skv_colour_matrix_for(&matrix, 4, air.wavelength_nm, air.solar_irradiance) != SKV_OK)
        return failed("building a table");
    if (memcmp(&model, baked_model(), sizeof model) != 0)
        return failed("the baked model differs from the one that is built");
    if (size != sizeof baked_table_words || memcmp(table, baked_table(), size) != 0)
        return failed("the baked table differs from the one that is built");
    if (memcmp(&matrix, &baked_colour, sizeof matrix) != 0)
        return failed("the baked colour matrix differs");
    if (checksum(&model, table, &matrix, &built) != SKV_OK || built != sum)
        return failed("radiance with the baked table differs");
    free(table);
    free(work);
    printf("note: baked C: model %zu bytes, table %zu bytes\n", sizeof(skv_model), sizeof baked_table_words);
    return 0;
}
#endif

int main(void) {
    uint32_t sum = 0;
    if (baked_check() != SKV_OK)
        return failed("skv_table_check() of the baked table");
    if (checksum(baked_model(), baked_table(), &baked_colour, &sum) != SKV_OK)
        return failed("radiance with the baked table");
    printf("checksum %08lx\n", (unsigned long)sum);
#ifndef SKV_TEST_SMALL
    return compare_with_built(sum);
#else
    return 0;
#endif
}
