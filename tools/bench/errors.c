/// bench-errors FILE.ini...: error of every rule against the reference, per class of ray, single scattering.
/// Error of a ray: largest channel error / largest channel of the truth, which counts as at least 5 % of the dome's
/// mean.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cases.h"

#define SKY    80
#define GROUND 40
#define RAYS   (SKY + GROUND)

typedef struct group {
    const char *name;
    int heights, suns; // six suns: day, even in elevation from 1 to 90 deg
    float height_km[6];
    double sun_zenith_deg[6];
    int class_of_sky, class_of_ground;
} group;

static const char *const class_name[] = {"sky 0-5 km, day",     "sky 8-60 km, day",     "to the ground, day",
                                         "sky, sun 88-90",      "to the ground, 88-90", "sky, sun 92-96",
                                         "to the ground, 92-96"};
#define CLASSES 7
static const group groups[] = {
    {"low", 5, 6, {0, 0.3f, 1, 3, 5}, {0}, 0, 2},
    {"high", 5, 6, {8, 12, 20, 40, 60}, {0}, 1, 2},
    {"sunset", 6, 3, {0, 1, 5, 12, 30, 60}, {88, 89, 90}, 3, 4},
    {"twilight", 6, 3, {0, 1, 5, 12, 30, 60}, {92, 94, 96}, 5, 6},
};
#define GROUPS     4
#define FRAMES_MAX (30 * GROUPS)

// The truth of one frame's rays.
typedef struct dome {
    float height_km;
    double sun_zenith_deg;
    int rays, class_of[RAYS];
    float direction[RAYS][3];
    double truth[RAYS][4], largest[RAYS];
    double mean;
} dome;

static dome domes[FRAMES_MAX];
static int dome_count;

static double halton(int i, int base) {
    double f = 1, r = 0;
    for (; i > 0; i /= base) {
        f /= base;
        r += f * (i % base);
    }
    return r;
}

// Sky: zenith angle even from the zenith to the geometric horizon. Ground: even from there to the nadir.
static void lay_directions(dome *d, const bench_air *air, const group *g) {
    const double radius = (double)air->atmosphere.radius_km;
    const double horizon = 90 + acos(radius / (radius + (double)d->height_km)) * 57.295779513082323;
    d->rays = d->height_km > 0 ? RAYS : SKY;
    for (int i = 0; i < d->rays; i++) {
        const int at = i + 1 + RAYS * (dome_count % 64); // other directions in every frame
        const double t = halton(at, 2), azimuth = 180 * halton(at, 3);
        const int sky = i < SKY;
        bench_direction(d->direction[i], sky ? t * horizon : horizon + t * (180 - horizon), azimuth);
        d->class_of[i] = sky ? g->class_of_sky : g->class_of_ground;
    }
}

static void find_truth(dome *d, const bench_air *air) {
    float sun[3];
    bench_direction(sun, d->sun_zenith_deg, 0);
    const double sun_d[3] = {(double)sun[0], (double)sun[1], (double)sun[2]};
    d->mean = 0;
    for (int i = 0; i < d->rays; i++) {
        const double v[3] = {(double)d->direction[i][0], (double)d->direction[i][1], (double)d->direction[i][2]};
        const ref_ray ray = ref_ray_from_vectors((double)d->height_km, v, sun_d);
        ref_answer answer;
        if (ref_single(&air->truth.atmosphere, &ray, 0, NULL, &answer) != 0) {
            fprintf(stderr, "bench-errors: the reference did not converge\n");
            exit(1);
        }
        memcpy(d->truth[i], answer.radiance, sizeof d->truth[i]);
        d->largest[i] = 0;
        for (int b = 0; b < air->atmosphere.bands; b++)
            d->largest[i] = fmax(d->largest[i], answer.radiance[b]);
        d->mean += d->largest[i] / d->rays;
    }
}

static void lay_domes(const bench_air *air) {
    dome_count = 0;
    for (int k = 0; k < GROUPS; k++)
        for (int n = 0; n < groups[k].heights * groups[k].suns; n++) {
            dome *d = &domes[dome_count++];
            d->height_km = groups[k].height_km[n % groups[k].heights];
            const int s = n / groups[k].heights;
            d->sun_zenith_deg = groups[k].suns == 6 ? 89 * (s + halton(n + 1, 5)) / 6 : groups[k].sun_zenith_deg[s];
            lay_directions(d, air, &groups[k]);
            find_truth(d, air);
        }
}

