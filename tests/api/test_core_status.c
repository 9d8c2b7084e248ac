/// Every status of the core's calls: each pointer, each range from both sides, NaN and the infinities; on error nothing
/// is written; a refused ray leaves all others as they are.
#include <float.h>

#include "core_air.h"

#define COUNT(a) ((int)(sizeof(a) / sizeof((a)[0])))
#define GUARD    0xa5

static skv_model model, written;

static int build_model(void **state) {
    (void)state;
    const skv_atmosphere a = air_br17o();
    build(&model, &a);
    return 0;
}

static void check_untouched(const char *what, const void *memory, size_t bytes) {
    for (size_t i = 0; i < bytes; i++)
        if (((const unsigned char *)memory)[i] != GUARD)
            fail_msg("%s: byte %d of %d was written", what, (int)i, (int)bytes);
}

static void check_build(const char *what, double value, const skv_atmosphere *a, skv_status want) {
    memset(&written, GUARD, sizeof written);
    const skv_status got = skv_model_build(&written, a);
    if (got != want)
        fail_msg("skv_model_build, %s = %.9g: got status %d, want %d", what, value, (int)got, (int)want);
    if (want != SKV_OK)
        check_untouched(what, &written, sizeof written);
}

/// Past a bound by the smallest step.
static float above(float x) {
    return nextafterf(x, INFINITY);
}

static float below(float x) {
    return nextafterf(x, -INFINITY);
}

/// A float of skv_atmosphere. The bounds themselves are inside unless they are open.
typedef struct field {
    const char *name;
    size_t offset;
    int elements;
    float lo, hi;
} field;

#define AT(name) #name, offsetof(skv_atmosphere, name)
static const field fields[] = {
    {AT(albedo), 4, 0, 1},
    {AT(solar_irradiance), 4, 0, 1e6f},
    {AT(rayleigh_scattering_per_km), 4, 0, 1e4f},
    {AT(rayleigh_absorption_per_km), 4, 0, 1e4f},
    {AT(aerosol_g), 1, -0.9999f, 0.9999f},
    {AT(dust_g), 1, -0.9999f, 0.9999f},
    {AT(turbidity), 1, 0, 1e4f},
    {AT(ozone_absorption_per_km), 4, 0, 1e4f},
    {AT(rayleigh.scale_height_km), 1, 0.001f, 1000},
    {AT(aerosol.scale_height_km), 1, 0.001f, 1000},
    {AT(dust.scale_height_km), 1, 0.001f, 1000},
    {AT(ozone.peak_km), 1, 0, 1000},
    {AT(ozone.half_width_km), 1, 0.01f, 1000},
};

static void check_float(skv_atmosphere a, const char *name, size_t offset, float value, skv_status want) {
    memcpy((char *)&a + offset, &value, sizeof value);
    check_build(name, (double)value, &a, want);
}

static void check_never(const skv_atmosphere *a, const char *name, size_t offset) {
    check_float(*a, name, offset, NAN, SKV_ERR_RANGE);
    check_float(*a, name, offset, INFINITY, SKV_ERR_RANGE);
    check_float(*a, name, offset, -INFINITY, SKV_ERR_RANGE);
}

static void check_field(const skv_atmosphere *a, const field *f) {
    for (int i = 0; i < f->elements; i++) {
        const size_t at = f->offset + (size_t)i * sizeof(float);
        check_float(*a, f->name, at, f->lo, SKV_OK);
        check_float(*a, f->name, at, f->hi, SKV_OK);
        check_float(*a, f->name, at, below(f->lo), SKV_ERR_RANGE);
        check_float(*a, f->name, at, above(f->hi), SKV_ERR_RANGE);
        check_never(a, f->name, at);
    }
}

static void atmosphere_pointers(void **state) {
    (void)state;
    const skv_atmosphere a = air_br17o();
    memset(&written, GUARD, sizeof written);
    check_status("no model", skv_model_build(NULL, &a), SKV_ERR_NULL);
    check_status("no atmosphere", skv_model_build(&written, NULL), SKV_ERR_NULL);
    check_untouched("no atmosphere", &written, sizeof written);
}

