#include "scene.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "skyvert/moonlight.h"
#include "skyvert/stars.h"

#ifdef SKV_HAVE_GEOGRAPHICLIB
#include "port/geographiclib/skv_geo.h"
#endif

/// Rays from which on a grid is cheaper.
#define GRID_PAYS 2000
/// The moon lights the sky where the sun is lower below the horizon than this: until then it adds less than 1/1000.
#define MOONLIGHT_DEG 3.0

static bool is_earth_preset(const sky_options *options) {
    static const skv_preset others[] = {SKV_PRESET_MARS, SKV_PRESET_TINY, SKV_PRESET_GIANT, SKV_PRESET_TITAN};
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++)
        if (options->preset == others[i])
            return false;
    return !options->atmosphere_path;
}

/// An air of the user's own counts as the Earth's where the moment is one of the Earth.
static bool is_earth(const sky_options *options) {
    return options->atmosphere_path || is_earth_preset(options);
}

/// Radius of the sphere that stands for the ellipsoid here: the atmosphere's own without a position.
static float local_radius_km(const sky_options *options, const moment *now) {
    double radius_km = (double)options->atmosphere.radius_km;
#ifdef SKV_HAVE_GEOGRAPHICLIB
    if (is_earth_preset(options) && now->has_position)
        (void)skv_geo_local_sphere(now->at.lat_deg, &radius_km);
#else
    (void)now;
#endif
    return (float)radius_km;
}

static int build_model(scene *view, const moment *now) {
    const sky_options *const options = view->options;
    skv_atmosphere atmosphere = options->atmosphere;
    atmosphere.radius_km = local_radius_km(options, now);
    // Along a flight the radius changes by metres: the same model for a whole kilometre.
    if (!view->has_model || fabsf(view->model.radius_km - atmosphere.radius_km) >= 1.0f) {
        const skv_status status = skv_model_build(&view->model, &atmosphere);
        if (status != SKV_OK)
            return fail_usage(
                "skyvert %s: the core refuses this atmosphere (status %d): see skyvert/atmosphere.h for ranges",
                options->command, (int)status);
        view->has_model = true;
    }
    if (options->light.orders == 0)
        return 0;
    return all_orders_build(&view->orders, options->command, &view->model, (skv_table_kind)options->light.table,
                            (float)(options->ground_m / 1000.0), view->progress);
}

// ---- lights and discs

static bool wanted(int asked, bool known) {
    return asked == CHOICE_ON || (asked == CHOICE_AUTO && known);
}

/// How far the sun is: on another planet's preset as far as its irradiance says.
static double distance_of_sun(const scene *view, const moment *now) {
    const sky_options *const options = view->options;
    skv_atmosphere earth;
    if (is_earth(options) || skv_atmosphere_preset(&earth, SKV_PRESET_EARTH_CLEAR, options->bands) != SKV_OK)
        return now->sun_distance_au;
    double here = 0.0, there = 0.0;
    for (int b = 0; b < options->bands; b++) {
        here += (double)options->atmosphere.solar_irradiance[b];
        there += (double)earth.solar_irradiance[b];
    }
    return here > 0.0 ? sqrt(there / here) : now->sun_distance_au;
}

/// The sun, and its disc where that is drawn.
static skv_status add_sun(scene *view, const moment *now, const scene_plan *plan) {
    skv_light *const sun = &view->light[0];
    skv_status status = skv_light_sun(sun, &view->model, now->sun_enu);
    if (is_earth_preset(view->options)) // the presets' irradiance is that at 1 au
        for (int b = 0; b < 4; b++)
            sun->irradiance[b] /= (float)(now->sun_distance_au * now->sun_distance_au);
    view->lights = 1;
    if (status != SKV_OK || view->options->light.discs == CHOICE_OFF)
        return status;
    status = skv_disc_sun(&view->around.disc[view->around.discs], &view->model, sun, (float)distance_of_sun(view, now),
                          plan->sample_rad);
    view->around.discs += status == SKV_OK;
    return status;
}

/// The moon's disc, and the moon as a light in the night.
static skv_status add_moon(scene *view, const moment *now, const scene_plan *plan) {
    skv_moonlight moonlight;
    const float distance_au = is_earth_preset(view->options) ? (float)now->sun_distance_au : 1.0f;
    skv_status status = skv_moonlight_at(&moonlight, &view->model, &now->moon, distance_au, now->moon_side);
    if (status != SKV_OK)
        return status;
    if (SKV_LIGHTS_MAX > 1 && now->sun_elevation_deg < scene_horizon_deg(view) - MOONLIGHT_DEG) {
        skv_light *const moon = &view->light[view->lights++];
        memcpy(moon->direction_enu, now->moon.direction_enu, sizeof moon->direction_enu);
        memcpy(moon->irradiance, moonlight.irradiance, sizeof moon->irradiance);
    }
    if (view->options->light.discs == CHOICE_OFF)
        return SKV_OK;
    status = skv_disc_moon(&view->around.disc[view->around.discs], &view->model, &moonlight, now->moon.direction_enu,
                           now->sun_enu, plan->sample_rad);
    view->around.discs += status == SKV_OK;
    return status;
}

