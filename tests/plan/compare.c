/// plan-compare SCENE.ini TRUTH.csv SEED FRAMES RAYS BANDS SPECIES+GROUND LIGHT GRID SAMPLES MAX-ERROR-% [GOT]:
/// errors against the path tracer, by the metric that the planner promises in.
/// GOT: `ray BITS...` lines of measure.c. Prints `measured P95`, `library P95` (the whole library with the same
/// choices), and for each term of the configuration `drop P95 TERM`, in %.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/plan/search.h"

enum { RAYS_MAX = 4096, MEAN_VIEWS = 48 };

static double truth[RAYS_MAX][4];
static float rgb[RAYS_MAX][TRADE_BANDS], many[RAYS_MAX][TRADE_BANDS], got[RAYS_MAX][TRADE_BANDS];
static double want[RAYS_MAX][TRADE_BANDS], scratch[RAYS_MAX], mean[RAYS_MAX];

static void fail(const char *what, const char *name) {
    fprintf(stderr, "plan-compare: %s: %s\n", name, what);
    exit(1);
}

static FILE *open_file(const char *name) {
    FILE *const in = fopen(name, "r");
    if (!in)
        fail("cannot be opened", name);
    return in;
}

static skv_colour_matrix matrix_of(const plan_scene *scene, int bands) {
    skv_atmosphere air;
    skv_colour_matrix m;
    plan_air(scene, 0, bands, &air);
    if (skv_colour_matrix_for(&m, bands, air.wavelength_nm, air.solar_irradiance) != SKV_OK)
        fail("no colours", scene->planet);
    return m;
}

/// Rows come air by air; each is put where its frame and ray are.
static void read_truth(const char *name, const plan_samples *s) {
    char text[1024];
    FILE *const in = open_file(name);
    const skv_colour_matrix m = matrix_of(s->scene, 4);
    size_t place[RAYS_MAX], n = 0, rows = 0;
    for (int which = 0; which < plan_airs(s->scene); which++)
        for (size_t i = 0; i < s->rays; i++)
            if (s->frame[i / (size_t)s->views].air == which)
                place[n++] = i;
    while (fgets(text, sizeof text, in)) {
        double x[10];
        if (text[0] == '#' || text[0] == 'a')
            continue;
        const char *c = text;
        for (int i = 0; i < 10; i++) {
            char *end;
            x[i] = strtod(c, &end);
            if (end == c)
                fail("not a row of plan-truth", name);
            c = end + 1;
        }
        if (rows >= n)
            fail("too many rows", name);
        const plan_ray *const ray = &s->ray[place[rows]];
        if (fabs(x[4] - (90 - ray->elevation_deg)) > 1e-4 || fabs(x[5] - ray->azimuth_deg) > 1e-4)
            fail("belongs to another scene", name);
        for (int k = 0; k < 3; k++) {
            truth[place[rows]][k] = 0;
            for (int b = 0; b < 4; b++)
                truth[place[rows]][k] += (double)m.rgb[k][b] * x[6 + b];
        }
        rows++;
    }
    fclose(in);
    if (rows != n)
        fail("too few rows", name);
}

static void read_got(const char *name, const plan_samples *s, int bands) {
    char text[256];
    FILE *const in = open_file(name);
    const skv_colour_matrix m = matrix_of(s->scene, bands);
    size_t n = 0;
    while (fgets(text, sizeof text, in)) {
        if (strncmp(text, "ray", 3) != 0)
            continue;
        char *c = text + 3;
        float radiance[4] = {0};
        for (int b = 0; b < bands; b++) {
            const uint32_t bits = (uint32_t)strtoul(c, &c, 16);
            memcpy(&radiance[b], &bits, sizeof bits);
        }
        if (n >= s->rays)
            fail("too many rays", name);
        for (int k = 0; k < 3; k++) {
            double sum = 0;
            for (int b = 0; b < bands; b++)
                sum += (double)m.rgb[k][b] * (double)radiance[b];
            rgb[n][k] = (float)sum;
        }
        n++;
    }
    fclose(in);
    if (n != s->rays)
        fail("too few rays", name);
}

