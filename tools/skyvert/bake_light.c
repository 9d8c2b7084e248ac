/// `skyvert bake`: the light that goes into texels.
#include "bake.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// ---- models and table

/// A kind of matter with a phase function of its own.
typedef struct matter {
    const char *name; ///< of its layer
    float *scattering_per_km;
    skv_phase phase;
    float g;
} matter;

/// @return how many there are in an atmosphere
static int matter_of(skv_atmosphere *a, matter list[SKV_BAKE_DEFERRED_MAX]) {
    const matter all[] = {
        {"aerosol", a->aerosol_scattering_per_km, a->aerosol_phase, a->aerosol_g},
        {"dust", a->dust_scattering_per_km, a->dust_phase, a->dust_g},
    };
    int n = 0;
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        const float *const s = all[i].scattering_per_km;
        if (s[0] > 0.0f || s[1] > 0.0f || s[2] > 0.0f || s[3] > 0.0f)
            list[n++] = all[i];
    }
    return n;
}

/// For each deferred kind of matter an air in which it takes the same light away but sends none back: the difference of
/// single scattering is its own.
static skv_status build_bare(bake_air *air) {
    skv_atmosphere a = air->options->sky.atmosphere;
    matter list[SKV_BAKE_DEFERRED_MAX];
    skv_status status = SKV_OK;
    air->deferred = air->options->deferred ? matter_of(&a, list) : 0;
    for (int k = 0; k < air->deferred && status == SKV_OK; k++) {
        float kept[4];
        memcpy(kept, list[k].scattering_per_km, sizeof kept);
        memset(list[k].scattering_per_km, 0, sizeof kept);
        status = skv_model_build(&air->bare[k], &a);
        memcpy(list[k].scattering_per_km, kept, sizeof kept);
        air->phase[k] = list[k].phase == SKV_PHASE_HG ? SKV_BAKE_HG : SKV_BAKE_CS;
        air->g[k] = list[k].g;
        air->deferred_name[k] = list[k].name;
    }
    return status;
}

/// The irradiance of the Earth presets is that at 1 au.
static float sun_scale(const bake_options *options) {
    static const skv_preset others[] = {SKV_PRESET_MARS, SKV_PRESET_TINY, SKV_PRESET_GIANT, SKV_PRESET_TITAN};
    bool earth = !options->sky.atmosphere_path;
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++)
        earth = earth && options->sky.preset != others[i];
    const double au = options->now.sun_distance_au;
    return earth && au > 0.0 ? (float)(1.0 / (au * au)) : 1.0f;
}

int bake_air_begin(bake_air *air, const bake_options *options) {
    memset(air, 0, sizeof *air);
    air->options = options;
    air->ground_km = (float)(options->sky.ground_m / 1000.0);
    air->sun_scale = options->what == SKV_BAKE_SKY_VIEW ? sun_scale(options) : 1.0f;
    skv_status status = skv_model_build(&air->model, &options->sky.atmosphere);
    if (status == SKV_OK)
        status = build_bare(air);
    if (status != SKV_OK)
        return fail_usage("skyvert bake: the core refuses this atmosphere (status %d): see skyvert/atmosphere.h",
                          (int)status);
    if (!(air->ground_km < air->model.top_km))
        return fail_usage("skyvert bake: --ground-m %g: the ground lies below the top of the air, %g m",
                          options->sky.ground_m, 1000.0 * (double)air->model.top_km);
    if (options->sky.light.orders == 0 || options->what == SKV_BAKE_TRANSMITTANCE)
        return 0;
    return all_orders_build(&air->orders, "bake", &air->model, (skv_table_kind)options->sky.light.table, air->ground_km,
                            true);
}

void bake_air_end(bake_air *air) {
    all_orders_free(&air->orders);
}

// ---- radiance

static bool begin(const bake_air *air, const skv_model *model, float altitude_km, const float sun_enu[3],
                  skv_frame *frame) {
    skv_light sun;
    if (skv_light_sun(&sun, model, sun_enu) != SKV_OK)
        return false;
    for (int b = 0; b < 4; b++)
        sun.irradiance[b] *= air->sun_scale;
    return skv_frame_begin(frame, model, &air->options->sky.quality, altitude_km + air->ground_km, air->ground_km, &sun,
                           1) == SKV_OK;
}

/// The core writes as many values a ray as there are bands; here it is always room for four.
static bool shine(bake_air *air, const skv_frame *frame, const bake_rays *rays, float *radiance, float *transmittance) {
    const skv_rays in = {.direction_enu = rays->direction_enu};
    const skv_sky out = {.radiance = radiance,
                         .radiance_stride = 4 * sizeof(float),
                         .transmittance = transmittance,
                         .transmittance_stride = 4 * sizeof(float)};
    air->evaluations += rays->n;
    return skv_radiance(frame, rays->n, &in, &out) == SKV_OK;
}

