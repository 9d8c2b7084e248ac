/// plan-truth pool [FIRST] | scene FILE.ini SEED FRAMES RAYS: path-traced truth for the planner, as CSV.
/// pool:  rays in many airs (from the FIRST one on), from which the planner knows the model's own error (pool.csv,
/// `make
///        plan-truth`).
/// scene: rays of a scene file, for tests: to .8 %, a fifth of the errors that are measured with them.
/// Columns: air, visibility_km (0: as it is), altitude_km, three angles, L and E (standard error) of four bands.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "convert.h"
#include "orders.h"
#include "tools/plan/sample.h"

static ref_job job = {.target = 0.005, .max_paths = 2000000, .seed = 1, .threads = 2, .lit_ground = 1};

typedef struct pool_air {
    int preset;
    double visibility_km;
    int rays;
} pool_air;

/// Airs that the model's error is known in.
static const pool_air pool[] = {
    {SKV_PRESET_EARTH_CLEAR, 0, 110}, {SKV_PRESET_EARTH_CLEAR, 60, 90}, {SKV_PRESET_EARTH_CLEAR, 30, 90},
    {SKV_PRESET_EARTH_CLEAR, 12, 90}, {SKV_PRESET_EARTH_HAZY, 0, 110},  {SKV_PRESET_EARTH_HAZY, 25, 110},
};

static int trace(const skv_atmosphere *air, int lit, ref_query *query, size_t n, ref_total *total) {
    static ref_file file;
    ref_tracer tracer;
    ref_job with = job;
    with.lit_ground = lit;
    ref_from_skyvert(air, 0, &file);
    if (ref_tracer_make(&tracer, &file.atmosphere, job.threads) != 0)
        return 1;
    const int result = ref_orders_run(&tracer, &with, query, n, total);
    ref_tracer_free(&tracer);
    return result;
}

static void print_rows(int air, double visibility_km, const ref_query *query, size_t n, const ref_total *total,
                       int bands) {
    for (size_t i = 0; i < n; i++) {
        printf("%d,%.6g,%.7g,%.7g,%.7g,%.7g", air, visibility_km, query[i].altitude_km, query[i].sun_zenith_deg,
               query[i].view_zenith_deg, query[i].azimuth_deg);
        for (int b = 0; b < bands; b++)
            printf(",%.5e", total[i].radiance[b]);
        for (int b = 0; b < bands; b++)
            printf(",%.1e", total[i].error[b]);
        printf("\n");
    }
}

static void print_head(const char *target) {
    printf("# all orders of scattering, to %g %% of each band (or %llu paths), by `make %s`\n", 100 * job.target,
           (unsigned long long)job.max_paths, target);
}

#define RAYS_MAX 4096
static ref_query query[RAYS_MAX];
static ref_total total[RAYS_MAX];

// --- the pool ---

/// The generator of [ParkMiller88], whose products are exact.
static double uniform(void) {
    static unsigned long long state = 20240817;
    state = state * 16807 % 2147483647;
    return (double)state / 2147483647.0;
}

static double bell(void) {
    return uniform() + uniform() + uniform() - 1.5; // width .5
}

static ref_query pool_ray(double radius_km, double scale) {
    ref_query q = {0};
    double u = uniform();
    q.altitude_km = scale * (u < .45 ? 2.5 * uniform() : u < .85 ? 2.5 + 10.5 * uniform() : 13 + 25 * uniform());
    u = uniform();
    const double sun = u < .3 ? 12 + 60 * uniform() : u < .6 ? 1 + 13 * uniform() : -8 + 10 * uniform();
    q.sun_zenith_deg = 90 - sun;
    const double dip = acos(radius_km / (radius_km + q.altitude_km)) * 57.295779513082323;
    u = uniform();
    const double up = u < .6 ? 90 * uniform() : u < .8 ? 6 * bell() : -25 * uniform();
    q.view_zenith_deg = fmin(fmax(90 - up + dip, 0.5), 179.5);
    q.azimuth_deg = 360 * uniform();
    return q;
}

static int make_pool(size_t first) {
    print_head("plan-truth");
    printf("air,visibility_km,altitude_km,sun_zenith_deg,view_zenith_deg,rel_azimuth_deg,L1,L2,L3,L4,E1,E2,E3,E4\n");
    for (size_t i = 0; i < sizeof pool / sizeof pool[0]; i++) {
        const plan_scene scene = {.preset = pool[i].preset,
                                  .visibility_km = {pool[i].visibility_km, pool[i].visibility_km}};
        skv_atmosphere air;
        plan_air(&scene, 0, 4, &air);
        for (int k = 0; k < pool[i].rays; k++)
            query[k] = pool_ray((double)air.radius_km, 1);
        if (i < first)
            continue;
        if (trace(&air, 1, query, (size_t)pool[i].rays, total) != 0)
            return 1;
        print_rows(pool[i].preset, pool[i].visibility_km, query, (size_t)pool[i].rays, total, 4);
        fflush(stdout);
    }
    return 0;
}

// --- a scene ---

static int make_scene(const char *path, unsigned seed, int frames, int rays) {
    plan_scene scene;
    const int failed = plan_scene_load(&scene, path);
    if (failed)
        return failed;
    job.target = 0.008;
    print_head("plan-scenes");
    printf("# seed %u, %d frames of %d rays, ground %s\n", seed, frames, rays, scene.terrain ? "lit" : "not lit");
    printf("air,visibility_km,altitude_km,sun_zenith_deg,view_zenith_deg,rel_azimuth_deg,L1,L2,L3,L4,E1,E2,E3,E4\n");
    int status = 0;
    for (int which = 0; which < plan_airs(&scene) && status == 0; which++) {
        skv_atmosphere air;
        size_t n = 0;
        plan_air(&scene, which, 4, &air);
        for (int i = 0; i < frames; i++) {
            const plan_frame f = plan_frame_at(&scene, seed, i);
            for (int j = 0; f.air == which && j < rays; j++) {
                const plan_ray r = plan_view_at(&scene, seed, i, j, rays);
                query[n++] = (ref_query){f.height_km, 90 - f.sun_deg, 90 - r.elevation_deg, r.azimuth_deg, 0};
            }
        }
        status = trace(&air, scene.terrain, query, n, total);
        if (status == 0)
            print_rows(which, plan_air_visibility_km(&scene, which), query, n, total, air.bands);
    }
    plan_scene_free(&scene);
    return status;
}

int main(int argc, char **argv) {
    if (argc >= 2 && strcmp(argv[1], "pool") == 0)
        return make_pool(argc > 2 ? strtoul(argv[2], NULL, 10) : 0);
    const long frames = argc == 6 ? strtol(argv[4], NULL, 10) : 0, rays = argc == 6 ? strtol(argv[5], NULL, 10) : 0;
    if (argc != 6 || strcmp(argv[1], "scene") != 0 || frames < 1 || rays < 1 || frames * rays > RAYS_MAX) {
        fprintf(stderr, "usage: plan-truth pool [FIRST] | scene FILE.ini SEED FRAMES RAYS (at most %d rays)\n",
                RAYS_MAX);
        return 2;
    }
    return make_scene(argv[2], (unsigned)strtoul(argv[3], NULL, 10), (int)frames, (int)rays);
}
