#include <math.h>

#include "tools/plan/kind.h"

/// Depth of a vertical ray, of what stands on the ground.
static double depth(double per_km, const skv_profile *p) {
    return p->kind == SKV_PROFILE_EXPONENTIAL || p->kind == SKV_PROFILE_EXP_BACKGROUND
               ? per_km * (double)p->scale_height_km
               : 8 * per_km;
}

plan_kind_of_ray plan_ray_kind(const skv_atmosphere *air, const plan_frame *frame, const plan_ray *ray) {
    const double degree = 0.017453292519943295, radius = (double)air->radius_km, h = fmax(frame->height_km, 0);
    const double horizon = -acos(radius / (radius + h)) / degree, up = ray->elevation_deg - horizon;
    // Densities in the frame's air count: a tenth of the haze is left at two scale heights.
    plan_kind_of_ray k;
    k.particles = (float)(1.5 * log(depth(plan_particles_per_km(air), &air->aerosol) + 0.02));
    k.gas = (float)(1.0 * log(depth(plan_gas_per_km(air), &air->rayleigh) + 0.002));
    k.sun = (float)(frame->sun_deg < 0 ? -1.5 * log(1 - frame->sun_deg / 2) : 1.5 * log(1 + frame->sun_deg / 4));
    k.height = (float)(1.2 * log(h + 0.7));
    k.view = (float)(up < 0 ? -1.2 * log(1 - up / 4) - 0.3 : 1.2 * log(1 + up / 5));
    k.azimuth = (float)(0.8 * cos(ray->azimuth_deg * degree) * cos(ray->elevation_deg * degree));
    return k;
}
