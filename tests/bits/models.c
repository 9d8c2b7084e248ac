/// Every preset, number of bands and kind of profile: what skv_model_build() derives.
#include "bits.h"

#include <string.h>

#include "skyvert/skyvert.h"

/// All words of the struct: it has floats and 32-bit integers only, so each reads as a float.
static void hash_model(const skv_model *model) {
    const unsigned char *const byte = (const unsigned char *)model;
    for (size_t i = 0; i < sizeof *model; i += sizeof(float)) {
        float value;
        memcpy(&value, byte + i, sizeof value);
        bits_float(value, BITS_ANY); // what an absent species has is not used
    }
}

static void set_profile(skv_profile *profile, skv_profile_kind kind) {
    static const float altitude[4] = {0.0f, 3.0f, 11.0f, 40.0f}, density[4] = {1.0f, 0.5f, 0.125f, 0.0f};
    profile->kind = kind;
    profile->scale_height_km = 2.5f;
    profile->background = 0.01f;
    profile->us76_a = 0.07771971f;
    profile->us76_b = 1.16364243f;
    profile->peak_km = 25.0f;
    profile->half_width_km = 15.0f;
    profile->lognormal_mu = 3.22261f;
    profile->lognormal_k = 5.55555555f;
    profile->table_altitude_km = altitude;
    profile->table_density = density;
    profile->table_rows = 4;
}

static void build(const skv_atmosphere *air) {
    memset(&bits_model, 0, sizeof bits_model);
    const skv_status status = skv_model_build(&bits_model, air);
    bits_word((uint32_t)status);
    if (status == SKV_OK)
        hash_model(&bits_model);
}

void bits_models(bits_scale scale) {
    bits_begin(scale == BITS_SMALL ? "small" : "full", "model");
    for (int preset = 0; preset < SKV_PRESET_COUNT; ++preset) {
        for (int bands = 3; bands <= 4; ++bands) {
            skv_atmosphere air;
            bits_word((uint32_t)skv_atmosphere_preset(&air, (skv_preset)preset, bands));
            if (scale == BITS_FULL || bands == 4)
                build(&air);
        }
    }
    const int kinds = scale == BITS_FULL ? SKV_PROFILE_TABLE : 0;
    for (int kind = SKV_PROFILE_NONE; kind <= kinds; ++kind) {
        for (int species = 0; species < SKV_SPECIES; ++species) {
            skv_atmosphere air;
            skv_atmosphere_preset(&air, SKV_PRESET_EARTH_CLEAR, 4);
            skv_profile *const profile[SKV_SPECIES] = {&air.rayleigh, &air.aerosol, &air.dust, &air.ozone};
            air.dust_scattering_per_km[0] = air.dust_extinction_per_km[0] = 0.01f;
            set_profile(profile[species], (skv_profile_kind)kind);
            build(&air);
        }
    }
    bits_end();
}
