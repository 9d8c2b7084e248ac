/// What instructions are counted from, on every target, built as the planner's header says: calls of the library with
/// known work (skyvert/work.h). Prints a line per counted window, in order; costs.sh puts the instructions beside them.
///
///     call N GROUND TRANSMITTANCE LIGHT RAYS WORK...   LIGHT: 0 single, 1 direct, 2 grid
///     grid WORK... | begin | empty
///     sizes MODEL FRAME LANES STACK-SINGLE STACK-TABLE STACK-GRID   bytes; no window
/// With the argument `time` (not on bare metal): `time NANOSECONDS`, of all calls, the least of some runs.
#include "tests/gates/window.h"

#include <stdio.h>
#include <string.h>

#include "skyvert/skyvert.h"
#include "tools/plan/grid_rays.h"

#if defined(__x86_64__) || defined(__aarch64__)
#include <time.h>
#define HOSTED 1
#else
#define HOSTED 0
#endif

#if !defined(__x86_64__)
__attribute__((noinline)) void window_begin(void) {
    __asm volatile("" ::: "memory");
}
__attribute__((noinline)) void window_end(void) {
    __asm volatile("" ::: "memory");
}
#endif

enum { RAYS = 96, ONE_LANE = SKV_LANES == 1 };

static skv_model model;
static skv_frame frame;
static float direction[RAYS][3], length_km[RAYS], radiance[RAYS][4], transmittance[RAYS][4], grid[8192];
static uint32_t table[5000];
static float work_space[20000];
static int silent;
static unsigned window_number;

static void begin_window(void) {
    if (!silent)
        WINDOW_BEGIN();
}

static void end_window(void) {
    char name[16];
    snprintf(name, sizeof name, "%u", window_number++);
    (void)name;
    if (!silent)
        WINDOW_END(name);
}

static void print_work(const skv_work *w) {
    const uint32_t *const x = &w->blocks;
    for (size_t i = 0; i < sizeof *w / sizeof *x; i++)
        printf(" %lu", (unsigned long)x[i]);
    printf("\n");
}

// --- scenes ---

typedef struct scene {
    float height_km, sun_up, low, high; ///< sine of the sun's elevation; elevation of the directions, degrees
} scene;

static const scene scenes[] = {
    {0.002f, 0.82f, -10.0f, 90.0f}, {0.002f, 0.10f, 0.0f, 90.0f},  {1.0f, 0.42f, -10.0f, 90.0f},
    {1.0f, -0.05f, -20.0f, 40.0f},  {2.5f, 0.02f, -90.0f, 90.0f},  {4.0f, 0.14f, -5.0f, 60.0f},
    {7.0f, -0.02f, -10.0f, 90.0f},  {9.0f, 0.30f, -90.0f, 90.0f},  {11.0f, 0.05f, -20.0f, 40.0f},
    {0.4f, -0.09f, 0.0f, 90.0f},    {11.5f, -0.07f, -5.0f, 60.0f}, {0.2f, 0.03f, -20.0f, 40.0f},
};
enum { SCENES = sizeof scenes / sizeof scenes[0] };

/// Sine of an angle in degrees up to 90: good to .001, which is enough for directions.
static float sine(float degrees) {
    const float x = degrees * 0.0174532925f, x2 = x * x;
    return x * (1.0f - x2 * (0.16666667f - x2 * (0.0083333333f - x2 * 0.00019841f)));
}

static void lay(const scene *s) {
    enum { AROUND = 16, RINGS = RAYS / AROUND };
    for (int i = 0; i < RAYS; i++) {
        const float up = sine(s->low + (s->high - s->low) * ((float)(i / AROUND) + 0.5f) / (float)RINGS);
        const float flat = sqrtf(1.0f - up * up), turn = 360.0f * (float)(i % AROUND) / (float)AROUND - 180.0f;
        const float half = sine(0.5f * turn), other = sqrtf(fmaxf(1.0f - half * half, 0.0f));
        direction[i][0] = flat * 2.0f * half * other;
        direction[i][1] = flat * (1.0f - 2.0f * half * half);
        direction[i][2] = up;
        length_km[i] = 1.0f + 0.4f * (float)(i * 37 % RAYS);
    }
}

