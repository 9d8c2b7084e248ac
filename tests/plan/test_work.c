// skv_radiance_work() counts exactly what skv_radiance() does: radiance.c and diffuse.c are compiled in here with their
// inner calls counted.
#include "check.h"

#include "core/cells.h"
#include "core/gauss.h"

#include "skyvert/skyvert.h"
#include "skyvert/work.h"

static skv_work counted;

static void counted_legs(const skv_frame *frame, const skv_legs *leg, int count, const float irradiance[4]) {
    uint32_t low = 0;
    for (int l = 0; l < count; l++) {
        const float rms = leg->rms.v[l], nu = leg->nu.v[l];
        low += rms + leg->a.v[l] * nu < 0.0f || rms + leg->b.v[l] * nu < 0.0f;
    }
    counted.runs++;
    counted.legs += (uint32_t)count;
    counted.low_legs += low;
    counted.low_runs += skv_legs_down(leg) != 0;
    skv_gauss_legs(frame, leg, count, irradiance);
}

static void counted_find(const skv_table *t, int bands, const skv_lanes *x, const skv_lanes *y, skv_cells_places *p) {
    int32_t last = -1;
    skv_cells_find(t, bands, x, y, p);
    counted.diffuse_nodes++;
    for (int l = 0; l < SKV_LANES; l++) {
        const int row = (int)x->v[l] > t->altitudes - 2 ? t->altitudes - 2 : (int)x->v[l];
        counted.diffuse_fine += row + 1 < t->detailed;
        counted.diffuse_fading += row + 1 == t->detailed;
        counted.diffuse_loads += p->mean[l] != last;
        last = p->mean[l];
    }
}

#define skv_gauss_legs counted_legs
#include "core/radiance.c"
#undef skv_gauss_legs
#define skv_cells_find counted_find
#include "core/diffuse.c"
#undef skv_cells_find

static uint32_t state;
static float uniform(void) {
    state = state * 1664525u + 1013904223u;
    return (float)(state >> 8) * 5.9604645e-8f;
}

enum { RAYS = 301 };
static float direction[RAYS][3], length_km[RAYS], radiance[RAYS][4];
static uint32_t table_store[2200];
static float work_store[20000];

static void compare(const char *what, int round, uint32_t got, uint32_t want) {
    if (got != want)
        fail_msg("%s of frame %d: got %u, want %u, tolerance 0", what, round, (unsigned)got, (unsigned)want);
}

static void check_frame(const skv_frame *frame, int round, size_t n, int lengths) {
    const skv_rays rays = {direction[0], 0, lengths ? length_km : NULL, 0};
    const skv_sky sky = {radiance[0], sizeof radiance[0], NULL, 0};
    skv_work work;
    memset(&counted, 0, sizeof counted);
    assert_int_equal(skv_radiance(frame, n, &rays, &sky), SKV_OK);
    assert_int_equal(skv_radiance_work(frame, n, &rays, &work), SKV_OK);
    compare("runs", round, work.runs, counted.runs);
    compare("legs", round, work.legs, counted.legs);
    compare("low_runs", round, work.low_runs, counted.low_runs);
    compare("low_legs", round, work.low_legs, counted.low_legs);
    compare("diffuse_nodes", round, work.diffuse_nodes, counted.diffuse_nodes);
    compare("diffuse_fine", round, work.diffuse_fine, counted.diffuse_fine);
    compare("diffuse_fading", round, work.diffuse_fading, counted.diffuse_fading);
    compare("diffuse_loads", round, work.diffuse_loads, counted.diffuse_loads);
}

static void test_exact(void **unused) {
    static skv_model model;
    skv_atmosphere air;
    skv_table_spec spec;
    skv_table *const table = (skv_table *)(void *)table_store;
    (void)unused;
    unsigned legs = 0, nodes = 0;
    for (int round = 0; round < 60; round++) {
        state = (uint32_t)round + 1u;
        const skv_preset presets[4] = {SKV_PRESET_EARTH_CLEAR, SKV_PRESET_EARTH_HAZY, SKV_PRESET_EARTH_SMOKE,
                                       SKV_PRESET_EARTH_DENSE};
        if (round % 15 == 0) {
            assert_int_equal(skv_atmosphere_preset(&air, presets[round / 15], 3 + round % 2), SKV_OK);
            assert_int_equal(skv_model_build(&model, &air), SKV_OK);
            assert_int_equal(skv_table_spec_for(&spec, &model, SKV_TABLE_ACCURATE), SKV_OK);
            spec.orders = spec.polar[0] = spec.polar[1] = spec.azimuths[0] = spec.azimuths[1] = 2;
            assert_int_equal(skv_table_build(table, sizeof table_store, work_store, sizeof work_store, &model, &spec),
                             SKV_OK);
        }
        skv_frame frame;
        skv_light sun;
        const float up = 1.2f * uniform() - 0.25f, turn = uniform();
        const float toward[3] = {turn, 1.0f - turn, up};
        for (int i = 0; i < RAYS; i++) {
            direction[i][0] = uniform() - 0.5f;
            direction[i][1] = uniform() - 0.5f;
            direction[i][2] = round % 3 == 0 ? uniform() : uniform() - 0.5f;
            length_km[i] = uniform() < 0.3f ? 0.0f : 300.0f * uniform();
        }
        assert_int_equal(skv_light_sun(&sun, &model, toward), SKV_OK);
        const float height = round % 5 == 4 ? 300.0f * uniform() : 14.0f * uniform() * uniform();
        assert_int_equal(skv_frame_begin(&frame, &model, NULL, height, 0.0f, &sun, 1), SKV_OK);
        check_frame(&frame, round, RAYS - (size_t)(round % 11), round % 2);
        assert_int_equal(skv_frame_table(&frame, table), SKV_OK);
        check_frame(&frame, round, (size_t)(1 + round), round % 4 == 1);
        legs += counted.legs;
        nodes += counted.diffuse_nodes;
    }
    assert_true(legs > 1000 && nodes > 1000); // the frames did have work
}

static void test_status(void **unused) {
    skv_frame none;
    skv_work work;
    const skv_rays rays = {direction[0], 0, NULL, 0};
    (void)unused;
    memset(&none, 0, sizeof none);
    assert_int_equal(skv_radiance_work(NULL, 1, &rays, &work), SKV_ERR_NULL);
    assert_int_equal(skv_radiance_work(&none, 1, NULL, &work), SKV_ERR_NULL);
    assert_int_equal(skv_radiance_work(&none, 1, &rays, NULL), SKV_ERR_NULL);
    assert_int_equal(skv_radiance_work(&none, 1, &rays, &work), SKV_ERR_LAYOUT);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_exact), cmocka_unit_test(test_status)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