static void atmosphere_fields(void **state) {
    (void)state;
    const skv_atmosphere a = air_smoky();
    for (int i = 0; i < COUNT(fields); i++)
        check_field(&a, &fields[i]);
}

/// Ranges that depend on another field, and open ones.
static void atmosphere_fields_that_depend(void **state) {
    (void)state;
    const skv_atmosphere plain = air_smoky();
    skv_atmosphere a = plain;
    check_never(&a, AT(radius_km));
    check_never(&a, AT(top_km));
    check_float(a, AT(radius_km), 60, SKV_OK);
    check_float(a, AT(radius_km), below(60), SKV_ERR_RANGE);
    check_float(a, AT(radius_km), 1e5f, SKV_OK);
    check_float(a, AT(radius_km), above(1e5f), SKV_ERR_RANGE);
    check_float(a, AT(top_km), 0.1f, SKV_OK);
    check_float(a, AT(top_km), below(0.1f), SKV_ERR_RANGE);
    check_float(a, AT(top_km), 1000, SKV_OK);
    check_float(a, AT(top_km), above(1000), SKV_ERR_RANGE);
    a.top_km = 0.5f;
    check_float(a, AT(radius_km), 1, SKV_OK);
    check_float(a, AT(radius_km), below(1), SKV_ERR_RANGE);
    a = plain;
    for (int b = 0; b < 4; b++) {
        const size_t at = (size_t)b * sizeof(float);
        const size_t nm = offsetof(skv_atmosphere, wavelength_nm) + at;
        const size_t scattering = offsetof(skv_atmosphere, aerosol_scattering_per_km) + at;
        const size_t extinction = offsetof(skv_atmosphere, aerosol_extinction_per_km) + at;
        const size_t dust_scattering = offsetof(skv_atmosphere, dust_scattering_per_km) + at;
        const size_t dust_extinction = offsetof(skv_atmosphere, dust_extinction_per_km) + at;
        const size_t colour = offsetof(skv_atmosphere, absorption_colour) + at;
        check_never(&a, "wavelength_nm", nm);
        check_never(&a, "aerosol_scattering_per_km", scattering);
        check_never(&a, "aerosol_extinction_per_km", extinction);
        check_never(&a, "absorption_colour", colour);
        check_float(a, "aerosol_scattering_per_km", scattering, 0, SKV_OK);
        check_float(a, "aerosol_scattering_per_km", scattering, -FLT_MIN, SKV_ERR_RANGE);
        check_float(a, "aerosol_scattering_per_km", scattering, a.aerosol_extinction_per_km[b], SKV_OK);
        check_float(a, "aerosol_scattering_per_km", scattering, above(a.aerosol_extinction_per_km[b]), SKV_ERR_RANGE);
        check_float(a, "aerosol_extinction_per_km", extinction, 1e4f, SKV_OK);
        check_float(a, "aerosol_extinction_per_km", extinction, above(1e4f), SKV_ERR_RANGE);
        check_never(&a, "dust_scattering_per_km", dust_scattering);
        check_never(&a, "dust_extinction_per_km", dust_extinction);
        check_float(a, "dust_scattering_per_km", dust_scattering, 0, SKV_OK);
        check_float(a, "dust_scattering_per_km", dust_scattering, -FLT_MIN, SKV_ERR_RANGE);
        check_float(a, "dust_scattering_per_km", dust_scattering, above(a.dust_extinction_per_km[b]), SKV_ERR_RANGE);
        check_float(a, "dust_extinction_per_km", dust_extinction, 1e4f, SKV_OK);
        check_float(a, "dust_extinction_per_km", dust_extinction, above(1e4f), SKV_ERR_RANGE);
        check_float(a, "absorption_colour", colour, 1, SKV_OK);
        check_float(a, "absorption_colour", colour, above(1), SKV_ERR_RANGE);
        check_float(a, "absorption_colour", colour, 0, SKV_ERR_RANGE);
        check_float(a, "absorption_colour", colour, -1, SKV_ERR_RANGE);
        if (b > 0) {
            check_float(a, "wavelength_nm", nm, a.wavelength_nm[b - 1], SKV_ERR_RANGE);
            check_float(a, "wavelength_nm", nm, above(a.wavelength_nm[b - 1]), SKV_OK);
        }
    }
    check_float(a, AT(wavelength_nm), 200, SKV_OK);
    check_float(a, AT(wavelength_nm), below(200), SKV_ERR_RANGE);
    check_float(a, AT(wavelength_nm[3]), 3000, SKV_OK);
    check_float(a, AT(wavelength_nm[3]), above(3000), SKV_ERR_RANGE);
}

