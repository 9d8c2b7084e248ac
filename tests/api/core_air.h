/// Atmospheres, directions and frames for the tests of the core.
#ifndef TESTS_API_CORE_AIR_H
#define TESTS_API_CORE_AIR_H

#include <math.h>
#include <string.h>

#include "airs.h"
#include "check.h"
#include "skyvert/radiance.h"

static inline void check_status(const char *what, skv_status got, skv_status want) {
    if (got != want)
        fail_msg("%s: got status %d, want %d", what, (int)got, (int)want);
}

/// The figures of tools/bench/br17o.ini: clear, with ozone.
static inline skv_atmosphere air_br17o(void) {
    skv_atmosphere a = air_clear(4);
    fill(a.solar_irradiance, 1, 1, 1, 1);
    fill(a.albedo, 0.1, 0.1, 0.1, 0.1);
    return a;
}

/// The figures of tools/bench/br16.ini: strong aerosol, no ozone.
static inline skv_atmosphere air_br16(void) {
    skv_atmosphere a = air_hazy(4);
    fill(a.solar_irradiance, 1, 1, 1, 1);
    fill(a.albedo, 0.03, 0.055, 0.061, 0.035);
    return a;
}

/// A layer of smoke beside that: its own scale height, phase function and colours.
static inline skv_atmosphere air_smoky(void) {
    skv_atmosphere a = air_br17o();
    fill(a.dust_scattering_per_km, 0.03, 0.022, 0.016, 0.012);
    fill(a.dust_extinction_per_km, 0.034, 0.025, 0.018, 0.0135);
    a.dust.kind = SKV_PROFILE_EXPONENTIAL;
    a.dust.scale_height_km = 2.5f;
    a.dust_phase = SKV_PHASE_HG;
    a.dust_g = 0.6f;
    return a;
}

/// Zenith angle, and azimuth clockwise from north; exactly level at 90 degrees, exactly down at 180.
static inline void toward(float to[3], double zenith_deg, double azimuth_deg) {
    const double level = zenith_deg == 180 ? 0 : sin(zenith_deg * DEGREE);
    to[0] = (float)(level * sin(azimuth_deg * DEGREE));
    to[1] = (float)(level * cos(azimuth_deg * DEGREE));
    to[2] = zenith_deg == 90 ? 0.0f : (float)cos(zenith_deg * DEGREE);
}

static inline skv_quality quality_of(skv_rule rule, skv_depth depth, int samples, int depth_samples, uint32_t terms) {
    const skv_quality q = {rule, depth, samples, depth_samples, terms};
    return q;
}

static inline skv_quality tier_of(skv_tier tier, uint32_t terms) {
    skv_quality q;
    check_status("skv_quality_tier", skv_quality_tier(&q, tier), SKV_OK);
    q.terms = terms;
    return q;
}

static inline void build(skv_model *model, const skv_atmosphere *atmosphere) {
    check_status("skv_model_build", skv_model_build(model, atmosphere), SKV_OK);
}

/// One sun of the model's irradiance, at azimuth 137 degrees.
#define SUN_AZIMUTH 137.0
static inline void begin(skv_frame *frame, const skv_model *model, const skv_quality *quality, double observer_km,
                         double ground_km, double sun_deg) {
    float direction[3];
    skv_light sun;
    toward(direction, sun_deg, SUN_AZIMUTH);
    check_status("skv_light_sun", skv_light_sun(&sun, model, direction), SKV_OK);
    check_status("skv_frame_begin",
                 skv_frame_begin(frame, model, quality, (float)observer_km, (float)ground_km, &sun, 1), SKV_OK);
}

typedef struct shone {
    float radiance[4];
    float transmittance[4];
} shone;

/// One ray of four bands.
static inline shone shine(const skv_frame *frame, const float direction[3], float length_km) {
    shone out;
    const skv_rays rays = {direction, 0, &length_km, 0};
    const skv_sky sky = {out.radiance, 0, out.transmittance, 0};
    check_status("skv_radiance", skv_radiance(frame, 1, &rays, &sky), SKV_OK);
    return out;
}

static inline double largest4(const float x[4]) {
    double most = 0;
    for (int b = 0; b < 4; b++)
        most = (double)x[b] > most ? (double)x[b] : most;
    return most;
}

static inline void check_same_bits(const char *what, const shone *got, const shone *want) {
    for (int b = 0; b < 4; b++)
        if (memcmp(&got->radiance[b], &want->radiance[b], sizeof(float)) != 0 ||
            memcmp(&got->transmittance[b], &want->transmittance[b], sizeof(float)) != 0)
            fail_msg("%s, band %d: got radiance %.9g, transmittance %.9g, want %.9g and %.9g, tolerance 0", what, b,
                     (double)got->radiance[b], (double)got->transmittance[b], (double)want->radiance[b],
                     (double)want->transmittance[b]);
}

/// Radiance relative to the largest band wanted, transmittance as it is.
static inline void check_alike(const char *what, const shone *got, const shone *want, double radiance,
                               double transmittance) {
    for (int b = 0; b < 4; b++) {
        check_near(what, (double)got->radiance[b], (double)want->radiance[b], radiance * largest4(want->radiance));
        check_near(what, (double)got->transmittance[b], (double)want->transmittance[b], transmittance);
    }
}

#endif
