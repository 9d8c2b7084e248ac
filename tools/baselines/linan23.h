/// [Linan23]: a table of transmittance, and per frame a picture of the sky in four bands.
///
/// The light that a point gets is the sun's through the table, an isotropic light L_ms that depends on the sun's
/// elevation alone (Eq. 5.7, a logistic function fitted to a path tracer), and light that the sunlit ground below sends
/// (Eq. 5.5): 1/(4 pi) omega (albedo/pi) T_ground T_between mu_s, with omega the planet's solid angle.
#ifndef TOOLS_BASELINES_LINAN23_H
#define TOOLS_BASELINES_LINAN23_H

#include "baseline.h"

/// Sizes; LINAN23_SIZES are the thesis's.
typedef struct linan23_sizes {
    int transmittance_width, transmittance_height, transmittance_steps; ///< cosine by altitude, even
    int sky_width, sky_height;                                          ///< azimuth by elevation
    int steps_inside, steps_outside; ///< of a ray seen from within the air, from above it
} linan23_sizes;

#define LINAN23_SIZES ((linan23_sizes){256, 64, 64, 256, 256, 32, 64})

typedef struct linan23 linan23;

/// As baseline's calls, with sizes.
int linan23_build(linan23 **state, const skv_atmosphere *air, const baseline_wants *wants, const linan23_sizes *sizes,
                  int literal, baseline_cost *cost);
void linan23_frame(linan23 *state, const baseline_view *view);
void linan23_radiance(const linan23 *state, size_t n, const float (*direction_enu)[3], float (*radiance)[4]);
void linan23_release(linan23 *state);
/// Directly, without the picture of the sky: what a texel holds. For tests.
void linan23_direct(const linan23 *state, const baseline_view *view, const double direction_enu[3], double radiance[4]);
/// Eq. 5.7: radiance for a unit sun at a wavelength, 1/sr.
double linan23_logistic(double wavelength_nm, double mu_s);

#endif
