/// [Keller08]: single scattering by midpoints of steps that grow along the ray, the optical depths likewise.
///
/// Light that is scattered once (Eq. 5.1 of the paper): N steps end at L (i/N)^3 along the line of sight of length L;
/// at the middle of each lies the scattering point. Its optical depths, to the observer and to the sun, are sums over
/// M steps that end at l (j/M)^2 of the way l, taken from the scattering point. Points whose sun is behind the planet
/// are dark.
#ifndef TOOLS_BASELINES_KELLER08_H
#define TOOLS_BASELINES_KELLER08_H

#include "baseline.h"

typedef struct keller08_form {
    int view_steps, depth_steps; ///< N and M
    int even;                    ///< 1: steps of equal length instead, for the paper's claim
    int own_terms; ///< 1: the paper's terms: gas and one aerosol, exponential, Henyey-Greenstein, no absorption but
                   ///< the constant colour; 0: everything the atmosphere has
    int literal;   ///< 1: with the printed slips
} keller08_form;

typedef struct keller08 keller08;

/// As baseline's calls.
int keller08_build(keller08 **state, const skv_atmosphere *air, const keller08_form *form, baseline_cost *cost);
void keller08_frame(keller08 *state, const baseline_view *view);
void keller08_radiance(const keller08 *state, size_t n, const float (*direction_enu)[3], float (*radiance)[4]);
void keller08_release(keller08 *state);

#endif