/// Moves what each deferred kind of matter scatters once from radiance into a layer of its own.
/// @param whole, rest  for working, [n][4]
static bool split(bake_air *air, const bake_rays *rays, float *radiance, float *const once[], float *whole,
                  float *rest) {
    const skv_bake_table t = {.phase = {air->phase[0], air->phase[1]}, .g = {air->g[0], air->g[1]}};
    skv_frame frame;
    if (!begin(air, &air->model, rays->altitude_km, rays->sun_enu, &frame) || !shine(air, &frame, rays, whole, NULL))
        return false;
    for (int k = 0; k < air->deferred; k++) {
        if (!begin(air, &air->bare[k], rays->altitude_km, rays->sun_enu, &frame) ||
            !shine(air, &frame, rays, rest, NULL))
            return false;
        for (size_t i = 0; i < rays->n; i++) {
            const float phase = skv_bake_phase(&t, k + 1, rays->direction_enu + 3 * i, rays->sun_enu);
            for (size_t at = 4 * i; at < 4 * i + (size_t)air->model.bands; at++) {
                const float own = fminf(fmaxf(whole[at] - rest[at], 0.0f), radiance[at]);
                once[k][at] = own / phase;
                radiance[at] -= own;
            }
        }
    }
    return true;
}

bool bake_light(bake_air *air, const bake_rays *rays, float *radiance, float *const once[], float *transmittance) {
    skv_frame frame;
    if (!begin(air, &air->model, rays->altitude_km, rays->sun_enu, &frame))
        return false;
    if (air->orders.table && skv_frame_table(&frame, air->orders.table) != SKV_OK)
        return false;
    if (!shine(air, &frame, rays, radiance, transmittance))
        return false;
    if (!once || air->deferred == 0)
        return true;
    float *const work = malloc(8 * rays->n * sizeof *work);
    const bool ok = work && split(air, rays, radiance, once, work, work + 4 * rays->n);
    free(work);
    return ok;
}

// ---- irradiance: radiance integrated over half spheres

enum { POLAR = 10, AZIMUTHS = 10, PIECES = 3, SPHERE = PIECES * POLAR * AZIMUTHS };

/// Gauss-Legendre nodes and weights on [0, 1], by Newton's method on the recurrence of the polynomials.
static void gauss_nodes(int n, double x[], double w[]) {
    const double pi = 3.14159265358979323846;
    for (int i = 0; i < n; i++) {
        double z = cos(pi * (i + 0.75) / (n + 0.5)), derivative = 1.0;
        for (int step = 0; step < 20; step++) {
            double p = 1.0, before = 0.0;
            for (int k = 1; k <= n; k++) {
                const double next = ((2.0 * k - 1.0) * z * p - (k - 1.0) * before) / k;
                before = p;
                p = next;
            }
            derivative = n * (z * p - before) / (z * z - 1.0);
            z -= p / derivative;
        }
        x[i] = 0.5 * (1.0 - z);
        w[i] = 1.0 / ((1.0 - z * z) * derivative * derivative);
    }
}

/// Directions and |mu| x solid angle over the sphere, split where radiance has an edge: at the horizontal (the
/// surface's) and at the horizon. Nodes crowd quadratically at the upper end of each piece, and in azimuth at the sun.
static void sphere(float horizon_mu, float direction[SPHERE][3], double weight[SPHERE]) {
    const double pi = 3.14159265358979323846, mu_h = (double)horizon_mu;
    const double from[PIECES] = {0.0, 0.0, mu_h}, to[PIECES] = {1.0, mu_h, -1.0};
    double x[POLAR], wx[POLAR], y[AZIMUTHS], wy[AZIMUTHS];
    gauss_nodes(POLAR, x, wx);
    gauss_nodes(AZIMUTHS, y, wy);
    for (int i = 0; i < SPHERE; i++) {
        const int piece = i / (POLAR * AZIMUTHS), k = i / AZIMUTHS % POLAR, j = i % AZIMUTHS;
        const double whole = to[piece] - from[piece], mu = from[piece] + whole * x[k] * x[k];
        const double phi = pi * y[j] * y[j], level = sqrt(fmax(1.0 - mu * mu, 0.0));
        direction[i][0] = (float)(level * cos(phi));
        direction[i][1] = (float)(level * sin(phi));
        direction[i][2] = (float)mu;
        // Both halves of the sky: twice 2 pi y dy.
        weight[i] = fabs(mu) * fabs(whole) * 2.0 * x[k] * wx[k] * 4.0 * pi * y[j] * wy[j];
    }
}

bool bake_irradiance(bake_air *air, float altitude_km, const float sun_enu[3], float out[3][4]) {
    static float direction[SPHERE][3], radiance[SPHERE][4];
    static double weight[SPHERE];
    const skv_bake_table t = {.radius_km = air->model.radius_km + air->ground_km};
    const bake_rays rays = {altitude_km, {sun_enu[0], sun_enu[1], sun_enu[2]}, SPHERE, direction[0]};
    const bake_rays beam = {altitude_km, {sun_enu[0], sun_enu[1], sun_enu[2]}, 1, sun_enu};
    float horizon, sine, none[4], through[4];
    skv_bake_horizon(&t, altitude_km, &horizon, &sine);
    sphere(horizon, direction, weight);
    if (!bake_light(air, &rays, radiance[0], NULL, NULL) || !bake_light(air, &beam, none, NULL, through))
        return false;
    for (int b = 0; b < air->model.bands; b++) {
        double sum[2] = {0.0, 0.0};
        for (int i = 0; i < SPHERE; i++)
            sum[direction[i][2] < 0.0f] += weight[i] * (double)radiance[i][b];
        out[SKV_BAKE_DOWN][b] = (float)sum[0];
        out[SKV_BAKE_UP][b] = (float)sum[1];
        out[SKV_BAKE_BEAM][b] = sun_enu[2] >= horizon ? through[b] * air->model.solar_irradiance[b] *
                                                            air->model.absorption_colour[b] * air->sun_scale
                                                      : 0.0f;
    }
    return true;
}
