/// Airs to test in, as the library gets them and as the reference sees the same floats; rays, frames and errors.
#ifndef TESTS_PROPERTY_AIR_H
#define TESTS_PROPERTY_AIR_H

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "airs.h"
#include "check.h"
#include "convert.h"
#include "skyvert/radiance.h"

typedef struct air {
    const char *name;
    skv_atmosphere atmosphere;
    skv_model model;
    ref_file truth;
    float ground_km;
} air;

static inline void must(skv_status status, const char *what) {
    if (status != SKV_OK)
        fail_msg("%s: status %d, wanted SKV_OK", what, (int)status);
}

/// Profiles that are not exponential.
static inline skv_atmosphere air_shaped(int bands) {
    skv_atmosphere a = air_clear(bands);
    a.rayleigh.kind = SKV_PROFILE_US76;
    a.rayleigh.us76_a = .07771971f;
    a.rayleigh.us76_b = 1.16364243f;
    a.aerosol.kind = SKV_PROFILE_EXP_BACKGROUND;
    a.aerosol.background = 2e-3f;
    a.aerosol_phase = SKV_PHASE_HG;
    a.aerosol_g = 0.76f;
    a.ozone.kind = SKV_PROFILE_LOGNORMAL;
    a.ozone.lognormal_mu = 3.22261f;
    a.ozone.lognormal_k = 5.55555555f;
    return a;
}

/// Smoke of its own scale height and phase function, in a gas that absorbs.
static inline skv_atmosphere air_smoky(int bands) {
    skv_atmosphere a = air_clear(bands);
    fill(a.rayleigh_absorption_per_km, 0, 0.001, 0.003, 0.01);
    fill(a.dust_scattering_per_km, 0.03, 0.022, 0.016, 0.012);
    fill(a.dust_extinction_per_km, 0.034, 0.025, 0.018, 0.0135);
    a.dust.kind = SKV_PROFILE_EXP_BACKGROUND;
    a.dust.scale_height_km = 2.5f;
    a.dust.background = 1e-3f;
    a.dust_phase = SKV_PHASE_HG;
    a.dust_g = 0.6f;
    return a;
}

/// A layer: smoke between 2 and 5 km, or dust with sharper edges from a table.
static inline skv_atmosphere air_layered(int bands, int from_table) {
    static const float km[] = {0, 2.8f, 3, 4.5f, 5, 10}, density[] = {0, 0, 1, 1, 0, 0};
    skv_atmosphere a = air_clear(bands);
    fill(a.dust_scattering_per_km, 0.15, 0.115, 0.09, 0.08);
    fill(a.dust_extinction_per_km, 0.16, 0.12, 0.095, 0.085);
    a.dust.kind = from_table ? SKV_PROFILE_TABLE : SKV_PROFILE_TENT;
    a.dust.peak_km = 3.5f;
    a.dust.half_width_km = 1.5f;
    a.dust.table_altitude_km = km;
    a.dust.table_density = density;
    a.dust.table_rows = 6;
    a.dust_phase = SKV_PHASE_HG;
    a.dust_g = 0.66f;
    return a;
}

static inline void air_make(air *to, const char *name, skv_atmosphere atmosphere, float ground_km) {
    to->name = name;
    to->atmosphere = atmosphere;
    to->ground_km = ground_km;
    must(skv_model_build(&to->model, &to->atmosphere), name);
    ref_from_skyvert(&to->atmosphere, (double)ground_km, &to->truth);
}

/// Zenith angle and azimuth from the sun's azimuth; the sun stands in the south.
static inline void direction_of(float to[3], double zenith_deg, double azimuth_deg) {
    to[0] = (float)(sin(zenith_deg * DEGREE) * sin(azimuth_deg * DEGREE));
    to[1] = (float)(-sin(zenith_deg * DEGREE) * cos(azimuth_deg * DEGREE));
    to[2] = (float)cos(zenith_deg * DEGREE);
}

static inline skv_quality quality_of(skv_rule rule, skv_depth depth, int samples, int depth_samples) {
    const skv_quality q = {rule, depth, samples, depth_samples, SKV_WITH_ALL & ~(uint32_t)SKV_WITH_GROUND};
    return q;
}

static inline void frame_of(skv_frame *frame, const air *a, const skv_quality *quality, float observer_km,
                            const float sun[3]) {
    skv_light light;
    must(skv_light_sun(&light, &a->model, sun), "skv_light_sun");
    must(skv_frame_begin(frame, &a->model, quality, observer_km, a->ground_km, &light, 1), "skv_frame_begin");
}

static inline void truth_of(const air *a, float observer_km, const float view[3], const float sun[3], double length_km,
                            int lit_ground, ref_answer *answer) {
    const double v[3] = {(double)view[0], (double)view[1], (double)view[2]};
    const double s[3] = {(double)sun[0], (double)sun[1], (double)sun[2]};
    ref_ray ray = ref_ray_from_vectors((double)observer_km - (double)a->ground_km, v, s);
    ray.length_km = length_km;
    if (ref_single(&a->truth.atmosphere, &ray, lit_ground, NULL, answer) != 0)
        fail_msg("%s: reference did not converge: height %g, mu %g, mu_s %g", a->name, (double)observer_km, ray.mu,
                 ray.mu_s);
}

static inline double largest_of(const double *x, int n) {
    double largest = 0;
    for (int i = 0; i < n; i++)
        largest = fmax(largest, x[i]);
    return largest;
}

static inline double halton(int i, int base) {
    double f = 1, r = 0;
    for (; i > 0; i /= base) {
        f /= base;
        r += f * (i % base);
    }
    return r;
}

/// xorshift64*: random tests repeat exactly. [Vigna16]
static inline uint64_t random_bits(uint64_t *state) {
    uint64_t x = *state;
    x ^= x >> 12;
    x ^= x << 25;
    x ^= x >> 27;
    *state = x;
    return x * 0x2545F4914F6CDD1DULL;
}

static inline double random_unit(uint64_t *state) {
    return (double)(random_bits(state) >> 11) * 0x1p-53;
}

#endif