static skv_profile *profile_of(skv_atmosphere *a, int species) {
    skv_profile *const all[SKV_SPECIES] = {&a->rayleigh, &a->aerosol, &a->dust, &a->ozone};
    return all[species];
}

static void atmosphere_choices(void **state) {
    (void)state;
    static const int32_t bad_bands[] = {0, 1, 2, 5, -3, INT32_MAX, INT32_MIN};
    skv_atmosphere a = air_br17o();
    for (int i = 0; i < COUNT(bad_bands); i++) {
        a.bands = bad_bands[i];
        check_build("bands", (double)a.bands, &a, SKV_ERR_RANGE);
    }
    a = air_br17o();
    a.aerosol_phase = SKV_PHASE_HG;
    check_build("aerosol_phase", SKV_PHASE_HG, &a, SKV_OK);
    a.aerosol_phase = (skv_phase)2;
    check_build("aerosol_phase", 2, &a, SKV_ERR_RANGE);
    a = air_smoky();
    a.dust_phase = (skv_phase)-1;
    check_build("dust_phase", -1, &a, SKV_ERR_RANGE);
    for (int s = 0; s < SKV_SPECIES; s++) {
        a = air_br17o();
        profile_of(&a, s)->kind = (skv_profile_kind)7;
        check_build("profile.kind", 7, &a, SKV_ERR_RANGE);
    }
    // Of three bands the fourth is nobody's business.
    a = air_br17o();
    a.bands = 3;
    a.wavelength_nm[3] = a.albedo[3] = a.rayleigh_scattering_per_km[3] = a.absorption_colour[3] = NAN;
    a.aerosol_scattering_per_km[3] = a.aerosol_extinction_per_km[3] = a.ozone_absorption_per_km[3] = NAN;
    a.dust_scattering_per_km[3] = a.dust_extinction_per_km[3] = a.rayleigh_absorption_per_km[3] = NAN;
    check_build("fourth of three bands", 0, &a, SKV_OK);
}

