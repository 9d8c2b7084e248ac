/// Body of naive_float() and naive_double(): REAL, NAIVE and the functions are set by the file that includes this.
#include <math.h>

#include "naive.h"

typedef struct vec {
    REAL x, y, z;
} vec;

static REAL dot(vec a, vec b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static vec along(vec o, vec d, REAL t) {
    return (vec){o.x + t * d.x, o.y + t * d.y, o.z + t * d.z};
}

static vec unit(const float v[3]) {
    const vec a = {(REAL)v[0], (REAL)v[1], (REAL)v[2]};
    const REAL n = SQRT(dot(a, a));
    return (vec){a.x / n, a.y / n, a.z / n};
}

/// Roots of |o + t d| = radius. @return whether there are any before us.
static int sphere(vec o, vec d, REAL radius, REAL t[2]) {
    const REAL b = dot(o, d), c = dot(o, o) - radius * radius, disc = b * b - c;
    if (disc < 0)
        return 0;
    t[0] = -b - SQRT(disc);
    t[1] = -b + SQRT(disc);
    return t[1] > 0;
}

/// Distance to the ground. @return whether the ray meets it.
static int meets(vec o, vec d, REAL ground, REAL *end) {
    REAL t[2];
    if (dot(o, d) >= 0 || !sphere(o, d, ground, t))
        return 0;
    *end = t[0] > 0 ? t[0] : 0;
    return 1;
}

static REAL density(const skv_profile *p, REAL altitude) {
    const REAL h = altitude > -12 ? altitude : -12; // rays that touch the ground round into it
    switch (p->kind) {
    case SKV_PROFILE_EXPONENTIAL:
        return EXP(-h / (REAL)p->scale_height_km);
    case SKV_PROFILE_EXP_BACKGROUND:
        return (EXP(-h / (REAL)p->scale_height_km) + (REAL)p->background) / (1 + (REAL)p->background);
    case SKV_PROFILE_TENT: {
        const REAL x =
            1 - (h > (REAL)p->peak_km ? h - (REAL)p->peak_km : (REAL)p->peak_km - h) / (REAL)p->half_width_km;
        return x > 0 ? x : 0;
    }
    default:
        return 0;
    }
}

static void columns(const skv_atmosphere *a, vec from, vec d, REAL length, int steps, REAL column[3]) {
    const REAL ds = length / (REAL)steps;
    for (int i = 0; i < steps; i++) {
        const vec p = along(from, d, ((REAL)i + (REAL)0.5) * ds);
        const REAL h = SQRT(dot(p, p)) - (REAL)a->radius_km;
        column[0] += density(&a->rayleigh, h) * ds;
        column[1] += density(&a->aerosol, h) * ds;
        column[2] += density(&a->ozone, h) * ds;
    }
}

static REAL aerosol_phase(const skv_atmosphere *a, REAL nu) {
    const REAL g = (REAL)a->aerosol_g, pi = (REAL)3.14159265358979;
    const REAL hg = (1 - g * g) / (4 * pi * POW(1 + g * g - 2 * g * nu, (REAL)1.5));
    return a->aerosol_phase == SKV_PHASE_HG ? hg : hg * (REAL)1.5 * (1 + nu * nu) / (2 + g * g);
}

void NAIVE(const skv_atmosphere *a, float ground_km, float observer_km, const float view[3], const float sun[3],
           double radiance[4]) {
    const REAL radius = (REAL)a->radius_km, ground = radius + (REAL)ground_km, top = radius + (REAL)a->top_km;
    const vec o = {0, 0, radius + (REAL)observer_km}, v = unit(view), s = unit(sun);
    const REAL nu = dot(v, s), rayleigh = (REAL)0.0596831037 * (1 + nu * nu), aerosol = aerosol_phase(a, nu);
    REAL t[2], begin = 0, seen[3] = {0, 0, 0}, sum[4] = {0, 0, 0, 0};
    for (int b = 0; b < 4; b++)
        radiance[b] = 0;
    if (!sphere(o, v, top, t))
        return;
    begin = t[0] > 0 ? t[0] : 0;
    REAL end = t[1];
    (void)meets(o, v, ground, &end);
    const REAL ds = (end - begin) / NAIVE_VIEW_STEPS;
    for (int i = 0; i < NAIVE_VIEW_STEPS; i++) {
        const vec p = along(o, v, begin + ((REAL)i + (REAL)0.5) * ds);
        const REAL h = SQRT(dot(p, p)) - radius, turbidity = (REAL)a->turbidity;
        REAL to_sun[3] = {0, 0, 0};
        const REAL here[3] = {density(&a->rayleigh, h) * ds, density(&a->aerosol, h) * ds, density(&a->ozone, h) * ds};
        for (int k = 0; k < 3; k++)
            seen[k] += here[k];
        REAL below;
        if (meets(p, s, ground, &below) || !sphere(p, s, top, t))
            continue;
        columns(a, p, s, t[1], NAIVE_SUN_STEPS, to_sun);
        for (int b = 0; b < a->bands; b++) {
            const REAL tau = ((REAL)a->rayleigh_scattering_per_km[b] + (REAL)a->rayleigh_absorption_per_km[b]) *
                                 (seen[0] + to_sun[0]) +
                             turbidity * (REAL)a->aerosol_extinction_per_km[b] * (seen[1] + to_sun[1]) +
                             (REAL)a->ozone_absorption_per_km[b] * (seen[2] + to_sun[2]);
            sum[b] += EXP(-tau) * ((REAL)a->rayleigh_scattering_per_km[b] * rayleigh * here[0] +
                                   turbidity * (REAL)a->aerosol_scattering_per_km[b] * aerosol * here[1]);
        }
    }
    for (int b = 0; b < a->bands; b++)
        radiance[b] = (double)(sum[b] * (REAL)a->solar_irradiance[b]);
}
