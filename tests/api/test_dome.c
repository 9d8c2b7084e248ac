/// Dome meshes as meshes: closed, unfolded, oriented, continuous in the sun, dense where they should be.
#include "check.h"
#include "random.h"
#include "vectors.h"

#include "skyvert/dome.h"

#define PI 3.14159265358979323846

#define MOST_VERTICES 256
#define MOST_INDICES  2048

static float direction[MOST_VERTICES][3];
static uint32_t triangle[MOST_INDICES];

static void vertex(size_t i, double out[3]) {
    for (int c = 0; c < 3; c++)
        out[c] = (double)direction[i][c];
}

static void set_sun(skv_dome *dome, double azimuth, double elevation) {
    dome->sun_enu[0] = (float)(sin(azimuth) * cos(elevation));
    dome->sun_enu[1] = (float)(cos(azimuth) * cos(elevation));
    dome->sun_enu[2] = (float)sin(elevation);
}

static skv_dome plain_dome(skv_dome_kind kind) {
    skv_dome dome = {.kind = kind,
                     .rings = 12,
                     .rings_below = 0,
                     .azimuths = 20,
                     .horizon_rad = -0.02f,
                     .lowest_rad = -0.02f,
                     .height_km = 1.0f,
                     .radius_km = 6360.0f,
                     .top_km = 60.0f};
    set_sun(&dome, 2.0, 0.3);
    return dome;
}

static skv_dome random_dome(void) {
    skv_dome dome = plain_dome((skv_dome_kind)random_int(0, 2));
    dome.rings = random_int(2, 8);
    dome.rings_below = random_int(0, 4);
    dome.azimuths = random_int(3, 16);
    dome.horizon_rad = random_int(0, 3) ? (float)random_in(-0.3, 0) : 0.0f;
    dome.lowest_rad = random_int(0, 1) ? -1.57079632f : (float)random_in(-1.5, -0.4);
    dome.height_km = (float)pow(10, random_in(-3, 2.5));
    dome.top_km = (float)random_in(1, 200);
    set_sun(&dome, random_in(0, 2 * PI), random_int(0, 1) ? random_in(-PI / 2, PI / 2) : random_in(-0.15, 0.05));
    return dome;
}

/// Solid angle of a triangle seen from the origin, negative where it runs clockwise seen from inside
/// [Van Oosterom & Strackee 1983].
static double solid_angle(size_t i, size_t j, size_t k) {
    double a[3], b[3], c[3], n[3];
    vertex(i, a);
    vertex(j, b);
    vertex(k, c);
    cross(a, b, n);
    return -2 * atan2(dot(n, c), 1 + dot(a, b) + dot(b, c) + dot(c, a));
}

/// Of all that the last ring encloses, as a fan from the zenith.
static double under_the_rim(const skv_dome *dome, size_t vertices) {
    const size_t columns = (size_t)dome->azimuths, first = vertices - columns;
    double sum = 0;
    for (size_t j = 0; j < columns; j++)
        sum += solid_angle(0, first + j, first + (j + 1) % columns);
    return sum;
}

/// Each edge is run through once in each direction, but for the rim of an open dome; Euler's number is that of a sphere
/// or of a disc.
static void check_manifold(const skv_dome *dome, size_t vertices, size_t indices, int closed) {
    static unsigned char edge[MOST_VERTICES][MOST_VERTICES / 8];
    size_t rim = 0, edges = 0;
    memset(edge, 0, sizeof edge);
    for (size_t t = 0; t < indices; t += 3)
        for (size_t k = 0; k < 3; k++) {
            const uint32_t a = triangle[t + k], b = triangle[t + (k + 1) % 3];
            assert_true(a < vertices && b < vertices && a != b);
            assert_true((edge[a][b / 8] >> b % 8 & 1) == 0);
            edge[a][b / 8] = (unsigned char)(edge[a][b / 8] | 1 << b % 8);
        }
    for (size_t a = 0; a < vertices; a++)
        for (size_t b = 0; b < vertices; b++)
            if (edge[a][b / 8] >> b % 8 & 1) {
                const int back = edge[b][a / 8] >> a % 8 & 1;
                rim += !back;
                edges += !back || a < b;
            }
    assert_int_equal(rim, closed ? 0 : dome->azimuths);
    assert_int_equal((int)vertices - (int)edges + (int)(indices / 3), closed ? 2 : 1);
}

