/// All orders of scattering against the path tracer's answers in tools/reference/data, held to the numbers of DESIGN 7.
/// Error of a ray: largest channel error / largest channel, which counts as at least 5 % of the mean of its class.
///
///   test_all_orders [FILE.ini FILE.csv]...    measures other sets without judging them
#include "air.h"

#include "read_ini.h"
#include "skyvert/table.h"

enum { ROWS = 1200, DAY = 0, LOW, SET, DUSK, HIGH_SKY, LOW_GROUND, CLASSES };

static const char *const class_names[CLASSES] = {"sun 0-75",      "sun 80-85",           "sun 88-92",
                                                 "sun 94 and 96", "sky rays from 12 km", "ground rays, 1-5 km, day"};

typedef struct limit {
    double mean, p95, max; // percent; 0: no limit
} limit;

typedef struct set {
    const char *name, *ini, *csv;
    limit limits[CLASSES];
} set;

// DESIGN 7, "Total light, standard or high", for BR16 and BR17O; 95 % of fewer than 60 rays is one ray's luck: p95 is
// held in larger sets only. The truth's own noise is .3 % a value. The other airs have no number there: BR17O's for a
// fifth of its air; a fifth more than what is measured for five times as much and for Mars, whose dust scatters on up
// to 60 km; Mars with its coarse dust (g = .935) is held to what is measured and a fifth: light about the sun is wrong
// there at the horizon, by twice.
static const set sets[] = {
    {"br16 (haze)",
     "tools/bench/br16.ini",
     "tools/reference/data/br16.csv",
     {{.7, 3.2, 6}, {1.2, 5, 15}, {1.5, 5, 15}, {1.3, 3.5, 8}, {.3, 0, 1.5}, {2, 0, 6}}},
    {"br17o (clear)",
     "tools/bench/br17o.ini",
     "tools/reference/data/br17o.csv",
     {{.35, 1.3, 3}, {.6, 2.2, 4}, {.8, 2.2, 4}, {1.3, 3, 7}, {.3, 0, 1}, {1.2, 0, 4}}},
    {"thin (clear / 5)",
     "tools/reference/data/thin.ini",
     "tools/reference/data/thin.csv",
     {{.25, 1.3, 2}, {.4, 2.2, 2}, {.5, 2.2, 4}, {.7, 3, 4}, {.3, 0, 1}, {.4, 0, 1}}},
    {"thick (clear x 5)",
     "tools/reference/data/thick.ini",
     "tools/reference/data/thick.csv",
     {{2.2, 0, 8}, {1.4, 0, 4}, {.9, 0, 4}, {2.6, 0, 13}, {1.2, 0, 4}, {4, 0, 7}}},
    {"mars",
     "tools/reference/data/mars.ini",
     "tools/reference/data/mars.csv",
     {{2.5, 0, 8}, {5, 0, 14}, {4.7, 0, 22}, {6, 0, 29}, {1.5, 0, 4}, {2.5, 0, 6}}},
    {"mars, coarse dust",
     "tools/reference/data/coarse.ini",
     "tools/reference/data/coarse.csv",
     {{4.8, 0, 26}, {3.9, 0, 11.4}, {9.9, 0, 116}, {14.4, 0, 109}, {3.6, 0, 13}, {1.8, 0, 3.4}}},
};

typedef struct row {
    double height, sun, view, azimuth, truth[4], got[4];
    int below; // the horizon
} row;

static row rows[ROWS];
static skv_model model;
static skv_table *table;

/// @return rows; 0 where there is no such file.
static int read_rows(const char *name, double radius_km) {
    FILE *const in = fopen(name, "r");
    char line[512];
    int n = 0;
    while (in && fgets(line, sizeof line, in) && n < ROWS) {
        row *const r = &rows[n];
        if (sscanf(line, "%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf", &r->height, &r->sun, &r->view, &r->azimuth, &r->truth[0],
                   &r->truth[1], &r->truth[2], &r->truth[3]) != 8)
            continue; // comments, names of the columns
        r->below = r->view > 90 + acos(radius_km / (radius_km + r->height)) / DEGREE;
        n++;
    }
    if (in)
        fclose(in);
    return n;
}

static void build_table(const char *ini, double *radius_km) {
    static ref_file file;
    static ref_float_tables tables;
    skv_atmosphere atmosphere;
    if (ref_read_ini(&file, ini) != 0)
        fail_msg("%s cannot be read", ini);
    ref_to_skyvert(&file.atmosphere, &atmosphere, &tables);
    for (int b = 0; b < atmosphere.bands; b++)
        atmosphere.solar_irradiance[b] = 1;
    must(skv_model_build(&model, &atmosphere), ini);
    *radius_km = (double)atmosphere.radius_km;
    skv_table_spec spec;
    must(skv_table_spec_for(&spec, &model, SKV_TABLE_ACCURATE), "spec");
    const size_t n = skv_table_size(&spec, atmosphere.bands), work_bytes = skv_table_work_size(&spec, atmosphere.bands);
    void *const work = malloc(work_bytes);
    free(table);
    table = malloc(n);
    assert_true(work && table);
    must(skv_table_build(table, n, work, work_bytes, &model, NULL), "skv_table_build");
    free(work);
}

