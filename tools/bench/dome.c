/// The directions that costs are measured with.
#include "dome.h"

#include <stdlib.h>
#include <time.h>

const bench_scene bench_scenes[BENCH_SCENES] = {
    {"bare", 1, 2, 45, 0}, {"dome", 0, 1, 60, -10}, {"dusk", 0, 1, 94, -10}};

void bench_lay_dome(const bench_scene *scene, float direction[VERTICES][3]) {
    for (int i = 0; i < VERTICES; i++) {
        const double elevation = 90 + (scene->lowest_deg - 90) * ((i / AZIMUTHS) + 0.5) / RINGS;
        bench_direction(direction[i], 90 - elevation, 360.0 * (i % AZIMUTHS) / AZIMUTHS);
    }
}

double bench_now_ns(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return 1e9 * (double)t.tv_sec + (double)t.tv_nsec;
}

static int ascending(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

void bench_sort(double *x, size_t n) {
    qsort(x, n, sizeof *x, ascending);
}
