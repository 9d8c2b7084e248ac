/// What the tests of baked tables share: a preset's sky evaluated directly, random directions, errors.
#ifndef TESTS_BAKE_SKY_H
#define TESTS_BAKE_SKY_H

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "skyvert/skyvert.h"

#include "port/bake/skv_bake_file.h"

#define DEGREE 0.017453292519943295

static inline void stop(const char *what) {
    fprintf(stderr, "FAILED: %s\n", what);
    exit(1);
}

/// Model and table of a preset, made by the library; nothing of the command.
typedef struct bake_sky {
    skv_model model;
    void *table; ///< skv_table
    size_t table_bytes;
} bake_sky;

static inline skv_preset preset_named(const char *name) {
    static const char *const names[] = {"earth-clear", "earth-hazy", "mars"};
    for (int i = 0; i < 3; i++)
        if (strcmp(names[i], name) == 0)
            return (skv_preset)i;
    stop("no such preset");
    return SKV_PRESET_COUNT;
}

static inline void sky_begin(bake_sky *sky, const char *preset, float turbidity) {
    skv_atmosphere air;
    skv_table_spec spec;
    if (skv_atmosphere_preset(&air, preset_named(preset), 4) != SKV_OK)
        stop("skv_atmosphere_preset");
    air.turbidity = turbidity;
    if (skv_model_build(&sky->model, &air) != SKV_OK ||
        skv_table_spec_for(&spec, &sky->model, SKV_TABLE_ACCURATE) != SKV_OK)
        stop("skv_model_build");
    sky->table_bytes = skv_table_size(&spec, 4);
    const size_t work_bytes = skv_table_work_size(&spec, 4);
    void *work = malloc(work_bytes);
    sky->table = calloc(1, sky->table_bytes);
    if (!work || !sky->table ||
        skv_table_build(sky->table, sky->table_bytes, work, work_bytes, &sky->model, &spec) != SKV_OK)
        stop("skv_table_build");
    free(work);
}

/// Radiance and transmittance (NULL = not wanted), [n][4], of all orders.
static inline void sky_light(const bake_sky *sky, int ground_lit, float altitude_km, const float sun_enu[3], size_t n,
                             const float *direction, float *radiance, float *transmittance) {
    skv_quality quality;
    skv_light sun;
    skv_frame frame;
    const skv_rays rays = {direction, 0, NULL, 0};
    const skv_sky out = {radiance, 0, transmittance, 0};
    if (skv_quality_tier(&quality, SKV_TIER_STANDARD) != SKV_OK)
        stop("skv_quality_tier");
    if (ground_lit)
        quality.terms |= SKV_WITH_GROUND;
    if (skv_light_sun(&sun, &sky->model, sun_enu) != SKV_OK ||
        skv_frame_begin(&frame, &sky->model, &quality, altitude_km, 0.0f, &sun, 1) != SKV_OK ||
        skv_frame_table(&frame, sky->table) != SKV_OK || skv_radiance(&frame, n, &rays, &out) != SKV_OK)
        stop("skv_radiance");
}

/// [Vigna16]-like generator: xorshift64*, [0, 1).
static inline double uniform(uint64_t *state) {
    *state ^= *state >> 12;
    *state ^= *state << 25;
    *state ^= *state >> 27;
    return (double)((*state * 2685821657736338717u) >> 11) / 9007199254740992.0;
}

static inline void toward(float to[3], double zenith_rad, double azimuth_rad) {
    to[0] = (float)(sin(zenith_rad) * sin(azimuth_rad));
    to[1] = (float)(sin(zenith_rad) * cos(azimuth_rad));
    to[2] = (float)cos(zenith_rad);
}

/// A third of the directions even over the sphere, a third within some degrees of the horizon, a third about the sun.
static inline void random_direction(uint64_t *state, double dip_rad, double sun_zenith_rad, double sun_azimuth_rad,
                                    float to[3]) {
    const double kind = uniform(state), a = uniform(state), b = uniform(state);
    const double pi = 3.14159265358979323846;
    double zenith = acos(1.0 - 2.0 * a), azimuth = 2.0 * pi * b;
    if (kind > 2.0 / 3.0) {
        zenith = 0.5 * pi + dip_rad + (a - 0.5) * fabs(a - 0.5) * 20.0 * DEGREE;
    } else if (kind > 1.0 / 3.0) {
        const double away = 25.0 * DEGREE * a;
        zenith = sun_zenith_rad + away * cos(2.0 * pi * b);
        azimuth = sun_azimuth_rad + away * sin(2.0 * pi * b) / fmax(sin(sun_zenith_rad), 0.2);
    }
    toward(to, zenith, azimuth);
}

/// Errors of many vertices, %.
typedef struct errors {
    double *of;
    size_t n, room;
} errors;

static inline void errors_add(errors *e, double percent) {
    if (e->n == e->room) {
        e->room = e->room ? 2 * e->room : 1024;
        e->of = realloc(e->of, e->room * sizeof *e->of);
        if (!e->of)
            stop("no memory");
    }
    e->of[e->n++] = percent;
}

static int errors_compare(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

typedef struct error_summary {
    double mean, p95, most;
} error_summary;

static inline error_summary errors_sum(errors *e) {
    error_summary s = {0.0, 0.0, 0.0};
    if (e->n == 0)
        return s;
    qsort(e->of, e->n, sizeof *e->of, errors_compare);
    for (size_t i = 0; i < e->n; i++)
        s.mean += e->of[i] / (double)e->n;
    s.p95 = e->of[(size_t)(0.95 * (double)(e->n - 1))];
    s.most = e->of[e->n - 1];
    free(e->of);
    *e = (errors){NULL, 0, 0};
    return s;
}

static inline double most4(const float x[4]) {
    return fmax(fmax(fabs((double)x[0]), fabs((double)x[1])), fmax(fabs((double)x[2]), fabs((double)x[3])));
}

/// Largest channel error over the largest channel, at least 5 % of the dome's mean; %.
static inline double error_of(const float got[4], const float want[4], double dome_mean) {
    const float d[4] = {got[0] - want[0], got[1] - want[1], got[2] - want[2], got[3] - want[3]};
    const double least = fmax(most4(want), fmax(0.05 * dome_mean, 1e-30));
    return 100.0 * most4(d) / least;
}

/// A raw16f file, opened; its bytes stay.
static inline void table_read(const char *path, skv_bake_table *table) {
    FILE *const f = fopen(path, "rb");
    long size = 0;
    if (!f || fseek(f, 0, SEEK_END) != 0 || (size = ftell(f)) <= 0 || fseek(f, 0, SEEK_SET) != 0)
        stop("cannot read the table");
    void *const bytes = malloc((size_t)size);
    if (!bytes || fread(bytes, 1, (size_t)size, f) != (size_t)size || skv_bake_open(bytes, (size_t)size, table) != 0)
        stop("not a table");
    fclose(f);
}

#endif
