// Projections against directions worked out by hand: where zenith, horizon and the four winds lie in each picture.
#include <math.h>
#include <string.h>

#include "check.h"
#include "tools/skyvert/projection.h"

/// Rounding of a unit vector to float, and of a few sines before.
#define FLOAT_ERROR 3e-7

static void expect(const projection *map, const char *what, double x, double y, double east, double north, double up) {
    float d[3] = {0.0f, 0.0f, 0.0f};
    const double cover = projection_direction(map, x, y, d);
    print_message("%s: covered %g\n", what, cover);
    assert_true(cover > 0.0);
    check_near(what, (double)d[0], east, FLOAT_ERROR);
    check_near(what, (double)d[1], north, FLOAT_ERROR);
    check_near(what, (double)d[2], up, FLOAT_ERROR);
}

/// 101 x 101: the centre is pixel 50, the circle's radius 50.5 pixels.
static void test_fisheye(void **state) {
    (void)state;
    projection map = {.kind = PROJECTION_FISHEYE, .width = 101, .height = 101, .fov_deg = 180.0};
    projection_prepare(&map);
    const double half = sqrt(0.5), r = 50.5;
    expect(&map, "zenith in the centre", 50, 50, 0, 0, 1);
    expect(&map, "north up", 50, 50 - r, 0, 1, 0);
    expect(&map, "south down", 50, 50 + r, 0, -1, 0);
    expect(&map, "east left", 50 - r, 50, 1, 0, 0);
    expect(&map, "west right", 50 + r, 50, -1, 0, 0);
    expect(&map, "45 degrees at half the radius", 50, 50 - r / 2, 0, half, half);
    expect(&map, "northeast, upper left", 50 - r * half, 50 - r * half, half, half, 0);
    float d[3];
    check_near("corner not covered", projection_direction(&map, 0, 0, d), 0.0, 0.0);
    check_near("edge half covered", projection_direction(&map, 50, 50 - r, d), 0.5, 1e-12); // on the circle itself
}

static void test_fisheye_wide(void **state) {
    (void)state;
    projection map = {.kind = PROJECTION_FISHEYE, .width = 300, .height = 101, .fov_deg = 360.0};
    projection_prepare(&map);
    expect(&map, "centre of a wide picture", 149.5, 50, 0, 0, 1);
    expect(&map, "horizon at half the radius", 149.5, 50 - 50.5 / 2, 0, 1, 0);
    expect(&map, "nadir on the circle", 149.5 + 50.5, 50, 0, 0, -1);
}

/// [OpenEXR] technical introduction: latitude pi/2 - pi y/(H-1), longitude pi - 2 pi x/(W-1), longitude 0 = +Z = north,
/// pi/2 = +X = west.
static void test_latlong(void **state) {
    (void)state;
    projection map = {.kind = PROJECTION_LATLONG, .width = 361, .height = 181};
    projection_prepare(&map);
    expect(&map, "north in the centre", 180, 90, 0, 1, 0);
    expect(&map, "east three quarters from the left", 270, 90, 1, 0, 0);
    expect(&map, "west a quarter from the left", 90, 90, -1, 0, 0);
    expect(&map, "south at the left end", 0, 90, 0, -1, 0);
    expect(&map, "south at the right end", 360, 90, 0, -1, 0);
    expect(&map, "zenith on top", 77, 0, 0, 0, 1);
    expect(&map, "nadir at the bottom", 300, 180, 0, 0, -1);
    expect(&map, "30 degrees up in the east", 270, 60, sqrt(0.75), 0, 0.5);
}

