/// The march along a ray.
#include "march.h"

#include <math.h>

/// Densities that scatter, and the extinction of everything.
typedef struct medium {
    double density[BASELINE_SCATTERERS];
    double extinction[4];
} medium;

static void medium_at(const baseline_air *air, double altitude_km, medium *m) {
    *m = (medium){0};
    for (int i = 0; i < BASELINE_SPECIES; i++) {
        if (air->profile[i].kind == SKV_PROFILE_NONE)
            continue;
        const double density = baseline_density(air, i, fmin(altitude_km, air->top_km));
        if (i < BASELINE_SCATTERERS)
            m->density[i] = density;
        for (int b = 0; b < air->bands; b++)
            m->extinction[b] += density * air->extinction[i][b];
    }
}

static double edge(const march_rule *rule, int i) {
    const double x = (double)i / rule->steps;
    return rule->squared ? x * x : x;
}

/// One step of `length` km: adds to the radiance, lessens the transmittance.
static void step(const baseline_air *air, const march_rule *rule, const double phase[], const medium *m,
                 const double sun[4], const double diffuse[4], double length, march_result *r) {
    for (int b = 0; b < air->bands; b++) {
        double directed = 0.0, scattering = 0.0;
        for (int i = 0; i < BASELINE_SCATTERERS; i++) {
            const double s = air->scattering[i][b] * m->density[i];
            directed += s * phase[i];
            scattering += s;
        }
        const double depth = m->extinction[b] * length, lost = -expm1(-depth);
        const double reach = depth > 1e-12 ? length * lost / depth : length;
        const double source = directed * sun[b] + (rule->bare ? 0.0 : scattering * diffuse[b]);
        r->radiance[b] += r->transmittance[b] * source * reach;
        if (rule->bare)
            r->radiance[b] += diffuse[b] * length;
        r->transmittance[b] *= 1.0 - lost;
    }
}

void march(const baseline_air *air, const march_ray *ray, const march_rule *rule,
           const double phase[BASELINE_SCATTERERS], march_light *light, const void *model, march_result *result) {
    double length;
    *result = (march_result){.transmittance = {1.0, 1.0, 1.0, 1.0}};
    result->ground = baseline_ray(air, ray->altitude_km, ray->mu, &length);
    const double r0 = air->radius_km + ray->altitude_km, b_sun = r0 * ray->mu_s;
    for (int i = 0; i < rule->steps; i++) {
        const double from = edge(rule, i), part = edge(rule, i + 1) - from, s = length * (from + rule->at * part);
        const double h = fmin(baseline_altitude(air, ray->altitude_km, ray->mu, s), air->top_km);
        const double mu_s = fmin(1.0, fmax(-1.0, (b_sun + s * ray->nu) / (air->radius_km + h)));
        double sun[4], diffuse[4];
        medium m;
        medium_at(air, h, &m);
        light(model, h, mu_s, sun, diffuse);
        step(air, rule, phase, &m, sun, diffuse, length * part, result);
    }
    const double end = result->ground ? air->radius_km : air->radius_km + air->top_km;
    result->mu_s = fmin(1.0, fmax(-1.0, (b_sun + length * ray->nu) / end));
}

int march_enter(const baseline_air *air, march_ray *ray) {
    const double b_sun = (air->radius_km + ray->altitude_km) * ray->mu_s;
    double s;
    if (!baseline_enter(air, &ray->altitude_km, &ray->mu, &s))
        return 0;
    ray->mu_s = fmin(1.0, fmax(-1.0, (b_sun + s * ray->nu) / (air->radius_km + ray->altitude_km)));
    return 1;
}

march_ray march_ray_of(const baseline_view *view, const double direction[3]) {
    const double *const sun = view->sun_enu;
    const double nu = direction[0] * sun[0] + direction[1] * sun[1] + direction[2] * sun[2];
    return (march_ray){view->observer_km, fmin(1.0, fmax(-1.0, direction[2])), sun[2], fmin(1.0, fmax(-1.0, nu))};
}

void march_transmittance(const baseline_air *air, double altitude_km, double mu, double length, int steps, double at,
                         double transmittance[4]) {
    double depth[4] = {0};
    for (int i = 0; i < steps; i++) {
        double extinction[4];
        const double h = baseline_altitude(air, altitude_km, mu, length * (i + at) / steps);
        baseline_extinction(air, fmin(h, air->top_km), extinction);
        for (int b = 0; b < air->bands; b++)
            depth[b] += extinction[b] * length / steps;
    }
    for (int b = 0; b < 4; b++)
        transmittance[b] = b < air->bands ? exp(-depth[b]) : 0.0;
}

double march_azimuth_cosine(const baseline_view *view, const double direction[3]) {
    const double *const sun = view->sun_enu;
    const double size = hypot(direction[0], direction[1]) * hypot(sun[0], sun[1]);
    return size > 1e-12 ? fmin(1.0, fmax(-1.0, (direction[0] * sun[0] + direction[1] * sun[1]) / size)) : 1.0;
}

#define LOWEST_SUN (-0.2)

void march_ground_make(march_ground *ground, march_sky *sky, const void *model) {
    enum { UP = 10, AROUND = 10 };
    *ground = (march_ground){{{0}}};
    for (int k = 0; k < MARCH_GROUND_SUNS * UP * AROUND; k++) {
        const int sun = k / (UP * AROUND), i = k / AROUND % UP, j = k % AROUND;
        const double mu_s = LOWEST_SUN + (1.0 - LOWEST_SUN) * sun / (MARCH_GROUND_SUNS - 1), mu = (i + 0.5) / UP;
        const double turn = cos(BASELINE_PI * (j + 0.5) / AROUND); // one half of the sky is the other's mirror image
        const double nu = mu * mu_s + sqrt((1.0 - mu * mu) * fmax(0.0, 1.0 - mu_s * mu_s)) * turn;
        double radiance[4];
        sky(model, &(march_ray){0.0, mu, mu_s, fmin(1.0, fmax(-1.0, nu))}, radiance);
        for (int b = 0; b < 4; b++)
            ground->sky[sun][b] += radiance[b] * mu * 2.0 * BASELINE_PI / (UP * AROUND);
    }
}

void march_ground_at(const march_ground *ground, double mu_s, double irradiance[4]) {
    const double x = (mu_s - LOWEST_SUN) / (1.0 - LOWEST_SUN) * (MARCH_GROUND_SUNS - 1);
    const int i = x < MARCH_GROUND_SUNS - 1 ? (int)fmax(x, 0.0) : MARCH_GROUND_SUNS - 2;
    for (int b = 0; b < 4; b++)
        irradiance[b] = x < 0.0 ? 0.0 : ground->sky[i][b] + (x - i) * (ground->sky[i + 1][b] - ground->sky[i][b]);
}