static int begin(const scene *s, int samples, int ground) {
    const float sun[3] = {0.0f, sqrtf(1.0f - s->sun_up * s->sun_up), s->sun_up};
    skv_quality quality;
    skv_light light;
    (void)skv_quality_tier(&quality, SKV_TIER_STANDARD);
    quality.samples = samples;
    quality.terms |= ground ? (uint32_t)SKV_WITH_GROUND : 0u;
    return skv_light_sun(&light, &model, sun) == SKV_OK &&
           skv_frame_begin(&frame, &model, &quality, s->height_km, 0.0f, &light, 1) == SKV_OK;
}

static int begin_table(void) {
    return skv_frame_table(&frame, (const skv_table *)(const void *)table) == SKV_OK;
}

// --- windows ---

static void call(int samples, int ground, int with_transmittance, int light, int lengths) {
    const skv_rays rays = {direction[0], 0, lengths ? length_km : NULL, 0};
    const skv_sky sky = {radiance[0], sizeof *radiance, with_transmittance ? transmittance[0] : NULL,
                         sizeof *transmittance};
    skv_work w;
    memset(&w, 0, sizeof w);
    if (!silent)
        plan_work_add(&frame, RAYS, &rays, ONE_LANE, &w);
    begin_window();
    const skv_status status = skv_radiance(&frame, RAYS, &rays, &sky);
    end_window();
    if (silent)
        return;
    printf(status == SKV_OK ? "call %d %d %d %d %d" : "failed %d %d %d %d %d", samples, ground, with_transmittance,
           light, RAYS);
    print_work(&w);
}

static void make_grid(void) {
    skv_work w;
    memset(&w, 0, sizeof w);
    if (!silent)
        plan_grid_work(&frame, ONE_LANE, &w);
    begin_window();
    const skv_status status = skv_frame_grid(&frame, grid, sizeof grid);
    end_window();
    if (silent)
        return;
    printf(status == SKV_OK ? "grid" : "failed");
    print_work(&w);
}

static void count(const scene *s) {
    lay(s);
    if (!begin(s, 5, 0))
        return;
    call(5, 0, 0, 0, 0);
    (void)begin(s, 8, 0);
    call(8, 0, 1, 0, 0);
    (void)begin(s, 3, 1);
    call(3, 1, 0, 0, 0);
    call(3, 1, 1, 0, 1);
    (void)begin(s, 5, 1);
    (void)begin_table();
    call(5, 1, 1, 1, 0);
    call(5, 1, 1, 1, 1);
    (void)begin(s, 5, 0);
    (void)begin_table();
    call(5, 0, 0, 1, 0);
    make_grid();
    call(5, 0, 0, 2, 0);
    (void)begin(s, 5, 1);
    (void)begin_table();
    (void)skv_frame_grid(&frame, grid, sizeof grid);
    call(5, 1, 0, 2, 0);
    call(5, 1, 1, 2, 0);
    begin_window();
    (void)begin(s, 5, 1);
    (void)begin_table();
    end_window();
    if (!silent)
        printf("begin\n");
}

// --- stack ---

enum { PAINTED = HOSTED ? 24 * 1024 : 6 * 1024, PAINT = 0xA5 };

/// Makes the system map the stack that is painted.
__attribute__((noinline)) static void deepen(void) {
    volatile unsigned char room[PAINTED + 1024];
    for (int i = 0; i < PAINTED + 1024; i += 256)
        room[i] = (unsigned char)i;
    (void)room[1024];
}

