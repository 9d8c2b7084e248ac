/// The fine part of a cell: what degrees 0 to 2 leave of the light that the forward-scattering species sends on.
///
/// Its source is gathered exactly for a set of directions that crowd at the horizon, where paths are long, and fitted
/// there, in relative terms, by few functions of the direction: harmonics of degrees 3 and 4 about the vertical and
/// towards the light, and an aureole. A truncated series would spend its terms where nobody looks: near the horizon of
/// a setting sun it is two to three times as wrong (`make` figures in README "Tables").
#ifndef SKV_CORE_FINE_FIT_H
#define SKV_CORE_FINE_FIT_H

#include "core/fine.h"

/// Directions: elevations times azimuths.
#define SKV_FINE_ELEVATIONS 10
#define SKV_FINE_AZIMUTHS   6

#define SKV_FINE_DIRECTIONS (SKV_FINE_ELEVATIONS * SKV_FINE_AZIMUTHS)

typedef struct skv_fine_directions {
    float x[SKV_FINE_DIRECTIONS], y[SKV_FINE_DIRECTIONS], z[SKV_FINE_DIRECTIONS];
} skv_fine_directions;

void skv_fine_directions_init(skv_fine_directions *d);

/// A phase function between all directions and a gathered one, the mean over its two half circles.
void skv_fine_phases(int cornette_shanks, float g, const skv_fine_directions *d, const float w[3],
                     float phase[restrict SKV_FINE_DIRECTIONS]);

/// Least squares of relative errors, with a trace of weight on small coefficients.
/// @param source  [directions] of the species, per unit of its scattering.
/// @param low     mean and degrees 1 and 2 of the cell.
void skv_fine_fit(const float source[SKV_FINE_DIRECTIONS], const float low[6], const float moment[4], float g,
                  const float toward[3], float mu_s, float out[SKV_TABLE_FINE]);

#endif