/// Means of the frames' directions, by the library at its best: a scale, not a truth.
static void find_means(plan_shop *shop, const plan_scene *scene, unsigned seed, int frames) {
    plan_samples s;
    const plan_config best = plan_best(scene);
    if (!plan_samples_make(&s, scene, seed, frames, MEAN_VIEWS) || s.rays > RAYS_MAX ||
        plan_colours(shop, &best, &s, many) != SKV_OK)
        fail("the library refuses it", scene->planet);
    const int per = s.views + s.terrains;
    for (int i = 0; i < frames; i++)
        for (int j = 0; j < s.views; j++) {
            const float *const c = many[i * per + j];
            mean[i] += (double)fmaxf(fmaxf(c[0], c[1]), c[2]) / s.views;
        }
    plan_samples_free(&s);
}

static double error_of(const plan_samples *s) {
    trade_error e;
    for (size_t i = 0; i < s->rays; i++)
        for (int k = 0; k < 3; k++) {
            const double scale = 1 / mean[i / (size_t)s->views];
            want[i][k] = truth[i][k] * scale;
            got[i][k] = (float)((double)rgb[i][k] * scale);
        }
    trade_measure(s->rays, 3, (const float(*)[TRADE_BANDS])got, (const double(*)[TRADE_BANDS])want, scratch, &e);
    return 100 * e.p95;
}

static double library(plan_shop *shop, const plan_config *config, const plan_samples *s) {
    return plan_colours(shop, config, s, rgb) == SKV_OK ? error_of(s) : -1;
}

int main(int argc, char **argv) {
    static plan_scene scene;
    plan_samples s;
    long x[8];
    if (argc < 11 || plan_scene_load(&scene, argv[1]) != 0) {
        fprintf(stderr,
                "usage: plan-compare SCENE.ini TRUTH.csv SEED FRAMES RAYS BANDS TERMS LIGHT GRID SAMPLES [GOT]\n");
        return 2;
    }
    for (int i = 0; i < 8; i++)
        x[i] = strtol(argv[3 + i], NULL, 10);
    const plan_config config = {.bands = (int)x[3],
                                .species = (unsigned)x[4] & 15u,
                                .ground = (x[4] & SKV_WITH_GROUND) != 0,
                                .light = (plan_light_kind)x[5],
                                .grid = x[6] != 0,
                                .samples = (int)x[7]};
    plan_shop *const shop = plan_shop_open(&scene);
    if (!shop || x[1] * x[2] > RAYS_MAX || !plan_samples_make(&s, &scene, (unsigned)x[0], (int)x[1], (int)x[2]))
        fail("too many rays", argv[1]);
    // Rays of a length have no truth here.
    if (s.terrains > 0) {
        for (int i = 0; i < s.frames; i++)
            memmove(s.ray + i * s.views, s.ray + i * (s.views + s.terrains), (size_t)s.views * sizeof *s.ray);
        s.terrains = 0;
        s.rays = (size_t)(s.frames * s.views);
    }
    read_truth(argv[2], &s);
    find_means(shop, &scene, (unsigned)x[0], (int)x[1]);
    if (argc > 11) {
        read_got(argv[11], &s, config.bands);
        printf("measured %.3f\n", error_of(&s));
    }
    printf("library %.3f\n", library(shop, &config, &s));
    for (plan_term t = 0; t < PLAN_TERMS; t++) {
        plan_config other;
        bool dropped;
        if (plan_toggle(&scene, &config, t, &other, &dropped) && !dropped)
            printf("drop %.3f %s\n", library(shop, &other, &s), plan_term_names[t]);
    }
    plan_samples_free(&s);
    plan_shop_close(shop);
    plan_scene_free(&scene);
    return 0;
}
