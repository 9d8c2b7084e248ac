/// A million random extremes: any bit pattern as direction, length, height, light and parameter of the air; also with
/// flush-to-zero and in the other rounding modes. Radiance is never NaN, infinite or negative, transmittance in [0, 1],
/// bad parameters get a status, refused rays are 0.
#include <fenv.h>
#if defined(__SSE__)
#include <xmmintrin.h>
#endif

#include "air.h"

#define RAYS 100

static uint64_t state_of_random = 0x9E3779B97F4A7C15ULL;

static float from_bits(uint32_t bits) {
    float f;
    memcpy(&f, &bits, sizeof f);
    return f;
}

static uint32_t bits_of(float f) {
    uint32_t bits;
    memcpy(&bits, &f, sizeof bits);
    return bits;
}

// By bits: comparisons with subnormals would depend on the mode under test.
static int is_finite(float f) {
    return (bits_of(f) & 0x7f800000u) != 0x7f800000u;
}

static int is_tiny(float f) {
    return (bits_of(f) & 0x7f800000u) == 0;
}

static int one_in(int n) {
    return random_bits(&state_of_random) % (uint64_t)n == 0;
}

static float wild(void) {
    static const uint32_t special[] = {0x00000000u, 0x80000000u, 0x7f800000u, 0xff800000u, 0x7fc00000u, 0xffc00001u,
                                       0x00000001u, 0x807fffffu, 0x00800000u, 0x7f7fffffu, 0xff7fffffu, 0x3f800000u,
                                       0xbf800000u, 0x3f7fffffu, 0x33800000u, 0x45c6c000u};
    const uint64_t r = random_bits(&state_of_random);
    return r & 1 ? from_bits((uint32_t)(r >> 32)) : from_bits(special[(r >> 8) % 16]);
}

// Even in the logarithm, often the very end of the range.
static float within(float low, float high) {
    const double t = random_unit(&state_of_random), from = low > 0 ? (double)low : (double)high * 1e-12;
    if (one_in(8))
        return high;
    if (one_in(8))
        return low;
    return fminf(high, fmaxf(low, (float)(from * pow((double)high / from, t))));
}

static float table_km[SKV_TABLE_ROWS_MAX], table_density[SKV_TABLE_ROWS_MAX];

static void random_profile(skv_profile *p, int species) {
    static const skv_profile_kind closed[] = {SKV_PROFILE_NONE, SKV_PROFILE_EXPONENTIAL};
    static const skv_profile_kind shaped[] = {SKV_PROFILE_US76, SKV_PROFILE_TENT, SKV_PROFILE_LOGNORMAL,
                                              SKV_PROFILE_TABLE};
    const uint64_t r = random_bits(&state_of_random) >> 20;
    p->kind = species == 2 || r % 8 == 0 ? shaped[(r >> 8) % 4] : closed[(r >> 8) % 8 != 0];
    if (species == 1 && one_in(3))
        p->kind = SKV_PROFILE_EXP_BACKGROUND;
    p->scale_height_km = within(0.001f, 1000);
    p->background = within(0, 1);
    p->us76_a = within(1e-5f, 10);
    p->us76_b = within(0.5f, 3);
    p->peak_km = within(0, 1000);
    p->half_width_km = within(0.01f, 1000);
    p->lognormal_mu = (float)(-3 + 10 * random_unit(&state_of_random));
    p->lognormal_k = within(0.05f, 200);
    p->table_rows = one_in(4) ? SKV_TABLE_ROWS_MAX : 2 + (uint32_t)(r % 30);
    p->table_altitude_km = table_km;
    p->table_density = table_density;
}

static void random_tables(void) {
    double km = -20;
    for (int i = 0; i < SKV_TABLE_ROWS_MAX; i++) {
        km += 0.01 + random_unit(&state_of_random) * 10;
        table_km[i] = (float)km;
        table_density[i] = within(0, 1e6f);
    }
}

