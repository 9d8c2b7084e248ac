/// The whole build: transmittance, orders, then half floats, phase table and ambient light.
#include <stdlib.h>

#include "elek09.h"

size_t elek_work_bytes(void) {
    return ELEK_LAYERS * sizeof(elek_layer) + ELEK_T * ELEK_T * sizeof(float[4]) + 2 * ELEK_CELLS * sizeof(elek_light) +
           (size_t)ELEK_U * ELEK_W * ELEK_TURNS * sizeof(elek_light) + elek_kernel_size() * sizeof(float);
}

size_t elek_table_bytes(int bands) {
    const size_t cells = ELEK_KINDS * ELEK_CELLS + ELEK_T * ELEK_T + ELEK_AMBIENT;
    return sizeof(uint16_t) * (cells * (size_t)bands + ELEK_SHAPES * ELEK_ANGLES);
}

static void free_build(elek_build *build) {
    free(build->layer);
    free(build->transmittance);
    free(build->order);
    free(build->sum);
    free(build->gathered);
    free(build->kernel);
}

static int make_room(elek_build *build, int all) {
    build->layer = malloc(ELEK_LAYERS * sizeof *build->layer);
    build->transmittance = malloc(ELEK_T * ELEK_T * sizeof *build->transmittance);
    build->order = malloc(ELEK_CELLS * sizeof *build->order);
    build->sum = calloc(ELEK_CELLS, sizeof *build->sum);
    int there = build->layer && build->transmittance && build->order && build->sum;
    if (there && all) {
        build->gathered = malloc((size_t)ELEK_U * ELEK_W * ELEK_TURNS * sizeof *build->gathered);
        build->kernel = malloc(elek_kernel_size() * sizeof(float));
        there = build->gathered && build->kernel;
    }
    return there ? 0 : -1;
}

static void add_order(elek_build *build) {
    for (size_t i = 0; i < ELEK_CELLS; i++)
        for (int kind = 0; kind < ELEK_KINDS; kind++)
            for (int b = 0; b < 4; b++)
                build->sum[i].of[kind][b] += build->order[i].of[kind][b];
}

/// Orders into build->sum. @return 0; 1 stopped; -2.
static int make_orders(elek_build *build, const baseline_wants *wants) {
    const int orders = wants->all ? ELEK_ORDERS : 1;
    double done = wants->all ? 0.06 : 0.4;
    if (wants->all && elek_gather_begin(build) > ELEK_HEAVIEST)
        return -2;
    if (baseline_parallel(wants, 0.0, done, ELEK_T, elek_transmittance_row, build) != 0)
        return 1;
    for (int k = 1; k <= orders; k++) {
        const double share = (1.0 - done) / (orders - k + 1), gather = done + 0.3 * share;
        if (k > 1 && baseline_parallel(wants, done, gather, ELEK_W, elek_gather_column, build) != 0)
            return 1;
        if (baseline_parallel(wants, k > 1 ? gather : done, done + share, ELEK_U * ELEK_V,
                              k == 1 ? elek_once_path : elek_again_path, build) != 0)
            return 1;
        done += share;
        add_order(build);
    }
    return 0;
}

/// Power of two that the largest value is at most 2^15 times.
static float unit_for(float largest) {
    return largest > 0.0f ? ldexpf(1.0f, (int)ceilf(log2f(largest)) - 15) : 1.0f;
}

static void pack_scattering(elek_store *store, const elek_light *sum) {
    float largest = 0.0f;
    for (size_t i = 0; i < ELEK_CELLS; i++)
        for (int n = 0; n < 4 * ELEK_KINDS; n++)
            largest = fmaxf(largest, sum[i].of[n / 4][n % 4]);
    store->scattering_unit = unit_for(largest);
    for (size_t i = 0; i < ELEK_CELLS; i++)
        for (int n = 0; n < 4 * ELEK_KINDS; n++)
            store->scattering[i][n / 4][n % 4] = baseline_to_half(sum[i].of[n / 4][n % 4] / store->scattering_unit);
}

