/// Light scattered more than once: the bytes of tables, radiance with and without a grid, irradiance.
#include "bits.h"

#include <string.h>

#include "skyvert/skyvert.h"

enum { RAYS = 9, TABLE_WORDS = 1060, WORK_WORDS = 2800, GRID_BYTES = 4 * WORK_WORDS };

#define model bits_model
static skv_frame frame;
static uint32_t table[TABLE_WORDS], work[WORK_WORDS];
// In the work space, which nothing else uses by then; two lights of four bands are refused.
static float *const grid = (float *)(void *)work;

static const skv_table *built(void) {
    return (const skv_table *)(const void *)table;
}

/// Small ones: what a board has room and time for.
static skv_table_spec random_spec(void) {
    skv_table_spec s;
    bits_word((uint32_t)skv_table_spec_kind(&s, SKV_TABLE_SMALL));
    s.altitudes = 4;
    s.detailed = (int32_t)bits_pick(2);
    s.suns = 8;
    s.orders = 2 + (int32_t)bits_pick(3);
    for (int i = 0; i < 2; ++i) {
        s.samples[i] = 2 + (int32_t)bits_pick(5);
        s.polar[i] = 2;
        s.azimuths[i] = 2 + (int32_t)bits_pick(2);
    }
    s.format = bits_pick(3) == 0 ? SKV_TABLE_FLOAT : SKV_TABLE_PACKED;
    s.ground_km = bits_pick(3) == 0 ? 0.4f : 0.0f;
    return s;
}

static void begin_frame(float top_km) {
    static const float height[5] = {0.0f, 0.01f, 1.0f, 0.2f, 1.5f};
    const uint32_t which = bits_pick(5);
    skv_light light[2];
    skv_quality quality;
    const int32_t lights = 1 + (bits_pick(3) == 0);
    for (int32_t i = 0; i < lights; ++i) {
        bits_word((uint32_t)skv_light_sun(&light[i], &model, (const float[3]){0.0f, 0.0f, 1.0f}));
        bits_direction(light[i].direction_enu);
    }
    bits_word((uint32_t)skv_quality_tier(&quality, (skv_tier)bits_pick(3)));
    quality.terms = SKV_WITH_ALL;
    bits_word((uint32_t)skv_frame_begin(&frame, &model, &quality, which < 3 ? height[which] : height[which] * top_km,
                                        0.0f, light, lights));
    bits_word((uint32_t)skv_frame_table(&frame, built()));
}

static void shoot(void) {
    float view[RAYS][3], radiance[RAYS][4] = {{0}}, transmittance[RAYS][4] = {{0}}, irradiance[RAYS][4] = {{0}};
    for (int i = 0; i < RAYS; ++i)
        bits_direction(view[i]);
    const skv_rays rays = {view[0], 0, NULL, 0};
    const skv_sky sky = {radiance[0], sizeof *radiance, transmittance[0], sizeof *transmittance};
    bits_word((uint32_t)skv_radiance(&frame, RAYS, &rays, &sky));
    bits_floats(radiance[0], sizeof radiance / sizeof(float), BITS_NOT_NEGATIVE);
    bits_word(
        (uint32_t)skv_irradiance(&frame, SKV_IRRADIANCE_ALL, RAYS, view[0], 0, irradiance[0], sizeof *irradiance));
    bits_floats(irradiance[0], sizeof irradiance / sizeof(float), BITS_NOT_NEGATIVE);
    const skv_status status = skv_frame_grid(&frame, grid, GRID_BYTES);
    bits_word((uint32_t)status);
    if (status != SKV_OK)
        return;
    bits_floats(grid, skv_grid_size(&frame) / sizeof(float), BITS_NOT_NEGATIVE);
    bits_word((uint32_t)skv_radiance(&frame, RAYS, &rays, &sky));
    bits_floats(radiance[0], sizeof radiance / sizeof(float), BITS_NOT_NEGATIVE);
}

/// Tables may be carried from one machine to another: every byte counts. A host that flushes small numbers to 0 may
/// have other logarithms of the dark cells: not compared then.
static void one_table(uint32_t preset, uint32_t frames) {
    skv_atmosphere air;
    const skv_table_spec spec = random_spec();
    bits_word((uint32_t)skv_atmosphere_preset(&air, (skv_preset)preset, 3 + (int32_t)bits_pick(2)));
    air.albedo[1] = bits_uniform(0.0f, 1.0f);
    bits_word((uint32_t)skv_model_build(&model, &air));
    memset(table, 0, sizeof table);
    bits_word((uint32_t)skv_table_build((skv_table *)(void *)table, sizeof table, work, sizeof work, &model, &spec));
    bits_word((uint32_t)skv_table_check(table, sizeof table, &model));
    for (size_t i = 0; i < built()->bytes / sizeof *table; ++i)
        bits_word(bits_tiny_is_zero() ? 0 : table[i]);
    for (uint32_t i = 0; i < frames; ++i) {
        begin_frame(air.top_km);
        shoot();
    }
}

void bits_tables(bits_scale scale) {
    bits_begin(scale == BITS_SMALL ? "small" : "full", "tables");
    for (uint32_t i = 0; i < (scale == BITS_SMALL ? 2u : 40u); ++i)
        one_table(scale == BITS_SMALL ? (uint32_t)SKV_PRESET_EARTH_HAZY + i : i % SKV_PRESET_COUNT,
                  scale == BITS_SMALL ? 3u : 8u);
    bits_end();
}