static void answer(row *r, skv_tier tier) {
    float sun[3], view[3], radiance[4];
    skv_quality q;
    skv_light light;
    skv_frame frame;
    direction_of(sun, r->sun, 0);
    direction_of(view, r->view, r->azimuth);
    must(skv_quality_tier(&q, tier), "tier");
    q.terms = SKV_WITH_ALL;
    must(skv_light_sun(&light, &model, sun), "sun");
    must(skv_frame_begin(&frame, &model, &q, (float)r->height, 0, &light, 1), "frame");
    must(skv_frame_table(&frame, table), "skv_frame_table");
    const skv_rays rays = {view, 0, NULL, 0};
    const skv_sky sky = {radiance, 0, NULL, 0};
    must(skv_radiance(&frame, 1, &rays, &sky), "skv_radiance");
    for (int b = 0; b < model.bands; b++)
        r->got[b] = (double)radiance[b];
}

static int is_of(const row *r, int class_of) {
    switch (class_of) {
    case DAY:
        return r->sun <= 76;
    case LOW:
        return r->sun > 79 && r->sun < 86;
    case SET:
        return r->sun >= 87.9 && r->sun < 93;
    case DUSK:
        return r->sun >= 93;
    case HIGH_SKY:
        return r->height >= 12 && !r->below && r->sun <= 76;
    default:
        return r->below && r->height >= 1 && r->height <= 5 && r->sun <= 76;
    }
}

static int ascending(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static int judge(const set *s, int count, int class_of, const char *tier) {
    static double error[ROWS];
    const row *worst = NULL;
    double mean_truth = 0, mean = 0, largest = -1;
    int n = 0, of = 0;
    for (int i = 0; i < count; i++)
        if (is_of(&rows[i], class_of)) {
            mean_truth += largest_of(rows[i].truth, model.bands);
            of++;
        }
    for (int i = 0; i < count; i++) {
        double e = 0;
        if (!is_of(&rows[i], class_of))
            continue;
        for (int b = 0; b < model.bands; b++)
            e = fmax(e, fabs(rows[i].got[b] - rows[i].truth[b]));
        e *= 100 / fmax(largest_of(rows[i].truth, model.bands), 0.05 * mean_truth / of);
        mean += e / of;
        worst = e > largest ? &rows[i] : worst;
        largest = fmax(largest, e);
        error[n++] = e;
    }
    if (n == 0)
        return 0;
    qsort(error, (size_t)n, sizeof *error, ascending);
    const double p95 = error[(int)(0.95 * n)];
    const limit *const l = &s->limits[class_of];
    print_message("figure: all orders, %s, %s, %s: mean %.2f p95 %.1f max %.1f %% (%d rays)\n", s->name, tier,
                  class_names[class_of], mean, p95, largest, n);
    if ((l->mean > 0 && mean > l->mean) || (l->p95 > 0 && n >= 60 && p95 > l->p95) ||
        (l->max > 0 && largest > l->max)) {
        print_message("%s, %s, %s: allowed mean %g p95 %g max %g %%; worst %g km, sun %g, view %g, azimuth %g\n",
                      s->name, tier, class_names[class_of], l->mean, l->p95, l->max, worst->height, worst->sun,
                      worst->view, worst->azimuth);
        return 1;
    }
    return 0;
}

static int measure(const set *s) {
    double radius_km = 0;
    int failed = 0;
    build_table(s->ini, &radius_km);
    const int n = read_rows(s->csv, radius_km);
    if (n == 0)
        print_message("note: all orders: no rows in %s\n", s->csv);
    for (int tier = SKV_TIER_STANDARD; n > 0 && tier <= SKV_TIER_HIGH; tier++) {
        for (int i = 0; i < n; i++)
            answer(&rows[i], (skv_tier)tier);
        for (int c = 0; c < CLASSES; c++)
            failed |= judge(s, n, c, tier == SKV_TIER_HIGH ? "high" : "standard");
    }
    return failed;
}

static void all_orders_against_the_path_tracer(void **state) {
    int failed = 0;
    (void)state;
    for (size_t i = 0; i < sizeof sets / sizeof *sets; i++)
        failed |= measure(&sets[i]);
    if (failed)
        fail_msg("a class is outside its limits (above)");
}

int main(int argc, char **argv) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(all_orders_against_the_path_tracer)};
    for (int i = 1; i + 1 < argc; i += 2) {
        const set s = {argv[i + 1], argv[i], argv[i + 1], {{0, 0, 0}}};
        (void)measure(&s);
    }
    return argc > 1 ? 0 : cmocka_run_group_tests(tests, NULL, NULL);
}
