/// bench-tables sizes|count|time FILE.ini: what light of all orders costs.
/// count: run it under callgrind --collect-atstart=no; every figure is one dump, labelled `what|rule|divisor`.
/// time:  builds in ms, and nanoseconds a vertex; what is compared is interleaved, so that a busy machine disturbs all
/// of it alike.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <valgrind/callgrind.h>

#include "dome.h"
#include "skyvert/table.h"

#define BUILDS  9
#define REPEATS 41
#define DEAR    12
#define STEPS   200000

static const char *const kind_name[] = {"accurate", "small"};
static const char *const way_name[] = {"single", "direct", "grid"};
enum { SINGLE, DIRECT, GRID, WAYS };

static float store[2][4000], work[40000], grid[8192];
static float direction[VERTICES][3], radiance[VERTICES][4];
static double checksum;

static void spec_of(skv_table_spec *spec, int kind) {
    bench_check(skv_table_spec_kind(spec, (skv_table_kind)kind), "skv_table_spec_kind");
}

static void build(const bench_air *air, int kind) {
    skv_table_spec spec;
    spec_of(&spec, kind);
    skv_table *const table = (skv_table *)(void *)store[kind];
    bench_check(skv_table_build(table, sizeof store[kind], work, sizeof work, &air->model, &spec), "skv_table_build");
}

static void start_collecting(void) {
    CALLGRIND_ZERO_STATS;
    CALLGRIND_TOGGLE_COLLECT;
}

// The argument of a client request must be a string of the program's own.
static void stop_collecting(const char *what, const char *rule, int divisor) {
    char label[96];
    CALLGRIND_TOGGLE_COLLECT;
    snprintf(label, sizeof label, "%s|%s|%d", what, rule, divisor);
    CALLGRIND_DUMP_STATS_AT(label);
}

static void begin(skv_table_builder *builder, const bench_air *air, int kind) {
    skv_table_spec spec;
    spec_of(&spec, kind);
    bench_check(skv_table_begin(builder, &air->model, &spec, (skv_table *)(void *)store[kind], sizeof store[kind], work,
                                sizeof work),
                "skv_table_begin");
}

/// The steps that take longest, by the clock: candidates for the most instructions.
static void find_dear(const bench_air *air, int kind, int dear[DEAR]) {
    static double took[STEPS];
    skv_table_builder builder;
    int n = 0;
    begin(&builder, air, kind);
    for (int done = 0; done < 1000 && n < STEPS; n++) {
        const double start = bench_now_ns();
        bench_check(skv_table_step(&builder, &done), "skv_table_step");
        took[n] = bench_now_ns() - start;
    }
    for (int i = 0; i < DEAR; i++) {
        dear[i] = 0;
        for (int k = 0; k < n; k++)
            dear[i] = took[k] > took[dear[i]] ? k : dear[i];
        took[dear[i]] = 0;
    }
}

static void count_steps(const bench_air *air, int kind) {
    skv_table_builder builder;
    int dear[DEAR];
    find_dear(air, kind, dear);
    begin(&builder, air, kind);
    for (int n = 0, done = 0; done < 1000; n++) {
        int is_dear = 0;
        for (int i = 0; i < DEAR; i++)
            is_dear = is_dear || dear[i] == n;
        if (is_dear)
            start_collecting();
        (void)skv_table_step(&builder, &done);
        if (is_dear)
            stop_collecting("step", kind_name[kind], 1);
    }
}

static void frame_of(skv_frame *frame, const bench_air *air, const bench_scene *scene, int way) {
    skv_quality quality;
    bench_check(skv_quality_tier(&quality, SKV_TIER_STANDARD), "skv_quality_tier");
    bench_frame(frame, air, &quality, scene->height_km, scene->sun_zenith_deg);
    if (way != SINGLE)
        bench_check(skv_frame_table(frame, (const skv_table *)(const void *)store[0]), "skv_frame_table");
}

/// A frame's work after skv_frame_table(): the grid belongs to it.
static void shine(skv_frame *frame, int way) {
    const skv_rays rays = {direction[0], 0, NULL, 0};
    const skv_sky sky = {radiance[0], sizeof radiance[0], NULL, 0};
    if (way == GRID)
        bench_check(skv_frame_grid(frame, grid, sizeof grid), "skv_frame_grid");
    bench_check(skv_radiance(frame, VERTICES, &rays, &sky), "skv_radiance");
}