/// Every triangle turns the right way round, and together they cover the sphere, or the cap, once.
static void check_cover(const skv_dome *dome, size_t vertices, size_t indices, int closed) {
    double sum = 0;
    for (size_t t = 0; t < indices; t += 3) {
        const double angle = solid_angle(triangle[t], triangle[t + 1], triangle[t + 2]);
        if (!(angle > 0))
            fail_msg("kind %d, %d+%d rings x %d, triangle %d: solid angle %g", (int)dome->kind, (int)dome->rings,
                     (int)dome->rings_below, (int)dome->azimuths, (int)(t / 3), angle);
        sum += angle;
    }
    check_near("solid angle of all triangles", sum, closed ? 4 * PI : under_the_rim(dome, vertices), 3e-5); // floats
}

static void check_columns(const skv_dome *dome, size_t vertices) {
    const size_t columns = (size_t)dome->azimuths;
    for (size_t i = 0; i < vertices; i++) {
        double v[3];
        vertex(i, v);
        check_near("length", sqrt(dot(v, v)), 1, 3e-7);
        if (i > columns && i < 1 + columns * ((vertices - 1) / columns)) // below the one before in its column
            assert_true(direction[i][2] < direction[i - columns][2]);
    }
}

static void meshes_are_meshes(void **state) {
    (void)state;
    random_state = 21;
    for (int i = 0; i < CASES(4000); i++) {
        const skv_dome dome = random_dome();
        size_t vertices = 0, indices = 0;
        assert_int_equal(skv_dome_size(&dome, &vertices, &indices), SKV_OK);
        assert_true(vertices <= MOST_VERTICES && indices <= MOST_INDICES);
        assert_int_equal(skv_dome_build(&dome, direction[0], 0, vertices, triangle, indices), SKV_OK);
        const int closed = dome.rings_below > 0 && dome.lowest_rad < -1.57f;
        check_columns(&dome, vertices);
        check_manifold(&dome, vertices, indices, closed);
        check_cover(&dome, vertices, indices, closed);
    }
}

/// The elevations that the header promises.
static void rings_are_where_they_should_be(void **state) {
    (void)state;
    for (int kind = 0; kind < 2; kind++) {
        skv_dome dome = plain_dome((skv_dome_kind)kind);
        dome.rings_below = 4;
        dome.lowest_rad = -1.0f;
        dome.azimuths = 6;
        assert_int_equal(skv_dome_build(&dome, direction[0], 0, MOST_VERTICES, triangle, MOST_INDICES), SKV_OK);
        for (int ring = 0; ring < 16; ring++) {
            const double t = ring < 12 ? (11 - ring) / 12.0 : (ring - 11) / 4.0, s = kind ? t * t * t : t;
            const double h = (double)dome.horizon_rad, e = h + s * (ring < 12 ? PI / 2 - h : -1.0 - h);
            for (int j = 0; j < 6; j++) {
                const float *const v = direction[1 + ring * 6 + j];
                const double az = 2 * PI * j / 6;
                check_near("east", (double)v[0], sin(az) * cos(e), 5e-7);
                check_near("north", (double)v[1], cos(az) * cos(e), 5e-7);
                // The linear share that keeps rings apart is 8e-6 rad at the horizon.
                check_near("up", (double)v[2], sin(e), 1e-5);
            }
        }
    }
}

/// Largest move of a vertex when the sun (or the observer) takes a step along a path.
typedef void (*path)(skv_dome *dome, double s);

