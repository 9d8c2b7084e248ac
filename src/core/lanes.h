/// Structure-of-arrays blocks: SKV_LANES rays side by side. Loops over lanes are what the compilers vectorise.
#ifndef SKV_CORE_LANES_H
#define SKV_CORE_LANES_H

#include "skyvert/frame.h"

#include "core/elementary.h"

#define SKV_EACH_LANE(l) for (int l = 0; l < SKV_LANES; l++)

/// One value per lane, aligned for the widest vectors in use.
#if defined(__GNUC__)
typedef struct __attribute__((aligned(SKV_LANES >= 8 ? 32 : 4 * SKV_LANES < 16 ? 4 * SKV_LANES : 16))) skv_lanes {
    float v[SKV_LANES];
} skv_lanes;
#define SKV_INLINE static inline __attribute__((always_inline))
#else
typedef struct skv_lanes {
    float v[SKV_LANES];
} skv_lanes;
#define SKV_INLINE static inline
#endif

enum { SKV_RAYLEIGH = 0, SKV_AEROSOL = 1, SKV_OZONE = 2, SKV_SPECIES = 3 };

/// Columns of the species to the top of the air, km of their unit density.
typedef struct skv_columns {
    skv_lanes of[SKV_SPECIES];
} skv_columns;

/// Whether a species is there: compiled in, in the model, switched on.
SKV_INLINE int skv_present(const skv_frame *frame, int species) {
    const int built = species == SKV_RAYLEIGH  ? SKV_TERM_RAYLEIGH
                      : species == SKV_AEROSOL ? SKV_TERM_AEROSOL
                                               : SKV_TERM_OZONE;
    return built && frame->species[species].kind != SKV_PROFILE_NONE;
}

/// Number of bands; a constant where config.h fixes it.
SKV_INLINE int skv_bands(const skv_model *model) {
#if SKV_BANDS
    (void)model;
    return SKV_BANDS;
#else
    return model->bands;
#endif
}

/// Which config.h selection compiled this code; recorded in models and frames.
#define SKV_LAYOUT                                                                                                     \
    (0x534B5601u ^ ((uint32_t)SKV_BANDS << 24) ^ ((uint32_t)SKV_TERM_OZONE << 23) ^                                   \
     ((uint32_t)SKV_PROFILE_TABULATED << 22) ^ ((uint32_t)SKV_LIGHTS_MAX << 16))

#endif
