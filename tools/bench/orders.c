/// bench-orders [--worst] {FILE.ini TRUTH.csv...}...: error of light of all orders against path-traced truth.
///
/// Error of a ray: largest channel error / largest channel of the truth, which counts as at least 5 % of the mean of
/// its class. The truth's ground is lit.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cases.h"
#include "dome.h"
#include "skyvert/table.h"

#define RAYS_MAX 4000

typedef struct truth_ray {
    double altitude_km, sun_deg, view_deg, azimuth_deg;
    double radiance[4], largest, noise; ///< noise: of the largest relative to it
    int class, ground;
} truth_ray;

static truth_ray rays[RAYS_MAX];
static int ray_count;

static const char *const class_name[] = {"day", "80-85", "88-92", "94", "96", "97-108"};
#define CLASSES 6
static const double class_low[CLASSES] = {0, 80, 88, 93.5, 95.5, 96.5};
static const double class_high[CLASSES] = {75.01, 85, 92, 94.5, 96.5, 108};

/// Light scattered once, or a table of some kind; how it is evaluated.
typedef struct scheme {
    const char *name;
    int table; ///< -1: none
    skv_table_format format;
    int grid;
    skv_tier tier;
} scheme;

static const scheme schemes[] = {
    {"single scattering only", -1, SKV_TABLE_PACKED, 0, SKV_TIER_STANDARD},
    {"small", SKV_TABLE_SMALL, SKV_TABLE_PACKED, 0, SKV_TIER_STANDARD},
    {"small, grid", SKV_TABLE_SMALL, SKV_TABLE_PACKED, 1, SKV_TIER_STANDARD},
    {"accurate, fast", SKV_TABLE_ACCURATE, SKV_TABLE_PACKED, 0, SKV_TIER_FAST},
    {"accurate", SKV_TABLE_ACCURATE, SKV_TABLE_PACKED, 0, SKV_TIER_STANDARD},
    {"accurate, grid", SKV_TABLE_ACCURATE, SKV_TABLE_PACKED, 1, SKV_TIER_STANDARD},
    {"accurate, high", SKV_TABLE_ACCURATE, SKV_TABLE_PACKED, 0, SKV_TIER_HIGH},
    {"large", SKV_TABLE_LARGE, SKV_TABLE_PACKED, 0, SKV_TIER_STANDARD},
    {"accurate, floats", SKV_TABLE_ACCURATE, SKV_TABLE_FLOAT, 0, SKV_TIER_STANDARD},
};

static void fail(const char *name, int line, const char *what) {
    fprintf(stderr, "bench-orders: %s:%d: %s\n", name, line, what);
    exit(2);
}

static int class_of(double sun_deg) {
    for (int c = 0; c < CLASSES; c++)
        if (sun_deg >= class_low[c] && sun_deg <= class_high[c])
            return c;
    return -1;
}

/// Four angles and lengths, one radiance and one standard error per band.
static void take_row(const bench_air *air, const char *name, int line, const char *text) {
    double x[12];
    const int bands = air->atmosphere.bands, want = 4 + 2 * bands;
    for (int i = 0; i < want; i++) {
        char *end;
        x[i] = strtod(text, &end);
        if (end == text || !isfinite(x[i]) || (*end != (i == want - 1 ? '\n' : ',') && *end != '\0'))
            fail(name, line, "altitude, three angles, and L and E of each band are wanted");
        text = end + 1;
    }
    if (ray_count == RAYS_MAX)
        fail(name, line, "too many rays");
    truth_ray *const r = &rays[ray_count];
    *r = (truth_ray){.altitude_km = x[0], .sun_deg = x[1], .view_deg = x[2], .azimuth_deg = x[3]};
    for (int b = 0; b < bands; b++) {
        r->radiance[b] = x[4 + b];
        if (x[4 + b] > r->largest)
            r->noise = x[4 + bands + b] / x[4 + b];
        r->largest = fmax(r->largest, x[4 + b]);
    }
    const double radius = (double)air->atmosphere.radius_km;
    r->class = class_of(r->sun_deg);
    r->ground = r->view_deg > 90 + acos(radius / (radius + r->altitude_km)) * 57.295779513082323;
    if (r->class >= 0 && r->largest > 0)
        ray_count++;
}

static void load_truth(const bench_air *air, const char *name) {
    char text[1024];
    FILE *in = fopen(name, "r");
    int header = 0;
    if (!in)
        fail(name, 0, "cannot be opened");
    for (int line = 1; fgets(text, sizeof text, in); line++) {
        if (text[0] == '#')
            continue;
        if (!header && strncmp(text, "altitude_km,sun_zenith_deg,view_zenith_deg,rel_azimuth_deg,L_", 61) != 0)
            fail(name, line, "not the header of skyvert-reference");
        if (header)
            take_row(air, name, line, text);
        header = 1;
    }
    fclose(in);
}

static const skv_table *build_table(const bench_air *air, const scheme *s, float *store, size_t size) {
    static float work[40000];
    skv_table_spec spec;
    skv_table *const table = (skv_table *)(void *)store;
    if (s->table < 0)
        return NULL;
    bench_check(skv_table_spec_for(&spec, &air->model, (skv_table_kind)s->table), "skv_table_spec_for");
    spec.format = (int32_t)s->format;
    bench_check(skv_table_build(table, size, work, sizeof work, &air->model, &spec), "skv_table_build");
    return table;
}