/// Bytes of stack that a call takes: what lies below is painted first. No call stands between painting and running.
__attribute__((noinline)) static unsigned stack_of(int light) {
    const skv_rays rays = {direction[0], 0, NULL, 0};
    const skv_sky sky = {radiance[0], sizeof *radiance, transmittance[0], sizeof *transmittance};
    volatile unsigned char *const top = (volatile unsigned char *)__builtin_frame_address(0) - 256;
    for (int i = 1; i <= PAINTED; i++)
        top[-i] = PAINT;
    if (light == 2)
        (void)skv_frame_grid(&frame, grid, sizeof grid);
    (void)skv_radiance(&frame, RAYS, &rays, &sky);
    int i = PAINTED;
    while (i > 0 && top[-i] == PAINT)
        i--;
    return (unsigned)i + 256u;
}

static void print_sizes(void) {
    unsigned stack[3];
    lay(&scenes[3]);
    for (int light = 0; light < 3; light++) {
        (void)begin(&scenes[3], 5, 1);
        if (light > 0)
            (void)begin_table();
        deepen();
        stack[light] = stack_of(light);
    }
    printf("sizes %lu %lu %d %u %u %u\n", (unsigned long)sizeof(skv_model), (unsigned long)sizeof(skv_frame),
           (int)SKV_LANES, stack[0], stack[1], stack[2]);
}

// --- the air ---

static int build(void) {
    skv_atmosphere air;
    skv_table_spec spec;
    const skv_preset preset = SKV_TERM_DUST ? SKV_PRESET_MARS : SKV_PRESET_EARTH_HAZY;
    (void)skv_atmosphere_preset(&air, preset, SKV_BANDS);
    air.turbidity = SKV_TERM_DUST ? 0.5f : 1.0f;
    if (SKV_TERM_DUST && SKV_TERM_OZONE) {
        skv_atmosphere earth;
        (void)skv_atmosphere_preset(&earth, SKV_PRESET_EARTH_HAZY, SKV_BANDS);
        memcpy(air.ozone_absorption_per_km, earth.ozone_absorption_per_km, sizeof air.ozone_absorption_per_km);
        air.ozone = earth.ozone;
    }
    if (!SKV_TERM_AEROSOL)
        air.aerosol.kind = SKV_PROFILE_NONE;
    if (!SKV_TERM_OZONE)
        air.ozone.kind = SKV_PROFILE_NONE;
    if (skv_model_build(&model, &air) != SKV_OK || skv_table_spec_for(&spec, &model, SKV_TABLE_ACCURATE) != SKV_OK)
        return 0;
    // Where rows and columns lie counts, not what is in them: as few directions as can be.
    spec.orders = spec.polar[0] = spec.polar[1] = spec.azimuths[0] = spec.azimuths[1] = 2;
    spec.samples[0] = spec.samples[1] = 2;
    return skv_table_build((skv_table *)(void *)table, sizeof table, work_space, sizeof work_space, &model, &spec) ==
           SKV_OK;
}

#if HOSTED
static double now_ns(void) {
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return 1e9 * (double)t.tv_sec + (double)t.tv_nsec;
}

static void print_time(void) {
    double least = 1e30;
    silent = 1;
    for (int k = 0; k < 15; k++) {
        const double start = now_ns();
        for (int i = 0; i < SCENES; i++)
            count(&scenes[i]);
        const double took = now_ns() - start;
        least = took < least ? took : least;
    }
    printf("time %.0f\n", least);
}
#endif

int main(int argc, char **argv) {
    (void)argv;
    if (!build()) {
        printf("failed build\n");
        return 1;
    }
#if HOSTED
    if (argc > 1) {
        print_time();
        return 0;
    }
#endif
    (void)argc;
    lay(&scenes[0]);
    (void)begin(&scenes[0], 5, 0);
    silent = 1;
    call(5, 0, 0, 0, 0); // what the loader resolves at first use is not the library's
    silent = 0;
    window_number = 0;
    begin_window();
    end_window();
    printf("empty\n");
    for (int i = 0; i < SCENES; i++)
        count(&scenes[i]);
    print_sizes();
    return 0;
}
