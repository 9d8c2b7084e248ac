/// Tables, grids and irradiance of random airs at the ends of every range: nothing is NaN, infinite, negative or less
/// than light scattered once, and no air sends more than the sun's energy.
#include "air.h"

#include "skyvert/irradiance.h"
#include "skyvert/table.h"

enum { VIEWS = 12, TABLE_BYTES = 65536, WORK_BYTES = 400000, GRID_FLOATS = 4000 };

static uint64_t state_of_random = 0x2545F4914F6CDD1DULL;
static uint32_t table_words[TABLE_BYTES / 4], work[WORK_BYTES / 4];
static float grid[GRID_FLOATS];
static skv_model model;

static int one_in(int n) {
    return random_bits(&state_of_random) % (uint64_t)n == 0;
}

static double between(double low, double high) {
    return low + (high - low) * random_unit(&state_of_random);
}

/// Even in the logarithm, often one of the ends.
static float within(double low, double high) {
    if (one_in(6))
        return (float)high;
    if (one_in(6))
        return (float)low;
    return (float)fmin(high, fmax(low, low * pow(high / low, random_unit(&state_of_random))));
}

static float random_g(void) {
    static const float ends[] = {-0.9999f, -0.99f, -0.5f, 0.0f, 0.5f, 0.9f, 0.99f, 0.9999f};
    return one_in(2) ? ends[random_bits(&state_of_random) % 8] : (float)between(-0.95, 0.95);
}

static void random_layer(skv_profile *p, float scattering[4], float extinction[4], double most) {
    p->kind = one_in(3) ? SKV_PROFILE_EXP_BACKGROUND : one_in(6) ? SKV_PROFILE_TENT : SKV_PROFILE_EXPONENTIAL;
    p->scale_height_km = within(0.001, 1000);
    p->background = one_in(2) ? 0 : within(1e-6, 1);
    p->peak_km = within(0.1, 100);
    p->half_width_km = within(0.01, 100);
    for (int b = 0; b < 4; b++) {
        extinction[b] = one_in(4) ? 0 : within(1e-8, most);
        scattering[b] = one_in(3) ? extinction[b] : extinction[b] * (float)random_unit(&state_of_random);
    }
}

/// Bands at 0, no gas, no aerosol, dust alone, albedo 0 and 1, planets of 1 to 70,000 km.
static skv_atmosphere random_air(void) {
    skv_atmosphere a = air_none(one_in(2) ? 3 : 4);
    float absorbed[4];
    a.radius_km = one_in(2) ? 6360 : within(1, 70000);
    a.top_km = fminf(one_in(2) ? 60 : within(0.1, 1000), a.radius_km);
    for (int b = 0; b < 4; b++) {
        a.albedo[b] = one_in(3) ? 1.0f : one_in(3) ? 0.0f : (float)random_unit(&state_of_random);
        a.solar_irradiance[b] = one_in(20) ? 0 : one_in(10) ? 1e6f : 1;
    }
    const double most = one_in(4) ? 1e4 : one_in(2) ? 10 : 0.1;
    if (!one_in(4)) {
        random_layer(&a.rayleigh, a.rayleigh_scattering_per_km, absorbed, most);
        a.rayleigh.kind = one_in(8) ? SKV_PROFILE_US76 : SKV_PROFILE_EXPONENTIAL;
        a.rayleigh.us76_a = 0.0777f;
        a.rayleigh.us76_b = 1.16f;
    }
    if (!one_in(3))
        random_layer(&a.aerosol, a.aerosol_scattering_per_km, a.aerosol_extinction_per_km, most);
    if (one_in(3))
        random_layer(&a.dust, a.dust_scattering_per_km, a.dust_extinction_per_km, most);
    a.aerosol_phase = one_in(2) ? SKV_PHASE_HG : SKV_PHASE_CS;
    a.dust_phase = one_in(2) ? SKV_PHASE_HG : SKV_PHASE_CS;
    a.aerosol_g = random_g();
    a.dust_g = random_g();
    a.turbidity = one_in(5) ? 1000 : 1;
    if (one_in(2)) {
        a.ozone.kind = SKV_PROFILE_TENT;
        a.ozone.peak_km = 0.4f * a.top_km;
        a.ozone.half_width_km = 0.2f * a.top_km;
        fill(a.ozone_absorption_per_km, 0, 1e-3, 1, within(1e-6, 1e4));
    }
    return a;
}

static skv_table_spec random_spec(const skv_atmosphere *a) {
    skv_table_spec s;
    must(skv_table_spec_kind(&s, one_in(4) ? SKV_TABLE_SMALL : SKV_TABLE_ACCURATE), "spec");
    s.altitudes = 4 + (int32_t)(random_bits(&state_of_random) % 5);
    s.detailed = (int32_t)(random_bits(&state_of_random) % (uint64_t)(s.altitudes + 1));
    s.suns = 8 + (int32_t)(random_bits(&state_of_random) % 5);
    s.orders = one_in(8) ? 0 : 2 + (int32_t)(random_bits(&state_of_random) % 6);
    for (int i = 0; i < 2; i++) {
        s.samples[i] = 2 + (int32_t)(random_bits(&state_of_random) % 3);
        s.polar[i] = s.azimuths[i] = 3;
    }
    s.format = one_in(3) ? SKV_TABLE_FLOAT : SKV_TABLE_PACKED;
    s.ground_km = one_in(3) ? (float)between(-0.4, 0.4) * fminf(a->top_km, 1) : 0;
    return s;
}

