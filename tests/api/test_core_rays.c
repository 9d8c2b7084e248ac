/// skv_radiance() as a call: pointers, layouts, strides, refused rays, and results in the caller's own vertices.
#include "core_air.h"

#define COUNT(a) ((int)(sizeof(a) / sizeof((a)[0])))
#define GUARD    0xa5
#define RAYS     21

static skv_model model;
static float view[RAYS][3], length[RAYS];

static const skv_quality qualities[] = {
    {SKV_GAUSS_EXP, SKV_DEPTH_BY_CHAPMAN, 6, 1, SKV_WITH_ALL},
    {SKV_GAUSS_EXP, SKV_DEPTH_BY_INNER, 4, 4, SKV_WITH_ALL},
    {SKV_KELLER, SKV_DEPTH_BY_INNER, 4, 4, SKV_WITH_ALL},
    {SKV_UNIFORM, SKV_DEPTH_BY_CHAPMAN, 4, 1, SKV_WITH_ALL},
};
static const struct { double observer_km, sun_deg; } scenes[] = {{0, 40}, {5, 93}, {80, 70}};
#define FRAMES (COUNT(qualities) * COUNT(scenes))

static int build_model(void **state) {
    (void)state;
    const skv_atmosphere a = air_br17o();
    build(&model, &a);
    for (int i = 0; i < RAYS; i++) {
        toward(view[i], 180.0 * i / (RAYS - 1), 77.0 * i);
        for (int c = 0; c < 3; c++)
            view[i][c] *= 0.3f * (float)(i + 1); // any length
        length[i] = i % 4 == 3 ? 7.5f * (float)i : INFINITY;
    }
    return 0;
}

static void begin_number(skv_frame *frame, int n) {
    const int scene = n / COUNT(qualities);
    begin(frame, &model, &qualities[n % COUNT(qualities)], scenes[scene].observer_km, 0, scenes[scene].sun_deg);
}

static void check_untouched(const char *what, const void *memory, size_t bytes) {
    for (size_t i = 0; i < bytes; i++)
        if (((const unsigned char *)memory)[i] != GUARD)
            fail_msg("%s: byte %d of %d was written", what, (int)i, (int)bytes);
}

/// What is written in one call, with guards around it.
static float radiance[RAYS + 2][4], transmittance[RAYS + 2][4];

static void call(const char *what, const skv_frame *frame, size_t n, const skv_rays *rays, const skv_sky *sky,
                 skv_status want) {
    memset(radiance, GUARD, sizeof radiance);
    memset(transmittance, GUARD, sizeof transmittance);
    check_status(what, skv_radiance(frame, n, rays, sky), want);
    if (want != SKV_OK || n == 0) {
        check_untouched(what, radiance, sizeof radiance);
        check_untouched(what, transmittance, sizeof transmittance);
    }
}

static void pointers_layouts_and_strides(void **state) {
    (void)state;
    skv_frame frame, other;
    static skv_model unbuilt;
    begin_number(&frame, 0);
    const skv_rays rays = {view[0], 0, length, 0};
    const skv_sky sky = {radiance[1], 0, transmittance[1], 0};
    skv_rays r = rays;
    skv_sky s = sky;
    call("no frame", NULL, RAYS, &rays, &sky, SKV_ERR_NULL);
    call("no rays", &frame, RAYS, NULL, &sky, SKV_ERR_NULL);
    call("no sky", &frame, RAYS, &rays, NULL, SKV_ERR_NULL);
    r.direction_enu = NULL;
    call("no directions", &frame, RAYS, &r, &sky, SKV_ERR_NULL);
    s.radiance = NULL;
    call("no radiance", &frame, RAYS, &rays, &s, SKV_ERR_NULL);
    memset(&other, 0, sizeof other);
    call("zeroed frame", &other, RAYS, &rays, &sky, SKV_ERR_LAYOUT);
    other = frame;
    other.layout ^= 2;
    call("another layout", &other, RAYS, &rays, &sky, SKV_ERR_LAYOUT);
    other = frame;
    other.model = NULL;
    call("no model", &other, RAYS, &rays, &sky, SKV_ERR_LAYOUT);
    other.model = &unbuilt;
    call("zeroed model", &other, RAYS, &rays, &sky, SKV_ERR_LAYOUT);
    call("no ray", &frame, 0, &rays, &sky, SKV_OK);
    call("all right", &frame, RAYS, &rays, &sky, SKV_OK);
    for (int k = 0; k < 4; k++) {
        static const size_t fields[4] = {12, 4, 16, 16};
        static const size_t wrong[] = {1, 2, 3, 5, 6, 13, 17, 18, 19, 4, 8, 12};
        for (int i = 0; i < COUNT(wrong); i++) {
            size_t *stride[4] = {&r.direction_stride, &r.length_stride, &s.radiance_stride, &s.transmittance_stride};
            r = rays;
            s = sky;
            *stride[k] = wrong[i];
            if (wrong[i] % 4 != 0 || wrong[i] < fields[k])
                call("stride", &frame, RAYS, &r, &s, SKV_ERR_SIZE);
            *stride[k] = fields[k];
            call("packed stride", &frame, RAYS, &r, &s, SKV_OK);
        }
    }
    // Nothing before or behind the results of n rays.
    check_untouched("before", radiance[0], sizeof radiance[0]);
    check_untouched("behind", radiance[RAYS + 1], sizeof radiance[0]);
    check_untouched("before", transmittance[0], sizeof transmittance[0]);
    check_untouched("behind", transmittance[RAYS + 1], sizeof transmittance[0]);
}

