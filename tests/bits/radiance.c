/// Rules, depths, tiers, terms, presets, observers, suns, directions and lengths: radiance and transmittance.
#include "bits.h"

#include <math.h>

#include "skyvert/skyvert.h"

enum { MOST = 40 };

/// A caller's vertex: the fields lie apart, so the strides are used.
typedef struct vertex {
    float direction[3];
    float length_km;
    float radiance[4];
    float transmittance[4];
} vertex;

#define model bits_model
static skv_frame frame;

static void random_quality(skv_quality *q, uint32_t which) {
    static const uint8_t samples[3][4] = {{1, 5, 16, 33}, {2, 4, 5, 16}, {2, 5, 8, 16}};
    if (which < 3) {
        skv_quality_tier(q, (skv_tier)which);
        return;
    }
    q->rule = (skv_rule)(which % 3);
    q->depth = which % 6 < 3 ? SKV_DEPTH_BY_CHAPMAN : SKV_DEPTH_BY_INNER;
    q->samples = samples[q->rule][bits_pick(4)];
    q->depth_samples = 1 + (int32_t)bits_pick(9);
    q->terms = bits_pick(3) == 0 ? bits_pick(SKV_WITH_ALL + 1) : SKV_WITH_ALL;
}

static int32_t random_lights(skv_light *light) {
    const int32_t n = 1 + (bits_pick(4) == 0);
    for (int32_t i = 0; i < n; ++i) {
        skv_light_sun(&light[i], &model, (const float[3]){0.0f, 0.0f, 1.0f});
        light[i].direction_enu[0] = bits_uniform(-1.0f, 1.0f);
        light[i].direction_enu[1] = bits_uniform(0.1f, 1.0f);
        // half of the suns near the horizon or below it
        light[i].direction_enu[2] = bits_pick(2) == 0 ? bits_uniform(0.0f, 2.0f) : bits_uniform(-0.2f, 0.1f);
        light[i].irradiance[1] *= bits_uniform(0.5f, 1.0f);
    }
    return n;
}

static float random_observer(float top_km) {
    static const float low[6] = {-0.5f, 0.0f, 0.001f, 0.3f, 2.4f, 12.0f};
    const uint32_t which = bits_pick(9);
    if (which < 6)
        return low[which];
    return which == 6 ? top_km : which == 7 ? bits_uniform(0.0f, 1.2f) * top_km : 30.0f * top_km;
}

static float random_ground(float top_km) {
    static const float ground[4] = {0.0f, -0.43f, 2.4f, 0.587f};
    const float g = ground[bits_pick(4)];
    return g < 0.5f * top_km ? g : 0.0f;
}

static void shoot(int bands) {
    static vertex v[MOST];
    const size_t n = 1 + bits_pick(MOST);
    const int with_length = bits_pick(3) == 0;
    const int with_transmittance = bits_pick(2) == 0;
    for (size_t i = 0; i < n; ++i) {
        bits_direction(v[i].direction);
        v[i].length_km = bits_pick(2) == 0 ? INFINITY : bits_product(0.0f, 1.0f, 300.0f);
    }
    const skv_rays rays = {v[0].direction, sizeof *v, with_length ? &v[0].length_km : NULL, sizeof *v};
    const skv_sky sky = {v[0].radiance, sizeof *v, with_transmittance ? v[0].transmittance : NULL, sizeof *v};
    bits_word((uint32_t)skv_radiance(&frame, n, &rays, &sky));
    for (size_t i = 0; i < n; ++i) {
        bits_floats(v[i].radiance, (size_t)bands, BITS_NOT_NEGATIVE);
        if (with_transmittance)
            bits_floats(v[i].transmittance, (size_t)bands, BITS_NOT_NEGATIVE);
    }
}

static void one_frame(const skv_atmosphere *air, uint32_t which) {
    skv_quality quality;
    skv_light light[2];
    random_quality(&quality, which);
    const int32_t lights = random_lights(light);
    const float observer = random_observer(air->top_km);
    const float ground = random_ground(air->top_km);
    const skv_status status = skv_frame_begin(&frame, &model, &quality, observer, ground, light, lights);
    bits_word((uint32_t)status);
    // Numbers of rays that are no multiple of any number of lanes.
    if (status == SKV_OK)
        shoot(air->bands);
}

/// Variants of the presets, so that each profile and phase function is met.
static void vary(skv_atmosphere *air, uint32_t which) {
    air->aerosol_phase = which & 1 ? SKV_PHASE_CS : SKV_PHASE_HG;
    if (which & 2)
        air->turbidity = 3.0f;
    if (which % 5 == 4)
        air->aerosol_g = -0.6f;
    if (which % 7 == 3)
        air->absorption_colour[1] = 0.7f;
    if (which % 3 == 1) {
        for (int b = 0; b < 4; ++b) {
            air->dust_scattering_per_km[b] = 0.02f + 0.01f * (float)b;
            air->dust_extinction_per_km[b] = 0.05f;
            air->rayleigh_absorption_per_km[b] = 0.004f * (float)b;
        }
        air->dust = (skv_profile){.kind = SKV_PROFILE_TENT, .peak_km = 3.0f, .half_width_km = 1.0f};
        if (which % 2 == 0)
            air->dust = (skv_profile){.kind = SKV_PROFILE_EXPONENTIAL, .scale_height_km = 2.0f};
        air->dust_phase = which & 1 ? SKV_PHASE_HG : SKV_PHASE_CS;
        air->dust_g = 0.8f;
    }
    if (which % 4 == 3) {
        air->rayleigh.kind = SKV_PROFILE_US76;
        air->rayleigh.us76_a = 0.07771971f;
        air->rayleigh.us76_b = 1.16364243f;
    }
}

/// `variants` models of each preset with `frames` frames each.
static void sweep(uint32_t variants, uint32_t frames) {
    for (uint32_t preset = 0; preset < SKV_PRESET_COUNT; ++preset) {
        for (uint32_t variant = 0; variant < variants; ++variant) {
            skv_atmosphere air;
            skv_atmosphere_preset(&air, (skv_preset)preset, (preset + variant) % 2 == 0 ? 3 : 4);
            vary(&air, preset + variant);
            bits_word((uint32_t)skv_model_build(&model, &air));
            for (uint32_t i = 0; i < frames; ++i)
                one_frame(&air, (i + variant) % 9);
        }
    }
}

void bits_radiance(bits_scale scale) {
    bits_begin(scale == BITS_SMALL ? "small" : "full", "radiance");
    if (scale == BITS_SMALL)
        sweep(1, 9);
    else
        sweep(8, 36);
    bits_end();
}
