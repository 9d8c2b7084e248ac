/// bench-cost count|time FILE.ini: what a vertex costs, single scattering.
/// count: run it under callgrind --collect-atstart=no; every figure is one dump, labelled `what|rule|vertices`.
/// time:  nanoseconds, rules interleaved so that a busy machine disturbs all of them alike.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <valgrind/callgrind.h>

#include "dome.h"

#define COPIES  64
#define REPEATS 41

static float direction[VERTICES][3], radiance[VERTICES][4];
static double checksum;

static void add_up(int n, int bands) {
    for (int i = 0; i < n; i++)
        for (int b = 0; b < bands; b++)
            checksum += (double)radiance[i][b];
}

static void shine(const skv_frame *frame, int n) {
    const skv_rays rays = {direction[0], 0, NULL, 0};
    const skv_sky sky = {radiance[0], sizeof radiance[0], NULL, 0};
    bench_check(skv_radiance(frame, (size_t)n, &rays, &sky), "skv_radiance");
}

// The argument of a client request must be a string of the program's own.
static void count_one(const skv_frame *frame, int n, const char *what, const char *rule) {
    char label[96];
    snprintf(label, sizeof label, "%s|%s|%d", what, rule, n);
    shine(frame, n); // warm: lazily bound symbols are not the library's
    CALLGRIND_ZERO_STATS;
    CALLGRIND_TOGGLE_COLLECT;
    shine(frame, n);
    CALLGRIND_TOGGLE_COLLECT;
    CALLGRIND_DUMP_STATS_AT(label);
    add_up(n, frame->model->bands);
}

// The dearest vertex: batches of copies of one direction, around the horizon where rays have two or three lit parts.
static void count_worst(const bench_air *air, const skv_quality *quality, const char *rule) {
    static const double suns[] = {60, 92, 95}, elevations[] = {60, 3, 0.5, -0.2, -0.6, -1, -3}, azimuths[] = {0, 180};
    for (int n = 0; n < 3 * 7 * 2; n++) {
        skv_frame frame;
        bench_frame(&frame, air, quality, 1, suns[n % 3]);
        for (int i = 0; i < COPIES; i++)
            bench_direction(direction[i], 90 - elevations[n / 3 % 7], azimuths[n / 21]);
        count_one(&frame, COPIES, "worst", rule);
    }
}

static int begin(skv_frame *frame, const bench_air *air, const bench_scene *s, size_t rule) {
    skv_quality quality;
    skv_frame probe;
    skv_light light = {{0, 0, 1}, {1, 1, 1, 1}};
    if (bench_quality(&bench_rules[rule], &quality) != SKV_OK ||
        skv_frame_begin(&probe, &air->model, &quality, 0, 0, &light, 1) != SKV_OK)
        return 0; // left out of this build
    bench_frame(frame, air, &quality, s->height_km, s->sun_zenith_deg);
    return 1;
}

static void count(const bench_air airs[2], int trimmed) {
    for (int k = 0; k < (trimmed ? 1 : BENCH_SCENES); k++)
        for (size_t r = 0; r < bench_rule_count; r++) {
            skv_frame frame;
            bench_lay_dome(&bench_scenes[k], direction);
            if (begin(&frame, &airs[bench_scenes[k].bare], &bench_scenes[k], r))
                count_one(&frame, VERTICES, bench_scenes[k].name, bench_rules[r].name);
        }
    for (size_t r = 0; !trimmed && r < bench_rule_count; r++) {
        skv_quality quality;
        if (bench_rules[r].tier >= 0 && bench_quality(&bench_rules[r], &quality) == SKV_OK)
            count_worst(&airs[0], &quality, bench_rules[r].name);
    }
}

static void time_scene(const bench_air *air, const bench_scene *s) {
    static double took[16][REPEATS];
    static skv_frame frame[16];
    int present[16];
    bench_lay_dome(s, direction);
    for (size_t r = 0; r < bench_rule_count; r++)
        present[r] = begin(&frame[r], air, s, r);
    for (int i = -3; i < REPEATS; i++)
        for (size_t r = 0; r < bench_rule_count; r++) {
            if (!present[r])
                continue;
            const double start = bench_now_ns();
            shine(&frame[r], VERTICES);
            add_up(VERTICES, air->model.bands);
            if (i >= 0)
                took[r][i] = bench_now_ns() - start;
        }
    for (size_t r = 0; r < bench_rule_count; r++) {
        if (!present[r])
            continue;
        bench_sort(took[r], REPEATS);
        printf("%s|%s|%.1f|%.1f|%.3f\n", s->name, bench_rules[r].name, took[r][REPEATS / 2] / VERTICES,
               took[r][0] / VERTICES, took[r][0] * 1e-6);
    }
}

int main(int argc, char **argv) {
    static bench_air airs[2]; // whole, bare
    if (argc != 3 || (strcmp(argv[1], "count") != 0 && strcmp(argv[1], "time") != 0)) {
        fprintf(stderr, "usage: bench-cost count|time FILE.ini\n");
        return 2;
    }
    const int trimmed = SKV_BANDS == 3;
    bench_air_load(&airs[1], argv[2], 1);
    if (!trimmed)
        bench_air_load(&airs[0], argv[2], 0);
    if (argv[1][0] == 'c')
        count(airs, trimmed);
    for (int k = 0; argv[1][0] == 't' && k < (trimmed ? 1 : BENCH_SCENES); k++)
        time_scene(&airs[bench_scenes[k].bare], &bench_scenes[k]);
    printf("checksum|%.9g\n", checksum);
    return 0;
}