// Within every range of the header, mostly at its edges.
static skv_atmosphere random_air(void) {
    skv_atmosphere a = air_clear(one_in(2) ? 3 : 4);
    random_tables();
    if (one_in(3))
        return a;
    a.radius_km = within(1, 100000);
    a.top_km = fminf(within(0.1f, 1000), a.radius_km);
    random_profile(&a.rayleigh, 0);
    random_profile(&a.aerosol, 1);
    random_profile(&a.ozone, 2);
    if (one_in(2)) {
        random_profile(&a.dust, 1);
        a.dust_phase = one_in(2) ? SKV_PHASE_HG : SKV_PHASE_CS;
        a.dust_g = within(-0.9999f, 0.9999f);
    }
    a.aerosol_phase = one_in(2) ? SKV_PHASE_HG : SKV_PHASE_CS;
    a.aerosol_g = (one_in(2) ? 1.0f : -1.0f) * within(0, 0.9999f);
    a.turbidity = one_in(2) ? 1 : within(0, 1e4f);
    for (int i = 0; i < a.bands; i++) {
        a.solar_irradiance[i] = within(0, 1e6f);
        a.albedo[i] = within(0, 1);
        a.rayleigh_scattering_per_km[i] = within(0, 1e4f);
        a.aerosol_extinction_per_km[i] = within(0, 1e4f);
        a.aerosol_scattering_per_km[i] = fminf(within(0, 1e4f), a.aerosol_extinction_per_km[i]);
        a.ozone_absorption_per_km[i] = within(0, 1e4f);
        a.rayleigh_absorption_per_km[i] = one_in(2) ? 0 : within(0, 1e4f);
        a.dust_extinction_per_km[i] = within(0, 1e4f);
        a.dust_scattering_per_km[i] = fminf(within(0, 1e4f), a.dust_extinction_per_km[i]);
        a.absorption_colour[i] = within(1e-3f, 1);
    }
    return a;
}

typedef struct bad_field {
    size_t offset;
    float low, high;
} bad_field;

#define FIELD(f, low, high)                                                                                            \
    { offsetof(skv_atmosphere, f), low, high }
static const bad_field checked[] = {FIELD(radius_km, 1, 100000),
                                    FIELD(top_km, 0.1f, 1000),
                                    FIELD(wavelength_nm[1], 440, 600),
                                    FIELD(solar_irradiance[2], 0, 1e6f),
                                    FIELD(albedo[0], 0, 1),
                                    FIELD(rayleigh_scattering_per_km[1], 0, 1e4f),
                                    FIELD(aerosol_scattering_per_km[0], 0, 0.00444f),
                                    FIELD(aerosol_extinction_per_km[0], 0.003996f, 1e4f),
                                    FIELD(aerosol_g, -0.9999f, 0.9999f),
                                    FIELD(rayleigh_absorption_per_km[1], 0, 1e4f),
                                    FIELD(dust_scattering_per_km[0], 0, 0.034f),
                                    FIELD(dust_extinction_per_km[2], 0.016f, 1e4f),
                                    FIELD(dust_g, -0.9999f, 0.9999f),
                                    FIELD(dust.scale_height_km, 0.001f, 1000),
                                    FIELD(dust.background, 0, 1),
                                    FIELD(turbidity, 0, 1e4f),
                                    FIELD(ozone_absorption_per_km[2], 0, 1e4f),
                                    FIELD(rayleigh.scale_height_km, 0.001f, 1000),
                                    FIELD(aerosol.scale_height_km, 0.001f, 1000),
                                    FIELD(ozone.peak_km, 0, 1000),
                                    FIELD(ozone.half_width_km, 0.01f, 1000)};

// One field of a sound air holds anything: SKV_OK exactly where the header's range admits it; else nothing is written.
static void parameters_out_of_range_get_a_status(void **state) {
    static skv_model model;
    (void)state;
    for (int i = 0; i < 20000; i++) {
        const bad_field *f = &checked[i % (int)(sizeof checked / sizeof *checked)];
        skv_atmosphere a = air_smoky(3);
        const float value = wild();
        memcpy((char *)&a + f->offset, &value, sizeof value);
        int good = is_finite(value) && value >= f->low && value <= f->high;
        good = good && a.top_km <= a.radius_km;
        good = good && a.wavelength_nm[0] < a.wavelength_nm[1] && a.wavelength_nm[1] < a.wavelength_nm[2];
        memset(&model, 0x5a, 64);
        const skv_status status = skv_model_build(&model, &a);
        if ((status == SKV_OK) != good)
            fail_msg("skv_model_build: field at byte %d = %g (%08x): status %d, in range %d", (int)f->offset,
                     (double)value, (unsigned)bits_of(value), (int)status, good);
        if (!good && (status != SKV_ERR_RANGE || ((const unsigned char *)&model)[3] != 0x5a))
            fail_msg("skv_model_build: field at byte %d = %g: status %d or model written", (int)f->offset,
                     (double)value, (int)status);
    }
}

static skv_quality random_quality(void) {
    static const int cheap[] = {1, 2, 3, 4, 5, 8};
    skv_quality q = quality_of((skv_rule)(random_bits(&state_of_random) >> 30) % 3, SKV_DEPTH_BY_CHAPMAN, 4, 4);
    if (!one_in(4))
        q.rule = SKV_GAUSS_EXP;
    q.depth = one_in(3) ? SKV_DEPTH_BY_INNER : SKV_DEPTH_BY_CHAPMAN;
    q.samples = cheap[1 + (random_bits(&state_of_random) >> 40) % 5];
    q.depth_samples = cheap[1 + (random_bits(&state_of_random) >> 40) % 5];
    q.terms = (uint32_t)(random_bits(&state_of_random) >> 32) & SKV_WITH_ALL;
    if (one_in(2))
        q.terms = SKV_WITH_ALL;
    return q;
}

