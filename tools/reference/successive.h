/// All orders of scattering in double, one order after the other on a grid: the second opinion on the path tracer. It
/// shares with it the tabulated depths of air.h and the first order of single.h, not its choices: nothing here is
/// random.
///
/// The grid spans heights, sun zenith angles within a window around the one asked for, and directions. Radiance that
/// comes in is gathered along straight rays with Gauss points between the horizon and the poles, averaged over each
/// phase function, and gathered again, till the rest is a geometric series.
#ifndef TOOLS_REFERENCE_SUCCESSIVE_H
#define TOOLS_REFERENCE_SUCCESSIVE_H

#include "air.h"

typedef struct ref_grid {
    int heights, suns; ///< nodes; heights from the ground to the top, quadratic; suns evenly in angle
    double sun_low_deg, sun_high_deg;
    int thetas, turns;    ///< nodes of the directions that light is scattered into, even in angle
    int polars, azimuths; ///< Gauss points of the directions that it comes from, per side of the horizon; azimuths
    int cells;            ///< per stretch of a ray, with two Gauss points each
    int orders;           ///< most orders after the first
} ref_grid;

typedef struct ref_successive {
    const ref_air *air;
    ref_grid grid;
    double *
        source; ///< [heights][suns][thetas][turns][2 REF_BANDS]: mean of what comes in over the Rayleigh, aerosol phase
    double *ground; ///< [suns][REF_BANDS] diffuse irradiance
    int orders;     ///< used
    double rest;    ///< last order over all, largest, before the tail was added
} ref_successive;

/// @return 0; -1 out of memory.
int ref_successive_make(ref_successive *solver, const ref_air *air, const ref_grid *grid);
void ref_successive_free(ref_successive *solver);

/// Radiance of all orders, times the irradiance. The observer is within the air, the sun's angle within the window.
/// @return 0; -1 iff the first order did not converge.
int ref_successive_radiance(const ref_successive *solver, double height_km, double sun_zenith_deg,
                            double view_zenith_deg, double azimuth_deg, int lit_ground, double radiance[REF_BANDS]);

#endif
