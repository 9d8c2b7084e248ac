/// The geoid: proj-data's grid read by the test itself against what the converter and the port make of it, and every
/// kind of broken file. TEST_GTX is the grid, TEST_GEOID_DIR holds egm96-15.pgm.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "check.h"
#include "port/geographiclib/skv_geo.h"
#include "wgs84.h"

int bilinear_heights(const char *folder, const double (*lat_lon)[2], int n, double *height_m);

enum { ROWS = 721, COLUMNS = 1440, PGM_PIXELS = 2 * ROWS * COLUMNS };
static float grid[ROWS][COLUMNS]; // from the south pole, from 180 W
static unsigned char pgm[PGM_PIXELS + 1000];
static size_t pgm_size;
static char pgm_path[512];

static size_t slurp(const char *path, unsigned char *to, size_t most) {
    FILE *f = fopen(path, "rb");
    if (!f)
        fail_msg("cannot open %s", path);
    const size_t n = fread(to, 1, most, f);
    fclose(f);
    return n;
}

static int load(void **unused) {
    (void)unused;
    static unsigned char raw[40 + 4 * ROWS * COLUMNS];
    if (slurp(TEST_GTX, raw, sizeof raw) != sizeof raw)
        return -1;
    for (size_t i = 0; i < (size_t)ROWS * COLUMNS; i++) {
        const unsigned char *b = raw + 40 + 4 * i;
        const uint32_t bits = (uint32_t)b[0] << 24 | (uint32_t)b[1] << 16 | (uint32_t)b[2] << 8 | b[3];
        memcpy(&grid[i / COLUMNS][i % COLUMNS], &bits, 4);
    }
    snprintf(pgm_path, sizeof pgm_path, "%s/egm96-15.pgm", TEST_GEOID_DIR);
    pgm_size = slurp(pgm_path, pgm, sizeof pgm);
    return 0;
}

static double bilinear(double lat_deg, double lon_deg) {
    const double y = (lat_deg + 90) * 4, x = fmod(lon_deg + 180, 360) * 4;
    const int row = y >= ROWS - 1 ? ROWS - 2 : (int)y, column = (int)x, next = (column + 1) % COLUMNS;
    const double fy = y - row, fx = x - column;
    return (1 - fy) * ((1 - fx) * (double)grid[row][column] + fx * (double)grid[row][next]) +
           fy * ((1 - fx) * (double)grid[row + 1][column] + fx * (double)grid[row + 1][next]);
}

static skv_geoid *open_grid(void) {
    skv_geoid *g = NULL;
    char message[SKV_GEO_MESSAGE] = "";
    if (skv_geo_geoid_open(pgm_path, &g, message, sizeof message) != SKV_OK)
        fail_msg("%s", message);
    return g;
}

/// Every node of the grid is where and what the PGM says, to half of its 3 mm step.
static void test_converter(void **unused) {
    (void)unused;
    assert_true(pgm_size > PGM_PIXELS);
    const unsigned char *pixels = pgm + pgm_size - PGM_PIXELS;
    double worst = 0;
    for (int row = 0; row < ROWS; row++)
        for (int column = 0; column < COLUMNS; column++, pixels += 2) {
            const double got = -108 + .003 * (256 * pixels[0] + pixels[1]);
            const double error = fabs(got - (double)grid[ROWS - 1 - row][(column + COLUMNS / 2) % COLUMNS]);
            worst = error > worst ? error : worst;
        }
    print_message("figure: geoid nodes, PGM against GTX, worst %.4f m\n", worst);
    check_at_most("PGM against GTX, m", worst, .0015 + 1e-9);
}