static void random_direction(float v[3], const float sun[3]) {
    const uint64_t r = random_bits(&state_of_random) >> 50;
    direction_of(v, 180 * random_unit(&state_of_random), 360 * random_unit(&state_of_random));
    if (r % 8 == 0)
        memcpy(v, sun, 3 * sizeof *v);
    else if (r % 8 == 1)
        v[2] = 0;
    else if (r % 8 == 2)
        direction_of(v, 90 + 20 * (random_unit(&state_of_random) - 0.5), 30);
    else if (r % 8 < 6)
        return;
    for (int i = 0; i < 3; i++) {
        if (r % 32 == 7)
            v[i] = wild();
        if (r % 64 == 6)
            v[i] *= 1e30f;
    }
}

// One frame with whatever: its status must be an error where something is not finite.
static int random_frame(skv_frame *frame, const skv_model *model, skv_light lights[2]) {
    const skv_quality q = random_quality();
    float observer = within(1e-6f, 1e6f) * (one_in(8) ? -1.0f : 1.0f), ground = 0;
    if (one_in(2))
        observer = (float)(random_unit(&state_of_random) * 1.2 * (double)model->top_km);
    if (one_in(4))
        ground = (float)(random_unit(&state_of_random) * 24 - 12);
    if (one_in(10))
        observer = wild();
    if (one_in(20))
        ground = wild();
    int finite = is_finite(observer) && is_finite(ground);
    for (int i = 0; i < 2; i++) {
        direction_of(lights[i].direction_enu, 180 * random_unit(&state_of_random), 0);
        if (one_in(20))
            lights[i].direction_enu[one_in(2)] = wild();
        for (int b = 0; b < 4; b++)
            lights[i].irradiance[b] = within(0, 1e6f);
        if (one_in(40))
            lights[i].irradiance[1] = wild();
        finite = finite && is_finite(lights[i].irradiance[1]);
        for (int k = 0; k < 3; k++)
            finite = finite && is_finite(lights[i].direction_enu[k]);
    }
    const skv_status status = skv_frame_begin(frame, model, &q, observer, ground, lights, SKV_LIGHTS_MAX < 2 ? 1 : 2);
    if (status == SKV_OK && !finite)
        fail_msg("skv_frame_begin: observer %g, ground %g: SKV_OK for something not finite", (double)observer,
                 (double)ground);
    return status == SKV_OK;
}

static void print_case(const skv_frame *f, const float v[3], float length) {
    print_message("frame: height %g ground %g top %g radius %g, rule %d depth %d N %d M %d terms %u, mu_s %g\n",
                  (double)f->height_km, (double)f->ground_km, (double)f->top_km, (double)f->radius_km,
                  (int)f->quality.rule, (int)f->quality.depth, (int)f->quality.samples, (int)f->quality.depth_samples,
                  (unsigned)f->quality.terms, (double)f->light[0].mu_s);
    print_message("light %.9g %.9g %.9g; view %.9g %.9g %.9g, length %.9g\n", (double)f->light[0].direction_enu[0],
                  (double)f->light[0].direction_enu[1], (double)f->light[0].direction_enu[2], (double)v[0],
                  (double)v[1], (double)v[2], (double)length);
}

static void print_air(const skv_atmosphere *a) {
    const skv_profile *p[SKV_SPECIES] = {&a->rayleigh, &a->aerosol, &a->dust, &a->ozone};
    print_message("air: radius %.9g top %.9g bands %d g %.9g phase %d turbidity %.9g\n", (double)a->radius_km,
                  (double)a->top_km, (int)a->bands, (double)a->aerosol_g, (int)a->aerosol_phase, (double)a->turbidity);
    for (int i = 0; i < SKV_SPECIES; i++)
        print_message("  kind %d H %.9g bg %.9g us76 %.9g %.9g tent %.9g %.9g ln %.9g %.9g rows %u\n", (int)p[i]->kind,
                      (double)p[i]->scale_height_km, (double)p[i]->background, (double)p[i]->us76_a,
                      (double)p[i]->us76_b, (double)p[i]->peak_km, (double)p[i]->half_width_km,
                      (double)p[i]->lognormal_mu, (double)p[i]->lognormal_k, (unsigned)p[i]->table_rows);
    for (int b = 0; b < a->bands; b++)
        print_message("  band %d: E %.9g R %.9g+%.9g A %.9g/%.9g D %.9g/%.9g O %.9g\n", b,
                      (double)a->solar_irradiance[b], (double)a->rayleigh_scattering_per_km[b],
                      (double)a->rayleigh_absorption_per_km[b], (double)a->aerosol_scattering_per_km[b],
                      (double)a->aerosol_extinction_per_km[b], (double)a->dust_scattering_per_km[b],
                      (double)a->dust_extinction_per_km[b], (double)a->ozone_absorption_per_km[b]);
}

