/// The fine part of a cell's source: what degrees 0 to 2 leave of the light that a forward-scattering species sends on.
#ifndef SKV_CORE_FINE_H
#define SKV_CORE_FINE_H

#include "skyvert/table.h"

#include "core/moments.h"

/// The functions that are fitted, times the species' moments.
/// @param q  v.s - mu mu_s.
static inline void skv_fine_basis(const float moment[4], float aureole, float mu, float q, float mu_s,
                                  float out[SKV_TABLE_FINE]) {
    const float mu2 = mu * mu, a3 = moment[2], a4 = moment[3];
    out[0] = a3 * (2.5f * mu2 - 1.5f) * mu;
    out[1] = a4 * ((4.375f * mu2 - 3.75f) * mu2 + 0.375f);
    out[2] = aureole;
    out[3] = a3 * (5.0f * mu2 - 1.0f) * q;
    out[4] = a4 * (7.0f * mu2 - 3.0f) * mu * q;
    const float xy = 2.0f * q * q - (1.0f - mu_s * mu_s) * (1.0f - mu2);
    out[5] = a3 * mu * xy;
    out[6] = a4 * (7.0f * mu2 - 1.0f) * xy;
}

#endif
