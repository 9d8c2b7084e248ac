/// One checksum over rules, depths, airs, heights and suns: equal whatever SKV_LANES the core was built with.
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "skyvert/radiance.h"

#define RAYS 77

static uint32_t hash = 2166136261u; // FNV-1a

static void add(const void *data, size_t n) {
    const unsigned char *p = data;
    for (size_t i = 0; i < n; i++)
        hash = (hash ^ p[i]) * 16777619u;
}

static void shine(const skv_model *model, const skv_quality *quality, float height, float mu_s) {
    static float view[RAYS][3], radiance[RAYS][4], through[RAYS][4];
    const float sun[3] = {0.0f, -0.5f, mu_s};
    skv_light light;
    skv_frame frame;
    for (int i = 0; i < RAYS; i++) {
        view[i][0] = (float)(i % 7) - 3.0f;
        view[i][1] = (float)(i % 5) - 2.0f;
        view[i][2] = i % 3 ? 0.01f * (float)(i - RAYS / 2) : 0.2f * (float)(i - RAYS / 3) + 0.1f;
    }
    const skv_rays rays = {view[0], 0, NULL, 0};
    const skv_sky sky = {radiance[0], sizeof radiance[0], through[0], sizeof through[0]};
    const skv_status status[] = {skv_light_sun(&light, model, sun),
                                 skv_frame_begin(&frame, model, quality, height, 0.0f, &light, 1),
                                 skv_radiance(&frame, RAYS, &rays, &sky)};
    add(status, sizeof status);
    for (int i = 0; i < RAYS; i++) {
        add(radiance[i], (size_t)model->bands * sizeof(float));
        add(through[i], (size_t)model->bands * sizeof(float));
    }
}

int main(void) {
    static const float heights[] = {0.0f, 1.5f, 25.0f, 70.0f}, suns[] = {0.7f, 0.01f, -0.03f};
    static skv_model model;
    for (int preset = 0; preset < SKV_PRESET_COUNT; preset++)
        for (int n = 0; n < 2 * 3 * 4 * 3; n++) {
            skv_atmosphere a;
            const skv_quality q = {(skv_rule)(n % 3), n / 3 % 2 ? SKV_DEPTH_BY_INNER : SKV_DEPTH_BY_CHAPMAN, 5, 4,
                                   SKV_WITH_ALL};
            if (skv_atmosphere_preset(&a, (skv_preset)preset, 3 + preset % 2) != SKV_OK ||
                skv_model_build(&model, &a) != SKV_OK)
                return 1;
            shine(&model, &q, heights[n / 6 % 4], suns[n / 24]);
        }
    printf("%08x\n", (unsigned)hash);
    return 0;
}