static void add_up(void) {
    for (int i = 0; i < VERTICES; i++)
        for (int b = 0; b < 4; b++)
            checksum += (double)radiance[i][b];
}

static void count(const bench_air *air) {
    for (int kind = 0; kind < 2; kind++) {
        start_collecting();
        build(air, kind);
        stop_collecting("build", kind_name[kind], 1);
        count_steps(air, kind);
    }
    for (int s = BENCH_DOME; s < BENCH_SCENES; s++) {
        skv_frame frame;
        bench_lay_dome(&bench_scenes[s], direction);
        for (int way = 0; way < WAYS; way++) {
            frame_of(&frame, air, &bench_scenes[s], way);
            shine(&frame, way); // warm
            frame_of(&frame, air, &bench_scenes[s], way);
            start_collecting();
            shine(&frame, way);
            stop_collecting(bench_scenes[s].name, way_name[way], VERTICES);
            add_up();
        }
        frame_of(&frame, air, &bench_scenes[s], GRID);
        start_collecting();
        bench_check(skv_frame_grid(&frame, grid, sizeof grid), "skv_frame_grid");
        stop_collecting(bench_scenes[s].name, "of it building the grid", VERTICES);
    }
}

/// `what|name|median|least|largest` in the unit.
static void print_spread(const char *what, const char *name, double *took, int n, double unit) {
    bench_sort(took, (size_t)n);
    printf("%s|%s|%.4g|%.4g|%.4g\n", what, name, took[n / 2] / unit, took[0] / unit, took[(int)(0.9 * n)] / unit);
}

static void time_builds(const bench_air *air) {
    static double took[2][BUILDS];
    for (int i = 0; i < BUILDS; i++)
        for (int kind = 0; kind < 2; kind++) {
            const double start = bench_now_ns();
            build(air, kind);
            took[kind][i] = bench_now_ns() - start;
        }
    for (int kind = 0; kind < 2; kind++)
        print_spread("build ms", kind_name[kind], took[kind], BUILDS, 1e6);
}

static void time_scene(const bench_air *air, const bench_scene *scene) {
    static double took[WAYS][REPEATS];
    bench_lay_dome(scene, direction);
    for (int i = -3; i < REPEATS; i++)
        for (int way = 0; way < WAYS; way++) {
            skv_frame frame;
            const double start = bench_now_ns();
            frame_of(&frame, air, scene, way);
            shine(&frame, way);
            add_up();
            if (i >= 0)
                took[way][i] = bench_now_ns() - start;
        }
    for (int way = 0; way < WAYS; way++) {
        char what[32];
        snprintf(what, sizeof what, "%s ns/vertex", scene->name);
        print_spread(what, way_name[way], took[way], REPEATS, VERTICES);
    }
}

static void sizes(void) {
    for (int bands = 4; bands > 2; bands--)
        for (int kind = 0; kind < 2; kind++) {
            skv_table_spec spec;
            spec_of(&spec, kind);
            printf("%s, %d bands: table %zu bytes", kind_name[kind], bands, skv_table_size(&spec, bands));
            printf(", work space %zu, builder %zu", skv_table_work_size(&spec, bands), sizeof(skv_table_builder));
            spec.format = SKV_TABLE_FLOAT;
            printf("; in floats %zu\n", skv_table_size(&spec, bands));
        }
}

int main(int argc, char **argv) {
    static bench_air air;
    if (argc != 3) {
        fprintf(stderr, "usage: bench-tables sizes|count|time FILE.ini\n");
        return 2;
    }
    bench_air_load(&air, argv[2], 0);
    build(&air, 0);
    if (argv[1][0] == 's') {
        skv_frame frame;
        sizes();
        frame_of(&frame, &air, &bench_scenes[BENCH_DOME], DIRECT);
        printf("grid of one light, 4 bands: %zu bytes; skv_frame %zu, skv_model %zu\n", skv_grid_size(&frame),
               sizeof(skv_frame), sizeof(skv_model));
    } else if (argv[1][0] == 'c') {
        count(&air);
    } else {
        time_builds(&air);
        for (int s = BENCH_DOME; s < BENCH_SCENES; s++)
            time_scene(&air, &bench_scenes[s]);
    }
    printf("checksum|%.9g\n", checksum);
    return 0;
}
