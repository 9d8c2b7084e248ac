/// Every rule against the converged double reference at the same floats: ground to 60 km, sun -6 to 90 deg elevation.
/// Error of a ray: largest channel error / largest channel, which counts as at least 5 % of the dome's mean.
#include "air.h"

#define SKY    12
#define GROUND 6

enum { LOW_DAY, LOW_DAY_OTHER, HIGH_DAY, GROUND_DAY, LOW_SUN, LAYER_DAY, LAYER_LOW, CLASSES };
static const char *const class_names[CLASSES] = {
    "sky 0-5 km, day", "the same, other air", "sky above 5 km, day", "rays to the ground, day",
    "sun -6 to 1 deg", "layers, day",         "layers, sun -6 to 1"};

typedef struct tally {
    int n;
    double error[20000], worst;
    char where[160];
} tally;

static tally tallies[CLASSES];

static void note(int class_of, double error, const air *a, float h, double sun, double view, double azimuth) {
    tally *t = &tallies[class_of];
    if (t->n < 20000)
        t->error[t->n++] = error;
    if (!(error <= t->worst)) {
        t->worst = error;
        snprintf(t->where, sizeof t->where, "%s, %g km, sun zenith %g, view zenith %.3f, azimuth %.2f", a->name,
                 (double)h, sun, view, azimuth);
    }
}

typedef struct dome {
    float sun[3], height_km;
    double sun_zenith_deg;
    int n, class_of[SKY + GROUND];
    float view[SKY + GROUND][3];
    double zenith[SKY + GROUND], azimuth[SKY + GROUND];
    ref_answer truth[SKY + GROUND];
    double mean;
} dome;

static void lay(dome *d, const air *a, float height_km, double sun_zenith_deg, int seed) {
    const double radius = (double)a->atmosphere.radius_km + (double)a->ground_km,
                 y = (double)height_km - (double)a->ground_km;
    const double horizon = 90 + acos(radius / (radius + y)) / DEGREE;
    d->height_km = height_km;
    d->sun_zenith_deg = sun_zenith_deg;
    direction_of(d->sun, sun_zenith_deg, 0);
    d->n = y > 0 ? SKY + GROUND : SKY;
    d->mean = 0;
    for (int i = 0; i < d->n; i++) {
        const double t = halton(i + 1 + seed, 2);
        d->zenith[i] = i < SKY ? t * horizon : horizon + t * (180 - horizon);
        d->azimuth[i] = 180 * halton(i + 1 + seed, 3);
        direction_of(d->view[i], d->zenith[i], d->azimuth[i]);
        truth_of(a, height_km, d->view[i], d->sun, INFINITY, 0, &d->truth[i]);
        d->mean += largest_of(d->truth[i].radiance, a->atmosphere.bands) / d->n;
        const int other = (double)a->atmosphere.aerosol_extinction_per_km[0] > 0.03 ||
                          a->atmosphere.rayleigh.kind == SKV_PROFILE_US76 ||
                          a->atmosphere.dust.kind != SKV_PROFILE_NONE;
        const int low = other ? LOW_DAY_OTHER : LOW_DAY;
        const int layer = a->atmosphere.dust.kind == SKV_PROFILE_TENT || a->atmosphere.dust.kind == SKV_PROFILE_TABLE;
        if (layer)
            d->class_of[i] = sun_zenith_deg > 89 ? LAYER_LOW : LAYER_DAY;
        else
            d->class_of[i] = sun_zenith_deg > 89 ? LOW_SUN : i >= SKY ? GROUND_DAY : height_km <= 5 ? low : HIGH_DAY;
    }
}

static void measure(const dome *d, const air *a, const skv_quality *quality) {
    skv_frame frame;
    float radiance[SKY + GROUND][4] = {{0}}, through[SKY + GROUND][4] = {{0}};
    const skv_rays rays = {d->view[0], 0, NULL, 0};
    const skv_sky sky = {radiance[0], sizeof radiance[0], through[0], sizeof through[0]};
    frame_of(&frame, a, quality, d->height_km, d->sun);
    must(skv_radiance(&frame, (size_t)d->n, &rays, &sky), "skv_radiance");
    for (int i = 0; i < d->n; i++) {
        double error = 0;
        for (int b = 0; b < a->atmosphere.bands; b++) {
            error = fmax(error, fabs((double)radiance[i][b] - d->truth[i].radiance[b]));
            if (!(radiance[i][b] >= 0 && through[i][b] >= 0 && through[i][b] <= 1))
                fail_msg("%s: radiance %g, transmittance %g", a->name, (double)radiance[i][b], (double)through[i][b]);
        }
        note(d->class_of[i], error / fmax(largest_of(d->truth[i].radiance, a->atmosphere.bands), 0.05 * d->mean), a,
             d->height_km, d->sun_zenith_deg, d->zenith[i], d->azimuth[i]);
    }
}

typedef struct limit {
    double mean, p95, max; // percent; 0: not limited
} limit;

typedef struct rule {
    const char *name;
    skv_quality quality;
    limit limits[CLASSES];
} rule;

