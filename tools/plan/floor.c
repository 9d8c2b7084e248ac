/// plan-floor POOL.csv [FILE.ini TRUTH.csv]... > floor_data.h: what the library at its best is off from the path
/// tracer, ray by ray. POOL.csv is plan-truth's; TRUTH.csv skyvert-reference's in the air of FILE.ini.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/plan/kind.h"
#include "tools/plan/light.h"

enum { BANDS = 4, ANGLES = 4, COLUMNS = ANGLES + 2 * BANDS };

static int fail(const char *name, int line, const char *what) {
    fprintf(stderr, "plan-floor: %s:%d: %s\n", name, line, what);
    return 2;
}

static int numbers(const char *text, int n, double x[]) {
    for (int i = 0; i < n; i++) {
        char *end;
        x[i] = strtod(text, &end);
        if (end == text || !isfinite(x[i]) || *end != (i == n - 1 ? '\n' : ','))
            return 0;
        text = end + 1;
    }
    return 1;
}

/// The air of a row; the one before it is kept.
typedef struct pool_air {
    plan_scene scene;
    plan_shop *shop;
} pool_air;

static int begin(pool_air *air, const double x[2]) {
    const int preset = (int)x[0];
    if (air->shop && air->scene.preset == preset && !(fabs(air->scene.visibility_km.low - x[1]) > 0))
        return 1;
    plan_shop_close(air->shop);
    air->scene = (plan_scene){.preset = preset, .visibility_km = {x[1], x[1]}, .terrain = true};
    air->shop = plan_shop_open(&air->scene);
    return air->shop != NULL;
}

static void to_rgb(const skv_colour_matrix *m, const double radiance[BANDS], double rgb[3]) {
    for (int c = 0; c < 3; c++) {
        rgb[c] = 0;
        for (int b = 0; b < BANDS; b++)
            rgb[c] += (double)m->rgb[c][b] * radiance[b];
    }
}

/// @param x  altitude, zenith angles of sun and view, azimuth, radiances.
static int print_row(pool_air *air, const double x[COLUMNS]) {
    plan_frame frame = {0, x[0], 90 - x[1]};
    plan_ray ray = {90 - x[2], x[3], INFINITY};
    const plan_samples one = {&air->scene, 1, 1, 0, 1, &frame, &ray};
    const plan_config best = {BANDS, plan_species(&air->scene), true, PLAN_LARGE, false, 16};
    float rgb[1][TRADE_BANDS];
    double truth[3], most = 0;
    skv_colour_matrix m;
    skv_status status = plan_colours(air->shop, &best, &one, rgb);
    const plan_built *const built = status == SKV_OK ? plan_build(air->shop, 0, &best, &status) : NULL;
    if (!built || skv_colour_matrix_for(&m, BANDS, built->air.wavelength_nm, built->air.solar_irradiance) != SKV_OK)
        return 0;
    to_rgb(&m, x + ANGLES, truth);
    for (int c = 0; c < 3; c++)
        most = fmax(most, (double)rgb[0][c]);
    const plan_kind_of_ray k = plan_ray_kind(&built->air, &frame, &ray);
    printf("    {{%.2ff, %.2ff, %.2ff, %.2ff, %.2ff, %.2ff}, {", (double)k.particles, (double)k.gas, (double)k.sun,
           (double)k.height, (double)k.view, (double)k.azimuth);
    for (int c = 0; c < 3; c++) {
        const double off = ((double)rgb[0][c] - truth[c]) / most;
        printf("%s%.0f", c ? ", " : "", fmax(fmin(20000 * off, 32000), -32000) + 0.0);
    }
    printf("}},\n");
    return 1;
}

/// @param own  the rows' first two columns name their air. @return the exit status
static int take_rows(pool_air *air, const char *name, int own) {
    char text[1024];
    double x[2 + COLUMNS];
    FILE *const in = fopen(name, "r");
    int status = in ? 0 : fail(name, 0, "cannot be opened");
    for (int line = 1; status == 0 && fgets(text, sizeof text, in); line++) {
        if (text[0] == '#' || text[0] == 'a')
            continue;
        if (!numbers(text, own + COLUMNS, x))
            status = fail(name, line, "not a row of truth");
        else if ((own > 0 && !begin(air, x)) || !print_row(air, x + own))
            status = fail(name, line, "the library refuses this row");
    }
    if (in)
        fclose(in);
    return status;
}

static int take_file(const char *ini, const char *csv) {
    static pool_air air;
    air = (pool_air){.scene = {.preset = -1, .terrain = true}};
    if (atmosphere_load(&air.scene.file, ini) != 0)
        return 2;
    air.shop = plan_shop_open(&air.scene);
    const int status = air.shop ? take_rows(&air, csv, 0) : 1;
    plan_shop_close(air.shop);
    plan_scene_free(&air.scene);
    return status;
}

int main(int argc, char **argv) {
    static pool_air air;
    if (argc < 2 || argc % 2 != 0) {
        fprintf(stderr, "usage: plan-floor POOL.csv [FILE.ini TRUTH.csv]... > floor_data.h\n");
        return 2;
    }
    printf("// Made by tools/plan/floor.c from tools/plan/pool.csv and tools/reference/data: `make plan-floor`.\n"
           "// clang-format off\nstatic const plan_floor_ray plan_floor_rays[] = {\n");
    int status = take_rows(&air, argv[1], 2);
    plan_shop_close(air.shop);
    for (int i = 2; i < argc && status == 0; i += 2)
        status = take_file(argv[i], argv[i + 1]);
    printf("};\n");
    return status;
}
