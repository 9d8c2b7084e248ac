#include "scene.h"

#include <math.h>
#include <stdio.h>
#include <time.h>

#ifdef SKV_HAVE_GEOGRAPHICLIB
#include "port/geographiclib/skv_geo.h"
#endif

static bool is_earth(const sky_options *options) {
    return !options->atmosphere_path &&
           (options->preset == SKV_PRESET_EARTH_CLEAR || options->preset == SKV_PRESET_EARTH_HAZY);
}

/// Radius of the sphere that stands for the ellipsoid here: the atmosphere's own without a position.
static float local_radius_km(const sky_options *options, const moment *now) {
    double radius_km = (double)options->atmosphere.radius_km;
#ifdef SKV_HAVE_GEOGRAPHICLIB
    if (is_earth(options) && now->has_position)
        (void)skv_geo_local_sphere(now->at.lat_deg, &radius_km);
#else
    (void)now;
#endif
    return (float)radius_km;
}

static int build_model(scene *view, const moment *now) {
    skv_atmosphere atmosphere = view->options->atmosphere;
    atmosphere.radius_km = local_radius_km(view->options, now);
    // Along a flight the radius changes by metres: the same model for a whole kilometre.
    if (view->has_model && fabsf(view->model.radius_km - atmosphere.radius_km) < 1.0f)
        return 0;
    const skv_status status = skv_model_build(&view->model, &atmosphere);
    if (status != SKV_OK)
        return fail_usage(
            "skyvert %s: the core refuses this atmosphere (status %d): see skyvert/atmosphere.h for ranges",
            view->options->command, (int)status);
    view->has_model = true;
    return 0;
}

int scene_begin(scene *view, const sky_options *options, const moment *now) {
    view->options = options;
    view->observer_km = now->at.msl_m / 1000.0;
    const int built = build_model(view, now);
    if (built != 0)
        return built;
    skv_light sun;
    skv_status status = skv_light_sun(&sun, &view->model, now->sun_enu);
    if (is_earth(options)) // the presets' irradiance is that at 1 au
        for (int b = 0; b < 4; b++)
            sun.irradiance[b] /= (float)(now->sun_distance_au * now->sun_distance_au);
    if (status == SKV_OK)
        status = skv_frame_begin(&view->frame, &view->model, &options->quality, (float)view->observer_km,
                                 (float)(options->ground_m / 1000.0), &sun, 1);
    if (status != SKV_OK)
        return fail_usage("skyvert %s: the core refuses height %g m with ground %g m (status %d): the ground lies from "
                          "-12000 to 12000 m and below the top of the air, %g m",
                          options->command, now->at.msl_m, options->ground_m, (int)status,
                          1000.0 * (double)view->model.top_km);
    return 0;
}

static double processor_s(void) {
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now); // other programs on the machine do not count
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

bool scene_colours(scene *view, size_t n, const float *direction_enu, float *radiance, float *rgb, float *luminance) {
    const skv_rays rays = {.direction_enu = direction_enu};
    const skv_sky sky = {.radiance = radiance};
    const double start_s = processor_s();
    const bool done =
        skv_radiance(&view->frame, n, &rays, &sky) == SKV_OK &&
        skv_colour(&view->options->matrix, view->model.bands, n, radiance, 0, rgb, 0, luminance, 0) == SKV_OK;
    view->core_s += processor_s() - start_s;
    view->rays += n;
    return done;
}

char *scene_timing(const scene *view, char *text, size_t size) {
    snprintf(text, size, "%zu rays, %.0f ns of processor time each (radiance and colour)", view->rays,
             view->rays > 0 ? 1e9 * view->core_s / (double)view->rays : 0.0);
    return text;
}

double scene_zenith_luminance(scene *view) {
    const float up[3] = {0.0f, 0.0f, 1.0f};
    float radiance[4], rgb[3], luminance = 0.0f;
    return scene_colours(view, 1, up, radiance, rgb, &luminance) ? (double)luminance : 0.0;
}

double scene_horizon_deg(const scene *view) {
    const double ground_km = view->options->ground_m / 1000.0;
    const double ratio = (view->observer_km - ground_km) / ((double)view->model.radius_km + ground_km);
    return ratio > 0.0 ? -acos(1.0 / (1.0 + ratio)) * (180.0 / 3.14159265358979323846) : 0.0;
}