static double error_of(const bench_air *air, const scheme *s, const skv_table *table, const truth_ray *r,
                       double class_mean) {
    static float grid[8192];
    skv_quality quality;
    skv_frame frame;
    float direction[3], radiance[4];
    bench_check(skv_quality_tier(&quality, s->tier), "skv_quality_tier");
    quality.terms |= SKV_WITH_GROUND;
    bench_frame(&frame, air, &quality, (float)r->altitude_km, r->sun_deg);
    bench_check(skv_frame_table(&frame, table), "skv_frame_table");
    // High up a grid is refused: rays are integrated there whatever is asked for.
    const skv_status has_grid = s->grid ? skv_frame_grid(&frame, grid, sizeof grid) : SKV_OK;
    bench_check(has_grid == SKV_ERR_RANGE ? SKV_OK : has_grid, "skv_frame_grid");
    bench_direction(direction, r->view_deg, r->azimuth_deg);
    const skv_rays ray = {direction, 0, NULL, 0};
    const skv_sky sky = {radiance, 0, NULL, 0};
    bench_check(skv_radiance(&frame, 1, &ray, &sky), "skv_radiance");
    double error = 0;
    for (int b = 0; b < air->atmosphere.bands; b++)
        error = fmax(error, fabs((double)radiance[b] - r->radiance[b]));
    return error / fmax(r->largest, 0.05 * class_mean);
}

static double error[RAYS_MAX], mean_of_class[CLASSES];
static int rays_of_class[CLASSES];

static void find_means(void) {
    for (int c = 0; c < CLASSES; c++) {
        mean_of_class[c] = rays_of_class[c] = 0;
        for (int i = 0; i < ray_count; i++)
            if (rays[i].class == c) {
                mean_of_class[c] += rays[i].largest;
                rays_of_class[c]++;
            }
        mean_of_class[c] /= fmax(rays_of_class[c], 1);
    }
}

/// kind: 0 sky, 1 ground, 2 both.
static void print_line(const char *name, int kind) {
    static const char *const kinds[] = {"sky", "ground", "all"};
    static double chosen[RAYS_MAX];
    printf("%-22s %-6s", name, kinds[kind]);
    for (int c = 0; c < CLASSES; c++) {
        size_t n = 0;
        double sum = 0;
        for (int i = 0; i < ray_count; i++)
            if (rays[i].class == c && (kind == 2 || rays[i].ground == kind)) {
                chosen[n++] = error[i];
                sum += error[i];
            }
        if (rays_of_class[c] == 0)
            continue;
        if (n == 0) {
            printf(" | %20s", "-");
            continue;
        }
        bench_sort(chosen, n);
        printf(" | %6.2f %6.2f %6.2f", 100 * sum / (double)n, 100 * chosen[(size_t)(0.95 * (double)n)],
               100 * chosen[n - 1]);
    }
    printf("\n");
}

/// A row that `skyvert eval` takes.
static void print_worst(const char *ini, int class) {
    int worst = -1;
    for (int i = 0; i < ray_count; i++)
        if ((class < 0 || rays[i].class == class) && (worst < 0 || error[i] > error[worst]))
            worst = i;
    if (worst < 0)
        return;
    printf("    worst %s%s%.2f %% (%s): %.9g,%.9g,%.9g,%.9g\n", class < 0 ? "" : class_name[class],
           class < 0 ? "" : ": ", 100 * error[worst], ini, rays[worst].altitude_km, rays[worst].sun_deg,
           rays[worst].view_deg, rays[worst].azimuth_deg);
}

static void print_head(const char *ini) {
    double noise = 0;
    for (int i = 0; i < ray_count; i++)
        noise += rays[i].noise / ray_count;
    printf("\n%s: error in %%, mean, 95th percentile, largest; mean standard error of the truth %.2f\n%-29s", ini,
           100 * noise, "");
    for (int c = 0; c < CLASSES; c++)
        if (rays_of_class[c] > 0) {
            char text[32];
            snprintf(text, sizeof text, "%s (%d rays)", class_name[c], rays_of_class[c]);
            printf(" | %-20s", text);
        }
    printf("\n");
}

static void measure(const bench_air *air, const char *ini, const scheme *s, int each) {
    static float store[20000];
    const skv_table *const table = build_table(air, s, store, sizeof store);
    for (int i = 0; i < ray_count; i++)
        error[i] = error_of(air, s, table, &rays[i], mean_of_class[rays[i].class]);
    for (int kind = 0; kind < 3; kind++)
        print_line(s->name, kind);
    if (!each)
        print_worst(ini, -1);
    for (int c = 0; each && c < CLASSES; c++)
        print_worst(ini, c);
}

static int ends_in(const char *name, const char *end) {
    const size_t n = strlen(name), m = strlen(end);
    return n >= m && strcmp(name + n - m, end) == 0;
}

int main(int argc, char **argv) {
    static bench_air air;
    const int each = argc > 1 && strcmp(argv[1], "--worst") == 0;
    int i = 1 + each;
    if (i + 1 >= argc || !ends_in(argv[i], ".ini")) {
        fprintf(stderr, "usage: bench-orders [--worst] {FILE.ini TRUTH.csv...}...\n");
        return 2;
    }
    while (i < argc) {
        const char *const ini = argv[i++];
        ray_count = 0;
        bench_air_load(&air, ini, 0);
        while (i < argc && !ends_in(argv[i], ".ini"))
            load_truth(&air, argv[i++]);
        find_means();
        print_head(ini);
        for (size_t k = 0; ray_count > 0 && k < sizeof schemes / sizeof *schemes; k++)
            measure(&air, ini, &schemes[k], each);
    }
    return 0;
}
