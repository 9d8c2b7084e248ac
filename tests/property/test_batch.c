/// A ray's result is its own: the same bits alone or anywhere in a batch, packed or in interleaved vertices, whatever
/// its neighbours are; two lights add up.
#if defined(__SSE__)
#include <xmmintrin.h>
#endif

#include "air.h"

#define RAYS 131

static float view[RAYS][3], length[RAYS];

static void lay_rays(void) {
    uint64_t random = 88172645463325252ULL;
    for (int i = 0; i < RAYS; i++) {
        direction_of(view[i], i % 3 ? 85 + 12 * random_unit(&random) : 180 * random_unit(&random),
                     360 * random_unit(&random));
        length[i] = i % 5 ? INFINITY : (float)(300 * random_unit(&random));
        for (int k = 0; k < 3; k++)
            view[i][k] *= (float)(0.1 + 3 * random_unit(&random));
    }
    view[17][1] = NAN;
    memset(view[64], 0, sizeof view[64]);
    length[100] = -1;
}

static const struct {
    skv_rule rule;
    skv_depth depth;
    int samples, depth_samples;
} qualities[] = {{SKV_GAUSS_EXP, SKV_DEPTH_BY_CHAPMAN, 4, 1},
                 {SKV_GAUSS_EXP, SKV_DEPTH_BY_CHAPMAN, 7, 1},
                 {SKV_GAUSS_EXP, SKV_DEPTH_BY_INNER, 4, 4},
                 {SKV_KELLER, SKV_DEPTH_BY_INNER, 5, 5},
                 {SKV_UNIFORM, SKV_DEPTH_BY_CHAPMAN, 5, 1}};
#define QUALITIES 5
static const float heights[] = {0, 1, 30, 90};
static const double suns[] = {30, 91, 95};
#define CASES (QUALITIES * 4 * 3)

static air airs[2];

static int make_airs(void **state) {
    (void)state;
    air_make(&airs[0], "clear", air_clear(4), 0);
    air_make(&airs[1], "shaped", air_shaped(3), 0);
    lay_rays();
    return 0;
}

static void frame_number(skv_frame *frame, int n) {
    float sun[3];
    skv_quality q = quality_of(qualities[n % QUALITIES].rule, qualities[n % QUALITIES].depth,
                               qualities[n % QUALITIES].samples, qualities[n % QUALITIES].depth_samples);
    q.terms = SKV_WITH_ALL;
    direction_of(sun, suns[n / QUALITIES % 3], 20);
    frame_of(frame, &airs[n % 2], &q, heights[n / QUALITIES / 3], sun);
}

typedef struct result {
    float radiance[4], through[4];
} result;

static void shine(const skv_frame *frame, int first, int n, result *out) {
    const skv_rays rays = {view[first], 0, length + first, 0};
    const skv_sky sky = {out[0].radiance, sizeof *out, out[0].through, sizeof *out};
    memset(out, 0, (size_t)n * sizeof *out);
    const skv_status status = skv_radiance(frame, (size_t)n, &rays, &sky);
    if (status != SKV_OK && status != SKV_ERR_DIRECTION)
        fail_msg("skv_radiance: status %d", (int)status);
}

static void same(const char *what, int frame, int ray, const result *got, const result *want) {
    if (memcmp(got, want, sizeof *got) != 0)
        fail_msg("%s: frame %d, ray %d: radiance %.9g, want %.9g, transmittance %.9g, want %.9g", what, frame, ray,
                 (double)got->radiance[0], (double)want->radiance[0], (double)got->through[0],
                 (double)want->through[0]);
}

static void position_in_the_batch_does_not_matter(void **state) {
    static result whole[RAYS], part[RAYS];
    (void)state;
    for (int n = 0; n < CASES; n++) {
        skv_frame frame;
        frame_number(&frame, n);
        shine(&frame, 0, RAYS, whole);
        for (int i = 0; i < RAYS; i++) {
            shine(&frame, i, 1, part);
            same("alone", n, i, part, &whole[i]);
        }
        for (int first = 1; first < 40; first += 3) {
            shine(&frame, first, RAYS - first - first % 7, part);
            for (int i = 0; i < RAYS - first - first % 7; i++)
                same("shifted", n, first + i, &part[i], &whole[first + i]);
        }
    }
}

typedef struct vertex {
    float before;
    float radiance[4];
    float direction[3];
    float between;
    float through[4];
    float length;
    float after[3];
} vertex;

