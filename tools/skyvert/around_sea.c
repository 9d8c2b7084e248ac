/// Water below the sky: mirrored sky, mirrored discs or glitter.
#include <math.h>
#include <string.h>

#include "around.h"

/// Higher than this over the water a frame of its own for each ray: a degree and more of the sun's height between the
/// water below and the water at the horizon.
#define FAR_KM 1.0f

static bool is_flat(const skv_water *water) {
    return !(water->slope2_along > 0.0f) && !(water->slope2_across > 0.0f);
}

/// Transmittance from the water below toward each light.
static skv_status find_through_air(surroundings *out) {
    for (int i = 0; i < out->at_sea.lights; i++) {
        float radiance[4];
        const skv_rays rays = {.direction_enu = out->at_sea.light[i].direction_enu};
        const skv_sky sky = {.radiance = radiance, .transmittance = out->through_air[i]};
        memset(out->through_air[i], 0, sizeof out->through_air[i]);
        if (!(out->at_sea.light[i].mu_s > 0.0f))
            continue;
        const skv_status status = skv_radiance(&out->at_sea, 1, &rays, &sky);
        if (status != SKV_OK)
            return status;
    }
    return SKV_OK;
}

static skv_status begin_at_sea(skv_frame *out, const skv_frame *frame, const skv_table *table,
                               const skv_light *lights) {
    skv_quality quality = frame->quality;
    quality.terms &= ~(uint32_t)SKV_WITH_GROUND; // mirrored rays go up
    skv_status status =
        skv_frame_begin(out, frame->model, &quality, frame->ground_km, frame->ground_km, lights, frame->lights);
    if (status == SKV_OK && table)
        status = skv_frame_table(out, table);
    return status;
}

skv_status around_set_water(surroundings *out, const skv_frame *frame, const skv_table *table, const skv_light *lights,
                            float wind_m_s, float wind_azimuth_deg) {
    skv_status status =
        wind_m_s > 0.0f ? skv_water_wind(&out->water, wind_m_s, wind_azimuth_deg) : skv_water_flat(&out->water);
    if (status == SKV_OK)
        status = begin_at_sea(&out->at_sea, frame, table, lights);
    memcpy(out->light, lights, sizeof out->light[0] * (size_t)frame->lights);
    out->has_water = status == SKV_OK;
    out->far = frame->height_km > FAR_KM;
    return status == SKV_OK ? find_through_air(out) : status;
}

// ---- near: one frame for all of the water

/// The sky as seen from the water below toward the first m of around->toward, into around->seen.
static skv_status look_up(surroundings *around, size_t m) {
    const skv_rays rays = {.direction_enu = around->toward[0]};
    const skv_sky sky = {.radiance = around->seen, .transmittance = around->clear};
    skv_status status = skv_radiance(&around->at_sea, m, &rays, &sky);
    if (status == SKV_OK && around->has_night)
        status = skv_night_add(&around->night, &around->at_sea, m, &rays, &sky);
    for (int i = 0; i < around->discs && status == SKV_OK && is_flat(&around->water); i++)
        status = skv_disc_add(&around->disc[i], &around->at_sea, m, &rays, &sky);
    return status;
}

static bool meets_water(const skv_water_hit *hit) {
    return hit->distance_km > 0.0f || hit->reflectance > 0.0f;
}

static skv_status mirror_near(surroundings *around, size_t n, size_t bands) {
    size_t m = 0;
    for (size_t i = 0; i < n; i++)
        if (meets_water(&around->hit[i]))
            memcpy(around->toward[m++], around->hit[i].local_enu, sizeof around->toward[0]);
    const skv_status status = m > 0 ? look_up(around, m) : SKV_OK;
    for (size_t i = 0, k = 0; i < n; i++) {
        const bool hit = meets_water(&around->hit[i]);
        for (size_t b = 0; b < bands; b++)
            around->mirrored[i * bands + b] = hit ? around->seen[k * bands + b] : 0.0f;
        k += hit;
    }
    return status;
}

// ---- far: what stands where it does over that point of the water

/// Turns the observer's axes into those of a point on the water: about the level line across the ray.
typedef struct turn {
    double east, north; ///< of the ray's level direction
    double sine, cosine;
} turn;

static turn turn_to(const skv_frame *frame, const float *direction_enu, float distance_km) {
    const double x = (double)direction_enu[0], y = (double)direction_enu[1], z = (double)direction_enu[2];
    const double level = hypot(x, y), length = hypot(level, z);
    const double sine = fmin(1.0, (double)distance_km * level / (length * (double)frame->radius_km));
    return (turn){level > 0.0 ? x / level : 0.0, level > 0.0 ? y / level : 1.0, sine, sqrt(1.0 - sine * sine)};
}

