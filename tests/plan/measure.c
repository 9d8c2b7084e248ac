/// A program as a product would build it: with the planner's skv_config.h, on the target, its choices from SKV_PLAN_*.
/// Prints `frame` per counted window (a whole frame: begin, table, grid, dome, terrain), then `ray BITS...`, the
/// radiance of the rays whose truth is known.
#include "tests/gates/window.h"

#include <stdio.h>
#include <string.h>

#include "skyvert/skyvert.h"

typedef struct case_frame {
    int air;
    float height_km, sun_enu[3];
} case_frame;

#include "case.h"

#if !defined(__x86_64__)
__attribute__((noinline)) void window_begin(void) {
    __asm volatile("" ::: "memory");
}
__attribute__((noinline)) void window_end(void) {
    __asm volatile("" ::: "memory");
}
#endif

static skv_model model[sizeof case_air / sizeof case_air[0]];
static skv_frame frame;
static float radiance[CASE_DOME + 1][SKV_BANDS];
static float terrain[CASE_TERRAIN + 1][SKV_BANDS];
#if SKV_OUT_TRANSMITTANCE
static float transmittance[CASE_DOME + 1][SKV_BANDS];
#endif
#if SKV_PLAN_GRID
static float grid[SKV_PLAN_GRID_BYTES / 4];
#endif

static skv_status begin(const case_frame *f) {
    skv_quality quality;
    skv_light sun;
    skv_status status = skv_quality_tier(&quality, SKV_TIER_STANDARD);
    quality.samples = SKV_PLAN_SAMPLES;
    quality.terms = SKV_PLAN_TERMS;
    if (status == SKV_OK)
        status = skv_light_sun(&sun, &model[f->air], f->sun_enu);
    if (status == SKV_OK)
        status = skv_frame_begin(&frame, &model[f->air], &quality, f->height_km, CASE_GROUND_KM, &sun, 1);
#if SKV_PLAN_TABLE
    if (status == SKV_OK)
        status = skv_frame_table(&frame, (const skv_table *)(const void *)case_table[f->air]);
#endif
#if SKV_PLAN_GRID
    if (status == SKV_OK)
        status = skv_frame_grid(&frame, grid, sizeof grid);
#endif
    return status;
}

static skv_status draw(void) {
    const skv_rays dome = {case_dome[0], 0, NULL, 0}, far = {case_terrain[0], 0, case_length_km, 0};
    skv_sky sky = {radiance[0], 0, NULL, 0}, behind = {terrain[0], 0, NULL, 0};
#if SKV_OUT_TRANSMITTANCE
    sky.transmittance = CASE_STARS ? transmittance[0] : NULL;
    behind.transmittance = transmittance[0];
#endif
    const skv_status status = skv_radiance(&frame, CASE_DOME, &dome, &sky);
    return status != SKV_OK || CASE_TERRAIN == 0 ? status : skv_radiance(&frame, CASE_TERRAIN, &far, &behind);
}

static skv_status count(void) {
    for (int i = 0; i < CASE_COUNTED; i++) {
        char name[16];
        snprintf(name, sizeof name, "%d", i);
        (void)name;
        WINDOW_BEGIN();
        skv_status status = begin(&case_counted[i]);
        if (status == SKV_OK)
            status = draw();
        WINDOW_END(name);
        if (status != SKV_OK)
            return status;
        printf("frame\n");
    }
    return SKV_OK;
}

static skv_status shine(int i) {
    const skv_rays rays = {case_view[i * CASE_RAYS], 0, NULL, 0};
    const skv_sky sky = {radiance[0], 0, NULL, 0};
    skv_status status = begin(&case_frames[i]);
    if (status == SKV_OK)
        status = skv_radiance(&frame, CASE_RAYS, &rays, &sky);
    for (int j = 0; status == SKV_OK && j < CASE_RAYS; j++) {
        printf("ray");
        for (int b = 0; b < SKV_BANDS; b++) {
            uint32_t bits;
            memcpy(&bits, &radiance[j][b], sizeof bits);
            printf(" %08lx", (unsigned long)bits);
        }
        printf("\n");
    }
    return status;
}

int main(void) {
    skv_status status = SKV_OK;
    for (size_t i = 0; i < sizeof case_air / sizeof case_air[0] && status == SKV_OK; i++)
        status = skv_model_build(&model[i], &case_air[i]);
    if (status == SKV_OK && (status = begin(&case_counted[0])) == SKV_OK)
        status = draw(); // what the loader resolves at first use is not the library's
    if (status == SKV_OK)
        status = count();
    for (int i = 0; i < CASE_FRAMES && status == SKV_OK; i++)
        status = shine(i);
    if (status != SKV_OK)
        printf("failed %d\n", (int)status);
    return status != SKV_OK;
}
