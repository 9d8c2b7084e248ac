/// Airs to test in. Nothing here comes from the library's presets.
#ifndef TESTS_AIRS_H
#define TESTS_AIRS_H

#include <string.h>

#include "skyvert/atmosphere.h"

#define DEGREE 0.017453292519943295

static inline void fill(float to[4], double a, double b, double c, double d) {
    to[0] = (float)a;
    to[1] = (float)b;
    to[2] = (float)c;
    to[3] = (float)d;
}

/// An Earth without air.
static inline skv_atmosphere air_none(int bands) {
    skv_atmosphere a;
    memset(&a, 0, sizeof a);
    a.radius_km = 6360;
    a.top_km = 60;
    a.bands = bands;
    fill(a.wavelength_nm, 440, 520, 600, 680);
    fill(a.solar_irradiance, 1.9, 1.85, 1.75, 1.5);
    fill(a.albedo, 0.1, 0.2, 0.3, 0.4);
    fill(a.absorption_colour, 1, 1, 1, 1);
    a.turbidity = 1;
    return a;
}

/// [Bruneton17]'s demo: clear, with ozone.
static inline skv_atmosphere air_clear(int bands) {
    skv_atmosphere a = air_none(bands);
    fill(a.rayleigh_scattering_per_km, 0.033100006, 0.0169677948, 0.00957268519, 0.00580233938);
    a.rayleigh.kind = SKV_PROFILE_EXPONENTIAL;
    a.rayleigh.scale_height_km = 8;
    fill(a.aerosol_scattering_per_km, 0.003996, 0.003996, 0.003996, 0.003996);
    fill(a.aerosol_extinction_per_km, 0.00444, 0.00444, 0.00444, 0.00444);
    a.aerosol.kind = SKV_PROFILE_EXPONENTIAL;
    a.aerosol.scale_height_km = 1.2f;
    a.aerosol_phase = SKV_PHASE_CS;
    a.aerosol_g = 0.8f;
    fill(a.ozone_absorption_per_km, 8.501668e-05, 0.0011494986, 0.0026972106, 0.0006497166);
    a.ozone.kind = SKV_PROFILE_TENT;
    a.ozone.peak_km = 25;
    a.ozone.half_width_km = 15;
    return a;
}

/// [Bruneton16]: strong aerosol, no ozone.
static inline skv_atmosphere air_hazy(int bands) {
    skv_atmosphere a = air_clear(bands);
    fill(a.rayleigh_scattering_per_km, 0.02900713, 0.01461732, 0.008156124, 0.004908462);
    fill(a.aerosol_scattering_per_km, 0.05142882, 0.04499519, 0.04012802, 0.03630459);
    fill(a.aerosol_extinction_per_km, 0.06428603, 0.05624398, 0.05016003, 0.04538074);
    a.aerosol_g = 0.7f;
    a.ozone.kind = SKV_PROFILE_NONE;
    return a;
}

#endif
