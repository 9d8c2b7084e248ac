/// The march along a ray that [Hillaire20] and [Linan23] share: in every step the source at one point, integrated with
/// the extinction there: L += T (S - S e^-tau)/extinction, T *= e^-tau ([Hillaire20]).
/// What differs, the light at a point, comes from the model.
#ifndef TOOLS_BASELINES_MARCH_H
#define TOOLS_BASELINES_MARCH_H

#include "common.h"

/// A ray and the sun; the start lies within the air.
typedef struct march_ray {
    double altitude_km;
    double mu;   ///< cosine of view and vertical
    double mu_s; ///< cosine of sun and vertical
    double nu;   ///< cosine of view and sun
} march_ray;

typedef struct march_rule {
    int steps;
    int squared; ///< step i ends at ((i+1)/steps)^2 of the way, else evenly
    double at;   ///< where in its step the point lies, 0 to 1
    int bare;    ///< 1: diffuse light is added as it is, without transmittance and scattering (a printed slip)
} march_rule;

/// The light of a unit sun at a point: the sun's that is left, 0 in the shadow, and the radiance that comes in from
/// elsewhere averaged over all directions.
typedef void march_light(const void *model, double altitude_km, double mu_s, double sun[4], double diffuse[4]);

typedef struct march_result {
    double radiance[4];      ///< for a unit sun
    double transmittance[4]; ///< of the whole ray
    int ground;              ///< it ends there
    double mu_s;             ///< at its end
} march_result;

/// @param[in] phase  of each scatterer at this ray's nu, 1/sr.
void march(const baseline_air *air, const march_ray *ray, const march_rule *rule,
           const double phase[BASELINE_SCATTERERS], march_light *light, const void *model, march_result *result);

/// Moves a start above the top to where the ray enters. @return 0 iff the ray misses the air.
int march_enter(const baseline_air *air, march_ray *ray);

/// The ray of a unit direction (east, north, up), as common_ray.c wants it.
march_ray march_ray_of(const baseline_view *view, const double direction[3]);

/// Columns to transmittance by midpoints: of a ray from an altitude through `length` km in `steps`; altitudes below
/// the ground count as on it.
void march_transmittance(const baseline_air *air, double altitude_km, double mu, double length, int steps, double at,
                         double transmittance[4]);

/// Cosine of the azimuth between view and sun; 1 where either is vertical.
double march_azimuth_cosine(const baseline_view *view, const double direction[3]);

/// Radiance along a ray under a unit sun.
typedef void march_sky(const void *model, const march_ray *ray, double radiance[4]);

enum { MARCH_GROUND_SUNS = 128 };

/// The sky's irradiance on level ground under a unit sun, from a model's own sky, over the sun's cosine: what the
/// ground of an engine gets from its captured sky. Neither paper has a table for it.
typedef struct march_ground {
    double sky[MARCH_GROUND_SUNS][4];
} march_ground;

void march_ground_make(march_ground *ground, march_sky *sky, const void *model);
/// 0 for suns further than about 11 deg below the horizon.
void march_ground_at(const march_ground *ground, double mu_s, double irradiance[4]);

#endif
