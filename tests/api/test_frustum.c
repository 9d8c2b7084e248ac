/// The frustum test against brute force in double.
#include "check.h"
#include "random.h"
#include "vectors.h"

#include "skyvert/dome.h"

/// Of a dome of 12 rings and 20 columns.
#define VERTICES 241

static float direction[VERTICES][3];

static skv_frustum random_frustum(void) {
    double f[3], u[3];
    skv_frustum frustum;
    random_direction(f);
    random_direction(u);
    const double length = pow(10, random_in(-10, 10));
    for (int c = 0; c < 3; c++) {
        frustum.forward_enu[c] = (float)(f[c] * length);
        frustum.up_enu[c] = (float)u[c];
    }
    frustum.tan_left = (float)tan(random_in(0.05, 1.4));
    frustum.tan_right = random_int(0, 1) ? frustum.tan_left : (float)tan(random_in(0.05, 1.4));
    frustum.tan_down = (float)tan(random_in(0.05, 1.4));
    frustum.tan_up = (float)tan(random_in(0.05, 1.4));
    frustum.margin_rad = random_int(0, 1) ? 0.0f : (float)random_in(0, 1);
    return frustum;
}

typedef struct axes {
    double forward[3], right[3], up[3];
} axes;

static axes axes_of(const skv_frustum *f) {
    axes a;
    double up[3];
    for (int c = 0; c < 3; c++) {
        a.forward[c] = (double)f->forward_enu[c];
        up[c] = (double)f->up_enu[c];
    }
    normalise(a.forward);
    cross(a.forward, up, a.right);
    normalise(a.right);
    cross(a.right, a.forward, a.up);
    return a;
}

/// How far inside the pyramid a direction is, as a tangent; negative outside.
static double inside_by(const skv_frustum *f, const axes *a, const double v[3]) {
    const double z = dot(v, a->forward), x = dot(v, a->right) / z, y = dot(v, a->up) / z;
    if (z <= 0)
        return z - 1;
    return fmin(fmin(x + (double)f->tan_left, (double)f->tan_right - x),
                fmin(y + (double)f->tan_down, (double)f->tan_up - y));
}

static int selects(const skv_frustum *f, const double v[3]) {
    const float d[3] = {(float)v[0], (float)v[1], (float)v[2]};
    uint32_t visible[1];
    size_t count = 9;
    assert_int_equal(skv_frustum_select(f, 1, d, 0, visible, &count), SKV_OK);
    assert_true(count <= 1 && (count == 0 || visible[0] == 0));
    return (int)count;
}

/// Without a margin: inside exactly by the tangents, but for 1e-6 rad (some 1e-4 in tangents up to 6) at the border.
static void frustum_is_the_pyramid(void **state) {
    (void)state;
    random_state = 23;
    int in = 0;
    for (int i = 0; i < CASES(200000); i++) {
        skv_frustum f = random_frustum();
        f.margin_rad = 0.0f;
        const axes a = axes_of(&f);
        double v[3];
        random_direction(v);
        const double by = inside_by(&f, &a, v);
        if (fabs(by) < 1e-4)
            continue;
        in += by > 0;
        if (selects(&f, v) != (by > 0))
            fail_msg("direction (%g %g %g), %g inside: selected %d", v[0], v[1], v[2], by, by < 0);
    }
    assert_true(in > CASES(200000) / 20);
}

/// Turns v by `angle` in a random direction.
static void swerve(double v[3], double angle) {
    double w[3], side[3];
    random_direction(w);
    cross(v, w, side);
    normalise(side);
    for (int c = 0; c < 3; c++)
        v[c] = v[c] * cos(angle) + side[c] * sin(angle);
}

/// With a margin: everything within it of the pyramid is selected, and what lies behind is not.
static void margin_is_kept(void **state) {
    (void)state;
    random_state = 24;
    for (int i = 0; i < CASES(100000); i++) {
        skv_frustum f = random_frustum();
        const axes a = axes_of(&f);
        const double x = random_in(-(double)f.tan_left, (double)f.tan_right);
        const double y = random_in(-(double)f.tan_down, (double)f.tan_up);
        double v[3];
        for (int c = 0; c < 3; c++)
            v[c] = a.forward[c] + x * a.right[c] + y * a.up[c];
        normalise(v);
        f.margin_rad = (float)random_in(0.001, 1.5);
        swerve(v, random_in(0, (double)f.margin_rad - 2e-5));
        if (!selects(&f, v))
            fail_msg("a direction within the margin %g was left out", (double)f.margin_rad);
        for (int c = 0; c < 3; c++)
            v[c] = -a.forward[c];
        f.margin_rad = (float)random_in(0, 0.15); // corners at up to 1.45 rad
        assert_true(!selects(&f, v));
    }
}

