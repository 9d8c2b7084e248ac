/// Stage 1, once per change: what the planet and its air are (skv_atmosphere, the user's) and what the core derives
/// from it (skv_model). Units: km, 1/km, nm, W m^-2 nm^-1. Altitudes are above the sphere of radius_km ("the sea").
#ifndef SKYVERT_ATMOSPHERE_H
#define SKYVERT_ATMOSPHERE_H

#include <stdint.h>

#include "skyvert/config.h"
#include "skyvert/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/// How the relative density of a species depends on the altitude h. Above top_km every density is 0.
typedef enum skv_profile_kind {
    SKV_PROFILE_NONE = 0,           ///< the species is absent
    SKV_PROFILE_EXPONENTIAL = 1,    ///< exp(-h/scale_height_km)
    SKV_PROFILE_EXP_BACKGROUND = 2, ///< (exp(-h/scale_height_km) + background)/(1 + background); aerosol and dust
    SKV_PROFILE_US76 = 3,           ///< exp(-us76_a h^us76_b), h in km; 1 below 0
    SKV_PROFILE_TENT = 4,           ///< max(0, 1 - |h - peak_km|/half_width_km)
    SKV_PROFILE_LOGNORMAL = 5,      ///< exp(-k (ln h - mu)^2)/h, normalised to 1 at its peak h = exp(mu - 1/(2k))
    SKV_PROFILE_TABLE = 6,          ///< linear between the rows of a table, constant beyond its ends
} skv_profile_kind;

/// Rows of a density table.
#define SKV_TABLE_ROWS_MAX 512

typedef struct skv_profile {
    skv_profile_kind kind;
    float scale_height_km;          ///< [0.001, 1000]; exponential kinds
    float background;               ///< [0, 1]; exponential with background
    float us76_a;                   ///< [1e-6, 10], km^-b
    float us76_b;                   ///< [0.5, 3]
    float peak_km;                  ///< [0, 1000]; tent
    float half_width_km;            ///< [0.01, 1000]; tent
    float lognormal_mu;             ///< [-3, 7]; ln km
    float lognormal_k;              ///< [0.05, 200]
    const float *table_altitude_km; ///< [table_rows], ascending, [-1e4, 1e4]; read by skv_model_build() only
    const float *table_density;     ///< [table_rows], [0, 1e6]; read by skv_model_build() only
    uint32_t table_rows;            ///< [2, SKV_TABLE_ROWS_MAX]
} skv_profile;

typedef enum skv_phase {
    SKV_PHASE_HG = 0, ///< Henyey-Greenstein
    SKV_PHASE_CS = 1, ///< Cornette-Shanks
} skv_phase;

/// User parameters. Fill it with skv_atmosphere_preset() or skv_atmosphere_clear(), then change what you need.
typedef struct skv_atmosphere {
    float radius_km; ///< of the sea-level sphere, [1, 100000]
    float top_km;    ///< altitude of the top of the air, [0.1, 1000] and <= radius_km
    int32_t bands;   ///< 3 or 4

    float wavelength_nm[4];    ///< [200, 3000], ascending
    float solar_irradiance[4]; ///< at the planet, W m^-2 nm^-1, [0, 1e6]; radiance scales with it
    float albedo[4];           ///< of the ground (Lambert), [0, 1]

    float rayleigh_scattering_per_km[4]; ///< at altitude 0, [0, 1e4]
    float rayleigh_absorption_per_km[4]; ///< of the gas beside that (methane), at altitude 0, [0, 1e4]
    skv_profile rayleigh;

    float aerosol_scattering_per_km[4]; ///< at altitude 0, [0, 1e4]
    float aerosol_extinction_per_km[4]; ///< at altitude 0, [aerosol_scattering_per_km, 1e4]
    skv_profile aerosol;
    skv_phase aerosol_phase;
    float aerosol_g; ///< parameter of the phase function (Henyey-Greenstein: its mean cosine), [-0.9999, 0.9999]
    float turbidity; ///< multiplies scattering and extinction of aerosol and dust, [0, 1e4]; 1 = as given [Keller08]

    /// A second layer (dust, smoke), with a phase function and a profile of its own.
    float dust_scattering_per_km[4]; ///< at density 1, [0, 1e4]
    float dust_extinction_per_km[4]; ///< at density 1, [dust_scattering_per_km, 1e4]
    skv_profile dust;
    skv_phase dust_phase;
    float dust_g; ///< as aerosol_g

    float ozone_absorption_per_km[4]; ///< at density 1, [0, 1e4]
    skv_profile ozone;

    /// Constant absorption colour [Keller08]: the share of light, per band, that is left after absorption which is not
    /// modelled as a species; multiplies radiance only, [1e-6, 1]; 1 = none.
    float absorption_colour[4];
} skv_atmosphere;

typedef enum skv_preset {
    SKV_PRESET_EARTH_CLEAR = 0,
    SKV_PRESET_EARTH_HAZY = 1,
    SKV_PRESET_MARS = 2,
    SKV_PRESET_TINY = 3,
    SKV_PRESET_GIANT = 4,
    SKV_PRESET_EARTH_THIN = 5,  ///< the clear Earth with a fifth of its air, aerosol and ozone [Elek09]
    SKV_PRESET_EARTH_DENSE = 6, ///< five times as much
    SKV_PRESET_EARTH_X25 = 7,   ///< 25 times
    SKV_PRESET_TITAN = 8,
    SKV_PRESET_EARTH_SMOKE = 9, ///< the clear Earth under a layer of smoke
    SKV_PRESET_COUNT = 10
} skv_preset;