static void turn_vector(const turn *t, const float from[3], float to[3]) {
    const double forward = (double)from[0] * t->east + (double)from[1] * t->north, up = (double)from[2];
    const double more = forward * (t->cosine - 1.0) - up * t->sine;
    const float vector[3] = {(float)((double)from[0] + more * t->east), (float)((double)from[1] + more * t->north),
                             (float)(forward * t->sine + up * t->cosine)};
    memcpy(to, vector, sizeof vector);
}

static skv_disc turned_disc(const turn *t, const skv_disc *disc) {
    skv_disc out = *disc;
    turn_vector(t, disc->direction_enu, out.direction_enu);
    turn_vector(t, disc->right_enu, out.right_enu);
    turn_vector(t, disc->up_enu, out.up_enu);
    turn_vector(t, disc->zenith_enu, out.zenith_enu);
    return out;
}

/// What ray i of the batch sees in the water, and what is left there of each light.
static skv_status look_up_there(surroundings *around, const skv_frame *frame, size_t i, const float *direction_enu,
                                float seen[4], float through_air[][4]) {
    const turn there = turn_to(frame, direction_enu, around->hit[i].distance_km);
    float toward[1 + SKV_LIGHTS_MAX][3], radiance[(1 + SKV_LIGHTS_MAX) * 4] = {0};
    float clear[(1 + SKV_LIGHTS_MAX) * 4] = {0};
    const size_t bands = (size_t)frame->model->bands;
    skv_light light[SKV_LIGHTS_MAX];
    skv_frame at_sea;
    memcpy(light, around->light, sizeof light);
    memcpy(toward[0], around->hit[i].local_enu, sizeof toward[0]);
    for (int32_t k = 0; k < frame->lights; k++) {
        turn_vector(&there, around->light[k].direction_enu, light[k].direction_enu);
        memcpy(toward[1 + k], light[k].direction_enu, sizeof toward[0]);
    }
    skv_status status = begin_at_sea(&at_sea, frame, frame->diffuse.table, light);
    const skv_rays rays = {.direction_enu = toward[0]};
    const skv_sky sky = {.radiance = radiance, .transmittance = clear};
    if (status == SKV_OK)
        status = skv_radiance(&at_sea, 1 + (size_t)frame->lights, &rays, &sky);
    if (status == SKV_OK && around->has_night)
        status = skv_night_add(&around->night, &at_sea, 1, &rays, &sky);
    for (int k = 0; k < around->discs && status == SKV_OK && is_flat(&around->water); k++) {
        const skv_disc disc = turned_disc(&there, &around->disc[k]);
        status = skv_disc_add(&disc, &at_sea, 1, &rays, &sky);
    }
    memcpy(seen, radiance, bands * sizeof *seen);
    for (int32_t k = 0; k < frame->lights; k++)
        for (size_t b = 0; b < bands; b++)
            through_air[k][b] = light[k].direction_enu[2] > 0.0f ? clear[(1 + (size_t)k) * bands + b] : 0.0f;
    return status;
}

/// Mirrored sky into around->mirrored; glitter is added at once.
static skv_status mirror_far(surroundings *around, const skv_frame *frame, size_t n, const skv_rays *rays,
                             const skv_sky *sky) {
    const size_t bands = (size_t)frame->model->bands;
    skv_status status = SKV_OK;
    for (size_t i = 0; i < n && status == SKV_OK; i++) {
        float seen[4] = {0.0f, 0.0f, 0.0f, 0.0f}, through_air[SKV_LIGHTS_MAX][4];
        const skv_rays ray = {.direction_enu = rays->direction_enu + 3 * i};
        const skv_sky one = {.radiance = sky->radiance + i * bands, .transmittance = sky->transmittance + i * bands};
        if (meets_water(&around->hit[i])) {
            status = look_up_there(around, frame, i, ray.direction_enu, seen, through_air);
            for (int32_t k = 0; k < frame->lights && status == SKV_OK; k++)
                status = skv_water_glint(&around->water, frame, k, through_air[k], 1, &ray, &one);
        }
        memcpy(around->mirrored + i * bands, seen, bands * sizeof *seen);
    }
    return status;
}

skv_status around_add_sea(surroundings *around, const skv_frame *frame, size_t n, const skv_rays *rays,
                          const skv_sky *sky) {
    skv_status status = skv_water_mirror(&around->water, frame, n, rays, around->hit);
    if (status == SKV_OK)
        status =
            around->far ? mirror_far(around, frame, n, rays, sky) : mirror_near(around, n, (size_t)frame->model->bands);
    if (status == SKV_OK)
        status = skv_water_add(frame, n, around->hit, around->mirrored, 0, sky);
    for (int32_t i = 0; i < frame->lights && status == SKV_OK && !around->far; i++)
        status = skv_water_glint(&around->water, frame, i, around->through_air[i], n, rays, sky);
    return status;
}
