/// Named atmospheres. The figures are presets_data.h's, written by tools/fit/presets.py, where each one's source
/// stands.
#include "skyvert/atmosphere.h"

#include <stddef.h>

typedef struct skv_preset_row {
    float radius_km, top_km, sun, rayleigh_height_km, aerosol_height_km, g, ozone_peak_km, ozone_half_width_km;
    skv_phase phase;
    float albedo[7], rayleigh[7], absorption[7], aerosol_scattering[7], aerosol_extinction[7], ozone[7];
} skv_preset_row;

typedef struct skv_preset_layer {
    float height_km, half_width_km, g; ///< of a tent, else half width 0 and the scale height
    skv_phase phase;
    float scattering[7], extinction[7];
} skv_preset_layer;

#include "core/presets_data.h"

/// Columns of the table for 3 or 4 bands.
static const float *skv_columns(const float table[7], int32_t bands) {
    return bands == 3 ? table : table + 3;
}

static void skv_fill(float to[4], const float table[7], int32_t bands, float factor) {
    const float *from = skv_columns(table, bands);
    for (int32_t i = 0; i < 4; ++i)
        to[i] = i < bands ? from[i] * factor : 0.0f;
}

static void skv_clear(skv_atmosphere *a, int32_t bands) {
    *a = (skv_atmosphere){.radius_km = 6371.0f, .top_km = 60.0f, .bands = bands, .turbidity = 1.0f};
    skv_fill(a->wavelength_nm, skv_preset_nm, bands, 1.0f);
    skv_fill(a->solar_irradiance, skv_preset_solar, bands, 1.0f);
    for (int32_t i = 0; i < 4; ++i)
        a->absorption_colour[i] = 1.0f;
}

static skv_profile skv_exponential(float height_km) {
    return (skv_profile){.kind = height_km > 0.0f ? SKV_PROFILE_EXPONENTIAL : SKV_PROFILE_NONE,
                         .scale_height_km = height_km};
}

static skv_profile skv_tent(float peak_km, float half_width_km) {
    return (skv_profile){.kind = half_width_km > 0.0f ? SKV_PROFILE_TENT : SKV_PROFILE_NONE,
                         .peak_km = peak_km,
                         .half_width_km = half_width_km};
}

static skv_profile skv_tabulated(const float *altitude_km, const float *density, uint32_t rows) {
    return (skv_profile){
        .kind = SKV_PROFILE_TABLE, .table_altitude_km = altitude_km, .table_density = density, .table_rows = rows};
}

/// A row with every length multiplied by `scale` (coefficients per length divided by it), the air `dense` times as
/// dense.
static void skv_from_row(skv_atmosphere *a, const skv_preset_row *row, float scale, float dense) {
    const int32_t bands = a->bands;
    const float per_km = dense / scale;
    a->radius_km = row->radius_km * scale;
    a->top_km = row->top_km * scale;
    skv_fill(a->solar_irradiance, skv_preset_solar, bands, row->sun);
    skv_fill(a->albedo, row->albedo, bands, 1.0f);
    skv_fill(a->rayleigh_scattering_per_km, row->rayleigh, bands, per_km);
    skv_fill(a->rayleigh_absorption_per_km, row->absorption, bands, per_km);
    a->rayleigh = skv_exponential(row->rayleigh_height_km * scale);
    skv_fill(a->aerosol_scattering_per_km, row->aerosol_scattering, bands, per_km);
    skv_fill(a->aerosol_extinction_per_km, row->aerosol_extinction, bands, per_km);
    a->aerosol = skv_exponential(row->aerosol_height_km * scale);
    a->aerosol_phase = row->phase;
    a->aerosol_g = row->g;
    skv_fill(a->ozone_absorption_per_km, row->ozone, bands, per_km);
    a->ozone = skv_tent(row->ozone_peak_km * scale, row->ozone_half_width_km * scale);
}

static void skv_add_dust(skv_atmosphere *a, const skv_preset_layer *layer) {
    skv_fill(a->dust_scattering_per_km, layer->scattering, a->bands, 1.0f);
    skv_fill(a->dust_extinction_per_km, layer->extinction, a->bands, 1.0f);
    a->dust = layer->half_width_km > 0.0f ? skv_tent(layer->height_km, layer->half_width_km)
                                          : skv_exponential(layer->height_km);
    a->dust_phase = layer->phase;
    a->dust_g = layer->g;
}

skv_status skv_atmosphere_clear(skv_atmosphere *atmosphere, int32_t bands) {
    if (atmosphere == NULL)
        return SKV_ERR_NULL;
    if (bands != 3 && bands != 4)
        return SKV_ERR_RANGE;
    skv_clear(atmosphere, bands);
    return SKV_OK;
}

skv_status skv_atmosphere_preset(skv_atmosphere *atmosphere, skv_preset preset, int32_t bands) {
    /// The row; how dense its air is; its top where that is not the row's: there the thicker air is as thin.
    static const struct {
        unsigned char row, layer; // 0: no layer
        float dense, top_km;
    } made[SKV_PRESET_COUNT] = {{0, 0, 1.0f, 0.0f}, {1, 0, 1.0f, 0.0f}, {2, 1, 1.0f, 0.0f},  {0, 0, 1.0f, 0.0f},
                                {3, 0, 1.0f, 0.0f}, {0, 0, 0.2f, 0.0f}, {0, 0, 5.0f, 75.0f}, {0, 0, 25.0f, 90.0f},
                                {4, 2, 1.0f, 0.0f}, {0, 3, 1.0f, 0.0f}};
    if (atmosphere == NULL)
        return SKV_ERR_NULL;
    if (bands != 3 && bands != 4)
        return SKV_ERR_RANGE;
    const unsigned which = (unsigned)preset;
    if (which >= SKV_PRESET_COUNT)
        return SKV_ERR_UNSUPPORTED;
    skv_clear(atmosphere, bands);
    skv_from_row(atmosphere, &skv_preset_rows[made[which].row],
                 preset == SKV_PRESET_TINY ? 1.0f / SKV_TINY_SCALE : 1.0f, made[which].dense);
    if (made[which].top_km > 0.0f)
        atmosphere->top_km = made[which].top_km;
    if (made[which].layer > 0)
        skv_add_dust(atmosphere, &skv_preset_layers[made[which].layer - 1]);
    if (preset == SKV_PRESET_TITAN) {
        atmosphere->aerosol = skv_tabulated(skv_titan_high_km, skv_titan_high_density,
                                            sizeof skv_titan_high_km / sizeof *skv_titan_high_km);
        atmosphere->dust =
            skv_tabulated(skv_titan_low_km, skv_titan_low_density, sizeof skv_titan_low_km / sizeof *skv_titan_low_km);
    }
    return SKV_OK;
}