/// An atmosphere without any species: Earth's radius, top at 60 km, given bands, everything else 0 or neutral.
/// @param[out] atmosphere
/// @param[in]  bands  3 (450, 535, 610 nm) or 4 (445, 520, 570, 630 nm).
/// @return SKV_OK; SKV_ERR_NULL iff atmosphere is NULL; SKV_ERR_RANGE iff bands is not 3 or 4.
skv_status skv_atmosphere_clear(skv_atmosphere *atmosphere, int32_t bands);

/// A named planet; where its figures come from stands in README "Sources" and in tools/fit/presets.py. Titan's profiles
/// point at tables of the library.
/// @return as skv_atmosphere_clear(); SKV_ERR_UNSUPPORTED iff there is no such preset.
skv_status skv_atmosphere_preset(skv_atmosphere *atmosphere, skv_preset preset, int32_t bands);

/// Kinds of matter, in this order: Rayleigh (the gas), aerosol, dust, ozone. The first SKV_SCATTERERS scatter.
#define SKV_SPECIES    4
#define SKV_SCATTERERS 3

/// Size of a tabulated column: rows over altitude, columns over the ray's elevation, and the columns of tangent rays.
#define SKV_COLUMN_ROWS     48
#define SKV_COLUMN_COLS     8
#define SKV_COLUMN_TANGENTS 64
/// Rows of a tabulated density.
#define SKV_DENSITY_ROWS 192
/// Most altitudes between which a layer's density is linear: tents, tables of up to SKV_KNOTS_MAX - 2 rows.
#define SKV_KNOTS_MAX 16
/// Most corners of densities that are taken care of.
#define SKV_MODEL_BREAKS 12

/// Derived: how one species' density and column are found (src/core/profile.h, column.h).
typedef struct skv_species {
    int32_t kind;          ///< skv_profile_kind; NONE where nothing of it scatters or absorbs
    int32_t column;        ///< 0 closed form; 1 table of ratios to it; 2 table of ratios to 1/(1 + 14 mu); 3 knots
    int32_t knots;         ///< of a layer (src/core/knots.h), which lie in its column's table
    float scale_height_km; ///< of the closed form
    float inv_scale_log2e; ///< log2(e)/scale_height_km
    float background;      ///< constant density beside exp(-h/H)
    float p0, p1, p2;      ///< parameters of the other densities
} skv_species;

/// Derived: a tabulated column (src/core/column_table.h).
typedef struct skv_column_table {
    float column[SKV_COLUMN_ROWS * SKV_COLUMN_COLS];
    float tangent[SKV_COLUMN_TANGENTS];
} skv_column_table;

/// Derived from an atmosphere; the caller's memory, constant after skv_model_build(), may be shared by any number of
/// threads and copied freely (it holds no pointers).
typedef struct skv_model {
    uint32_t layout; ///< which config.h selection built it
    uint32_t hash;   ///< of what scattering depends on: planet, albedo, species; not of the light
    int32_t bands;
    float radius_km;
    float top_km;
    float wavelength_nm[4];
    float solar_irradiance[4];
    float albedo[4];
    float absorption_colour[4];
    /// Per unit of the relative densities of `species`:
    float scattering_per_km[SKV_SCATTERERS][4];
    float extinction_per_km[SKV_SPECIES][4]; ///< ozone: absorption
    skv_species species[SKV_SPECIES];
    int32_t breaks; ///< altitudes where a scattering density has a corner: legs are cut there
    float break_km[SKV_MODEL_BREAKS];
    int32_t phase[SKV_SCATTERERS]; ///< skv_phase; Rayleigh's is not read
    float g[SKV_SCATTERERS];
    int32_t chapman_valid; ///< 0: a scale height is over 1/100 of the radius; depth is integrated instead
#if SKV_TERM_OZONE
    skv_column_table ozone_column;
    float ozone_density[SKV_DENSITY_ROWS]; ///< TABLE only
#endif
#if SKV_PROFILE_TABULATED
    skv_column_table column[2 + SKV_TERM_DUST];         ///< Rayleigh, aerosol, dust
    float density[2 + SKV_TERM_DUST][SKV_DENSITY_ROWS]; ///< TABLE only
#endif
} skv_model;

/// Checks an atmosphere and derives the model.
/// @param[out] model       the caller's, sizeof(skv_model) bytes.
/// @param[in]  atmosphere  may be discarded afterwards, tables included.
/// @return SKV_OK; SKV_ERR_NULL iff a pointer is NULL (a table's too); SKV_ERR_RANGE iff a field is outside the range
/// at
///         its declaration, infinite or NaN; SKV_ERR_UNSUPPORTED iff a term, profile, phase or number of bands was left
///         out at compile time. On error the model is not written.
/// Cost:   some 1e6 instructions where a column is tabulated (ozone), else some hundred. No allocation. Thread-safe.
skv_status skv_model_build(skv_model *model, const skv_atmosphere *atmosphere);

#ifdef __cplusplus
}
#endif
#endif
