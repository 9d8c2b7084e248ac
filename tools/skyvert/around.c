#include "around.h"

#include <string.h>

/// Transmittance from the water toward each light.
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

skv_status around_set_water(surroundings *out, const skv_frame *frame, const skv_table *table, const skv_light *lights,
                            float wind_m_s, float wind_azimuth_deg) {
    skv_quality quality = frame->quality;
    quality.terms &= ~(uint32_t)SKV_WITH_GROUND; // mirrored rays go up
    skv_status status =
        wind_m_s > 0.0f ? skv_water_wind(&out->water, wind_m_s, wind_azimuth_deg) : skv_water_flat(&out->water);
    if (status == SKV_OK)
        status = skv_frame_begin(&out->at_sea, frame->model, &quality, frame->ground_km, frame->ground_km, lights,
                                 frame->lights);
    if (status == SKV_OK && table)
        status = skv_frame_table(&out->at_sea, table);
    out->has_water = status == SKV_OK;
    return status == SKV_OK ? find_through_air(out) : status;
}

static bool is_flat(const skv_water *water) {
    return !(water->slope2_along > 0.0f) && !(water->slope2_across > 0.0f);
}

/// The sky as seen from the water toward the first m of around->toward, into around->seen.
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

static skv_status add_water(surroundings *around, const skv_frame *frame, size_t n, const skv_rays *rays,
                            const skv_sky *sky) {
    const size_t bands = (size_t)frame->model->bands;
    size_t m = 0;
    skv_status status = skv_water_mirror(&around->water, frame, n, rays, around->hit);
    for (size_t i = 0; i < n && status == SKV_OK; i++)
        if (around->hit[i].distance_km > 0.0f || around->hit[i].reflectance > 0.0f)
            memcpy(around->toward[m++], around->hit[i].local_enu, sizeof around->toward[0]);
    if (status != SKV_OK || m == 0)
        return status;
    status = look_up(around, m);
    for (size_t i = 0, k = 0; i < n; i++) {
        const bool hit = around->hit[i].distance_km > 0.0f || around->hit[i].reflectance > 0.0f;
        for (size_t b = 0; b < bands; b++)
            around->mirrored[i * bands + b] = hit ? around->seen[k * bands + b] : 0.0f;
        k += hit;
    }
    if (status == SKV_OK)
        status = skv_water_add(frame, n, around->hit, around->mirrored, 0, sky);
    for (int32_t i = 0; i < frame->lights && status == SKV_OK; i++)
        status = skv_water_glint(&around->water, frame, i, around->through_air[i], n, rays, sky);
    return status;
}

skv_status around_add(surroundings *around, const skv_frame *frame, size_t n, const float *direction_enu,
                      const skv_sky *sky) {
    const skv_rays rays = {.direction_enu = direction_enu};
    skv_status status = around->has_water ? add_water(around, frame, n, &rays, sky) : SKV_OK;
    if (status == SKV_OK && around->has_night)
        status = skv_night_add(&around->night, frame, n, &rays, sky);
    for (int i = 0; i < around->discs && status == SKV_OK; i++)
        status = skv_disc_add(&around->disc[i], frame, n, &rays, sky);
    return status;
}
