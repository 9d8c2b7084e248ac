/// [Hillaire20]: a table of transmittance, one of light scattered more than once, a picture of the sky per frame.
///
/// Multiple scattering (section 5.5): from the second order on light is taken as isotropic, and the same everywhere
/// around a point. L2 is the radiance that the first order sends to the point, mean over all directions, with the
/// light of the ground; f the share of a uniform unit radiance that the surroundings would send back; all orders are
/// L2/(1 - f).
#ifndef TOOLS_BASELINES_HILLAIRE20_H
#define TOOLS_BASELINES_HILLAIRE20_H

#include "baseline.h"

/// Sizes; the paper's are HILLAIRE20_SIZES.
typedef struct hillaire20_sizes {
    int transmittance_width, transmittance_height, transmittance_steps;
    int multiple_width, multiple_height; ///< sun's cosine by altitude
    int multiple_side;                   ///< side^2 directions
    int multiple_steps;
    int sky_width, sky_height, sky_steps; ///< azimuth by elevation
} hillaire20_sizes;

#define HILLAIRE20_SIZES ((hillaire20_sizes){256, 64, 40, 32, 32, 8, 20, 192, 108, 30})

typedef struct hillaire20 hillaire20;

/// As baseline's calls, with sizes.
int hillaire20_build(hillaire20 **state, const skv_atmosphere *air, const baseline_wants *wants,
                     const hillaire20_sizes *sizes, baseline_cost *cost, const char **why);
int hillaire20_frame(hillaire20 *state, const baseline_view *view);
void hillaire20_radiance(const hillaire20 *state, size_t n, const float (*direction_enu)[3], float (*radiance)[4]);
void hillaire20_release(hillaire20 *state);

/// All orders that a point gets from elsewhere under a unit sun, radiance averaged over all directions.
void hillaire20_multiple(const hillaire20 *state, double altitude_km, double mu_s, double radiance[4]);
/// Directly, without the picture of the sky: what a texel holds. For tests.
void hillaire20_direct(const hillaire20 *state, const baseline_view *view, const double direction_enu[3],
                       double radiance[4]);

#endif
