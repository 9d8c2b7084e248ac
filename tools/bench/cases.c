/// Rules that are compared and the air they are compared in.
#include "cases.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

const bench_rule bench_rules[] = {
    {"keller 4x4", -1, SKV_KELLER, 4, SKV_DEPTH_BY_INNER, 4},
    {"keller 5x5", -1, SKV_KELLER, 5, SKV_DEPTH_BY_INNER, 5},
    {"keller 16x16", -1, SKV_KELLER, 16, SKV_DEPTH_BY_INNER, 16},
    {"uniform 16x16", -1, SKV_UNIFORM, 16, SKV_DEPTH_BY_INNER, 16},
    {"gauss-exp 8, inner 16", -1, SKV_GAUSS_EXP, 8, SKV_DEPTH_BY_INNER, 16},
    {"gauss-exp fast", SKV_TIER_FAST, SKV_GAUSS_EXP, 4, SKV_DEPTH_BY_CHAPMAN, 1},
    {"gauss-exp standard", SKV_TIER_STANDARD, SKV_GAUSS_EXP, 6, SKV_DEPTH_BY_CHAPMAN, 1},
    {"gauss-exp high", SKV_TIER_HIGH, SKV_GAUSS_EXP, 8, SKV_DEPTH_BY_CHAPMAN, 1},
};
const size_t bench_rule_count = sizeof bench_rules / sizeof *bench_rules;

skv_status bench_quality(const bench_rule *rule, skv_quality *quality) {
    if (rule->tier >= 0)
        return skv_quality_tier(quality, (skv_tier)rule->tier);
    *quality = (skv_quality){rule->rule, rule->depth, rule->samples, rule->depth_samples,
                             SKV_WITH_ALL & ~(uint32_t)SKV_WITH_GROUND};
    return SKV_OK;
}

void bench_check(skv_status status, const char *what) {
    if (status == SKV_OK)
        return;
    fprintf(stderr, "bench: %s: status %d\n", what, (int)status);
    exit(1);
}

void bench_air_load(bench_air *air, const char *name, int bare) {
    if (ref_read_ini(&air->truth, name) != 0)
        exit(2);
    if (bare) {
        air->truth.atmosphere.bands = 3;
        air->truth.atmosphere.ozone.kind = REF_NONE;
    }
    ref_to_skyvert(&air->truth.atmosphere, &air->atmosphere, &air->tables);
    bench_check(skv_model_build(&air->model, &air->atmosphere), "skv_model_build");
    ref_from_skyvert(&air->atmosphere, 0, &air->truth);
}

void bench_direction(float direction[3], double zenith_deg, double azimuth_deg) {
    const double degree = 3.14159265358979323846 / 180;
    direction[0] = (float)(sin(zenith_deg * degree) * sin(azimuth_deg * degree));
    direction[1] = (float)(-sin(zenith_deg * degree) * cos(azimuth_deg * degree));
    direction[2] = (float)cos(zenith_deg * degree);
}

void bench_frame(skv_frame *frame, const bench_air *air, const skv_quality *quality, float height_km,
                 double sun_zenith_deg) {
    float sun[3];
    skv_light light;
    bench_direction(sun, sun_zenith_deg, 0);
    bench_check(skv_light_sun(&light, &air->model, sun), "skv_light_sun");
    bench_check(skv_frame_begin(frame, &air->model, quality, height_km, 0, &light, 1), "skv_frame_begin");
}