// Directions, lengths and results are fields of the caller's vertices: other fields stay as they are.
static void interleaved_vertices(void **state) {
    static result whole[RAYS];
    static vertex mesh[RAYS + 1];
    (void)state;
    for (int n = 0; n < CASES; n++) {
        skv_frame frame;
        frame_number(&frame, n);
        const int bands = frame.model->bands;
        shine(&frame, 0, RAYS, whole);
        memset(mesh, 0x55, sizeof mesh);
        const vertex untouched = mesh[RAYS];
        for (int i = 0; i < RAYS; i++) {
            memcpy(mesh[i].direction, view[i], sizeof view[i]);
            mesh[i].length = length[i];
        }
        const skv_rays rays = {mesh[0].direction, sizeof *mesh, &mesh[0].length, sizeof *mesh};
        const skv_sky sky = {mesh[0].radiance, sizeof *mesh, mesh[0].through, sizeof *mesh};
        assert_int_equal(skv_radiance(&frame, RAYS, &rays, &sky), SKV_ERR_DIRECTION);
        for (int i = 0; i < RAYS; i++) {
            result got = {{0}, {0}};
            memcpy(got.radiance, mesh[i].radiance, (size_t)bands * sizeof(float));
            memcpy(got.through, mesh[i].through, (size_t)bands * sizeof(float));
            same("interleaved", n, i, &got, &whole[i]);
            vertex other = mesh[i];
            memcpy(other.radiance, untouched.radiance, (size_t)bands * sizeof(float));
            memcpy(other.through, untouched.through, (size_t)bands * sizeof(float));
            memcpy(other.direction, untouched.direction, sizeof other.direction);
            other.length = untouched.length;
            if (memcmp(&other, &untouched, sizeof other) != 0 ||
                memcmp(mesh[i].direction, view[i], sizeof view[i]) != 0)
                fail_msg("frame %d, vertex %d: a field that is not an output was written", n, i);
        }
        if (memcmp(&mesh[RAYS], &untouched, sizeof untouched) != 0)
            fail_msg("frame %d: written beyond the last vertex", n);
    }
}

// Without transmittance and without lengths the radiance is the same.
static void optional_fields(void **state) {
    static result whole[RAYS];
    static float radiance[RAYS][4], packed[RAYS * 4], far_away[RAYS];
    (void)state;
    for (int i = 0; i < RAYS; i++)
        far_away[i] = INFINITY;
    for (int n = 0; n < CASES; n++) {
        skv_frame frame;
        frame_number(&frame, n);
        const size_t bands = (size_t)frame.model->bands;
        const skv_rays rays = {view[0], 0, far_away, 0}, short_form = {view[0], 0, NULL, 0};
        const skv_sky sky = {whole[0].radiance, sizeof *whole, whole[0].through, sizeof *whole};
        const skv_sky no_through = {radiance[0], sizeof radiance[0], NULL, 0}, tight = {packed, 0, NULL, 0};
        skv_radiance(&frame, RAYS, &rays, &sky);
        skv_radiance(&frame, RAYS, &short_form, &no_through);
        skv_radiance(&frame, RAYS, &short_form, &tight);
        for (size_t i = 0; i < RAYS; i++)
            if (memcmp(whole[i].radiance, radiance[i], bands * sizeof(float)) != 0 ||
                memcmp(whole[i].radiance, packed + i * bands, bands * sizeof(float)) != 0)
                fail_msg("frame %d, ray %d: %.9g, %.9g, %.9g", n, (int)i, (double)whole[i].radiance[0],
                         (double)radiance[i][0], (double)packed[i * bands]);
    }
}

static void nothing_is_written_for_no_rays_or_bad_strides(void **state) {
    float out[8] = {1, 2, 3, 4, 5, 6, 7, 8};
    const float want[8] = {1, 2, 3, 4, 5, 6, 7, 8};
    skv_frame frame;
    (void)state;
    frame_number(&frame, 0);
    const skv_rays rays = {view[0], 0, NULL, 0}, odd_rays = {view[0], 13, NULL, 0}, short_rays = {view[0], 8, NULL, 0};
    const skv_sky sky = {out, 0, NULL, 0}, odd = {out, 17, NULL, 0}, brief = {out, 12, NULL, 0};
    assert_int_equal(skv_radiance(&frame, 0, &rays, &sky), SKV_OK);
    assert_int_equal(skv_radiance(&frame, 2, &odd_rays, &sky), SKV_ERR_SIZE);
    assert_int_equal(skv_radiance(&frame, 2, &short_rays, &sky), SKV_ERR_SIZE);
    assert_int_equal(skv_radiance(&frame, 2, &rays, &odd), SKV_ERR_SIZE);
    assert_int_equal(skv_radiance(&frame, 2, &rays, &brief), SKV_ERR_SIZE); // four bands need 16 bytes
    assert_true(memcmp(out, want, sizeof out) == 0);
}