static void through_the_zenith(skv_dome *dome, double s) {
    dome->sun_enu[0] = (float)(s - 0.5);
    dome->sun_enu[1] = 0.003f;
    dome->sun_enu[2] = 1.0f;
}
static void setting(skv_dome *dome, double s) {
    set_sun(dome, 1.0, 0.15 - 0.25 * s);
}
static void night(skv_dome *dome, double s) {
    set_sun(dome, 1.0, -0.1 - 0.4 * s);
}
static void around(skv_dome *dome, double s) {
    set_sun(dome, 2 * PI * s, -0.04);
}
static void over_the_pole_at_twilight(skv_dome *dome, double s) {
    set_sun(dome, 2 * PI * s, -0.069); // the shadow's edge near the zenith
}
static void climbing(skv_dome *dome, double s) {
    set_sun(dome, 1.0, -0.03);
    dome->height_km = (float)(80 * s);
}

static double largest_step(path p, int steps) {
    static float before[MOST_VERTICES][3];
    skv_dome dome = plain_dome(SKV_DOME_ADAPTIVE);
    double worst = 0;
    for (int k = 0; k <= steps; k++) {
        p(&dome, (double)k / steps);
        assert_int_equal(skv_dome_build(&dome, direction[0], 0, MOST_VERTICES, NULL, 0), SKV_OK);
        for (size_t i = 0; k > 0 && i < 241; i++)
            for (int c = 0; c < 3; c++)
                worst = fmax(worst, fabs((double)direction[i][c] - (double)before[i][c]));
        memcpy(before, direction, sizeof before);
    }
    return worst;
}

/// No pops: with steps a quarter as long the largest move is about a quarter too, where a jump would stay as it is.
static void vertices_move_continuously(void **state) {
    (void)state;
    static const struct {
        const char *name;
        path p;
    } t[] = {{"sun through the zenith", through_the_zenith},
             {"sun from 8.6 to -5.7 degrees", setting},
             {"sun from -5.7 to -29 degrees", night},
             {"sun around at -2.3 degrees", around},
             {"sun around at -4 degrees", over_the_pole_at_twilight},
             {"observer from 0 to 80 km", climbing}};
    for (size_t i = 0; i < sizeof t / sizeof t[0]; i++) {
        const int steps = SMALL_TARGET ? 50 : 1500;
        const double coarse = largest_step(t[i].p, steps), fine = largest_step(t[i].p, 4 * steps);
        if (!SMALL_TARGET) // the steps must be short beside the bends of the path
            check_at_most(t[i].name, fine, 0.4 * coarse + 1e-6);
        // The sun moves 1.2e-6 rad from one of 60 frames a second to the next; .25 rad at 120 are .03 degrees a frame,
        // in the minutes in which the shadow's edge runs up the sky.
        check_at_most(t[i].name, fine * 4 * steps, 120.0);
        print_message("figure: dome, %s: largest move %.2g of a path of 1\n", t[i].name, fine * 4 * steps);
    }
}

static int within_of(const double axis[3], double angle, size_t vertices) {
    int n = 0;
    for (size_t i = 0; i < vertices; i++) {
        double v[3];
        vertex(i, v);
        n += dot(axis, v) > cos(angle);
    }
    return n;
}

/// More vertices near the sun than the horizon dome has, at all elevations.
static void dense_around_the_sun(void **state) {
    (void)state;
    for (int degrees = 5; degrees <= 75; degrees += 10) {
        int count[2];
        for (int k = 0; k < 2; k++) {
            skv_dome dome = plain_dome(k ? SKV_DOME_ADAPTIVE : SKV_DOME_HORIZON);
            double sum = 0;
            for (int j = 0; j < 24; j++) { // averaged over the azimuth: the columns of the other dome stand still
                set_sun(&dome, 2 * PI * j / 24, degrees * PI / 180);
                assert_int_equal(skv_dome_build(&dome, direction[0], 0, MOST_VERTICES, NULL, 0), SKV_OK);
                const double sun[3] = {(double)dome.sun_enu[0], (double)dome.sun_enu[1], (double)dome.sun_enu[2]};
                sum += within_of(sun, 20 * PI / 180, 241);
            }
            count[k] = (int)sum;
        }
        print_message("dome, sun at %d degrees: %.1f vertices within 20 degrees of it, %.1f without\n", degrees,
                      count[1] / 24.0, count[0] / 24.0);
        assert_true(count[1] * 2 >= count[0] * 3);
    }
}

