/// `skyvert bake`: tables for engines that want textures, and model and table for a microcontroller as C.
#ifndef SKYVERT_BAKE_H
#define SKYVERT_BAKE_H

#include "all_orders.h"
#include "command.h"
#include "moment.h"
#include "sky_options.h"

#include "port/bake/skv_bake.h"

enum { BAKE_MODEL = 4 }; ///< behind the four kinds of skv_bake.h
typedef enum bake_format { BAKE_EXR, BAKE_RAW16F, BAKE_C } bake_format;

/// Axes that a table may have.
enum { AXIS_ROWS, AXIS_AZIMUTHS, AXIS_SUNS, AXIS_ALTITUDES, AXES };

typedef struct bake_options {
    sky_options sky;
    moment_options when;
    moment now; ///< sky-view: where the observer and the sun are
    int what;   ///< SKV_BAKE_*, BAKE_MODEL
    int format; ///< bake_format
    int size[AXES];
    bool half, rgb, deferred;
    double sun_lowest_deg;
    const char *name;   ///< prefix in C
    const char *output; ///< file
} bake_options;

extern const char *const bake_what_names[];

/// What texels are computed from.
typedef struct bake_air {
    const bake_options *options;
    skv_model model;
    int deferred;                          ///< kinds of matter whose phase function is left to the sampler
    skv_model bare[SKV_BAKE_DEFERRED_MAX]; ///< the same, but one of these only absorbs: all light but what it scatters
    int32_t phase[SKV_BAKE_DEFERRED_MAX];  ///< as in skv_bake_table
    float g[SKV_BAKE_DEFERRED_MAX];
    const char *deferred_name[SKV_BAKE_DEFERRED_MAX];
    all_orders orders;    ///< its table NULL: single scattering
    float ground_km;      ///< above the sea
    float sun_scale;      ///< of the irradiance: the sun's distance
    uint64_t evaluations; ///< rays so far
} bake_air;

/// Builds models and table. @return 0, or a status after an error line; bake_air_end() in any case.
int bake_air_begin(bake_air *air, const bake_options *options);
void bake_air_end(bake_air *air);

/// The rays of one observer under one sun.
typedef struct bake_rays {
    float altitude_km; ///< above the ground
    float sun_enu[3];
    size_t n;
    const float *direction_enu; ///< [n][3]
} bake_rays;

/// Radiance, what each deferred kind of matter scatters once over its phase function ([air->deferred], NULL: all in
/// radiance), transmittance (NULL: not wanted), each [n][4] bands. @return false iff the core refused (a defect) or
/// there is no memory.
bool bake_light(bake_air *air, const bake_rays *rays, float *radiance, float *const once[], float *transmittance);

/// Irradiance of horizontal surfaces and of one that faces the sun (SKV_BAKE_DOWN, _UP, _BEAM).
bool bake_irradiance(bake_air *air, float altitude_km, const float sun_enu[3], float out[3][4]);

/// A table with its texels in W m^-2 sr^-1 nm^-1 (radiance), W m^-2 nm^-1 (irradiance), 1 (transmittance).
typedef struct bake_texture {
    skv_bake_table map;
    float *texels; ///< [layer][z][y][x][channel], times map.scale
    const char *layer_name[SKV_BAKE_LAYERS_MAX];
    char text[6144]; ///< sizes and mapping, for programs and people: "skyvert-bake 1" to "end"
} bake_texture;

/// Computes a texture, shows progress. @return 0, or a status after an error line; free texels in any case.
int bake_texture_make(bake_texture *texture, bake_air *air);
/// Fills in texture->text; data_offset as it stands there.
void bake_texture_describe(bake_texture *texture, const bake_air *air, int data_offset);

/// IEEE 754 binary16, to nearest even; beyond +-65504: that; NaN: 0.
uint16_t bake_half(float x);

/// The writers. @return 0, or a status after an error line.
int bake_write_exr(const bake_texture *texture, const bake_options *options, output *out);
int bake_write_raw16f(bake_texture *texture, const bake_air *air, output *out);
int bake_write_c(const bake_texture *texture, const bake_options *options, output *out);
int bake_write_model(const bake_air *air, output *out);

#endif