static int ascending(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static int judge(const rule *r) {
    int failed = 0;
    for (int c = 0; c < CLASSES; c++) {
        tally *t = &tallies[c];
        double mean = 0;
        qsort(t->error, (size_t)t->n, sizeof *t->error, ascending);
        for (int i = 0; i < t->n; i++)
            mean += 100 * t->error[i] / t->n;
        const double p95 = 100 * t->error[(int)(0.95 * t->n)], max = 100 * t->worst;
        const limit *l = &r->limits[c];
        const int ok =
            !(l->mean > 0 && mean > l->mean) && !(l->p95 > 0 && p95 > l->p95) && !(l->max > 0 && max > l->max);
        printf("figure: %-18s %-24s mean %.3f p95 %.3f max %.3f %% (%d rays)\n", r->name, class_names[c], mean, p95,
               max, t->n);
        if (!ok) {
            failed = 1;
            print_message("%s, %s: allowed mean %g p95 %g max %g %%; worst at %s\n", r->name, class_names[c], l->mean,
                          l->p95, l->max, t->where);
        }
    }
    return failed;
}

// The airs: what the design's figures are stated for, other profiles, and ground below and above the sea.
#define AIRS 8
static air airs[AIRS];

static int make_airs(void **state) {
    (void)state;
    air_make(&airs[0], "clear with ozone", air_clear(4), 0);
    air_make(&airs[1], "hazy", air_hazy(4), 0);
    air_make(&airs[2], "us76, background, lognormal", air_shaped(4), 0);
    air_make(&airs[3], "clear, ground at -0.43 km", air_clear(3), -0.43f);
    air_make(&airs[4], "hazy, ground at 2.4 km", air_hazy(3), 2.4f);
    air_make(&airs[5], "smoke and an absorbing gas", air_smoky(4), 0);
    air_make(&airs[6], "layer of smoke", air_layered(4, 0), 0);
    air_make(&airs[7], "layer from a table, ground at 2.4 km", air_layered(3, 1), 2.4f);
    return 0;
}

#define DOMES (AIRS * 8 * 10)
static dome domes[DOMES];

static void lay_domes(void) {
    static const float heights[] = {0, 0.02f, 1, 2.5f, 5, 12, 30, 60};
    static const double low_suns[] = {90, 92, 94, 96};
    int n = 0;
    for (int k = 0; k < AIRS; k++)
        for (int h = 0; h < 8; h++)
            for (int s = 0; s < 10; s++, n++) {
                // By day even in elevation, 1 to 90 deg.
                const double sun = s < 6 ? 89 * (s + halton(n + 1, 5)) / 6 : low_suns[s - 6];
                lay(&domes[n], &airs[k], fmaxf(heights[h], airs[k].ground_km), sun, n % 97 * 18);
            }
}

// Limits, mean/p95/max: the design's numbers to reach where it states them: 0-5 km by day (clear and moderately hazy
// air) for each tier, everything else for high. Elsewhere: twice what the design's table says N samples can do in that
// class, and for the rules by Keller its rows for 0-5 km. In layers the sun's columns have corners where a ray to the
// sun grazes an edge; legs are not cut there: by day it is seen at grazing rays alone, in twilight everywhere. In
// strong haze (0.064/km at 440 nm) fast and standard have no number of their own: three times the clear one.
static void rules_against_the_reference(void **state) {
    (void)state;
    rule rules[] = {
        {"fast", {0}, {{.5, 1.6, 4.5}, {1.5, 4.8, 13}, {1, 3, 22}, {1, 3, 22}, {2, 8, 33}, {.1, .4, 6}, {3, 12, 40}}},
        {"standard",
         {0},
         {{.08, .2, .4}, {.24, .6, 1.5}, {.25, .6, 5}, {.25, .6, 5}, {.4, 1.5, 6}, {.05, .15, .6}, {3, 12, 40}}},
        {"high",
         {0},
         {{.06, .15, .3}, {.06, .15, .3}, {.25, .6, 3}, {.25, .6, 3}, {.25, .6, 3}, {.05, .15, .6}, {2, 10, 30}}},
        {"gauss-exp 16",
         quality_of(SKV_GAUSS_EXP, SKV_DEPTH_BY_CHAPMAN, 16, 1),
         {{.06, .15, .3}, {.06, .15, .3}, {.25, .6, 3}, {.25, .6, 3}, {.25, .6, 3}, {.05, .15, .6}, {1, 4, 15}}},
        {"gauss-exp inner 16",
         quality_of(SKV_GAUSS_EXP, SKV_DEPTH_BY_INNER, 8, 16),
         {{.25, .6, 3}, {.25, .6, 3}, {.25, .6, 3}, {.25, .6, 3}, {.25, .6, 3}}},
        {"keller 16x16",
         quality_of(SKV_KELLER, SKV_DEPTH_BY_INNER, 16, 16),
         {{.7, 1.6, 4}, {1, 2.4, 6}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}}},
        {"uniform 16x16",
         quality_of(SKV_UNIFORM, SKV_DEPTH_BY_INNER, 16, 16),
         {{4.8, 19, 41}, {6, 25, 60}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}}},
    };
    int failed = 0;
    lay_domes();
    for (int t = 0; t < 3; t++)
        must(skv_quality_tier(&rules[t].quality, (skv_tier)t), "skv_quality_tier");
    for (size_t r = 0; r < sizeof rules / sizeof *rules; r++) {
        for (int c = 0; c < CLASSES; c++)
            tallies[c].n = 0, tallies[c].worst = 0;
        for (int i = 0; i < DOMES; i++)
            measure(&domes[i], &airs[i / 80], &rules[r].quality);
        failed |= judge(&rules[r]);
    }
    if (failed)
        fail_msg("a rule is outside its limits (above)");
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(rules_against_the_reference)};
    return cmocka_run_group_tests(tests, make_airs, NULL);
}
