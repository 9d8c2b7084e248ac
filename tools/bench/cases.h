/// Rules that are compared and the air they are compared in.
#ifndef TOOLS_BENCH_CASES_H
#define TOOLS_BENCH_CASES_H

#include <stddef.h>

#include "convert.h"
#include "skyvert/frame.h"
#include "skyvert/radiance.h"

typedef struct bench_rule {
    const char *name;
    int tier; ///< -1: the quality below
    skv_rule rule;
    int samples;
    skv_depth depth;
    int depth_samples;
} bench_rule;

extern const bench_rule bench_rules[];
extern const size_t bench_rule_count;

/// SKV_OK, or what the library says to this build's lack of the rule.
skv_status bench_quality(const bench_rule *rule, skv_quality *quality);

/// An atmosphere as the library sees it and as the reference sees the very same floats.
typedef struct bench_air {
    ref_file truth;
    ref_float_tables tables;
    skv_atmosphere atmosphere;
    skv_model model;
} bench_air;

/// Reads an ini file; bare: without ozone and with the first three bands only. Exits with a message when it cannot.
void bench_air_load(bench_air *air, const char *name, int bare);

/// Ends the program with a message unless the status is SKV_OK.
void bench_check(skv_status status, const char *what);

/// A frame with the sun in the south at this zenith angle.
void bench_frame(skv_frame *frame, const bench_air *air, const skv_quality *quality, float height_km,
                 double sun_zenith_deg);

/// East-north-up; azimuth from the sun's.
void bench_direction(float direction[3], double zenith_deg, double azimuth_deg);

#endif
