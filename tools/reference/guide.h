/// A coarse map of the light in the air. It only steers the random choices of the path tracer: whatever stands in it,
/// the expected answer is the same, only the noise changes.
#ifndef TOOLS_REFERENCE_GUIDE_H
#define TOOLS_REFERENCE_GUIDE_H

#include "air.h"

enum { GUIDE_HEIGHTS = 24, GUIDE_SUNS = 64, GUIDE_BELOW = 4, GUIDE_ABOVE = 6, GUIDE_TURNS = 6 };
enum { GUIDE_POLARS = GUIDE_BELOW + GUIDE_ABOVE };

/// Radiance that comes from a direction, for a unit sun: smooth + aerosol_phase(nu) * aerosol.
typedef struct ref_glow {
    float smooth[REF_BANDS], aerosol[REF_BANDS];
} ref_glow;

typedef struct ref_guide {
    double *mean;   ///< [GUIDE_HEIGHTS + 1][GUIDE_SUNS + 1][REF_BANDS] mean radiance over the sphere, diffuse, > 0
    ref_glow *glow; ///< [GUIDE_HEIGHTS][GUIDE_SUNS][GUIDE_POLARS][GUIDE_TURNS] at the middles
} ref_guide;

int ref_guide_make(ref_guide *guide, const ref_air *air, int threads);
void ref_guide_free(ref_guide *guide);

/// Mean radiance at a place.
void ref_guide_mean(const ref_guide *guide, double height01, double mu_s, double mean[REF_BANDS]);

/// Where directions are looked up around one place.
typedef struct ref_outlook {
    const ref_glow *cell;
    double mu_s, sin_s, horizon; ///< cosine of the horizon's zenith angle
} ref_outlook;
ref_outlook ref_guide_outlook(const ref_guide *guide, const ref_air *air, double e, double mu_s);
/// The cell of a direction: mu its zenith cosine, nu its cosine to the sun.
const ref_glow *ref_guide_glow(const ref_outlook *outlook, double mu, double nu);

#endif