// Light is linear: both lights together give the sum. 1e-6: a few roundings of float.
static void lights_add_up(void **state) {
    (void)state;
#if SKV_LIGHTS_MAX >= 2
    static float one[RAYS][4], two[RAYS][4], both[RAYS][4];
    skv_light lights[2];
    skv_quality q = quality_of(SKV_GAUSS_EXP, SKV_DEPTH_BY_CHAPMAN, 6, 1);
    q.terms = SKV_WITH_ALL;
    for (int n = 0; n < 8; n++) {
        skv_frame frame;
        float direction[3];
        const skv_rays rays = {view[0], 0, length, 0};
        float(*out[3])[4] = {one, two, both};
        for (int k = 0; k < 2; k++) {
            direction_of(direction, k ? 50 + 6 * n : 96 - 10 * n, 77 * k);
            must(skv_light_sun(&lights[k], &airs[0].model, direction), "skv_light_sun");
        }
        for (int k = 0; k < 3; k++) {
            const skv_sky sky = {out[k][0], sizeof out[k][0], NULL, 0};
            must(skv_frame_begin(&frame, &airs[0].model, &q, heights[n % 4], 0, lights + k % 2, k == 2 ? 2 : 1),
                 "skv_frame_begin");
            skv_radiance(&frame, RAYS, &rays, &sky);
        }
        for (int i = 0; i < RAYS * 4; i++) {
            const double sum = (double)one[i / 4][i % 4] + (double)two[i / 4][i % 4];
            check_near("two lights", (double)both[i / 4][i % 4], sum, 1e-6 * sum);
        }
    }
#else
    skip();
#endif
}

// A direction may have any length, also with subnormals flushed to zero. Powers of two change no bit of it; 1e-4 is
// left for the largest floats, whose inverse is subnormal.
static void length_of_a_direction(void) {
    static const float scales[] = {0x1p-100f, 0x1p-30f, 0x1p60f, 0x1p100f, 0x1p125f, 0x1.8p126f};
    static float long_view[RAYS][3], got[RAYS][4], want[RAYS][4];
    const skv_rays rays = {view[0], 0, NULL, 0}, long_rays = {long_view[0], 0, NULL, 0};
    const skv_sky sky = {want[0], sizeof want[0], NULL, 0}, long_sky = {got[0], sizeof got[0], NULL, 0};
    skv_frame frame;
    frame_number(&frame, 30);
    skv_radiance(&frame, RAYS, &rays, &sky);
    for (int n = 0; n < 6; n++) {
        for (int i = 0; i < RAYS * 3; i++)
            long_view[i / 3][i % 3] = view[i / 3][i % 3] * (scales[n] / 4);
        const skv_status status = skv_radiance(&frame, RAYS, &long_rays, &long_sky);
        if (status != SKV_ERR_DIRECTION)
            fail_msg("scale %g: status %d, wanted SKV_ERR_DIRECTION of the two bad rays", (double)scales[n],
                     (int)status);
        for (int i = 0; i < RAYS; i++)
            if (!(fabsf(got[i][0] - want[i][0]) <= 1e-4f * want[i][0]))
                fail_msg("direction times %g, ray %d: radiance %.9g, want %.9g", (double)scales[n] / 4, i,
                         (double)got[i][0], (double)want[i][0]);
    }
}

static void any_length_of_direction(void **state) {
    (void)state;
    length_of_a_direction();
#if defined(__SSE__)
    const unsigned mode = _mm_getcsr();
    _mm_setcsr(mode | 0x8040); // FTZ, DAZ
    length_of_a_direction();
    _mm_setcsr(mode);
#endif
}

static int restore(void **state) {
    (void)state;
#if defined(__SSE__)
    _mm_setcsr(0x1f80);
#endif
    return 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(position_in_the_batch_does_not_matter),
        cmocka_unit_test(interleaved_vertices),
        cmocka_unit_test(optional_fields),
        cmocka_unit_test(nothing_is_written_for_no_rays_or_bad_strides),
        cmocka_unit_test(lights_add_up),
        cmocka_unit_test_teardown(any_length_of_direction, restore),
    };
    return cmocka_run_group_tests(tests, make_airs, NULL);
}