static void test_perspective(void **state) {
    (void)state;
    projection map = {.kind = PROJECTION_PERSPECTIVE, .width = 101, .height = 51, .fov_deg = 90.0};
    const double half = sqrt(0.5), edge = 0.5 * 101; // half the width in pixels
    projection_prepare(&map);
    expect(&map, "north in the centre", 50, 25, 0, 1, 0);
    expect(&map, "east right, half the field of view", 50 + edge, 25, half, half, 0);
    expect(&map, "up", 50, 25 - edge, 0, half, half);
    map.azimuth_deg = 90.0;
    map.elevation_deg = 30.0;
    projection_prepare(&map);
    expect(&map, "east, 30 degrees up", 50, 25, sqrt(0.75), 0, 0.5);
    expect(&map, "south right of east", 50 + edge, 25, sqrt(0.75) * half, -half, 0.5 * half);
    map.elevation_deg = 90.0;
    projection_prepare(&map);
    expect(&map, "zenith", 50, 25, 0, 0, 1);
}

/// The weights of a picture sum to the solid angle it covers, up to one common factor.
static void test_weights(void **state) {
    (void)state;
    projection map = {.kind = PROJECTION_LATLONG, .width = 361, .height = 181};
    projection_prepare(&map);
    double cap = 0.0, all = 0.0;
    for (int y = 0; y < map.height; y++) {
        const double weight = projection_weight(&map, 5, y);
        all += weight;
        cap += y < 60 ? weight : y == 60 ? 0.5 * weight : 0.0;
    }
    check_near("latlong: share of the cap above 30 degrees", cap / all, 0.25, 1e-4); // trapezoid rule, 1 degree
    map = (projection){.kind = PROJECTION_FISHEYE, .width = 401, .height = 401, .fov_deg = 180.0};
    projection_prepare(&map);
    cap = all = 0.0;
    for (int i = 0; i < 401 * 401; i++) {
        float d[3];
        const double cover = projection_direction(&map, i % 401, i / 401, d);
        const double weight = cover > 0.0 ? cover * projection_weight(&map, i % 401, i / 401) : 0.0;
        all += weight;
        cap += cover > 0.0 && d[2] > 0.5f ? weight : 0.0;
    }
    check_near("fisheye: share of the cap above 30 degrees", cap / all, 0.5, 2e-3); // pixels cut by the circle
}

/// Largest angle between pixels side by side or one above the other.
static double widest(const projection *map) {
    double most = 0.0;
    for (int y = 0; y + 1 < map->height; y++)
        for (int x = 0; x + 1 < map->width; x++) {
            float here[3], next[2][3];
            if (!(projection_direction(map, x, y, here) > 0.0 && projection_direction(map, x + 1, y, next[0]) > 0.0 &&
                  projection_direction(map, x, y + 1, next[1]) > 0.0))
                continue;
            for (int k = 0; k < 2; k++) {
                const double d[3] = {(double)here[0] - (double)next[k][0], (double)here[1] - (double)next[k][1],
                                     (double)here[2] - (double)next[k][2]};
                most = fmax(most, sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]));
            }
        }
    return 2.0 * asin(0.5 * most);
}

/// The spacing that discs are spread over is that of the pixels themselves.
static void test_spacing(void **state) {
    (void)state;
    projection map = {.kind = PROJECTION_FISHEYE, .width = 101, .height = 121, .fov_deg = 180.0};
    projection_prepare(&map);
    check_near("fisheye: spacing", projection_spacing(&map) / widest(&map), 1.0, 0.01); // chords of a degree and a half
    map = (projection){.kind = PROJECTION_LATLONG, .width = 100, .height = 61};
    projection_prepare(&map);
    check_near("latlong: spacing", projection_spacing(&map) / widest(&map), 1.0, 0.01);
    map = (projection){.kind = PROJECTION_PERSPECTIVE, .width = 81, .height = 41, .fov_deg = 60.0};
    projection_prepare(&map);
    check_near("perspective: spacing", projection_spacing(&map) / widest(&map), 1.0, 0.01);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_fisheye),     cmocka_unit_test(test_fisheye_wide), cmocka_unit_test(test_latlong),
        cmocka_unit_test(test_perspective), cmocka_unit_test(test_weights),      cmocka_unit_test(test_spacing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