/// The parameters of each kind of profile, for each species that may have it.
static void profiles(void **state) {
    (void)state;
    static const struct {
        skv_profile_kind kind;
        const char *name;
        size_t offset;
        float lo, hi;
    } parameters[] = {
        {SKV_PROFILE_EXPONENTIAL, "scale_height_km", offsetof(skv_profile, scale_height_km), 0.001f, 1000},
        {SKV_PROFILE_EXP_BACKGROUND, "scale_height_km", offsetof(skv_profile, scale_height_km), 0.001f, 1000},
        {SKV_PROFILE_EXP_BACKGROUND, "background", offsetof(skv_profile, background), 0, 1},
        {SKV_PROFILE_US76, "us76_a", offsetof(skv_profile, us76_a), 1e-3f, 10},
        {SKV_PROFILE_US76, "us76_b", offsetof(skv_profile, us76_b), 0.5f, 3},
        {SKV_PROFILE_TENT, "peak_km", offsetof(skv_profile, peak_km), 0, 1000},
        {SKV_PROFILE_TENT, "half_width_km", offsetof(skv_profile, half_width_km), 0.01f, 1000},
        {SKV_PROFILE_LOGNORMAL, "lognormal_mu", offsetof(skv_profile, lognormal_mu), -3, 7},
        {SKV_PROFILE_LOGNORMAL, "lognormal_k", offsetof(skv_profile, lognormal_k), 0.05f, 200},
    };
    static const size_t species[SKV_SPECIES] = {offsetof(skv_atmosphere, rayleigh), offsetof(skv_atmosphere, aerosol),
                                                offsetof(skv_atmosphere, dust), offsetof(skv_atmosphere, ozone)};
    const skv_profile shaped = {SKV_PROFILE_NONE, 8, 2e-3f, 0.0777f, 1.1636f, 25, 15, 3.22f, 5.6f, NULL, NULL, 0};
    for (int i = 0; i < COUNT(parameters); i++)
        for (int s = 0; s < SKV_SPECIES; s++) {
            skv_atmosphere a = air_br17o();
            skv_profile *p = (skv_profile *)(void *)((char *)&a + species[s]);
            if (parameters[i].kind == SKV_PROFILE_EXP_BACKGROUND && s != 1 && s != 2)
                continue;
            *p = shaped;
            p->kind = parameters[i].kind;
            const size_t at = species[s] + parameters[i].offset;
            check_never(&a, parameters[i].name, at);
            check_float(a, parameters[i].name, at, above(parameters[i].hi), SKV_ERR_RANGE);
            // us76_a is open below.
            check_float(a, parameters[i].name, at,
                        parameters[i].kind == SKV_PROFILE_US76 && parameters[i].hi > 5 ? 0.0f : below(parameters[i].lo),
                        SKV_ERR_RANGE);
            check_float(a, parameters[i].name, at, parameters[i].lo, SKV_OK);
            check_float(a, parameters[i].name, at, parameters[i].hi, SKV_OK);
        }
}

static void tables(void **state) {
    (void)state;
    static float km[SKV_TABLE_ROWS_MAX + 1], density[SKV_TABLE_ROWS_MAX + 1];
    static const float bad_km[] = {NAN, INFINITY, -INFINITY}, bad_density[] = {NAN, INFINITY, -1e-30f, 1.0001e6f};
    for (int i = 0; i <= SKV_TABLE_ROWS_MAX; i++) {
        km[i] = 0.1f * (float)i;
        density[i] = 1 - (float)i / SKV_TABLE_ROWS_MAX;
    }
    for (int s = 0; s < SKV_SPECIES; s++) {
        skv_atmosphere a = air_br17o();
        skv_profile *p = profile_of(&a, s);
        p->kind = SKV_PROFILE_TABLE;
        p->table_altitude_km = km;
        p->table_density = NULL;
        p->table_rows = 3;
        check_build("no table_density", s, &a, SKV_ERR_NULL);
        p->table_density = density;
        p->table_altitude_km = NULL;
        check_build("no table_altitude_km", s, &a, SKV_ERR_NULL);
        p->table_altitude_km = km;
        static const uint32_t rows[] = {0, 1, 2, SKV_TABLE_ROWS_MAX, SKV_TABLE_ROWS_MAX + 1, UINT32_MAX};
        for (int i = 0; i < COUNT(rows); i++) {
            p->table_rows = rows[i];
            check_build("table_rows", rows[i], &a, i == 2 || i == 3 ? SKV_OK : SKV_ERR_RANGE);
        }
        p->table_rows = 3;
        for (int row = 0; row < 3; row++) {
            float kept = km[row];
            for (int i = 0; i < COUNT(bad_km); i++) {
                km[row] = bad_km[i];
                check_build("table_altitude_km", (double)bad_km[i], &a, SKV_ERR_RANGE);
            }
            if (row > 0) { // not ascending
                km[row] = km[row - 1];
                check_build("table_altitude_km", (double)km[row], &a, SKV_ERR_RANGE);
            }
            km[row] = kept;
            kept = density[row];
            for (int i = 0; i < COUNT(bad_density); i++) {
                density[row] = bad_density[i];
                check_build("table_density", (double)bad_density[i], &a, SKV_ERR_RANGE);
            }
            density[row] = kept;
        }
        check_build("a good table", s, &a, SKV_OK);
    }
}

