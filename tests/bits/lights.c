/// Discs, moonlight, stars, the night floor and water.
#include "bits.h"

#include "skyvert/disc.h"
#include "skyvert/night.h"
#include "skyvert/stars.h"
#include "skyvert/water.h"

enum { RAYS = 8 };

#define model bits_model
static float view[RAYS][3], radiance[RAYS][4], through[RAYS][4];

static void begin_model(void) {
    skv_atmosphere air;
    bits_word((uint32_t)skv_atmosphere_clear(&air, 4));
    for (int b = 0; b < 4; ++b)
        air.albedo[b] = 0.05f * (float)b;
    bits_word((uint32_t)skv_model_build(&model, &air));
}

static skv_frame begin_frame(const float direction[3]) {
    static const float height[4] = {0.0f, 0.01f, 11.0f, 400.0f};
    const skv_light light = {{direction[0], direction[1], direction[2]}, {1.9f, 1.8f, 1.7f, 1.6f}};
    skv_frame frame;
    bits_word((uint32_t)skv_frame_begin(&frame, &model, NULL, height[bits_pick(4)], 0.0f, &light, 1));
    return frame;
}

static void fill_rays(void) {
    for (int i = 0; i < RAYS; ++i) {
        bits_direction(view[i]);
        for (int b = 0; b < 4; ++b) {
            radiance[i][b] = bits_uniform(0.0f, 0.1f);
            through[i][b] = bits_uniform(0.0f, 1.0f);
        }
    }
}

static void discs(int n) {
    for (int i = 0; i < n; ++i) {
        float sun[3], moon[3];
        bits_direction(sun);
        bits_direction(moon);
        const skv_frame frame = begin_frame(sun);
        const skv_light light = {{sun[0], sun[1], sun[2]}, {1.9f, 1.8f, 1.7f, 1.6f}};
        skv_moon seen = {.distance_km = bits_uniform(356000.0f, 407000.0f)};
        seen.phase_angle_deg = bits_uniform(0.0f, 180.0f);
        skv_moonlight moonlight;
        skv_disc disc;
        bits_word((uint32_t)skv_moonlight_at(&moonlight, &model, &seen, 1.0f, (int)bits_pick(3) - 1));
        bits_floats(moonlight.irradiance, 4, BITS_NOT_NEGATIVE);
        bits_floats(moonlight.earthshine, 4, BITS_NOT_NEGATIVE);
        const float sample = bits_pick(3) == 0 ? 0.0f : bits_product(0.0f, 0.1f, 1.0f);
        bits_word((uint32_t)(i % 2 ? skv_disc_sun(&disc, &model, &light, 1.0f, sample)
                                   : skv_disc_moon(&disc, &model, &moonlight, moon, sun, sample)));
        bits_floats(disc.level, 4, BITS_NOT_NEGATIVE);
        const float pressure = bits_uniform(0.0f, 1100.0f);
        bits_word((uint32_t)skv_disc_refract(&disc, pressure, 10.0f));
        fill_rays();
        for (int k = 0; k < RAYS; ++k)
            for (int c = 0; c < 3; ++c)
                view[k][c] = disc.direction_enu[c] + bits_uniform(-0.003f, 0.003f);
        const skv_rays rays = {view[0], 0, NULL, 0};
        const skv_sky sky = {radiance[0], 0, through[0], 0};
        bits_word((uint32_t)skv_disc_add(&disc, &frame, RAYS, &rays, &sky));
        bits_floats(radiance[0], sizeof radiance / sizeof(float), BITS_NOT_NEGATIVE);
    }
}

