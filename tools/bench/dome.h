/// The directions that costs are measured with.
#ifndef TOOLS_BENCH_DOME_H
#define TOOLS_BENCH_DOME_H

#include "cases.h"

#define RINGS    32
#define AZIMUTHS 64
#define VERTICES (RINGS * AZIMUTHS)

/// What is looked at: the sky alone from 2 km, or a dome down to 10 degrees below the horizontal from 1 km.
typedef struct bench_scene {
    const char *name;
    int bare;
    float height_km;
    double sun_zenith_deg, lowest_deg;
} bench_scene;

enum { BENCH_BARE, BENCH_DOME, BENCH_DUSK, BENCH_SCENES };

extern const bench_scene bench_scenes[BENCH_SCENES];

void bench_lay_dome(const bench_scene *scene, float direction[VERTICES][3]);

double bench_now_ns(void);

/// Sorts n numbers.
void bench_sort(double *x, size_t n);

#endif