static void tiers(void **state) {
    (void)state;
    static const int samples[3] = {4, 6, 8};
    skv_quality q;
    check_status("no quality", skv_quality_tier(NULL, SKV_TIER_HIGH), SKV_ERR_NULL);
    memset(&q, GUARD, sizeof q);
    check_status("tier 3", skv_quality_tier(&q, (skv_tier)3), SKV_ERR_UNSUPPORTED);
    check_untouched("tier 3", &q, sizeof q);
    for (int t = 0; t < 3; t++) {
        check_status("tier", skv_quality_tier(&q, (skv_tier)t), SKV_OK);
        assert_true(q.rule == SKV_GAUSS_EXP && q.depth == SKV_DEPTH_BY_CHAPMAN && q.samples == samples[t]);
        assert_true(q.terms == (SKV_WITH_RAYLEIGH | SKV_WITH_AEROSOL | SKV_WITH_DUST | SKV_WITH_OZONE));
    }
}

static const float north_up[3] = {0, 0.6f, 0.8f};

static skv_light a_light(void) {
    const skv_light light = {{0, 0.6f, 0.8f}, {1, 1, 1, 1}};
    return light;
}

static void check_begin(const char *what, double value, const skv_model *of, const skv_quality *q, float observer_km,
                        float ground_km, const skv_light *lights, int32_t n, skv_status want) {
    skv_frame frame;
    memset(&frame, GUARD, sizeof frame);
    const skv_status got = skv_frame_begin(&frame, of, q, observer_km, ground_km, lights, n);
    if (got != want)
        fail_msg("skv_frame_begin, %s = %.9g: got status %d, want %d", what, value, (int)got, (int)want);
    if (want != SKV_OK)
        check_untouched(what, &frame, sizeof frame);
}

static void frame_pointers_and_layout(void **state) {
    (void)state;
    const skv_light light = a_light();
    check_status("no frame", skv_frame_begin(NULL, &model, NULL, 0, 0, &light, 1), SKV_ERR_NULL);
    check_begin("no model", 0, NULL, NULL, 0, 0, &light, 1, SKV_ERR_NULL);
    check_begin("no lights", 0, &model, NULL, 0, 0, NULL, 1, SKV_ERR_NULL);
    check_begin("no lights, none wanted", 0, &model, NULL, 0, 0, NULL, 0, SKV_OK);
    check_begin("no quality", 0, &model, NULL, 0, 0, &light, 1, SKV_OK);
    memset(&written, 0, sizeof written);
    check_begin("zeroed model", 0, &written, NULL, 0, 0, &light, 1, SKV_ERR_LAYOUT);
    written = model;
    written.layout ^= 1;
    check_begin("another layout", 0, &written, NULL, 0, 0, &light, 1, SKV_ERR_LAYOUT);
    written.layout = model.layout;
    check_begin("a copy", 0, &written, NULL, 0, 0, &light, 1, SKV_OK);
}