static void test_reader(void **unused) {
    (void)unused;
    enum { N = 20000 };
    static double at[N][2], height[N];
    uint64_t seed = 1;
    for (int i = 0; i < N; i++) {
        at[i][0] = i < 4 ? (i % 2 ? 90 : -90) : draw(&seed, -90, 90);
        at[i][1] = draw(&seed, -180, 180);
    }
    assert_int_equal(bilinear_heights(TEST_GEOID_DIR, (const double(*)[2])at, N, height), 0);
    skv_geoid *g = open_grid();
    double worst = 0, far = 0, square = 0;
    for (int i = 0; i < N; i++) {
        const double want = bilinear(at[i][0], at[i][1]);
        double got = 0;
        assert_int_equal(skv_geo_undulation(g, at[i][0], at[i][1], &got), SKV_OK);
        worst = fmax(worst, fabs(height[i] - want));
        far = fmax(far, fabs(got - want));
        square += (got - want) * (got - want) / N;
    }
    skv_geo_geoid_close(g);
    print_message("figure: geoid against bilinear GTX: bilinear PGM worst %.4f m, cubic worst %.3f m rms %.3f m\n",
                  worst, far, sqrt(square));
    check_at_most("bilinear reading of both, m", worst, .0015 + 1e-6); // the mean of four half steps of 3 mm
    // Bilinear is off by 1.152 m at most and 40 mm rms, cubic by .169 m and 7 mm: GeographicLib, GeoidEval(1).
    check_at_most("cubic against bilinear, m", far, 1.152 + .169);
    check_at_most("cubic against bilinear, rms, m", sqrt(square), .040 + .007);
}

static void test_published(void **unused) {
    (void)unused;
    skv_geoid *g = open_grid();
    double lat = 0, lon = 0, n = 0, n2 = 0, h = 0, msl = 0;
    // Timbuktu, the example of GeographicLib's manual; its finer 5' grid gives 28.7068.
    assert_int_equal(skv_geo_parse("16:46:33N 3:00:34W", &lat, &lon, NULL, 0), SKV_OK);
    assert_int_equal(skv_geo_undulation(g, lat, lon, &n), SKV_OK);
    check_near("Timbuktu, m", n, 28.708, .0005);
    assert_int_equal(skv_geo_undulation(g, lat, lon + 360, &n2), SKV_OK);
    check_near("a turn further, m", n2, n, 1e-9);
    assert_int_equal(skv_geo_height_from_msl(g, lat, lon, 263, &h), SKV_OK);
    check_near("above the ellipsoid, m", h, 263 + n, 1e-12);
    assert_int_equal(skv_geo_msl_from_height(g, lat, lon, h, &msl), SKV_OK);
    check_near("above the sea, m", msl, 263, 1e-12);
    skv_geo_geoid_close(g);
}

static void test_arguments(void **unused) {
    (void)unused;
    skv_geoid *g = open_grid();
    const double bad[] = {NAN, INFINITY, -INFINITY, 1e9};
    double x = 7;
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        assert_int_equal(skv_geo_undulation(g, bad[i], 0, &x), SKV_ERR_RANGE);
        assert_int_equal(skv_geo_undulation(g, 0, bad[i], &x), SKV_ERR_RANGE);
        assert_int_equal(skv_geo_msl_from_height(g, 0, 0, bad[i] * 2, &x), SKV_ERR_RANGE);
        assert_int_equal(skv_geo_height_from_msl(g, 0, bad[i], 0, &x), SKV_ERR_RANGE);
    }
    assert_int_equal(skv_geo_undulation(NULL, 0, 0, &x), SKV_ERR_NULL);
    assert_int_equal(skv_geo_undulation(g, 0, 0, NULL), SKV_ERR_NULL);
    assert_int_equal(skv_geo_msl_from_height(NULL, 0, 0, 0, &x), SKV_ERR_NULL);
    assert_int_equal(skv_geo_height_from_msl(g, 0, 0, 0, NULL), SKV_ERR_NULL);
    assert_true(x == 7);
    assert_int_equal(skv_geo_geoid_open(NULL, &g, NULL, 0), SKV_ERR_NULL);
    assert_int_equal(skv_geo_geoid_open("a.pgm", NULL, NULL, 0), SKV_ERR_NULL);
    skv_geo_geoid_close(g);
    skv_geo_geoid_close(NULL);
}

/// Each must be refused with one line that names the file, and leave the handle alone.
static void refuse(const char *path) {
    skv_geoid *const before = (skv_geoid *)&grid, *g = before;
    char message[SKV_GEO_MESSAGE] = "";
    const skv_status status = skv_geo_geoid_open(path, &g, message, sizeof message);
    if (status != SKV_ERR_UNSUPPORTED || g != before)
        fail_msg("%s: status %d, message '%s'", path, status, message);
    if (!strstr(message, path) || strchr(message, '\n'))
        fail_msg("%s: message '%s'", path, message);
    assert_int_equal(skv_geo_geoid_open(path, &g, NULL, 0), SKV_ERR_UNSUPPORTED);
}

