/// The sky of a moment by the core: the air and its table, the dome, the frame, colours.
///
/// Two airs: one is in use while the other one's table is built in steps; they change places when it is done.
#ifndef COCKPIT_SKY_H
#define COCKPIT_SKY_H

#include <stdbool.h>

#include "cockpit_state.h"
#include "vertices.h"

typedef struct cockpit_air {
    skv_model model;
    uint32_t table[2048]; ///< 8192 bytes: enough for the accurate kind
    double visibility_km;
    bool has_model, has_table;
} cockpit_air;

typedef struct cockpit_sky {
    // Set once.
    skv_preset preset;
    int bands;
    skv_tier tier;
    skv_dome dome;
    uint32_t vertices, indices;
    skv_colour_matrix matrix;
    float *radiance, *transmittance; ///< [vertices][bands]
    // The air.
    cockpit_air air[2];
    int current; ///< of air[]
    bool building;
    skv_table_builder builder;
    void *work;
    size_t work_bytes;
    uint32_t builds; ///< tables finished
    // Of the last frame.
    skv_frame frame;
    float *grid;
    size_t grid_bytes;
    bool has_grid;
    double distance_au;
    bool night;             ///< its floor is added
    double exposure;        ///< k of 1 - exp(-k rgb), follows slowly
    double zenith_cd_m2;    ///< luminance of the zenith
    skv_vertex *vertex;     ///< [vertices]
    skv_vertices_moment at; ///< what of it the sky knows
    int level;              ///< of cockpit_sky_cheaper()
} cockpit_sky;

typedef struct cockpit_sky_options {
    skv_preset preset;
    int bands; ///< 3 or 4
    skv_tier tier;
    uint32_t vertices; ///< at most so many
    double visibility_km;
} cockpit_sky_options;

/// Chooses a dome of at most this many vertices, [64, 65536].
void cockpit_dome_for(skv_dome *dome, uint32_t vertices);

/// @return 0; 1 iff there is no memory (nothing has to be freed then).
int cockpit_sky_begin(cockpit_sky *sky, const cockpit_sky_options *options);
void cockpit_sky_end(cockpit_sky *sky);

/// Indices of the dome's triangles. @param[out] indices  [sky->indices]
void cockpit_sky_indices(const cockpit_sky *sky, uint32_t *indices);

/// Goes on with the air: begins a new one where the visibility wanted has changed by over 2 %, and works at its table
/// for up to `budget_ns` of processor time. A bit of it is always done.
void cockpit_sky_build(cockpit_sky *sky, double visibility_km, int64_t budget_ns);

/// Evaluates the dome into sky->vertex and sky->at (but for times and flags of the bus).
/// @param[in] seconds  since the last one: how far the exposure follows.
/// @return false iff the core refused (a defect): the last frame stands.
bool cockpit_sky_frame(cockpit_sky *sky, const cockpit_now *now, double seconds);

/// Linear RGB towards n directions in the air of the last frame.
/// @param[in] disc    draw the sun's disc, for samples of this angle, rad; 0: none.
/// @param[in] work    [n][2*bands] floats.
bool cockpit_sky_look(const cockpit_sky *sky, size_t n, const float *direction_enu, float *work, float *rgb,
                      float disc_rad);

/// Extinction at 550 nm that goes with a visibility, and back: 3.912/V [Koschmieder24].
#define COCKPIT_KOSCHMIEDER 3.912

#endif
