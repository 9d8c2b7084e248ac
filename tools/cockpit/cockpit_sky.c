#define _POSIX_C_SOURCE 200809L
#include "cockpit_sky.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static const double pi = 3.14159265358979323846;
// Below these elevations of the sun the moon and the night's own light are added; above they would be less than 1e-4
// of the sky.
static const float moon_below_deg = -4.0f, night_below_deg = -5.0f;

void cockpit_dome_for(skv_dome *dome, uint32_t vertices) {
    const int32_t n = (int32_t)(vertices < 64 ? 64 : vertices > 65536 ? 65536 : vertices);
    const double side = sqrt((double)n / 2.0);
    int32_t best = 0;
    for (int32_t rings = (int32_t)(0.8 * side); rings <= (int32_t)(1.25 * side) + 1; rings++) {
        const int32_t azimuths = (n - 2) / rings; // zenith, rings, nadir
        if (rings < 4 || azimuths < 3 || rings * azimuths <= best)
            continue;
        best = rings * azimuths;
        *dome = (skv_dome){.kind = SKV_DOME_ADAPTIVE,
                           .azimuths = azimuths,
                           .rings_below = rings / 4 + 1,
                           .rings = rings + 1 - (rings / 4 + 1)};
    }
    dome->lowest_rad = (float)(-pi / 2);
}

/// Scales the particles so that the visibility at sea level is this. Clearer than the gas alone: none are left.
static void set_visibility(skv_atmosphere *a, double visibility_km) {
    int i = 0;
    while (i + 2 < a->bands && a->wavelength_nm[i + 1] < 550.0f)
        i++;
    const double t = fmax(0.0, fmin(1.0, (550.0 - (double)a->wavelength_nm[i]) /
                                             (double)(a->wavelength_nm[i + 1] - a->wavelength_nm[i])));
    const double gas =
        (1 - t) * (double)a->rayleigh_scattering_per_km[i] + t * (double)a->rayleigh_scattering_per_km[i + 1];
    const double haze =
        (1 - t) * (double)a->aerosol_extinction_per_km[i] + t * (double)a->aerosol_extinction_per_km[i + 1];
    if (haze > 0.0)
        a->turbidity = (float)fmax(0.0, fmin(1e4, (COCKPIT_KOSCHMIEDER / visibility_km - gas) / haze));
}

static bool build_model(const cockpit_sky *sky, cockpit_air *air, double visibility_km) {
    skv_atmosphere a;
    air->has_table = air->has_model = false;
    air->visibility_km = visibility_km;
    if (skv_atmosphere_preset(&a, sky->preset, sky->bands) != SKV_OK)
        return false;
    set_visibility(&a, visibility_km);
    air->has_model = skv_model_build(&air->model, &a) == SKV_OK;
    return air->has_model;
}

static bool room(void **memory, size_t *has, size_t wanted) {
    if (wanted <= *has)
        return true;
    void *const more = realloc(*memory, wanted);
    if (!more)
        return false;
    *memory = more;
    *has = wanted;
    return true;
}

static bool begin_table(cockpit_sky *sky, cockpit_air *air) {
    skv_table_spec spec;
    if (skv_table_spec_for(&spec, &air->model, SKV_TABLE_ACCURATE) != SKV_OK ||
        !room(&sky->work, &sky->work_bytes, skv_table_work_size(&spec, sky->bands)))
        return false;
    return skv_table_begin(&sky->builder, &air->model, &spec, (skv_table *)(void *)air->table, sizeof air->table,
                           sky->work, sky->work_bytes) == SKV_OK;
}

int cockpit_sky_begin(cockpit_sky *sky, const cockpit_sky_options *options) {
    memset(sky, 0, sizeof *sky);
    sky->preset = options->preset;
    sky->bands = options->bands;
    sky->tier = options->tier;
    cockpit_dome_for(&sky->dome, options->vertices);
    size_t vertices = 0, indices = 0;
    sky->dome.horizon_rad = 0.0f; // any valid dome tells the sizes
    sky->dome.sun_enu[2] = sky->dome.radius_km = sky->dome.top_km = 1.0f;
    const bool known = skv_dome_size(&sky->dome, &vertices, &indices) == SKV_OK;
    sky->vertices = (uint32_t)vertices;
    sky->indices = (uint32_t)indices;
    const size_t floats = vertices * (size_t)sky->bands;
    sky->radiance = calloc(floats, sizeof(float));
    sky->transmittance = calloc(floats, sizeof(float));
    sky->vertex = calloc(vertices, sizeof *sky->vertex);
    if (known && sky->radiance && sky->transmittance && sky->vertex &&
        build_model(sky, &sky->air[0], options->visibility_km) &&
        skv_colour_matrix_fitted(&sky->matrix, sky->bands, sky->air[0].model.wavelength_nm) == SKV_OK &&
        begin_table(sky, &sky->air[0])) {
        sky->building = true;
        return 0;
    }
    cockpit_sky_end(sky);
    return 1;
}