/// Elevation, opposite to the sun, at which a ray leaves the shadow at the height of a quarter of the air: by brute
/// force.
static double shadow_edge(double sun_elevation, double height_km) {
    const double r = 6360, shell = 7.2;
    for (double e = PI / 2; e > 0; e -= 1e-4) {
        const double vx = cos(e), vz = sin(e), z0 = r + height_km;
        const double b = z0 * vz, c = z0 * z0 - (r + shell) * (r + shell), d = -b + sqrt(b * b - c); // to the shell
        const double x = d * vx, z = z0 + d * vz;
        const double along = -x * cos(sun_elevation) + z * sin(sun_elevation); // the sun is at -x
        const double across = x * sin(sun_elevation) + z * cos(sun_elevation);
        if (along < 0 && fabs(across) < r)
            return e;
    }
    return 0;
}

/// Opposite to the low sun the rings stand closer at the shadow's edge than those of the horizon dome there.
static void dense_along_the_shadow(void **state) {
    (void)state;
    for (int tenths = 15; tenths <= 24; tenths += 3) {
        const double sun = -tenths / 10.0 * PI / 180, edge = shadow_edge(sun, 1.0);
        double gap[2];
        for (int k = 0; k < 2; k++) {
            skv_dome dome = plain_dome(k ? SKV_DOME_ADAPTIVE : SKV_DOME_HORIZON);
            dome.rings = 40;
            dome.azimuths = 4;
            set_sun(&dome, PI, sun); // column 0 is opposite
            assert_int_equal(skv_dome_build(&dome, direction[0], 0, MOST_VERTICES, NULL, 0), SKV_OK);
            gap[k] = 9;
            for (size_t i = 1; i + 4 < 161; i += 4) {
                const double hi = asin((double)direction[i][2]), lo = asin((double)direction[i + 4][2]);
                if (edge <= hi && edge > lo)
                    gap[k] = hi - lo;
            }
        }
        print_message(
            "figure: dome, sun at -%.1f degrees: shadow's edge at %.1f, rings %.2f degrees apart, %.2f without\n",
            tenths / 10.0, edge * 180 / PI, gap[1] * 180 / PI, gap[0] * 180 / PI);
        assert_true(gap[1] < 0.7 * gap[0]);
    }
}

#if !SMALL_TARGET
/// The most rings and columns: elevations of neighbours are still different floats.
static void extremes(void **state) {
    (void)state;
    static float big[100000][3];
    const struct {
        int32_t rings, below, azimuths;
        float horizon, lowest;
        double sun;
    } t[] = {{4096, 4096, 3, -0.06f, -1.57079633f, 0.02},
             {4096, 4096, 3, -1.5f, -1.55f, 1.4},
             {2, 0, 16384, 0.0f, 0.0f, 0.5},
             {2, 1, 16384, 0.0f, -1.57079633f, -0.06},
             {4096, 0, 3, 0.0f, 0.0f, -0.05},
             {4096, 4096, 3, -0.001f, -0.0184f, 0.0}};
    for (size_t i = 0; i < sizeof t / sizeof t[0]; i++)
        for (int kind = 0; kind < 3; kind++) {
            skv_dome dome = plain_dome((skv_dome_kind)kind);
            dome.rings = t[i].rings;
            dome.rings_below = t[i].below;
            dome.azimuths = t[i].azimuths;
            dome.horizon_rad = t[i].horizon;
            dome.lowest_rad = t[i].lowest;
            set_sun(&dome, 0.4, t[i].sun);
            size_t vertices;
            assert_int_equal(skv_dome_size(&dome, &vertices, NULL), SKV_OK);
            assert_int_equal(skv_dome_build(&dome, big[0], 0, 100000, NULL, 0), SKV_OK);
            const size_t columns = (size_t)dome.azimuths;
            for (size_t v = 1 + columns; v < vertices; v++) {
                const float *const a = big[v], *const b = big[v - columns];
                const double gap = hypot(hypot((double)(a[0] - b[0]), (double)(a[1] - b[1])), (double)(a[2] - b[2]));
                if (!(gap > 2e-7) || a[2] > b[2])
                    fail_msg("dome %d, kind %d, vertex %d: %g below its neighbour", (int)i, kind, (int)v, gap);
            }
        }
}
#endif