static void stars(int n) {
    for (int i = 0; i < n; ++i) {
        float magnitude[RAYS], luminance[RAYS], weight[RAYS], lux[RAYS], limit;
        fill_rays();
        for (int k = 0; k < RAYS; ++k) {
            magnitude[k] = bits_uniform(-5.0f, 8.0f);
            luminance[k] = bits_product(0.0f, 1.0f, 0.01f);
        }
        const skv_stars set = {.magnitude = magnitude,
                               .transmittance = through[0],
                               .bands = 4,
                               .band_weight = {0.1f, 0.4f, 0.3f, 0.2f},
                               .luminance = luminance,
                               .field_factor = 2.0f};
        bits_word((uint32_t)skv_star_weight(&set, RAYS, weight, 0, lux, 0));
        bits_floats(weight, RAYS, BITS_NOT_NEGATIVE);
        bits_floats(lux, RAYS, BITS_NOT_NEGATIVE);
        bits_word((uint32_t)skv_limiting_magnitude(&limit, luminance[0], 2.0f));
        bits_float(limit, BITS_FINITE);
    }
}

static void nights(int n) {
    for (int i = 0; i < n; ++i) {
        float sun[3];
        skv_night night;
        bits_direction(sun);
        const skv_frame frame = begin_frame(sun);
        bits_word((uint32_t)skv_night_earth(&night));
        night.scale = 1e9f / 1e6f; // large enough to be compared where tiny values count as 0
        fill_rays();
        const skv_rays rays = {view[0], 0, NULL, 0};
        const skv_sky sky = {radiance[0], 0, through[0], 0};
        bits_word((uint32_t)skv_night_add(&night, &frame, RAYS, &rays, &sky));
        bits_floats(radiance[0], sizeof radiance / sizeof(float), BITS_NOT_NEGATIVE);
    }
}

static void waters(int n) {
    for (int i = 0; i < n; ++i) {
        float sun[3];
        skv_water water;
        skv_water_hit hits[RAYS];
        bits_direction(sun);
        const skv_frame frame = begin_frame(sun);
        const float wind = bits_uniform(0.0f, 20.0f);
        const float azimuth = bits_uniform(-360.0f, 360.0f);
        bits_word((uint32_t)(bits_pick(4) == 0 ? skv_water_flat(&water) : skv_water_wind(&water, wind, azimuth)));
        fill_rays();
        for (int k = 0; k < RAYS; ++k)
            view[k][2] = view[k][2] > 0.0f ? -view[k][2] : view[k][2];
        const skv_rays rays = {view[0], 0, NULL, 0};
        const skv_sky sky = {radiance[0], 0, through[0], 0};
        bits_word((uint32_t)skv_water_mirror(&water, &frame, RAYS, &rays, hits));
        for (int k = 0; k < RAYS; ++k) {
            bits_floats(hits[k].local_enu, 3, BITS_FINITE);
            bits_floats(hits[k].mirror_enu, 3, BITS_FINITE);
            bits_float(hits[k].distance_km, BITS_NOT_NEGATIVE);
            bits_float(hits[k].cos_incidence, BITS_NOT_NEGATIVE);
            bits_float(hits[k].reflectance, BITS_NOT_NEGATIVE);
        }
        bits_word((uint32_t)skv_water_glint(&water, &frame, 0, NULL, RAYS, &rays, &sky));
        bits_word((uint32_t)skv_water_add(&frame, RAYS, hits, through[0], 0, &sky));
        bits_floats(radiance[0], sizeof radiance / sizeof(float), BITS_NOT_NEGATIVE);
        const float cosine = bits_uniform(0.0f, 1.0f);
        bits_float(skv_fresnel_schlick(cosine, 1.333f), BITS_NOT_NEGATIVE);
    }
}

void bits_lights(bits_scale scale) {
    const char *const name = scale == BITS_SMALL ? "small" : "full";
    const int n = scale == BITS_SMALL ? 20 : 2000;
    bits_begin(name, "discs");
    begin_model();
    discs(n);
    bits_end();
    bits_begin(name, "stars");
    stars(n);
    bits_end();
    bits_begin(name, "night");
    nights(n);
    bits_end();
    bits_begin(name, "water");
    waters(n);
    bits_end();
}
