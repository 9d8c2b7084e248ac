/// What a picture shows beside the sky itself: water, the light of the night, the discs of sun and moon.
#ifndef SKYVERT_AROUND_H
#define SKYVERT_AROUND_H

#include <stdbool.h>

#include "skyvert/disc.h"
#include "skyvert/night.h"
#include "skyvert/skyvert.h"
#include "skyvert/water.h"

/// Rays that one call of around_add() takes.
#define AROUND_BATCH 1024

typedef struct surroundings {
    int discs;
    skv_disc disc[2];
    bool has_night;
    skv_night night;
    bool has_water;
    skv_water water;
    skv_light light[SKV_LIGHTS_MAX];
    skv_frame at_sea; ///< on the water below, the same lights
    bool far;         ///< the water is seen so far off that lights stand elsewhere there: a frame for each ray
    float through_air[SKV_LIGHTS_MAX][4]; ///< from the water below toward each light
    // Scratch of a batch: rays that meet the water.
    skv_water_hit hit[AROUND_BATCH];
    float toward[AROUND_BATCH][3];
    float seen[AROUND_BATCH * 4], clear[AROUND_BATCH * 4], mirrored[AROUND_BATCH * 4];
} surroundings;

/// The water below a frame: the sky over it is that of `frame`, seen from the water.
/// @param wind_m_s  0: a mirror.
/// @return a skv_status
skv_status around_set_water(surroundings *out, const skv_frame *frame, const skv_table *table, const skv_light *lights,
                            float wind_m_s, float wind_azimuth_deg);

/// Adds everything to what skv_radiance() found for n <= AROUND_BATCH rays, packed, with transmittance.
skv_status around_add(surroundings *around, const skv_frame *frame, size_t n, const float *direction_enu,
                      const skv_sky *sky);

/// The water's part of it (around_sea.c).
skv_status around_add_sea(surroundings *around, const skv_frame *frame, size_t n, const skv_rays *rays,
                          const skv_sky *sky);

#endif