static void shine_all(const skv_frame *frame, int n, const float from[][3], const float lengths[], shone out[],
                      skv_status want) {
    const skv_rays rays = {from[0], 0, lengths, 0};
    const skv_sky sky = {out[0].radiance, sizeof out[0], out[0].transmittance, sizeof out[0]};
    check_status("skv_radiance", skv_radiance(frame, (size_t)n, &rays, &sky), want);
}

/// A refused ray is 0 and all others have the bits of a batch in which it never was.
static void refused_rays(void **state) {
    (void)state;
    static const struct {
        float direction[3], length;
    } bad[] = {{{0, 0, 0}, INFINITY},         {{NAN, 0, 1}, 1},       {{0, INFINITY, 0}, 2},
               {{0, 1, -INFINITY}, INFINITY}, {{0, 0, 1}, -1},        {{0, 0.6f, 0.8f}, NAN},
               {{1, 0, 0}, -INFINITY},        {{-0.0f, 0, -0.0f}, 3}, {{NAN, NAN, NAN}, NAN}};
    static const int places[] = {0, 7, 8, 13, RAYS - 1};
    static float mixed[RAYS][3], mixed_length[RAYS];
    static shone with[RAYS], without[RAYS];
    for (int n = 0; n < FRAMES; n++)
        for (int i = 0; i < COUNT(bad) * COUNT(places); i++) {
            const int place = places[i / COUNT(bad)], kind = i % COUNT(bad);
            skv_frame frame;
            begin_number(&frame, n);
            memcpy(mixed, view, sizeof mixed);
            memcpy(mixed_length, length, sizeof mixed_length);
            memmove(mixed[place], mixed[place + 1], sizeof mixed[0] * (size_t)(RAYS - 1 - place));
            memmove(&mixed_length[place], &mixed_length[place + 1], sizeof(float) * (size_t)(RAYS - 1 - place));
            shine_all(&frame, RAYS - 1, (const float(*)[3])mixed, mixed_length, without, SKV_OK);
            memcpy(mixed, view, sizeof mixed);
            memcpy(mixed_length, length, sizeof mixed_length);
            memcpy(mixed[place], bad[kind].direction, sizeof mixed[0]);
            mixed_length[place] = bad[kind].length;
            memset(with, GUARD, sizeof with);
            shine_all(&frame, RAYS, (const float(*)[3])mixed, mixed_length, with, SKV_ERR_DIRECTION);
            for (int k = 0; k < RAYS; k++) {
                const shone none = {{0, 0, 0, 0}, {0, 0, 0, 0}};
                if (k == place)
                    check_same_bits("the refused ray", &with[k], &none);
                else
                    check_same_bits("its neighbours", &with[k], &without[k < place ? k : k - 1]);
            }
        }
}

/// A caller's vertex.
typedef struct vertex {
    float uv[2];
    float position[3];
    float length_km;
    unsigned char rgba[4];
    float radiance[4];
    float normal[3];
    float transmittance[4];
    float tail;
} vertex;

static vertex vertices[RAYS];

