/// Airs, rays and errors for the tests of the baselines by marching; the same floats go to the reference in double.
#ifndef TESTS_BASELINES_LINAN_SKY_H
#define TESTS_BASELINES_LINAN_SKY_H

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "airs.h"
#include "baseline.h"
#include "check.h"
#include "convert.h"

/// The figures of tools/bench/br17o.ini: clear, with ozone.
static inline skv_atmosphere sky_clear(void) {
    skv_atmosphere a = air_clear(4);
    fill(a.solar_irradiance, 1, 1, 1, 1);
    fill(a.albedo, 0.1, 0.1, 0.1, 0.1);
    return a;
}

/// The figures of tools/bench/br16.ini: strong aerosol, no ozone.
static inline skv_atmosphere sky_hazy(void) {
    skv_atmosphere a = air_hazy(4);
    fill(a.solar_irradiance, 1, 1, 1, 1);
    fill(a.albedo, 0.03, 0.055, 0.061, 0.035);
    return a;
}

/// Gas and aerosol that only scatter, Henyey-Greenstein: nothing that [Keller08] does not have.
static inline skv_atmosphere sky_plain(double g) {
    skv_atmosphere a = sky_clear();
    a.aerosol_phase = SKV_PHASE_HG;
    a.aerosol_g = (float)g;
    a.ozone.kind = SKV_PROFILE_NONE;
    fill(a.ozone_absorption_per_km, 0, 0, 0, 0);
    memcpy(a.aerosol_extinction_per_km, a.aerosol_scattering_per_km, sizeof a.aerosol_extinction_per_km);
    return a;
}

/// The air made thinner or thicker.
static inline skv_atmosphere sky_times(skv_atmosphere a, double factor) {
    for (int b = 0; b < 4; b++) {
        a.rayleigh_scattering_per_km[b] *= (float)factor;
        a.aerosol_scattering_per_km[b] *= (float)factor;
        a.aerosol_extinction_per_km[b] *= (float)factor;
        a.ozone_absorption_per_km[b] *= (float)factor;
    }
    return a;
}

/// Zenith angle, and azimuth from the sun's; the sun stands in the south.
static inline void sky_direction(double to[3], double zenith_deg, double azimuth_deg) {
    to[0] = sin(zenith_deg * DEGREE) * sin(azimuth_deg * DEGREE);
    to[1] = -sin(zenith_deg * DEGREE) * cos(azimuth_deg * DEGREE);
    to[2] = cos(zenith_deg * DEGREE);
}

static inline baseline_view sky_view(double height_km, double sun_zenith_deg) {
    baseline_view view = {.observer_km = height_km};
    sky_direction(view.sun_enu, sun_zenith_deg, 0);
    return view;
}

static inline double sky_halton(int i, int base) {
    double f = 1, r = 0;
    for (; i > 0; i /= base) {
        f /= base;
        r += f * (i % base);
    }
    return r;
}

#define SKY_RAYS 40

/// Rays over the sky (two thirds) and, from above, to the ground, and what single scattering sends along them.
typedef struct sky_dome {
    baseline_view view;
    int n;
    double direction[SKY_RAYS][3];
    float direction_f[SKY_RAYS][3];
    double zenith[SKY_RAYS], azimuth[SKY_RAYS];
    double truth[SKY_RAYS][4];
    double mean; ///< of the largest bands
} sky_dome;

static inline double sky_largest(const double x[4]) {
    return fmax(fmax(x[0], x[1]), fmax(x[2], x[3]));
}

static inline void sky_lay(sky_dome *d, const skv_atmosphere *air, double height_km, double sun_zenith_deg,
                           int lit_ground) {
    ref_file file;
    ref_from_skyvert(air, 0, &file);
    const double radius = (double)air->radius_km;
    const double horizon = height_km > 0 ? 90 + acos(radius / (radius + height_km)) / DEGREE : 90;
    const int sky = height_km > 0 ? SKY_RAYS * 2 / 3 : SKY_RAYS;
    d->view = sky_view(height_km, sun_zenith_deg);
    d->n = SKY_RAYS;
    d->mean = 0;
    for (int i = 0; i < d->n; i++) {
        const double t = sky_halton(i + 1, 2);
        ref_answer answer;
        d->zenith[i] = i < sky ? t * (horizon - 0.2) : horizon + 0.2 + t * (179.8 - horizon);
        d->azimuth[i] = 180 * sky_halton(i + 1, 3);
        sky_direction(d->direction[i], d->zenith[i], d->azimuth[i]);
        for (int k = 0; k < 3; k++)
            d->direction_f[i][k] = (float)d->direction[i][k];
        const ref_ray ray = ref_ray_from_angles(height_km, sun_zenith_deg, d->zenith[i], d->azimuth[i]);
        if (ref_single(&file.atmosphere, &ray, lit_ground, NULL, &answer) != 0)
            fail_msg("the reference did not converge: %g km, sun %g, view %g", height_km, sun_zenith_deg, d->zenith[i]);
        memcpy(d->truth[i], answer.radiance, sizeof d->truth[i]);
        d->mean += sky_largest(d->truth[i]) / d->n;
    }
}

typedef struct sky_error {
    double mean, max; ///< in %
    int worst;
} sky_error;

/// Error of a ray: its largest band's, over its largest band, which counts as at least 5 % of the dome's mean.
static inline sky_error sky_compare(const sky_dome *d, const double (*want)[4], const double (*got)[4]) {
    sky_error e = {0, 0, 0};
    for (int i = 0; i < d->n; i++) {
        double off = 0;
        for (int b = 0; b < 4; b++)
            off = fmax(off, fabs(got[i][b] - want[i][b]));
        off *= 100 / fmax(sky_largest(want[i]), 0.05 * d->mean);
        e.mean += off / d->n;
        if (!(off <= e.max)) {
            e.max = off;
            e.worst = i;
        }
    }
    return e;
}

#endif