static void frustum_batch_and_errors(void **state) {
    (void)state;
    random_state = 25;
    const skv_dome dome = {.kind = SKV_DOME_EVEN, .rings = 12, .azimuths = 20};
    static uint32_t visible[VERTICES];
    static float wide[VERTICES][4];
    assert_int_equal(skv_dome_build(&dome, direction[0], 0, VERTICES, NULL, 0), SKV_OK);
    for (int i = 0; i < VERTICES; i++)
        for (int c = 0; c < 3; c++)
            wide[i][c] = direction[i][c] * 1e20f; // a position, not a direction
    for (int k = 0; k < 50; k++) {
        const skv_frustum f = random_frustum();
        size_t count = 0, at = 0;
        assert_int_equal(skv_frustum_select(&f, VERTICES, wide[0], sizeof wide[0], visible, &count), SKV_OK);
        for (size_t i = 0; i < VERTICES; i++) {
            const double v[3] = {(double)direction[i][0], (double)direction[i][1], (double)direction[i][2]};
            const int in = at < count && visible[at] == i;
            at += (size_t)in;
            const axes a = axes_of(&f);
            if (f.margin_rad == 0.0f && fabs(inside_by(&f, &a, v)) > 1e-4)
                assert_int_equal(in, inside_by(&f, &a, v) > 0);
        }
        assert_int_equal(at, count);
    }
    const skv_frustum good = {{0, 1, 0}, {0, 0, 1}, 1, 1, 1, 1, 0};
    size_t count = 55;
    wide[3][1] = NAN;
    wide[5][0] = wide[5][1] = wide[5][2] = 0.0f;
    wide[7][2] = INFINITY;
    assert_int_equal(skv_frustum_select(&good, VERTICES, wide[0], sizeof wide[0], visible, &count), SKV_ERR_DIRECTION);
    for (size_t i = 0; i < count; i++)
        assert_true(visible[i] != 3 && visible[i] != 5 && visible[i] != 7);
    assert_true(count > 20);
    count = 55;
#define BAD(status, field, value)                                                                                      \
    do {                                                                                                               \
        skv_frustum f = good;                                                                                          \
        f.field = value;                                                                                               \
        assert_int_equal(skv_frustum_select(&f, VERTICES, direction[0], 0, visible, &count), status);                  \
    } while (0)
    BAD(SKV_ERR_RANGE, tan_left, 0.0f);
    BAD(SKV_ERR_RANGE, tan_right, NAN);
    BAD(SKV_ERR_RANGE, tan_up, 2e4f);
    BAD(SKV_ERR_RANGE, tan_down, -1.0f);
    BAD(SKV_ERR_RANGE, margin_rad, -0.1f);
    BAD(SKV_ERR_RANGE, margin_rad, INFINITY);
    BAD(SKV_ERR_DIRECTION, forward_enu[1], 0.0f);
    BAD(SKV_ERR_DIRECTION, forward_enu[1], NAN);
    BAD(SKV_ERR_DIRECTION, up_enu[2], 0.0f);
    BAD(SKV_ERR_DIRECTION, up_enu[1], 1e9f);
    assert_int_equal(skv_frustum_select(NULL, 1, direction[0], 0, visible, &count), SKV_ERR_NULL);
    assert_int_equal(skv_frustum_select(&good, 1, NULL, 0, visible, &count), SKV_ERR_NULL);
    assert_int_equal(skv_frustum_select(&good, 1, direction[0], 0, NULL, &count), SKV_ERR_NULL);
    assert_int_equal(skv_frustum_select(&good, 1, direction[0], 0, visible, NULL), SKV_ERR_NULL);
    assert_int_equal(skv_frustum_select(&good, 1, direction[0], 10, visible, &count), SKV_ERR_SIZE);
    assert_int_equal(count, 55);
    assert_int_equal(skv_frustum_select(&good, 0, NULL, 0, NULL, &count), SKV_OK);
    assert_int_equal(count, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(frustum_is_the_pyramid),
        cmocka_unit_test(margin_is_kept),
        cmocka_unit_test(frustum_batch_and_errors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
