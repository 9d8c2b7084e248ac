/// A model, a frame and single rays for the tests of what is added to the sky.
#ifndef TESTS_SCENE_SKY_H
#define TESTS_SCENE_SKY_H

#include "api/random.h"
#include "check.h"

#include "skyvert/skyvert.h"

#define PI 3.14159265358979323846

/// One model at a time: it is 8 KiB, which a microcontroller has not often.
static skv_model scene_model;
static int scene_is_earth;

/// An atmosphere without air: these calls ask the model for its bands and the planet only. The one before is gone.
static inline skv_model *airless(int bands, const float nm[]) {
    skv_atmosphere a;
    assert_int_equal(skv_atmosphere_clear(&a, bands), SKV_OK);
    for (int b = 0; b < bands; b++) {
        a.wavelength_nm[b] = nm != NULL ? nm[b] : a.wavelength_nm[b];
        a.albedo[b] = 0.1f;
    }
    assert_int_equal(skv_model_build(&scene_model, &a), SKV_OK);
    scene_is_earth = 0;
    return &scene_model;
}

/// With the presets' four bands; not to be changed.
static inline const skv_model *earth(void) {
    if (!scene_is_earth)
        airless(4, NULL);
    scene_is_earth = 1;
    return &scene_model;
}

static inline skv_frame frame_at(const skv_model *model, float height_km, const skv_light *light) {
    skv_frame frame;
    assert_int_equal(skv_frame_begin(&frame, model, NULL, height_km, 0.0f, light, light != NULL ? 1 : 0), SKV_OK);
    return frame;
}

static inline void unit_of(double zenith_rad, double azimuth_rad, float v[3]) {
    v[0] = (float)(sin(zenith_rad) * sin(azimuth_rad));
    v[1] = (float)(sin(zenith_rad) * cos(azimuth_rad));
    v[2] = (float)cos(zenith_rad);
}

/// A few numbers that tests of any float put in.
static inline float odd_float(int i) {
    static const float edge[] = {0.0f,  -0.0f, 1.0f,  -1.0f,  1e-45f, 1e-38f,   -1e-30f,   3.4e38f,
                                 1e20f, 0.5f,  90.0f, 180.0f, 1e-6f,  INFINITY, -INFINITY, NAN};
    const int n = (int)(sizeof edge / sizeof edge[0]);
    return i % 3 == 0 ? random_float() : i % 3 == 1 ? edge[random_word() % (uint32_t)n] : (float)random_in(-2, 2);
}

#endif