static int set_lights(scene *view, const moment *now, const scene_plan *plan) {
    const light_options *const light = &view->options->light;
    const char *const command = view->options->command;
    view->lights = view->around.discs = 0;
    skv_status status = add_sun(view, now, plan);
    if (status != SKV_OK)
        return fail_job("skyvert %s: the core refuses the sun (status %d)", command, (int)status);
    if (light->moon == CHOICE_ON && !now->has_moon)
        return fail_usage("skyvert %s: --moon on: where? --utc and a position, or --moon-zenith-deg", command);
    if (now->has_moon && wanted(light->moon, is_earth(view->options)))
        status = add_moon(view, now, plan);
    if (status != SKV_OK)
        return fail_job("skyvert %s: the core refuses the moon (status %d)", command, (int)status);
    view->around.has_night = wanted(light->night, is_earth(view->options) && now->has_utc && now->has_position) &&
                             skv_night_earth(&view->around.night) == SKV_OK;
    return 0;
}

// ---- frames

static skv_status add_grid(scene *view, skv_frame *frame, float **grid) {
    const size_t size = skv_grid_size(frame);
    free(*grid);
    *grid = malloc(size > 0 ? size : 1);
    if (!*grid)
        return SKV_ERR_SIZE;
    const double start_s = processor_s();
    const skv_status status = skv_frame_grid(frame, *grid, size);
    view->cost.grid_s += processor_s() - start_s;
    view->cost.grids++;
    return status;
}

static int set_grids(scene *view, const scene_plan *plan) {
    const light_options *const light = &view->options->light;
    if (light->orders == 0 || !wanted(light->grid, plan->rays >= GRID_PAYS))
        return 0;
    skv_status status = add_grid(view, &view->frame, &view->grid[0]);
    if (status == SKV_OK && view->around.has_water && !view->around.far)
        status = add_grid(view, &view->around.at_sea, &view->grid[1]);
    // From too high up, or left out at compile time: ray by ray.
    if (status == SKV_OK || (light->grid == CHOICE_AUTO && (status == SKV_ERR_RANGE || status == SKV_ERR_UNSUPPORTED)))
        return 0;
    if (status == SKV_ERR_RANGE)
        return fail_usage("skyvert %s: --grid on: not from so high up; use auto or off", view->options->command);
    return fail_job("skyvert %s: --grid: no memory, or this build of the core lacks it (status %d)",
                    view->options->command, (int)status);
}

static skv_status begin_frames(scene *view) {
    const sky_options *const options = view->options;
    const skv_table *const table = options->light.orders == 0 ? NULL : view->orders.table;
    skv_status status = skv_frame_begin(&view->frame, &view->model, &options->quality, (float)view->observer_km,
                                        (float)(options->ground_m / 1000.0), view->light, view->lights);
    view->once = view->frame;
    if (status == SKV_OK && table)
        status = skv_frame_table(&view->frame, table);
    view->around.has_water = false;
    if (status == SKV_OK && options->water)
        status = around_set_water(&view->around, &view->frame, table, view->light, (float)options->light.wind_m_s,
                                  (float)options->light.wind_azimuth_deg);
    return status;
}

int scene_begin(scene *view, const sky_options *options, const moment *now, const scene_plan *plan) {
    view->options = options;
    view->observer_km = now->at.msl_m / 1000.0;
    int result = build_model(view, now);
    if (result == 0)
        result = set_lights(view, now, plan);
    if (result != 0)
        return result;
    const skv_status status = begin_frames(view);
    if (status != SKV_OK)
        return fail_usage("skyvert %s: the core refuses height %g m with ground %g m (status %d): the ground lies from "
                          "-12000 to 12000 m and below the top of the air, %g m",
                          options->command, now->at.msl_m, options->ground_m, (int)status,
                          1000.0 * (double)view->model.top_km);
    return set_grids(view, plan);
}

void scene_end(scene *view) {
    all_orders_free(&view->orders);
    for (int i = 0; i < 2; i++) {
        free(view->grid[i]);
        view->grid[i] = NULL;
    }
}

// ---- light

/// With --timing one batch in eight is done again, for the share of light scattered once.
static bool time_once(scene *view, size_t n, const skv_rays *rays, const skv_sky *sky) {
    const double start_s = processor_s();
    const bool done = skv_radiance(&view->once, n, rays, sky) == SKV_OK;
    view->cost.once_s += processor_s() - start_s;
    view->cost.sampled += n;
    return done;
}

/// At most AROUND_BATCH rays.
static bool find_radiance(scene *view, size_t n, const float *direction_enu, float *radiance, float *transmittance) {
    const skv_rays rays = {.direction_enu = direction_enu};
    const skv_sky sky = {.radiance = radiance, .transmittance = transmittance};
    if (view->options->timing && view->cost.sampled <= view->cost.rays / 8 && !time_once(view, n, &rays, &sky))
        return false;
    const double start_s = processor_s();
    bool done = skv_radiance(&view->frame, n, &rays, &sky) == SKV_OK;
    const double middle_s = processor_s();
    done = done && around_add(&view->around, &view->frame, n, direction_enu, &sky) == SKV_OK;
    view->cost.radiance_s += middle_s - start_s;
    view->cost.around_s += processor_s() - middle_s;
    view->cost.rays += n;
    return done;
}