static void qualities(void **state) {
    (void)state;
    const skv_light light = a_light();
    static const struct {
        skv_quality quality;
        skv_status want;
    } cases[] = {
        {{SKV_GAUSS_EXP, SKV_DEPTH_BY_CHAPMAN, 1, 1, 7}, SKV_ERR_RANGE},
        {{SKV_GAUSS_EXP, SKV_DEPTH_BY_CHAPMAN, 2, 0, 7}, SKV_OK}, // depth samples are for inner depth only
        {{SKV_GAUSS_EXP, SKV_DEPTH_BY_CHAPMAN, 16, 99, 31}, SKV_OK},
        {{SKV_GAUSS_EXP, SKV_DEPTH_BY_CHAPMAN, 17, 1, 7}, SKV_ERR_RANGE},
        {{SKV_GAUSS_EXP, SKV_DEPTH_BY_CHAPMAN, -8, 1, 7}, SKV_ERR_RANGE},
        {{SKV_KELLER, SKV_DEPTH_BY_INNER, 0, 1, 7}, SKV_ERR_RANGE},
        {{SKV_KELLER, SKV_DEPTH_BY_INNER, 1, 0, 7}, SKV_ERR_RANGE},
        {{SKV_KELLER, SKV_DEPTH_BY_INNER, 1, 1, 0}, SKV_OK},
        {{SKV_KELLER, SKV_DEPTH_BY_INNER, 64, 64, 7}, SKV_OK},
        {{SKV_KELLER, SKV_DEPTH_BY_INNER, 65, 64, 7}, SKV_ERR_RANGE},
        {{SKV_KELLER, SKV_DEPTH_BY_INNER, 64, 65, 7}, SKV_ERR_RANGE},
        {{SKV_UNIFORM, SKV_DEPTH_BY_INNER, 64, 64, 7}, SKV_OK},
        {{SKV_UNIFORM, SKV_DEPTH_BY_INNER, INT32_MAX, 64, 7}, SKV_ERR_RANGE},
        {{SKV_UNIFORM, SKV_DEPTH_BY_INNER, INT32_MIN, 64, 7}, SKV_ERR_RANGE},
        {{SKV_UNIFORM, SKV_DEPTH_BY_INNER, 8, 8, 32}, SKV_ERR_RANGE},
        {{SKV_UNIFORM, SKV_DEPTH_BY_INNER, 8, 8, 0x8000001fu}, SKV_ERR_RANGE},
        {{(skv_rule)3, SKV_DEPTH_BY_INNER, 8, 8, 7}, SKV_ERR_UNSUPPORTED},
        {{SKV_KELLER, (skv_depth)2, 8, 8, 7}, SKV_ERR_UNSUPPORTED},
    };
    for (int i = 0; i < COUNT(cases); i++)
        check_begin("quality", i, &model, &cases[i].quality, 1, 0, &light, 1, cases[i].want);
}

static void observers_and_grounds(void **state) {
    (void)state;
    static const float never[] = {NAN, INFINITY, -INFINITY};
    const skv_light light = a_light();
    for (int i = 0; i < 3; i++) {
        check_begin("observer_km", (double)never[i], &model, NULL, never[i], 0, &light, 1, SKV_ERR_RANGE);
        check_begin("ground_km", (double)never[i], &model, NULL, 0, never[i], &light, 1, SKV_ERR_RANGE);
    }
    for (int sign = -1; sign <= 1; sign += 2) {
        const float s = (float)sign;
        check_begin("observer_km", sign * 1e6, &model, NULL, s * 1e6f, 0, &light, 1, SKV_OK);
        check_begin("observer_km", sign * 1.0000001e6, &model, NULL, s * above(1e6f), 0, &light, 1, SKV_ERR_RANGE);
        check_begin("ground_km", sign * 12, &model, NULL, 0, s * 12, &light, 1, SKV_OK);
        check_begin("ground_km", sign * 12.000001, &model, NULL, 0, s * above(12), &light, 1, SKV_ERR_RANGE);
    }
    skv_atmosphere low = air_br16();
    low.top_km = 5;
    build(&written, &low);
    check_begin("ground_km", 5, &written, NULL, 0, 5, &light, 1, SKV_ERR_RANGE); // below the top
    check_begin("ground_km", 4.9999995, &written, NULL, 0, below(5), &light, 1, SKV_OK);
}