typedef struct tally {
    int n;
    double error[FRAMES_MAX * RAYS];
    double worst;
    char where[96];
} tally;

static tally tallies[CLASSES];

static void add(const dome *d, int i, double error) {
    tally *t = &tallies[d->class_of[i]];
    t->error[t->n++] = error;
    if (error > t->worst) {
        t->worst = error;
        const double v = acos((double)d->direction[i][2]) * 57.295779513082323;
        snprintf(t->where, sizeof t->where, "%g km, sun %g, view %.2f, azimuth %.1f", (double)d->height_km,
                 d->sun_zenith_deg, v,
                 atan2((double)d->direction[i][0], -(double)d->direction[i][1]) * 57.295779513082323);
    }
}

static void measure(const dome *d, const bench_air *air, const skv_quality *quality) {
    skv_frame frame;
    float radiance[RAYS][4] = {{0}};
    const skv_rays rays = {d->direction[0], 0, NULL, 0};
    const skv_sky sky = {radiance[0], sizeof radiance[0], NULL, 0};
    bench_frame(&frame, air, quality, d->height_km, d->sun_zenith_deg);
    bench_check(skv_radiance(&frame, (size_t)d->rays, &rays, &sky), "skv_radiance");
    for (int i = 0; i < d->rays; i++) {
        double error = 0;
        for (int b = 0; b < air->atmosphere.bands; b++)
            error = fmax(error, fabs((double)radiance[i][b] - d->truth[i][b]));
        add(d, i, error / fmax(d->largest[i], 0.05 * d->mean));
    }
}

static int ascending(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void print_row(const char *name) {
    printf("%-22s", name);
    for (int c = 0; c < CLASSES; c++) {
        tally *t = &tallies[c];
        double sum = 0;
        qsort(t->error, (size_t)t->n, sizeof *t->error, ascending);
        for (int i = 0; i < t->n; i++)
            sum += t->error[i];
        printf(" | %6.3f %6.2f %6.2f", 100 * sum / t->n, 100 * t->error[(int)(0.95 * t->n)], 100 * t->worst);
    }
    printf("\n");
}

static void print_rule(const bench_air *air, const char *name, const skv_quality *quality, int where) {
    for (int c = 0; c < CLASSES; c++)
        tallies[c].n = 0, tallies[c].worst = -1;
    for (int i = 0; i < dome_count; i++)
        measure(&domes[i], air, quality);
    print_row(name);
    for (int c = 0; where && c < CLASSES; c++)
        printf("    worst, %s: %.3f %% at %s\n", class_name[c], 100 * tallies[c].worst, tallies[c].where);
}

static void print_head(const char *name) {
    printf("\n%s: error in %%, mean, 95th percentile, largest\n%-22s", name, "");
    for (int c = 0; c < CLASSES; c++)
        printf(" | %-20s", class_name[c]);
    printf("\n");
}

int main(int argc, char **argv) {
    static bench_air air;
    int first = 1, where = 0, samples = 0;
    for (; first < argc && argv[first][0] == '-'; first++) {
        if (strcmp(argv[first], "--worst") == 0)
            where = 1;
        else if (strcmp(argv[first], "--samples") == 0 && first + 1 < argc)
            samples = atoi(argv[++first]);
        else
            first = argc;
    }
    if (first >= argc) {
        fprintf(stderr, "usage: bench-errors [--worst] [--samples N, gauss-exp alone] FILE.ini...\n");
        return 2;
    }
    for (int i = first; i < argc; i++) {
        bench_air_load(&air, argv[i], 0);
        lay_domes(&air);
        print_head(argv[i]);
        for (size_t r = 0; samples == 0 && r < bench_rule_count; r++) {
            skv_quality quality;
            if (bench_quality(&bench_rules[r], &quality) == SKV_OK)
                print_rule(&air, bench_rules[r].name, &quality, where);
        }
        if (samples > 0) {
            const skv_quality quality = {SKV_GAUSS_EXP, SKV_DEPTH_BY_CHAPMAN, samples, 1,
                                         SKV_WITH_ALL & ~(uint32_t)SKV_WITH_GROUND};
            print_rule(&air, "gauss-exp", &quality, where);
        }
    }
    return 0;
}