static int sound(float x, float most) {
    return is_finite(x) && (bits_of(x) >> 31 == 0 || bits_of(x) == 0x80000000u) && x <= most;
}

static void one_batch(const skv_frame *frame, const skv_atmosphere *a) {
    static float view[RAYS][3], length[RAYS], radiance[RAYS][4], through[RAYS][4];
    const size_t n = 1 + (size_t)(random_bits(&state_of_random) >> 40) % RAYS;
    int any_bad = 0, any_tiny = 0, bad[RAYS];
    for (size_t i = 0; i < n; i++) {
        random_direction(view[i], frame->light[0].direction_enu);
        length[i] = one_in(16) ? wild() : one_in(2) ? INFINITY : within(1e-6f, 1e4f);
        const int zero = is_tiny(view[i][0]) && is_tiny(view[i][1]) && is_tiny(view[i][2]);
        const int finite = is_finite(view[i][0]) && is_finite(view[i][1]) && is_finite(view[i][2]);
        const uint32_t l = bits_of(length[i]);
        bad[i] = zero || !finite || (l & 0x7fffffffu) > 0x7f800000u || (l > 0x80000000u && !is_tiny(length[i]));
        any_tiny |= is_tiny(length[i]) && l > 0x80000000u; // -subnormal: 0 where subnormals are flushed
        any_bad |= bad[i];
    }
    const skv_rays rays = {view[0], 0, length, 0};
    const skv_sky sky = {radiance[0], sizeof radiance[0], through[0], sizeof through[0]};
    memset(radiance, 0xff, sizeof radiance);
    memset(through, 0xff, sizeof through);
    const skv_status status = skv_radiance(frame, n, &rays, &sky);
    if (!any_tiny && status != (any_bad ? SKV_ERR_DIRECTION : SKV_OK))
        fail_msg("skv_radiance: status %d, some ray bad %d", (int)status, any_bad);
    for (size_t i = 0; i < n; i++)
        for (int b = 0; b < frame->model->bands; b++) {
            const float l = radiance[i][b], t = through[i][b];
            if (sound(l, 3.4e38f) && sound(t, 1) && !(bad[i] && (l > 0 || t > 0)))
                continue;
            print_case(frame, view[i], length[i]);
            print_air(a);
            fail_msg("ray %d of %d, band %d: radiance %g, transmittance %g, refused %d", (int)i, (int)n, b, (double)l,
                     (double)t, bad[i]);
        }
}

static int many(int batches) {
    static skv_model model;
    static skv_frame frame;
    skv_atmosphere a = random_air();
    skv_light lights[2];
    int done = 0, models = 0;
    must(skv_model_build(&model, &a), "skv_model_build of air within all ranges");
    for (int i = 0; i < batches; i++) {
        if (i % 24 == 0) {
            a = random_air();
            const skv_status status = skv_model_build(&model, &a);
            if (status != SKV_OK) {
                print_air(&a);
                fail_msg("skv_model_build: status %d for air within all ranges", (int)status);
            }
            models++;
        }
        if (random_frame(&frame, &model, lights)) {
            one_batch(&frame, &a);
            done++;
        }
    }
    printf("figure: %d batches of about %d random rays in %d airs: all finite and >= 0\n", done, RAYS / 2, models);
    return done;
}

static void a_million_extremes(void **state) {
    (void)state;
    many(24000 / (getenv("SKV_TEST_SHORT") ? 10 : 1));
}

static void with_flush_to_zero(void **state) {
    (void)state;
#if defined(__SSE__)
    const unsigned mode = _mm_getcsr();
    _mm_setcsr(mode | 0x8040); // FTZ, DAZ
    many(3000 / (getenv("SKV_TEST_SHORT") ? 10 : 1));
    _mm_setcsr(mode);
#else
    skip();
#endif
}

static void in_other_rounding_modes(void **state) {
    static const int modes[] = {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};
    (void)state;
    for (int i = 0; i < 3; i++) {
        fesetround(modes[i]);
        many(3000 / (getenv("SKV_TEST_SHORT") ? 10 : 1));
        fesetround(FE_TONEAREST);
    }
}

static int restore(void **state) {
    (void)state;
    fesetround(FE_TONEAREST);
#if defined(__SSE__)
    _mm_setcsr(0x1f80);
#endif
    return 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parameters_out_of_range_get_a_status),
        cmocka_unit_test(a_million_extremes),
        cmocka_unit_test_teardown(with_flush_to_zero, restore),
        cmocka_unit_test_teardown(in_other_rounding_modes, restore),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