static void write_file(const char *path, const char *head, const unsigned char *body, size_t bytes) {
    FILE *f = fopen(path, "wb");
    if (!f || fputs(head, f) < 0 || fwrite(body, 1, bytes, f) != bytes || fclose(f) != 0)
        fail_msg("cannot write %s", path);
}

static void test_broken_files(void **unused) {
    (void)unused;
    char path[600];
    refuse("/no/such/folder/egm96-15.pgm");
    refuse("egm96-15.gtx");
    refuse(".pgm");
    refuse("");
    snprintf(path, sizeof path, "%s/broken.pgm", TEST_GEOID_DIR);
    const size_t sizes[] = {0, 1, 2, 3, 60, 300, pgm_size - PGM_PIXELS, pgm_size - 1, pgm_size};
    for (size_t i = 0; i + 1 < sizeof sizes / sizeof sizes[0]; i++) {
        write_file(path, "", pgm, sizes[i]);
        refuse(path);
    }
    write_file(path, "x", pgm, pgm_size); // not a PGM
    refuse(path);
    memcpy(pgm + pgm_size, "xx", 2);
    write_file(path, "", pgm, pgm_size + 2); // too long
    refuse(path);
    static const char *const heads[] = {
        "P5\n# Offset -108\n# Scale 0.003\n1440 721\n255\n",
        "P5\n# Offset -108\n1440 721\n65535\n",
        "P5\n# Offset -108\n# Scale -1\n1440 721\n65535\n",
        "P5\n# Offset -108\n# Scale x\n1440 721\n65535\n",
        "P5\n# Offset -108\n# Scale 0.003\n-1440 721\n65535\n",
        "P5\n# Offset -108\n# Scale 0.003\n2147483647 2147483647\n65535\n",
        "P5\n# Offset -108\n# Scale 0.003\n1440 720\n65535\n",
        "P2\n# Offset -108\n# Scale 0.003\n1440 721\n65535\n",
    };
    for (size_t i = 0; i < sizeof heads / sizeof heads[0]; i++) {
        write_file(path, heads[i], pgm + pgm_size - PGM_PIXELS, PGM_PIXELS);
        refuse(path);
    }
    remove(path);
    refuse(path);
}

/// A grid may be well formed and hold no number: then no height comes out.
static void test_not_finite(void **unused) {
    (void)unused;
    char path[600];
    snprintf(path, sizeof path, "%s/infinite.pgm", TEST_GEOID_DIR);
    write_file(path, "P5\n# Offset inf\n# Scale 0.003\n1440 721\n65535\n", pgm + pgm_size - PGM_PIXELS, PGM_PIXELS);
    skv_geoid *g = NULL;
    double n = 7;
    if (skv_geo_geoid_open(path, &g, NULL, 0) == SKV_OK)
        assert_int_equal(skv_geo_undulation(g, 10, 20, &n), SKV_ERR_RANGE);
    skv_geo_geoid_close(g);
    remove(path);
    assert_true(n == 7);
}

static void test_find(void **unused) {
    (void)unused;
    char path[600] = "untouched", message[SKV_GEO_MESSAGE] = "", tiny[4] = "abc";
    setenv("SKYVERT_GEOID", pgm_path, 1);
    assert_int_equal(skv_geo_geoid_find(path, sizeof path, message, sizeof message), SKV_OK);
    assert_int_equal(strcmp(path, pgm_path), 0);
    assert_int_equal(skv_geo_geoid_find(tiny, sizeof tiny, message, sizeof message), SKV_ERR_SIZE);
    assert_int_equal(strcmp(tiny, "abc"), 0);
    unsetenv("SKYVERT_GEOID"); // and beside this test there is none
    assert_int_equal(skv_geo_geoid_find(path, sizeof path, message, sizeof message), SKV_ERR_UNSUPPORTED);
    assert_int_equal(strcmp(path, pgm_path), 0);
    assert_true(strstr(message, "proj-data") != NULL);
    assert_int_equal(skv_geo_geoid_find(NULL, 0, NULL, 0), SKV_ERR_NULL);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_converter), cmocka_unit_test(test_reader),       cmocka_unit_test(test_published),
        cmocka_unit_test(test_arguments), cmocka_unit_test(test_broken_files), cmocka_unit_test(test_not_finite),
        cmocka_unit_test(test_find),
    };
    return cmocka_run_group_tests(tests, load, NULL);
}
