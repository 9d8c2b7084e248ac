/// The atmosphere in double.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "common.h"

/// Points a table profile at copies of its rows.
static int own_table(skv_profile *profile) {
    if (profile->kind != SKV_PROFILE_TABLE) {
        profile->table_altitude_km = profile->table_density = NULL;
        return 0;
    }
    const size_t bytes = profile->table_rows * sizeof(float);
    float *const copy = malloc(2 * bytes);
    if (copy) {
        memcpy(copy, profile->table_altitude_km, bytes);
        memcpy(copy + profile->table_rows, profile->table_density, bytes);
    }
    profile->table_altitude_km = copy;
    profile->table_density = copy ? copy + profile->table_rows : NULL;
    return copy ? 0 : -1;
}

static void copy_numbers(baseline_air *air, const skv_atmosphere *a) {
    *air = (baseline_air){.radius_km = (double)a->radius_km, .top_km = (double)a->top_km, .bands = a->bands};
    air->profile[GAS] = a->rayleigh;
    air->profile[AEROSOL] = a->aerosol;
    air->profile[DUST] = a->dust;
    air->profile[OZONE] = a->ozone;
    air->phase[AEROSOL] = (int)a->aerosol_phase;
    air->phase[DUST] = (int)a->dust_phase;
    air->g[AEROSOL] = (double)a->aerosol_g;
    air->g[DUST] = (double)a->dust_g;
}

static void copy_band(baseline_air *air, const skv_atmosphere *a, int b) {
    const double haze = (double)a->turbidity;
    air->light[b] = (double)a->solar_irradiance[b] * (double)a->absorption_colour[b];
    air->albedo[b] = (double)a->albedo[b];
    air->scattering[GAS][b] = (double)a->rayleigh_scattering_per_km[b];
    air->extinction[GAS][b] = air->scattering[GAS][b] + (double)a->rayleigh_absorption_per_km[b];
    air->scattering[AEROSOL][b] = haze * (double)a->aerosol_scattering_per_km[b];
    air->extinction[AEROSOL][b] = haze * (double)a->aerosol_extinction_per_km[b];
    air->scattering[DUST][b] = haze * (double)a->dust_scattering_per_km[b];
    air->extinction[DUST][b] = haze * (double)a->dust_extinction_per_km[b];
    air->extinction[OZONE][b] = (double)a->ozone_absorption_per_km[b];
    for (int i = 0; i < BASELINE_SPECIES; i++)
        if (air->profile[i].kind == SKV_PROFILE_NONE) {
            air->extinction[i][b] = 0.0;
            if (i < BASELINE_SCATTERERS)
                air->scattering[i][b] = 0.0;
        }
}

int baseline_air_copy(baseline_air *air, const skv_atmosphere *atmosphere) {
    copy_numbers(air, atmosphere);
    for (int b = 0; b < air->bands; b++)
        copy_band(air, atmosphere, b);
    int failed = 0;
    for (int i = 0; i < BASELINE_SPECIES; i++)
        failed |= own_table(&air->profile[i]);
    if (failed)
        baseline_air_free(air);
    return failed;
}

void baseline_air_free(baseline_air *air) {
    for (int i = 0; i < BASELINE_SPECIES; i++) {
        free((void *)(uintptr_t)air->profile[i].table_altitude_km);
        air->profile[i].table_altitude_km = air->profile[i].table_density = NULL;
    }
}

int baseline_air_has(const baseline_air *air, int species) {
    double sum = 0.0;
    for (int b = 0; b < air->bands; b++)
        sum += air->extinction[species][b];
    return sum > 0.0;
}

static double table_density(const skv_profile *p, double h) {
    const float *const km = p->table_altitude_km;
    size_t low = 0, high = p->table_rows - 1;
    if (h <= (double)km[0])
        return (double)p->table_density[0];
    if (h >= (double)km[high])
        return (double)p->table_density[high];
    while (high - low > 1) {
        const size_t middle = (low + high) / 2;
        if ((double)km[middle] <= h)
            low = middle;
        else
            high = middle;
    }
    const double t = (h - (double)km[low]) / ((double)km[high] - (double)km[low]);
    return (1.0 - t) * (double)p->table_density[low] + t * (double)p->table_density[high];
}

/// exp(-k (ln h - mu)^2)/h over its largest value, at ln h = mu - 1/(2k).
static double lognormal_density(const skv_profile *p, double h) {
    const double k = (double)p->lognormal_k, mu = (double)p->lognormal_mu;
    if (!(h > 0.0))
        return 0.0;
    const double x = log(h) - mu;
    return exp(-k * x * x - (x + mu) + mu - 0.25 / k);
}

double baseline_density(const baseline_air *air, int species, double altitude_km) {
    const skv_profile *const p = &air->profile[species];
    const double h = altitude_km > 0.0 ? altitude_km : 0.0;
    if (h > air->top_km)
        return 0.0;
    switch (p->kind) {
    case SKV_PROFILE_EXPONENTIAL:
        return exp(-h / (double)p->scale_height_km);
    case SKV_PROFILE_EXP_BACKGROUND:
        return (exp(-h / (double)p->scale_height_km) + (double)p->background) / (1.0 + (double)p->background);
    case SKV_PROFILE_US76:
        return exp(-(double)p->us76_a * pow(h, (double)p->us76_b));
    case SKV_PROFILE_TENT:
        return fmax(0.0, 1.0 - fabs(h - (double)p->peak_km) / (double)p->half_width_km);
    case SKV_PROFILE_LOGNORMAL:
        return lognormal_density(p, h);
    case SKV_PROFILE_TABLE:
        return table_density(p, h);
    case SKV_PROFILE_NONE:
        break;
    }
    return 0.0;
}

void baseline_extinction(const baseline_air *air, double altitude_km, double extinction[4]) {
    for (int b = 0; b < 4; b++)
        extinction[b] = 0.0;
    for (int i = 0; i < BASELINE_SPECIES; i++) {
        if (air->profile[i].kind == SKV_PROFILE_NONE)
            continue;
        const double density = baseline_density(air, i, altitude_km);
        for (int b = 0; b < air->bands; b++)
            extinction[b] += density * air->extinction[i][b];
    }
}

static uint64_t hash_profile(uint64_t hash, const skv_profile *p) {
    const float number[] = {p->scale_height_km, p->background,    p->us76_a,       p->us76_b,
                            p->peak_km,         p->half_width_km, p->lognormal_mu, p->lognormal_k};
    const int32_t kind = (int32_t)p->kind;
    hash = baseline_hash(hash, &kind, sizeof kind);
    hash = baseline_hash(hash, number, sizeof number);
    if (p->kind != SKV_PROFILE_TABLE)
        return hash;
    hash = baseline_hash(hash, p->table_altitude_km, p->table_rows * sizeof(float));
    return baseline_hash(hash, p->table_density, p->table_rows * sizeof(float));
}

uint64_t baseline_air_hash(const baseline_air *air) {
    uint64_t hash = baseline_hash(BASELINE_HASH_START, &air->radius_km, sizeof air->radius_km);
    hash = baseline_hash(hash, &air->top_km, sizeof air->top_km);
    hash = baseline_hash(hash, &air->bands, sizeof air->bands);
    hash = baseline_hash(hash, air->scattering, sizeof air->scattering);
    hash = baseline_hash(hash, air->extinction, sizeof air->extinction);
    hash = baseline_hash(hash, air->phase, sizeof air->phase);
    hash = baseline_hash(hash, air->g, sizeof air->g);
    for (int i = 0; i < BASELINE_SPECIES; i++)
        hash = hash_profile(hash, &air->profile[i]);
    return hash;
}