static void other_radiance(scene *view, size_t n, const float *direction_enu, float *radiance) {
    const double start_s = processor_s();
    other_model_radiance(view->other, n, direction_enu, (size_t)view->model.bands, radiance);
    view->cost.radiance_s += processor_s() - start_s;
    view->cost.rays += n;
}

bool scene_colours(scene *view, size_t n, const float *direction_enu, float *radiance, float *rgb, float *luminance) {
    float transmittance[AROUND_BATCH * 4];
    const size_t bands = (size_t)view->model.bands;
    for (size_t first = 0; first < n; first += AROUND_BATCH) {
        const size_t count = n - first < AROUND_BATCH ? n - first : AROUND_BATCH;
        if (view->other)
            other_radiance(view, count, direction_enu + 3 * first, radiance + bands * first);
        else if (!find_radiance(view, count, direction_enu + 3 * first, radiance + bands * first, transmittance))
            return false;
    }
    const double start_s = processor_s();
    const bool done = skv_colour(&view->options->matrix, (int)bands, n, radiance, 0, rgb, 0, luminance, 0) == SKV_OK;
    view->cost.colour_s += processor_s() - start_s;
    return done;
}

scene_zenith_light scene_zenith(scene *view) {
    const float up[3] = {0.0f, 0.0f, 1.0f};
    float radiance[4], transmittance[4], rgb[3], luminance = 0.0f, weight[4], limit = 0.0f;
    const skv_colour_matrix *const matrix = &view->options->matrix;
    const int bands = view->model.bands, discs = view->around.discs;
    scene_zenith_light zenith = {0.0, 0.0};
    view->around.discs = 0;
    bool done = find_radiance(view, 1, up, radiance, transmittance);
    if (done && view->other)
        other_radiance(view, 1, up, radiance);
    done = done && skv_colour(matrix, bands, 1, radiance, 0, rgb, 0, &luminance, 0) == SKV_OK;
    view->around.discs = discs;
    if (!done || skv_limiting_magnitude(&limit, luminance, SKV_FIELD_FACTOR) != SKV_OK)
        return zenith;
    double left = 0.0;
    if (skv_star_bands(weight, matrix, bands, view->model.solar_irradiance) == SKV_OK)
        for (int b = 0; b < bands; b++)
            left += (double)weight[b] * (double)transmittance[b];
    zenith.luminance = (double)luminance;
    zenith.limiting_magnitude = (double)limit + (left > 0.0 ? 2.5 * log10(left) : 0.0);
    return zenith;
}

double scene_horizon_deg(const scene *view) {
    const double ground_km = view->options->ground_m / 1000.0;
    const double ratio = (view->observer_km - ground_km) / ((double)view->model.radius_km + ground_km);
    return ratio > 0.0 ? -acos(1.0 / (1.0 + ratio)) * (180.0 / 3.14159265358979323846) : 0.0;
}

// ---- what it cost

static double per(double seconds, size_t count) {
    return count > 0 ? 1e9 * seconds / (double)count : 0.0;
}

static char *other_timing(const scene *view, char *text, size_t size) {
    const scene_cost *const cost = &view->cost;
    snprintf(text, size,
             "%zu rays, %.0f ns of processor time each by %s, %.0f colour\ntables of %zu bytes, built in %.1f s",
             cost->rays, per(cost->radiance_s, cost->rays), view->other->is->name, per(cost->colour_s, cost->rays),
             view->other->cost.table_bytes, view->other->cost.build_s);
    return text;
}

char *scene_timing(const scene *view, char *text, size_t size) {
    if (view->other)
        return other_timing(view, text, size);
    const scene_cost *const cost = &view->cost;
    const double radiance = per(cost->radiance_s, cost->rays), once = per(cost->once_s, cost->sampled);
    const double around = per(cost->around_s, cost->rays), colour = per(cost->colour_s, cost->rays);
    int n = snprintf(text, size,
                     "%zu rays, %.0f ns of processor time each: %.0f light scattered once, %.0f more than once, %.0f "
                     "what is around, %.0f colour",
                     cost->rays, radiance + around + colour, fmin(once, radiance), fmax(radiance - once, 0.0), around,
                     colour);
    if (view->orders.table && n > 0 && (size_t)n < size)
        n += snprintf(text + n, size - (size_t)n, "\ntable of %u bytes, built in %.1f ms",
                      (unsigned)view->orders.table->bytes, 1e3 * view->orders.build_s);
    if (cost->grids > 0 && n > 0 && (size_t)n < size)
        snprintf(text + n, size - (size_t)n, "; %zu grids in %.1f ms each", cost->grids,
                 1e3 * cost->grid_s / (double)cost->grids);
    return text;
}