/// In place in interleaved vertices: the bits of packed arrays, and no other field is touched.
static void interleaved_vertices(void **state) {
    (void)state;
    static shone packed[RAYS];
    for (int n = 0; n < FRAMES; n++) {
        skv_frame frame;
        begin_number(&frame, n);
        shine_all(&frame, RAYS, (const float(*)[3])view, length, packed, SKV_OK);
        memset(vertices, GUARD, sizeof vertices);
        for (int i = 0; i < RAYS; i++) {
            memcpy(vertices[i].position, view[i], sizeof view[i]);
            vertices[i].length_km = length[i];
        }
        const skv_rays rays = {vertices[0].position, sizeof(vertex), &vertices[0].length_km, sizeof(vertex)};
        const skv_sky sky = {vertices[0].radiance, sizeof(vertex), vertices[0].transmittance, sizeof(vertex)};
        check_status("skv_radiance", skv_radiance(&frame, RAYS, &rays, &sky), SKV_OK);
        for (int i = 0; i < RAYS; i++) {
            shone got;
            memcpy(got.radiance, vertices[i].radiance, sizeof got.radiance);
            memcpy(got.transmittance, vertices[i].transmittance, sizeof got.transmittance);
            check_same_bits("vertex", &got, &packed[i]);
            assert_true(memcmp(vertices[i].position, view[i], sizeof view[i]) == 0);
            assert_true(memcmp(&vertices[i].length_km, &length[i], sizeof length[i]) == 0);
            check_untouched("uv", vertices[i].uv, sizeof vertices[i].uv);
            check_untouched("rgba", vertices[i].rgba, sizeof vertices[i].rgba);
            check_untouched("normal", vertices[i].normal, sizeof vertices[i].normal);
            check_untouched("tail", &vertices[i].tail, sizeof vertices[i].tail);
        }
    }
}

/// No lengths is all infinite; no transmittance changes no radiance; a ray alone is a ray among others.
static void optional_fields_and_single_rays(void **state) {
    (void)state;
    static shone endless[RAYS], none[RAYS];
    static float infinite[RAYS];
    for (int i = 0; i < RAYS; i++)
        infinite[i] = INFINITY;
    for (int n = 0; n < FRAMES; n++) {
        skv_frame frame;
        begin_number(&frame, n);
        shine_all(&frame, RAYS, (const float(*)[3])view, infinite, endless, SKV_OK);
        shine_all(&frame, RAYS, (const float(*)[3])view, NULL, none, SKV_OK);
        memset(radiance, GUARD, sizeof radiance);
        const skv_rays rays = {view[0], 0, NULL, 0};
        const skv_sky sky = {radiance[1], 0, NULL, 0};
        check_status("radiance only", skv_radiance(&frame, RAYS, &rays, &sky), SKV_OK);
        for (int i = 0; i < RAYS; i++) {
            const shone alone = shine(&frame, view[i], INFINITY);
            check_same_bits("no lengths", &none[i], &endless[i]);
            check_same_bits("alone", &alone, &endless[i]);
            assert_true(memcmp(radiance[i + 1], endless[i].radiance, sizeof radiance[0]) == 0);
        }
        check_untouched("behind", radiance[RAYS + 1], sizeof radiance[0]);
    }
}

/// Three bands: three floats a ray, packed or not.
static void three_bands(void **state) {
    (void)state;
    static skv_model three;
    skv_atmosphere a = air_br17o();
    a.bands = 3;
    build(&three, &a);
    skv_frame four_frame, frame;
    const skv_quality keller = qualities[2];
    begin(&four_frame, &model, &keller, 1, 0, 60);
    begin(&frame, &three, &keller, 1, 0, 60);
    const skv_rays rays = {view[0], 0, length, 0};
    float *const out = radiance[0], *const through = transmittance[0];
    memset(radiance, GUARD, sizeof radiance);
    memset(transmittance, GUARD, sizeof transmittance);
    const skv_sky sky = {out, 0, through, 12};
    check_status("three bands", skv_radiance(&frame, RAYS, &rays, &sky), SKV_OK);
    for (int i = 0; i < RAYS; i++) {
        // Rules without a map that depends on the bands give each band its own bits.
        const shone want = shine(&four_frame, view[i], length[i]);
        assert_true(memcmp(out + 3 * i, want.radiance, 12) == 0 &&
                    memcmp(through + 3 * i, want.transmittance, 12) == 0);
    }
    check_untouched("behind", out + (size_t)3 * RAYS, sizeof radiance - sizeof(float) * 3 * RAYS);
    check_untouched("behind", through + (size_t)3 * RAYS, sizeof transmittance - sizeof(float) * 3 * RAYS);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pointers_layouts_and_strides),
        cmocka_unit_test(refused_rays),
        cmocka_unit_test(interleaved_vertices),
        cmocka_unit_test(optional_fields_and_single_rays),
        cmocka_unit_test(three_bands),
    };
    return cmocka_run_group_tests(tests, build_model, NULL);
}
