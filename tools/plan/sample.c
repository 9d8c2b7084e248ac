#include "tools/plan/sample.h"

#include <math.h>
#include <stdint.h>

static const double degree = 0.017453292519943295;

/// Of i in a base, mirrored at the point: [0, 1).
static double halton(unsigned i, unsigned base) {
    double f = 1, sum = 0;
    for (; i > 0; i /= base) {
        f /= base;
        sum += f * (i % base);
    }
    return sum;
}

/// [0, 1) from four numbers: the mixing function of [Steele14].
static double noise(unsigned seed, unsigned a, unsigned b, unsigned c) {
    uint64_t z = ((uint64_t)seed << 32) + a * 0x9E3779B97F4A7C15u + b * 0xBF58476D1CE4E5B9u + c * 0x94D049BB133111EBu;
    for (int i = 0; i < 2; i++) {
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
        z ^= z >> 31;
    }
    return (double)(z >> 11) * 0x1p-53;
}

/// The sequence's coordinate in a base, turned by the seed.
static double coordinate(unsigned seed, int i, unsigned base) {
    const double x = halton((unsigned)i + 1, base) + noise(seed, base, 0, 0);
    return x - floor(x);
}

static double within(plan_range range, double x) {
    return range.low + (range.high - range.low) * x;
}

plan_frame plan_frame_at(const plan_scene *scene, unsigned seed, int i) {
    const plan_frame f = {(int)(plan_airs(scene) * coordinate(seed, i, 5)),
                          0.001 * within(scene->height_m, coordinate(seed, i, 2)),
                          within(scene->sun_deg, coordinate(seed, i, 3))};
    return f;
}

plan_ray plan_view_at(const plan_scene *scene, unsigned seed, int i, int j, int n) {
    const double golden = 0.6180339887498949;
    const double up = (j + noise(seed, (unsigned)i, (unsigned)j, 1)) / n;
    const double turn = j * golden + noise(seed, (unsigned)i, 0, 2);
    return (plan_ray){within(scene->view_deg, up), 360 * (turn - floor(turn)), INFINITY};
}

plan_ray plan_terrain_at(const plan_scene *scene, unsigned seed, int i, int j, int n) {
    plan_ray ray = plan_view_at(scene, seed + 7919, i, j, n);
    const plan_range v = scene->view_deg;
    const double low = fmin(fmax(v.low, -12), v.high), high = fmax(fmin(v.high, 4), v.low);
    ray.elevation_deg = low + (high - low) * (j + noise(seed, (unsigned)i, (unsigned)j, 3)) / n;
    const plan_range km = scene->terrain_km;
    ray.length_km = km.low * pow(km.high / km.low, noise(seed, (unsigned)i, (unsigned)j, 4));
    return ray;
}

plan_ray plan_dome_at(const plan_scene *scene, int i, int n) {
    const int rings = (int)fmax(floor(sqrt(0.5 * n) + 0.5), 1), around = (n + rings - 1) / rings;
    const double up = (i / around + 0.5) / rings;
    return (plan_ray){within(scene->view_deg, 1 - up), 360.0 * (i % around) / around, INFINITY};
}

void plan_direction(const plan_ray *ray, float direction[3]) {
    const double e = ray->elevation_deg * degree, a = ray->azimuth_deg * degree;
    direction[0] = (float)(cos(e) * sin(a));
    direction[1] = (float)(cos(e) * cos(a));
    direction[2] = (float)sin(e);
}

void plan_sun_direction(const plan_frame *frame, float direction[3]) {
    const plan_ray sun = {frame->sun_deg, 0, 0};
    plan_direction(&sun, direction);
}

plan_vertices plan_share(const plan_scene *scene, int vertices) {
    const int terrain = (int)(scene->terrain_share * vertices);
    return (plan_vertices){vertices - terrain, terrain};
}