void cockpit_sky_end(cockpit_sky *sky) {
    free(sky->radiance);
    free(sky->transmittance);
    free(sky->vertex);
    free(sky->work);
    free(sky->grid);
    memset(sky, 0, sizeof *sky);
}

void cockpit_sky_indices(const cockpit_sky *sky, uint32_t *indices) {
    (void)skv_dome_build(&sky->dome, &sky->vertex[0].direction_enu[0], sizeof *sky->vertex, sky->vertices, indices,
                         sky->indices);
}

static int64_t processor_ns(void) {
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (int64_t)t.tv_sec * 1000000000 + t.tv_nsec;
}

/// The air whose table is being built: the first one is in use meanwhile, without a table.
static int built(const cockpit_sky *sky) {
    return sky->air[sky->current].has_table ? 1 - sky->current : sky->current;
}

static void begin_other(cockpit_sky *sky, double visibility_km) {
    const double shown = sky->air[built(sky)].visibility_km;
    const double compared = sky->building ? shown : sky->air[sky->current].visibility_km;
    if (sky->building && !sky->air[sky->current].has_table)
        return; // the first one is finished first
    if (!(fabs(visibility_km - compared) > 0.02 * compared))
        return;
    cockpit_air *const air = &sky->air[1 - sky->current];
    sky->building = build_model(sky, air, visibility_km) && begin_table(sky, air);
    if (!sky->building)
        air->visibility_km = 0.0;
}

void cockpit_sky_build(cockpit_sky *sky, double visibility_km, int64_t budget_ns) {
    const double wanted = fmax(0.02, fmin(1000.0, visibility_km));
    begin_other(sky, wanted);
    const int64_t until = processor_ns() + budget_ns;
    int permille = 0;
    while (sky->building && skv_table_step(&sky->builder, &permille) == SKV_OK) {
        if (permille == 1000) {
            sky->current = built(sky);
            sky->air[sky->current].has_table = true;
            sky->building = false;
            sky->builds++;
        }
        if (processor_ns() >= until)
            break;
    }
}

static void quality_of(const cockpit_sky *sky, skv_quality *quality) {
    (void)skv_quality_tier(quality, sky->level > 0 ? SKV_TIER_FAST : sky->tier);
    quality->terms |= SKV_WITH_GROUND;
}

static int lights_of(const cockpit_sky *sky, const cockpit_now *now, skv_light lights[2]) {
    const skv_model *const model = &sky->air[sky->current].model;
    const float far = now->sun.distance_au * now->sun.distance_au;
    int n = 0;
    if (skv_light_sun(&lights[0], model, now->sun.direction_enu) == SKV_OK) {
        for (int i = 0; i < sky->bands; i++)
            lights[0].irradiance[i] /= far;
        n = 1;
    }
    if (!now->has_moon || now->sun.elevation_deg > moon_below_deg || now->moon.elevation_deg < -6.0f)
        return n;
    const int side = skv_moon_side(now->moon.direction_enu, now->sun.direction_enu, (float)now->latitude_deg);
    return skv_light_moon(&lights[n], model, &now->moon, 1.0f, side) == SKV_OK ? n + 1 : n;
}

/// The grid of a frame pays from some 500 vertices on; from very high up there is none.
static void add_table(cockpit_sky *sky) {
    cockpit_air *const air = &sky->air[sky->current];
    sky->has_grid = false;
    if (!air->has_table || skv_frame_table(&sky->frame, (const skv_table *)(const void *)air->table) != SKV_OK ||
        sky->vertices < 500)
        return;
    void *grid = sky->grid;
    const bool fits = room(&grid, &sky->grid_bytes, skv_grid_size(&sky->frame));
    sky->grid = grid;
    sky->has_grid = fits && skv_frame_grid(&sky->frame, sky->grid, sky->grid_bytes) == SKV_OK;
}

static bool begin_frame(cockpit_sky *sky, const cockpit_now *now) {
    skv_light lights[2];
    skv_quality quality;
    const skv_model *const model = &sky->air[sky->current].model;
    const double height_km = fmax(0.0, fmin(1e6, 1e-3 * now->height_m));
    quality_of(sky, &quality);
    if (skv_frame_begin(&sky->frame, model, &quality, (float)height_km, 0.0f, lights, lights_of(sky, now, lights)) !=
        SKV_OK)
        return false;
    add_table(sky);
    const double radius = (double)model->radius_km, up = height_km * (2 * radius + height_km);
    sky->dome.horizon_rad = (float)-atan2(sqrt(up), radius);
    sky->dome.height_km = (float)height_km;
    sky->dome.radius_km = model->radius_km;
    sky->dome.top_km = model->top_km;
    memcpy(sky->dome.sun_enu, now->sun.direction_enu, sizeof sky->dome.sun_enu);
    sky->distance_au = (double)now->sun.distance_au;
    sky->night = now->sun.elevation_deg < night_below_deg;
    return true;
}

