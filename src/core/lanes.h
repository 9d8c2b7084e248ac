/// Structure-of-arrays blocks: SKV_LANES rays side by side. Loops over lanes are what the compilers vectorise.
#ifndef SKV_CORE_LANES_H
#define SKV_CORE_LANES_H

#include "skyvert/frame.h"

#include "core/elementary.h"

/// A loop over the lanes. Unrolled first it would not be vectorised any more.
#if defined(__clang__)
#define SKV_EACH_LANE(l) _Pragma("clang loop unroll(disable)") for (int l = 0; l < SKV_LANES; l++)
#elif defined(__GNUC__)
#define SKV_EACH_LANE(l) _Pragma("GCC unroll 1") for (int l = 0; l < SKV_LANES; l++)
#else
#define SKV_EACH_LANE(l) for (int l = 0; l < SKV_LANES; l++)
#endif

/// Loops over the kinds of matter, unrolled where that was faster (gcc 12, clang 14) and size does not matter.
#if defined(__clang__) && SKV_SPECIALISE
#define SKV_EACH_SCATTERER(s) _Pragma("clang loop unroll(full)") for (int s = 0; s < SKV_SCATTERERS; s++)
#define SKV_EACH_SPECIES(s)   for (int s = 0; s < SKV_SPECIES; s++)
#elif defined(__GNUC__) && SKV_SPECIALISE
#define SKV_EACH_SCATTERER(s) _Pragma("GCC unroll 4") for (int s = 0; s < SKV_SCATTERERS; s++)
#define SKV_EACH_SPECIES(s)   _Pragma("GCC unroll 4") for (int s = 0; s < SKV_SPECIES; s++)
#else
#define SKV_EACH_SCATTERER(s) for (int s = 0; s < SKV_SCATTERERS; s++)
#define SKV_EACH_SPECIES(s)   for (int s = 0; s < SKV_SPECIES; s++)
#endif

/// A loop over bands or other small numbers, in the same way.
#if defined(__clang__)
#define SKV_EACH_OF(i, n) for (int i = 0; i < (n); i++)
#elif defined(__GNUC__)
#define SKV_EACH_OF(i, n) _Pragma("GCC unroll 1") for (int i = 0; i < (n); i++)
#else
#define SKV_EACH_OF(i, n) for (int i = 0; i < (n); i++)
#endif

/// One value per lane, aligned for the widest vectors in use.
#if defined(__GNUC__)
typedef struct __attribute__((aligned(SKV_LANES >= 8 ? 32 : 4 * SKV_LANES < 16 ? 4 * SKV_LANES : 16))) skv_lanes {
    float v[SKV_LANES];
} skv_lanes;
#else
typedef struct skv_lanes {
    float v[SKV_LANES];
} skv_lanes;
#endif

enum { SKV_RAYLEIGH = 0, SKV_AEROSOL = 1, SKV_DUST = 2, SKV_OZONE = 3 };

/// Columns of the species to the top of the air, km of their unit density.
typedef struct skv_columns {
    skv_lanes of[SKV_SPECIES];
} skv_columns;

/// What a frame needs, as bits: known to the compiler where a kernel is specialised, read from the frame elsewhere.
enum {
    SKV_HAS_RAYLEIGH = 1 << SKV_RAYLEIGH,
    SKV_HAS_AEROSOL = 1 << SKV_AEROSOL,
    SKV_HAS_DUST = 1 << SKV_DUST,
    SKV_HAS_OZONE = 1 << SKV_OZONE,
    SKV_HAS_RATIO = 16,      ///< a column of what scatters is tabulated
    SKV_HAS_BACKGROUND = 32, ///< an exponential has a background
    SKV_HAS_INNER = 64,      ///< depth by inner integration
    SKV_HAS_CUT = 128,       ///< the closed form reaches beyond the top
    SKV_HAS_DOWN = 256,      ///< a light may lie below the horizontal of a sample
    SKV_HAS_FOUR = 512,      ///< four bands
    SKV_HAS_GENERAL = SKV_HAS_RATIO | SKV_HAS_BACKGROUND | SKV_HAS_INNER,
    /// What is compiled in at all.
    SKV_HAS_BUILT = (SKV_TERM_RAYLEIGH ? SKV_HAS_RAYLEIGH : 0) | (SKV_TERM_AEROSOL ? SKV_HAS_AEROSOL : 0) |
                    (SKV_TERM_DUST ? SKV_HAS_DUST : 0) | (SKV_TERM_OZONE ? SKV_HAS_OZONE : 0) |
                    (SKV_PROFILE_TABULATED ? SKV_HAS_RATIO : 0) | SKV_HAS_BACKGROUND |
                    (SKV_DEPTH_INNER ? SKV_HAS_INNER : 0) | (SKV_DEPTH_CHAPMAN ? SKV_HAS_CUT : 0) | SKV_HAS_DOWN |
                    (SKV_BANDS == 3 ? 0 : SKV_HAS_FOUR)
};

#define SKV_PRESENT(has, species) (((has) >> (species)&1u) != 0)

/// Number of bands; a constant where config.h or the kernel fixes it.
#if SKV_BANDS
#define SKV_BANDS_OF(has) ((void)(has), SKV_BANDS)
#else
#define SKV_BANDS_OF(has) (((has)&SKV_HAS_FOUR) != 0 ? 4 : 3)
#endif

SKV_INLINE int skv_bands(const skv_model *model) {
#if SKV_BANDS
    (void)model;
    return SKV_BANDS;
#else
    return model->bands;
#endif
}

/// skv_species.column of a layer.
#define SKV_COLUMN_KNOTS 3

/// Whether a present species is a layer.
SKV_INLINE int skv_is_layer(const skv_frame *frame, unsigned has, int s) {
    return SKV_PROFILE_TABULATED && SKV_PRESENT(has, s) && (has & SKV_HAS_RATIO) != 0 &&
           frame->model->species[s].column == SKV_COLUMN_KNOTS;
}

/// exp2 of what decays: densities, transmittances. Not 0 below 2^-126 but that; x > 0 counts as 0.
SKV_INLINE float skv_decay(const skv_frame_limits *limits, float x) {
    return skv_exp2f_inner(skv_maxf(skv_minf(x, limits->zero), limits->exp2_floor));
}

/// Which config.h selection compiled this code; recorded in models and frames.
#define SKV_LAYOUT                                                                                                     \
    (0x534B5602u ^ ((uint32_t)SKV_BANDS << 24) ^ ((uint32_t)SKV_TERM_OZONE << 23) ^                                    \
     ((uint32_t)SKV_PROFILE_TABULATED << 22) ^ ((uint32_t)SKV_TERM_DUST << 21) ^ ((uint32_t)SKV_LIGHTS_MAX << 16))

#endif