static void describe(const skv_atmosphere *a, const skv_table_spec *s) {
    print_message("radius %g top %g albedo %g %g %g, table %dx%d detailed %d orders %d format %d ground %g\n",
                  (double)a->radius_km, (double)a->top_km, (double)a->albedo[0], (double)a->albedo[1],
                  (double)a->albedo[2], (int)s->altitudes, (int)s->suns, (int)s->detailed, (int)s->orders,
                  (int)s->format, (double)s->ground_km);
    const skv_profile *const p[3] = {&a->rayleigh, &a->aerosol, &a->dust};
    const float *const c[3][2] = {{a->rayleigh_scattering_per_km, a->rayleigh_absorption_per_km},
                                  {a->aerosol_scattering_per_km, a->aerosol_extinction_per_km},
                                  {a->dust_scattering_per_km, a->dust_extinction_per_km}};
    for (int i = 0; i < 3; i++)
        print_message("layer %d kind %d H %g background %g: scattering %g %g %g %g, extinction %g %g %g %g, g %g\n", i,
                      (int)p[i]->kind, (double)p[i]->scale_height_km, (double)p[i]->background, (double)c[i][0][0],
                      (double)c[i][0][1], (double)c[i][0][2], (double)c[i][0][3], (double)c[i][1][0],
                      (double)c[i][1][1], (double)c[i][1][2], (double)c[i][1][3],
                      i == 0   ? 0.0
                      : i == 1 ? (double)a->aerosol_g
                               : (double)a->dust_g);
}

static int fine(float x, float least) {
    return x >= least && x <= 3.1e38f;
}

static double largest_irradiance;

/// One frame: radiance by integral and by grid, irradiance of six surfaces.
static const char *frame_is_sound(const skv_atmosphere *a, const skv_table_spec *s, int number, char what[200]) {
    static const float heights[] = {-5, 0, 0.001f, 1, 20, 36000};
    float view[VIEWS][3], once[VIEWS][4], all[VIEWS][4], normal[6][3], out[6][4], sun[3];
    const float height = one_in(3) ? (float)between(0, 1.2) * a->top_km : heights[number % 6];
    const double zenith = one_in(4) ? 90 : one_in(4) ? 180.0 * (number % 2) : between(0, 180);
    skv_quality q = quality_of(SKV_GAUSS_EXP, SKV_DEPTH_BY_CHAPMAN, 4, 4);
    skv_light light[2];
    skv_frame frame;
    const int lights = 1 + one_in(4);
    q.terms = SKV_WITH_ALL;
    direction_of(sun, zenith, 0);
    for (int i = 0; i < lights; i++) {
        must(skv_light_sun(&light[i], &model, sun), "sun");
        direction_of(sun, between(0, 180), 120);
    }
    must(skv_frame_begin(&frame, &model, &q, height, one_in(2) ? s->ground_km : 0, light, lights), "frame");
    for (int i = 0; i < VIEWS; i++) {
        const double h = (double)frame.height_km, r = (double)frame.radius_km;
        const double dip = 90 + acos(r / (r + h)) / DEGREE;
        direction_of(view[i], i == 0 ? zenith : i % 3 ? between(0, 180) : dip + between(-0.5, 0.5), between(0, 360));
        direction_of(normal[i % 6], 36 * (i % 6), 60 * i);
    }
    const skv_rays rays = {view[0], 0, NULL, 0};
    const skv_sky to_once = {once[0], sizeof once[0], NULL, 0}, to_all = {all[0], sizeof all[0], NULL, 0};
    must(skv_radiance(&frame, VIEWS, &rays, &to_once), "single");
    must(skv_frame_table(&frame, (const skv_table *)(const void *)table_words), "table");
    for (int with_grid = 0; with_grid < 2; with_grid++) {
        const skv_status status = with_grid ? skv_frame_grid(&frame, grid, sizeof grid) : SKV_OK;
        if (status == SKV_ERR_RANGE)
            break; // too high for a grid
        if (status != SKV_OK)
            return snprintf(what, 200, "skv_frame_grid: %d", (int)status), what;
        must(skv_radiance(&frame, VIEWS, &rays, &to_all), "all");
        for (int i = 0; i < VIEWS * model.bands; i++) {
            const int k = i / model.bands, b = i % model.bands;
            if (!fine(all[k][b], once[k][b]))
                return snprintf(what, 200, "height %g, sun %g, view %g %g %g, band %d, grid %d: all %g, once %g",
                                (double)height, zenith, (double)view[k][0], (double)view[k][1], (double)view[k][2], b,
                                with_grid, (double)all[k][b], (double)once[k][b]),
                       what;
        }
    }
    must(skv_irradiance(&frame, SKV_IRRADIANCE_ALL, 6, normal[0], 0, out[0], sizeof out[0]), "irradiance");
    for (int i = 0; i < 6; i++)
        for (int b = 0; b < model.bands; b++) {
            const double most = (double)a->solar_irradiance[b] * lights;
            if (most > 0 && (double)height <= (double)a->top_km)
                largest_irradiance = fmax(largest_irradiance, (double)out[i][b] / most);
            if (!fine(out[i][b], 0) || (height <= a->top_km && (double)out[i][b] > 8 * most))
                return snprintf(what, 200, "height %g, sun %g, surface %d, band %d: irradiance %g of %g",
                                (double)height, zenith, i, b, (double)out[i][b], most),
                       what;
        }
    return NULL;
}