/// A capacity one short, odd strides, NULL: a status, and not a byte written.
static void errors_write_nothing(void **state) {
    (void)state;
    const skv_dome dome = plain_dome(SKV_DOME_ADAPTIVE);
    size_t vertices, indices;
    assert_int_equal(skv_dome_size(&dome, &vertices, &indices), SKV_OK);
    assert_int_equal(vertices, 241);
    assert_int_equal(indices, 3 * 20 * 23);
    memset(direction, 0x5a, sizeof direction);
    memset(triangle, 0x5a, sizeof triangle);
    float *const d = direction[0];
    assert_int_equal(skv_dome_build(&dome, d, 0, vertices - 1, triangle, indices), SKV_ERR_SIZE);
    assert_int_equal(skv_dome_build(&dome, d, 0, vertices, triangle, indices - 1), SKV_ERR_SIZE);
    assert_int_equal(skv_dome_build(&dome, d, 8, vertices, triangle, indices), SKV_ERR_SIZE);
    assert_int_equal(skv_dome_build(&dome, d, 14, vertices, triangle, indices), SKV_ERR_SIZE);
    assert_int_equal(skv_dome_build(&dome, NULL, 0, vertices, triangle, indices), SKV_ERR_NULL);
    assert_int_equal(skv_dome_build(NULL, d, 0, vertices, triangle, indices), SKV_ERR_NULL);
    assert_int_equal(skv_dome_size(NULL, &vertices, &indices), SKV_ERR_NULL);
    for (size_t i = 0; i < sizeof direction; i++)
        assert_int_equal(((unsigned char *)direction)[i], 0x5a);
    for (size_t i = 0; i < sizeof triangle; i++)
        assert_int_equal(((unsigned char *)triangle)[i], 0x5a);
}

static void check_refused(skv_dome dome, skv_status want, const char *what) {
    size_t vertices = 7, indices = 7;
    const skv_status size = skv_dome_size(&dome, &vertices, &indices);
    const skv_status build = skv_dome_build(&dome, direction[0], 0, MOST_VERTICES, NULL, 0);
    if (size != want || build != want || vertices != 7 || indices != 7)
        fail_msg("%s: statuses %d and %d, want %d", what, size, build, want);
}

