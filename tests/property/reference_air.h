/// Airs for tests of the reference itself.
#ifndef TESTS_PROPERTY_REFERENCE_AIR_H
#define TESTS_PROPERTY_REFERENCE_AIR_H

#include "single.h"

#define PI 3.14159265358979323846

/// The same density at every height.
static inline ref_profile uniform_profile(void) {
    static const double km[2] = {0, 1}, density[2] = {1, 1};
    return (ref_profile){.kind = REF_TABLE, .table_km = km, .table_density = density, .rows = 2};
}

/// Haze and ozone over dark ground.
static inline ref_atmosphere earth(void) {
    return (ref_atmosphere){.bands = 4,
                            .radius_km = 6360,
                            .top_km = 60,
                            .wavelength_nm = {440, 520, 600, 680},
                            .irradiance = {1, 1, 1, 1},
                            .albedo = {0.1, 0.1, 0.1, 0.1},
                            .rayleigh_scattering = {0.0331, 0.01697, 0.00957, 0.0058},
                            .rayleigh = {.kind = REF_EXPONENTIAL, .scale_km = 8},
                            .aerosol_scattering = {0.0514, 0.045, 0.0401, 0.0363},
                            .aerosol_extinction = {0.0643, 0.0562, 0.0502, 0.0454},
                            .aerosol = {.kind = REF_EXPONENTIAL, .scale_km = 1.2},
                            .phase = REF_CORNETTE_SHANKS,
                            .g = 0.8,
                            .ozone_absorption = {8.5e-5, 0.00115, 0.0027, 0.00065},
                            .ozone = {.kind = REF_TENT, .peak_km = 25, .half_width_km = 15}};
}

#endif