static void lights(void **state) {
    (void)state;
    static const float never[] = {NAN, INFINITY, -INFINITY}, bad_irradiance[] = {-1e-30f, 1.000001e6f};
    skv_light light[SKV_LIGHTS_MAX + 1];
    for (int i = 0; i <= SKV_LIGHTS_MAX; i++)
        light[i] = a_light();
    check_begin("n_lights", -1, &model, NULL, 0, 0, light, -1, SKV_ERR_RANGE);
    check_begin("n_lights", SKV_LIGHTS_MAX, &model, NULL, 0, 0, light, SKV_LIGHTS_MAX, SKV_OK);
    check_begin("n_lights", SKV_LIGHTS_MAX + 1, &model, NULL, 0, 0, light, SKV_LIGHTS_MAX + 1, SKV_ERR_RANGE);
    for (int n = 0; n < SKV_LIGHTS_MAX; n++) {
        for (int c = 0; c < 3; c++)
            for (int i = 0; i < 3; i++) {
                light[n].direction_enu[c] = never[i];
                check_begin("direction", (double)never[i], &model, NULL, 0, 0, light, SKV_LIGHTS_MAX,
                            SKV_ERR_DIRECTION);
                light[n] = a_light();
            }
        memset(light[n].direction_enu, 0, sizeof light[n].direction_enu);
        check_begin("direction", 0, &model, NULL, 0, 0, light, SKV_LIGHTS_MAX, SKV_ERR_DIRECTION);
        light[n] = a_light();
        for (int b = 0; b < 4; b++) {
            for (int i = 0; i < 5; i++) {
                light[n].irradiance[b] = i < 3 ? never[i] : bad_irradiance[i - 3];
                check_begin("irradiance", (double)light[n].irradiance[b], &model, NULL, 0, 0, light, SKV_LIGHTS_MAX,
                            SKV_ERR_RANGE);
            }
            light[n].irradiance[b] = 1e6f;
            check_begin("irradiance", 1e6, &model, NULL, 0, 0, light, SKV_LIGHTS_MAX, SKV_OK);
            light[n].irradiance[b] = 0;
            check_begin("irradiance", 0, &model, NULL, 0, 0, light, SKV_LIGHTS_MAX, SKV_OK);
            light[n] = a_light();
        }
    }
}

static void the_sun_as_a_light(void **state) {
    (void)state;
    static const float bad[][3] = {{0, 0, 0}, {NAN, 0, 1}, {0, INFINITY, 0}, {0, 0, -INFINITY}};
    skv_light light;
    memset(&light, GUARD, sizeof light);
    check_status("no light", skv_light_sun(NULL, &model, north_up), SKV_ERR_NULL);
    check_status("no model", skv_light_sun(&light, NULL, north_up), SKV_ERR_NULL);
    check_status("no direction", skv_light_sun(&light, &model, NULL), SKV_ERR_NULL);
    memset(&written, 0, sizeof written);
    check_status("zeroed model", skv_light_sun(&light, &written, north_up), SKV_ERR_LAYOUT);
    for (int i = 0; i < COUNT(bad); i++)
        check_status("direction", skv_light_sun(&light, &model, bad[i]), SKV_ERR_DIRECTION);
    check_untouched("skv_light_sun", &light, sizeof light);
    check_status("skv_light_sun", skv_light_sun(&light, &model, north_up), SKV_OK);
    assert_true(memcmp(light.direction_enu, north_up, sizeof north_up) == 0);
    assert_true(memcmp(light.irradiance, model.solar_irradiance, sizeof light.irradiance) == 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(atmosphere_pointers),
        cmocka_unit_test(atmosphere_fields),
        cmocka_unit_test(atmosphere_fields_that_depend),
        cmocka_unit_test(atmosphere_choices),
        cmocka_unit_test(profiles),
        cmocka_unit_test(tables),
        cmocka_unit_test(tiers),
        cmocka_unit_test(frame_pointers_and_layout),
        cmocka_unit_test(qualities),
        cmocka_unit_test(observers_and_grounds),
        cmocka_unit_test(lights),
        cmocka_unit_test(the_sun_as_a_light),
    };
    return cmocka_run_group_tests(tests, build_model, NULL);
}