static void bad_parameters(void **state) {
    (void)state;
    static const float odd[] = {NAN, INFINITY, -INFINITY};
    const skv_dome good = plain_dome(SKV_DOME_ADAPTIVE);
#define REFUSED(status, field, value)                                                                                  \
    do {                                                                                                               \
        skv_dome bad = good;                                                                                           \
        bad.rings_below = 1;                                                                                           \
        bad.lowest_rad = -1.0f;                                                                                        \
        bad.field = value;                                                                                             \
        check_refused(bad, status, #field " = " #value);                                                               \
    } while (0)
    REFUSED(SKV_ERR_UNSUPPORTED, kind, (skv_dome_kind)3);
    REFUSED(SKV_ERR_RANGE, rings, 1);
    REFUSED(SKV_ERR_RANGE, rings, 4097);
    REFUSED(SKV_ERR_RANGE, rings_below, -1);
    REFUSED(SKV_ERR_RANGE, rings_below, 4097);
    REFUSED(SKV_ERR_RANGE, azimuths, 2);
    REFUSED(SKV_ERR_RANGE, azimuths, 16385);
    REFUSED(SKV_ERR_RANGE, horizon_rad, 0.001f);
    REFUSED(SKV_ERR_RANGE, horizon_rad, -1.562f);
    REFUSED(SKV_ERR_RANGE, lowest_rad, -1.571f);
    REFUSED(SKV_ERR_RANGE, lowest_rad, -0.02f);
    REFUSED(SKV_ERR_RANGE, height_km, -1.0f);
    REFUSED(SKV_ERR_RANGE, radius_km, 0.5f);
    REFUSED(SKV_ERR_RANGE, top_km, 0.0f);
    REFUSED(SKV_ERR_RANGE, radius_km, 59.0f);
    for (int i = 0; i < 3; i++) {
        REFUSED(SKV_ERR_RANGE, horizon_rad, odd[i]);
        REFUSED(SKV_ERR_RANGE, lowest_rad, odd[i]);
        REFUSED(SKV_ERR_RANGE, height_km, odd[i]);
        REFUSED(SKV_ERR_RANGE, radius_km, odd[i]);
        REFUSED(SKV_ERR_RANGE, top_km, odd[i]);
        REFUSED(SKV_ERR_DIRECTION, sun_enu[1], odd[i]);
    }
    skv_dome bad = good;
    memset(bad.sun_enu, 0, sizeof bad.sun_enu);
    check_refused(bad, SKV_ERR_DIRECTION, "no sun");
    bad.kind = SKV_DOME_HORIZON; // the sun is not used
    assert_int_equal(skv_dome_size(&bad, NULL, NULL), SKV_OK);
}

/// Any bits in any field: a status, or finite vertices.
static void any_parameters(void **state) {
    (void)state;
    random_state = 22;
    for (int i = 0; i < CASES(100000); i++) {
        skv_dome dome = random_dome();
        float *const field[] = {&dome.horizon_rad, &dome.lowest_rad, &dome.sun_enu[0], &dome.sun_enu[1],
                                &dome.sun_enu[2],  &dome.height_km,  &dome.radius_km,  &dome.top_km};
        *field[random_int(0, 7)] = random_float();
        if (random_int(0, 1))
            *field[random_int(2, 4)] = random_float();
        size_t vertices = 0;
        if (skv_dome_size(&dome, &vertices, NULL) != SKV_OK)
            continue;
        assert_int_equal(skv_dome_build(&dome, direction[0], 0, vertices, NULL, 0), SKV_OK);
        for (size_t v = 0; v < vertices; v++)
            for (int c = 0; c < 3; c++)
                assert_true(fabsf(direction[v][c]) <= 1.000001f);
    }
}

static void stride_is_respected(void **state) {
    (void)state;
    static float wide[241][5];
    const skv_dome dome = plain_dome(SKV_DOME_ADAPTIVE);
    for (int i = 0; i < 241; i++)
        for (int c = 0; c < 5; c++)
            wide[i][c] = 77.0f;
    assert_int_equal(skv_dome_build(&dome, direction[0], 0, MOST_VERTICES, NULL, 0), SKV_OK);
    assert_int_equal(skv_dome_build(&dome, &wide[0][1], sizeof wide[0], 241, NULL, 0), SKV_OK);
    for (int i = 0; i < 241; i++) {
        assert_true(wide[i][0] == 77.0f && wide[i][4] == 77.0f);
        for (int c = 0; c < 3; c++)
            assert_true(wide[i][1 + c] == direction[i][c]);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(meshes_are_meshes),
        cmocka_unit_test(rings_are_where_they_should_be),
        cmocka_unit_test(vertices_move_continuously),
        cmocka_unit_test(dense_around_the_sun),
        cmocka_unit_test(dense_along_the_shadow),
#if !SMALL_TARGET
        cmocka_unit_test(extremes),
#endif
        cmocka_unit_test(errors_write_nothing),
        cmocka_unit_test(bad_parameters),
        cmocka_unit_test(any_parameters),
        cmocka_unit_test(stride_is_respected),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