/// Rows of g from 0 to the air's own, so that this one is exact.
static void make_phase(elek_store *store, const baseline_air *air) {
    baseline_air shaped = *air;
    for (int i = 0; i < ELEK_SHAPES; i++) {
        shaped.g[AEROSOL] = air->g[AEROSOL] * i / (ELEK_SHAPES - 1);
        for (int k = 0; k < ELEK_ANGLES; k++) {
            const double phase = elek_phase(&shaped, AEROSOL, 2.0 * k / (ELEK_ANGLES - 1) - 1.0);
            store->phase[i][k] = baseline_to_half((float)fmin(phase, 65504.0));
        }
    }
}

/// Radiance of the sky over the ground towards a zenith angle and an azimuth from the sun, per unit of irradiance.
static void sky_of(const elek_build *build, double mu_s, double a, double phi, double radiance[4]) {
    elek_corners at;
    const double nu = sin(a) * cos(phi) * sqrt(fmax(1.0 - mu_s * mu_s, 0.0)) + cos(a) * mu_s;
    const double phase[ELEK_KINDS] = {elek_phase_gas(nu), elek_phase(build->air, AEROSOL, fmin(fmax(nu, -1.0), 1.0))};
    elek_corners_of(build->air, build->literal, 0.0, cos(a), mu_s, &at);
    for (int b = 0; b < 4; b++)
        radiance[b] = 0.0;
    for (int c = 0; c < 8; c++)
        for (int kind = 0; kind < ELEK_KINDS; kind++)
            for (int b = 0; b < 4; b++)
                radiance[b] += (double)at.share[c] * phase[kind] * (double)build->sum[at.cell[c]].of[kind][b];
}

/// Its irradiance of level ground by 30 x 30 samples; those of the zenith and of the horizon weigh 0, and the last
/// azimuth is the first.
static void ambient_of(const elek_build *build, double mu_s, double sum[4]) {
    enum { STEPS = ELEK_SAMPLES - 1 };
    for (int b = 0; b < 4; b++)
        sum[b] = 0.0;
    for (int j = 1; j < STEPS; j++) {
        const double a = 0.5 * BASELINE_PI * j / STEPS;
        const double weight = cos(a) * sin(a) * (0.5 * BASELINE_PI / STEPS) * (2.0 * BASELINE_PI / STEPS);
        for (int i = 0; i < STEPS; i++) {
            double radiance[4];
            sky_of(build, mu_s, a, 2.0 * BASELINE_PI * i / STEPS, radiance);
            for (int b = 0; b < 4; b++)
                sum[b] += weight * radiance[b];
        }
    }
}

static void make_ambient(elek_store *store, const elek_build *build) {
    static const float unit = 1.0f / 32768.0f;
    store->ambient_unit = unit;
    for (int i = 0; i < ELEK_AMBIENT; i++) {
        double sum[4];
        ambient_of(build, elek_w_inverse((double)i / (ELEK_AMBIENT - 1)), sum);
        for (int b = 0; b < 4; b++)
            store->ambient[i][b] = baseline_to_half((float)sum[b] / unit);
    }
}

int elek_make(elek_store *store, const baseline_air *air, int literal, const baseline_wants *wants) {
    elek_build build = {.air = air, .literal = literal};
    int status = make_room(&build, wants->all);
    if (status == 0) {
        elek_make_layers(&build);
        status = make_orders(&build, wants);
    }
    if (status == 0) {
        pack_scattering(store, build.sum);
        for (size_t i = 0; i < ELEK_T * ELEK_T; i++)
            for (int b = 0; b < 4; b++)
                store->transmittance[i][b] = baseline_to_half(build.transmittance[i][b]);
        make_phase(store, air);
        make_ambient(store, &build);
    }
    free_build(&build);
    return status;
}