static void describe(cockpit_sky *sky, const cockpit_now *now) {
    skv_vertices_moment *const at = &sky->at;
    at->utc_day = now->has_time ? now->utc.day : INT32_MIN;
    at->utc_seconds = now->has_time ? (double)now->utc.seconds : 0.0;
    at->latitude_deg = now->latitude_deg;
    at->longitude_deg = now->longitude_deg;
    at->height_m = (float)now->height_m;
    at->horizon_rad = sky->dome.horizon_rad;
    memcpy(at->sun_enu, now->sun.direction_enu, sizeof at->sun_enu);
    at->sun_azimuth_deg = now->sun.azimuth_deg;
    at->sun_elevation_deg = now->sun.elevation_deg;
    memcpy(at->moon_enu, now->moon.direction_enu, sizeof at->moon_enu); // 0 where there is none
    at->moon_phase_deg = now->moon.phase_angle_deg;
    at->visibility_km = (float)sky->air[sky->current].visibility_km;
    at->exposure = (float)sky->exposure;
    at->zenith_luminance = (float)sky->zenith_cd_m2;
    at->utc_offset_s = now->time_offset_s;
}

/// Brings the average of log luminance above the horizon to .35 of white; half the way in .4 s.
static void expose(cockpit_sky *sky, const cockpit_now *now, double seconds) {
    double sum = 0.0;
    uint32_t n = 0;
    const uint32_t above = 1 + (uint32_t)(sky->dome.rings * sky->dome.azimuths);
    for (uint32_t i = 0; i < above && i < sky->vertices; i++, n++)
        sum += log(fmax((double)sky->vertex[i].luminance, 1e-5));
    const double mean = exp(sum / fmax(1.0, n)) / (double)SKV_WHITE_LUMINANCE;
    const double wanted = now->exposure > 0 ? now->exposure * (double)SKV_WHITE_LUMINANCE : 0.43 / mean;
    const double share = sky->exposure > 0 ? 1.0 - exp(-fmax(seconds, 0.0) / 0.6) : 1.0;
    const double from = sky->exposure > 0 ? sky->exposure : wanted;
    sky->exposure = fmax(1e-6, fmin(1e9, from * pow(wanted / from, share)));
    sky->zenith_cd_m2 = (double)sky->vertex[0].luminance;
}

/// The core's light towards n directions; where it is night with the night's own.
static bool radiance_of(const cockpit_sky *sky, size_t n, const float *direction, size_t stride, float *radiance,
                        float *transmittance) {
    const skv_rays rays = {.direction_enu = direction, .direction_stride = stride};
    const skv_sky out = {.radiance = radiance, .transmittance = transmittance};
    if (skv_radiance(&sky->frame, n, &rays, &out) != SKV_OK)
        return false;
    skv_night night;
    return !sky->night ||
           (skv_night_earth(&night) == SKV_OK && skv_night_add(&night, &sky->frame, n, &rays, &out) == SKV_OK);
}

bool cockpit_sky_frame(cockpit_sky *sky, const cockpit_now *now, double seconds) {
    const size_t stride = sizeof *sky->vertex;
    if (!begin_frame(sky, now) ||
        skv_dome_build(&sky->dome, sky->vertex[0].direction_enu, stride, sky->vertices, NULL, 0) != SKV_OK ||
        !radiance_of(sky, sky->vertices, sky->vertex[0].direction_enu, stride, sky->radiance,
                     sky->night ? sky->transmittance : NULL))
        return false;
    if (skv_colour(&sky->matrix, sky->bands, sky->vertices, sky->radiance, 0, sky->vertex[0].rgb, stride,
                   &sky->vertex[0].luminance, stride) != SKV_OK)
        return false;
    expose(sky, now, seconds);
    describe(sky, now);
    return true;
}

static bool add_disc(const cockpit_sky *sky, size_t n, const skv_rays *rays, const skv_sky *out, float sample_rad) {
    skv_disc disc;
    skv_light sun;
    const skv_frame *const f = &sky->frame;
    if (f->lights < 1)
        return true;
    memcpy(sun.direction_enu, sky->at.sun_enu, sizeof sun.direction_enu);
    for (int i = 0; i < 4; i++)
        sun.irradiance[i] = i < sky->bands ? f->model->solar_irradiance[i] : 0.0f;
    return skv_disc_sun(&disc, f->model, &sun, (float)fmax(0.9, sky->distance_au), sample_rad) == SKV_OK &&
           skv_disc_add(&disc, f, n, rays, out) == SKV_OK;
}

bool cockpit_sky_look(const cockpit_sky *sky, size_t n, const float *direction_enu, float *work, float *rgb,
                      float disc_rad) {
    float *const through = work + n * (size_t)sky->bands;
    const skv_rays rays = {.direction_enu = direction_enu};
    const skv_sky out = {.radiance = work, .transmittance = through};
    if (!radiance_of(sky, n, direction_enu, 0, work, through))
        return false;
    if (disc_rad > 0 && !add_disc(sky, n, &rays, &out, disc_rad))
        return false;
    return skv_colour(&sky->matrix, sky->bands, n, work, 0, rgb, 0, NULL, 0) == SKV_OK;
}