// Within the air no more than eight times the lights' irradiance: layers of a metre are seen by no quadrature, so this
// is a bound and not an error.
static void any_air_is_sound(void **state) {
    const int airs = getenv("SKV_TEST_SHORT") ? 25 : 120;
    int tables = 0, frames = 0, unsupported = 0, bad = 0;
    (void)state;
    for (int n = 0; n < airs; n++) {
        const skv_atmosphere a = random_air();
        const skv_table_spec s = random_spec(&a);
        char what[200];
        must(skv_model_build(&model, &a), "skv_model_build");
        const skv_status status =
            skv_table_build((skv_table *)(void *)table_words, sizeof table_words, work, sizeof work, &model, &s);
        unsupported += status == SKV_ERR_RANGE; // the ground above the top, or deep in a tiny planet
        if (status != SKV_OK && status != SKV_ERR_RANGE)
            fail_msg("air %d: skv_table_build: status %d", n, (int)status);
        if (status != SKV_OK)
            continue;
        must(skv_table_check(table_words, sizeof table_words, &model), "skv_table_check");
        tables++;
        for (int i = 0; i < 6; i++, frames++) {
            const char *wrong = frame_is_sound(&a, &s, i, what);
            if (wrong && bad++ < 8) {
                describe(&a, &s);
                print_message("air %d: %s\n", n, wrong);
            }
        }
    }
    print_message("figure: %d random tables, %d frames: largest irradiance within the air %.2f of the lights'\n",
                  tables, frames, largest_irradiance);
    if (bad)
        fail_msg("%d of %d frames are wrong (above)", bad, frames);
    assert_true(tables > airs / 2 && unsupported < airs / 4);
}

/// Haze made a thousand times thicker, where a table's own accuracy is wanted: a surface gets no more than the beam,
/// the sky and the ground can give it. In conservative fog over white ground both sides of a wall see at most about
/// twice the sun each.
static void thick_fog_keeps_the_energy(void **state) {
    double most = 0;
    (void)state;
    for (int k = 0; k < 4; k++) {
        skv_atmosphere a = k % 2 ? air_clear(4) : air_hazy(4);
        skv_table_spec s;
        a.turbidity = k < 2 ? 1000 : 30;
        fill(a.solar_irradiance, 1, 1, 1, 1);
        fill(a.albedo, 1, 0, 0.5, 1);
        memcpy(a.aerosol_extinction_per_km, a.aerosol_scattering_per_km, sizeof a.aerosol_scattering_per_km);
        must(skv_model_build(&model, &a), "model");
        must(skv_table_spec_kind(&s, SKV_TABLE_SMALL), "spec");
        must(skv_table_build((skv_table *)(void *)table_words, sizeof table_words, work, sizeof work, &model, &s),
             "table");
        for (int i = 0; i < 60; i++) {
            float sun[3], normal[6][3], out[6][4];
            skv_light light;
            skv_frame frame;
            direction_of(sun, i % 2 ? 10 * (i % 10) : 0, 0);
            must(skv_light_sun(&light, &model, sun), "sun");
            must(skv_frame_begin(&frame, &model, NULL, (float)(0.02 * i * i), 0, &light, 1), "frame");
            must(skv_frame_table(&frame, (const skv_table *)(const void *)table_words), "table");
            for (int n = 0; n < 6; n++)
                direction_of(normal[n], 36 * n, 60 * n);
            must(skv_irradiance(&frame, SKV_IRRADIANCE_ALL, 6, normal[0], 0, out[0], 0), "irradiance");
            for (int n = 0; n < 24; n++)
                most = fmax(most, (double)out[n / 4][n % 4]);
        }
    }
    print_message("figure: fog of 30 and 1000 times the aerosol: largest irradiance %.2f of the sun's\n", most);
    check_at_most("irradiance in fog, of the sun's", most, 2.5);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(any_air_is_sound),
                                       cmocka_unit_test(thick_fog_keeps_the_energy)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
