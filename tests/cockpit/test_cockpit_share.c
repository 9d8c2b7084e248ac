// The vertices: equal to the core's own answer, never torn, named and closed as vertices.h says.
#define _DEFAULT_SOURCE
#include <fcntl.h>
#include <math.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "check.h"
#include "tools/cockpit/cockpit_share.h"

static char name[40];

static const void *map_of(const char *shared, size_t *bytes) {
    const int fd = shm_open(shared, O_RDONLY, 0);
    if (fd < 0)
        return NULL;
    *bytes = (size_t)lseek(fd, 0, SEEK_END);
    const void *const map = mmap(NULL, *bytes, PROT_READ, MAP_SHARED, fd, 0);
    close(fd);
    return map == MAP_FAILED ? NULL : map;
}

static cockpit_now a_moment(double sun_elevation, double height_m) {
    cockpit_now now;
    const double e = sun_elevation * 3.14159265358979323846 / 180, a = 1.0;
    memset(&now, 0, sizeof now);
    now.has_sun = true;
    now.height_m = height_m;
    now.sun = (skv_sun){
        {(float)(cos(e) * sin(a)), (float)(cos(e) * cos(a)), (float)sin(e)}, 57.29578f, (float)sun_elevation, 1.0f};
    now.visibility_km = 25;
    return now;
}

static void begin(cockpit_sky *sky, uint32_t vertices) {
    const cockpit_sky_options options = {SKV_PRESET_EARTH_CLEAR, 4, SKV_TIER_STANDARD, vertices, 25};
    assert_int_equal(cockpit_sky_begin(sky, &options), 0);
}

// The same sky asked of the core by itself: an air of 25 km visibility, its whole table at once, no grid for few
// vertices, a grid for many: bit for bit.
static void equals_the_core(void **state) {
    (void)state;
    static const struct {
        uint32_t vertices;
        double sun, height;
    } cases[] = {{300, 30, 500}, {2048, 4, 10000}, {600, -3, 2000}, {2048, 60, 60000}};
    static skv_model model;
    static uint32_t table[2048], work[40000];
    static float grid[20000], radiance[2048][4], rgb[2048][3], luminance[2048];
    skv_atmosphere air;
    assert_int_equal(skv_atmosphere_preset(&air, SKV_PRESET_EARTH_CLEAR, 4), SKV_OK);
    // 3.912/25 km is the extinction at 550 nm; bands 520 and 570 nm straddle it: .4 and .6.
    const double gas = .4 * (double)air.rayleigh_scattering_per_km[1] + .6 * (double)air.rayleigh_scattering_per_km[2];
    const double haze = .4 * (double)air.aerosol_extinction_per_km[1] + .6 * (double)air.aerosol_extinction_per_km[2];
    air.turbidity = (float)((3.912 / 25 - gas) / haze);
    assert_int_equal(skv_model_build(&model, &air), SKV_OK);
    assert_int_equal(skv_table_build((skv_table *)(void *)table, sizeof table, work, sizeof work, &model, NULL),
                     SKV_OK);
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
        cockpit_sky sky;
        begin(&sky, cases[k].vertices);
        const cockpit_now now = a_moment(cases[k].sun, cases[k].height);
        cockpit_sky_build(&sky, 25, INT64_MAX / 2);
        assert_true(!sky.building && sky.air[sky.current].has_table);
        assert_true(cockpit_sky_frame(&sky, &now, 0.0));
        skv_quality quality;
        skv_light sun;
        skv_frame frame;
        skv_colour_matrix matrix;
        (void)skv_quality_tier(&quality, SKV_TIER_STANDARD);
        quality.terms |= SKV_WITH_GROUND;
        assert_int_equal(skv_light_sun(&sun, &model, now.sun.direction_enu), SKV_OK);
        assert_int_equal(skv_frame_begin(&frame, &model, &quality, (float)(1e-3 * now.height_m), 0, &sun, 1), SKV_OK);
        assert_int_equal(skv_frame_table(&frame, (const skv_table *)(const void *)table), SKV_OK);
        if (sky.vertices >= 500)
            (void)skv_frame_grid(&frame, grid, sizeof grid); // refuses at 60 km: ray by ray
        const skv_rays rays = {.direction_enu = sky.vertex[0].direction_enu, .direction_stride = sizeof *sky.vertex};
        const skv_sky out = {.radiance = radiance[0]};
        assert_int_equal(skv_radiance(&frame, sky.vertices, &rays, &out), SKV_OK);
        assert_int_equal(skv_colour_matrix_fitted(&matrix, 4, model.wavelength_nm), SKV_OK);
        assert_int_equal(skv_colour(&matrix, 4, sky.vertices, radiance[0], 0, rgb[0], 0, luminance, 0), SKV_OK);
        for (uint32_t i = 0; i < sky.vertices; i++)
            for (int c = 0; c < 3; c++)
                if (memcmp(&sky.vertex[i].rgb[c], &rgb[i][c], 4) != 0 ||
                    memcmp(&sky.vertex[i].luminance, &luminance[i], 4) != 0)
                    fail_msg("sun %g deg, %g m, vertex %u: got %.9g, want %.9g", cases[k].sun, cases[k].height, i,
                             (double)sky.vertex[i].rgb[c], (double)rgb[i][c]);
        assert_true(sky.has_grid == (sky.vertices >= 500 && cases[k].height < 20000));
        cockpit_sky_end(&sky);
    }
}

static void sizes_and_names(void **state) {
    (void)state;
    static const uint32_t wanted[] = {64, 100, 512, 2048, 5000, 65536};
    for (size_t i = 0; i < sizeof wanted / sizeof wanted[0]; i++) {
        cockpit_sky sky;
        cockpit_share share;
        size_t bytes = 0;
        begin(&sky, wanted[i]);
        if (sky.vertices > wanted[i] || sky.vertices < 0.9 * wanted[i])
            fail_msg("%u vertices wanted, %u made", wanted[i], sky.vertices);
        assert_int_equal(cockpit_share_open(&share, name + 1, &sky), 0); // without its slash
        const void *const map = map_of(name, &bytes);
        const skv_vertices_header *const h = map;
        assert_true(map != NULL && skv_vertices_check(map, bytes) == NULL);
        assert_true(h->vertices == sky.vertices && h->azimuths * h->rings + 2 == sky.vertices &&
                    h->state == SKV_VERTICES_WAITING);
        const uint32_t *const index = (const uint32_t *)(const void *)((const char *)map + h->indices_offset);
        for (uint32_t k = 0; k < h->indices; k++)
            if (index[k] >= h->vertices)
                fail_msg("index %u is %u of %u vertices", k, index[k], h->vertices);
        skv_vertices_moment moment;
        skv_vertex vertex[4];
        assert_int_equal(skv_vertices_read(map, &moment, vertex, 4), 0);
        cockpit_share_close(&share);
        assert_int_equal(h->state, SKV_VERTICES_ENDED);
        assert_true(map_of(name, &(size_t){0}) == NULL);
        munmap((void *)(uintptr_t)map, bytes);
        cockpit_sky_end(&sky);
    }
    assert_true(skv_vertices_check(&(skv_vertices_header){.magic = 1}, sizeof(skv_vertices_header)) != NULL);
}

// A second writer is refused while the first lives; what a killed one left is taken over.
static void one_writer(void **state) {
    (void)state;
    cockpit_sky sky;
    cockpit_share share;
    int pipes[2];
    assert_int_equal(pipe(pipes), 0);
    begin(&sky, 64);
    const pid_t child = fork();
    if (child == 0) {
        if (cockpit_share_open(&share, name, &sky) != 0 || write(pipes[1], "x", 1) != 1)
            _exit(1);
        pause();
    }
    char c;
    assert_int_equal(read(pipes[0], &c, 1), 1);
    assert_int_equal(cockpit_share_open(&share, name, &sky), 1);
    kill(child, SIGKILL);
    waitpid(child, NULL, 0);
    assert_int_equal(cockpit_share_open(&share, name, &sky), 0);
    cockpit_share_close(&share);
    assert_int_equal(cockpit_share_open(&share, "a/b", &sky), 2);
    assert_int_equal(cockpit_share_open(&share, "", &sky), 2);
    cockpit_sky_end(&sky);
    close(pipes[0]);
    close(pipes[1]);
}

typedef struct reading {
    const void *map;
    volatile int stop;
    uint64_t frames, torn, backwards, overtaken;
} reading;

// Every vertex of a frame holds the frame's number.
static void *read_on(void *argument) {
    reading *const r = argument;
    static skv_vertex vertex[2048];
    skv_vertices_moment moment;
    uint32_t last = 0;
    while (!r->stop) {
        const int32_t n = skv_vertices_read(r->map, &moment, vertex, 2048);
        r->overtaken += n < 0;
        for (int32_t i = 0; i < n; i++)
            if (!(vertex[i].luminance >= (float)moment.frame && vertex[i].luminance <= (float)moment.frame) ||
                vertex[i].luminance != vertex[i].rgb[2]) {
                r->torn++;
                break;
            }
        r->backwards += n > 0 && moment.frame < last;
        last = n > 0 ? moment.frame : last;
        r->frames += n > 0;
    }
    return NULL;
}

static int64_t now_ns(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (int64_t)t.tv_sec * 1000000000 + t.tv_nsec;
}

static void never_torn(void **state) {
    (void)state;
    cockpit_sky sky;
    cockpit_share share;
    size_t bytes = 0;
    pthread_t thread;
    reading r = {0};
    begin(&sky, 2048);
    assert_int_equal(cockpit_share_open(&share, name, &sky), 0);
    r.map = map_of(name, &bytes);
    assert_true(r.map != NULL);
    assert_int_equal(pthread_create(&thread, NULL, read_on, &r), 0);
    skv_vertices_moment moment = {0};
    uint32_t frame = 0;
    const int64_t until = now_ns() + 2000000000; // as fast as it can for 2 s: thousands of times a cockpit's rate
    while (now_ns() < until) {
        frame++;
        for (uint32_t i = 0; i < sky.vertices; i++)
            sky.vertex[i].luminance = sky.vertex[i].rgb[2] = (float)frame;
        assert_int_equal(cockpit_share_publish(&share, &sky, &moment), frame);
    }
    r.stop = 1;
    pthread_join(thread, NULL);
    print_message("figure: seqlock: %u frames written, %llu read, %llu torn, %llu overtaken\n", frame,
                  (unsigned long long)r.frames, (unsigned long long)r.torn, (unsigned long long)r.overtaken);
    assert_true(r.frames > 100);
    assert_true(r.torn == 0 && r.backwards == 0);
    cockpit_share_close(&share);
    cockpit_sky_end(&sky);
}

// What a reader finds while a frame is half written: the memory that the vertices come from is looked at on the way.
static unsigned char *half;
static size_t half_bytes;
static const skv_vertices_header *half_header;
static struct {
    int faults;
    uint32_t sequence, latest;
} seen;

static void half_way(int signal_number) {
    (void)signal_number;
    const unsigned char *const slot = (const unsigned char *)half_header + half_header->slots_offset;
    seen.faults++;
    seen.sequence = *(const uint32_t *)(const void *)slot;
    seen.latest = half_header->latest;
    mprotect(half, half_bytes, PROT_READ | PROT_WRITE);
}

static void odd_while_it_is_written(void **state) {
    (void)state;
    cockpit_sky sky;
    cockpit_share share;
    const skv_vertices_moment moment = {0};
    struct sigaction before, action = {.sa_handler = half_way};
    begin(&sky, 512);
    skv_vertex *const own = sky.vertex;
    half_bytes = sizeof *own * (size_t)sky.vertices;
    half = mmap(NULL, half_bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    assert_true(half != MAP_FAILED);
    memcpy(half, own, half_bytes);
    assert_int_equal(cockpit_share_open(&share, name, &sky), 0);
    half_header = (const skv_vertices_header *)(const void *)share.map;
    sky.vertex = (skv_vertex *)(void *)half;
    for (int i = 0; i < 3; i++)
        (void)cockpit_share_publish(&share, &sky, &moment);
    sigaction(SIGSEGV, &action, &before);
    mprotect(half, half_bytes, PROT_NONE);
    (void)cockpit_share_publish(&share, &sky, &moment); // the first slot again
    sigaction(SIGSEGV, &before, NULL);
    assert_true(seen.faults == 1 && seen.sequence == 3 && seen.latest == 3);
    assert_int_equal(half_header->latest, 1);
    sky.vertex = own;
    munmap(half, half_bytes);
    cockpit_share_close(&share);
    cockpit_sky_end(&sky);
}

// The visibility is turned while frames go on: the old air is shown until the new one's table is done; nothing grows.
static void air_is_rebuilt(void **state) {
    (void)state;
    cockpit_sky sky;
    begin(&sky, 64);
    cockpit_now now = a_moment(20, 1000);
    cockpit_sky_build(&sky, 25, 0);
    assert_true(cockpit_sky_frame(&sky, &now, 0.0)); // live before the first table
    assert_true(sky.building && sky.builds == 0 && (double)sky.vertex[0].luminance > 100);
    cockpit_sky_build(&sky, 25, INT64_MAX / 2);
    assert_int_equal(sky.builds, 1);
    const double clear = (double)sky.vertex[0].luminance;
    cockpit_sky_build(&sky, 2, 0);
    assert_true(sky.building && cockpit_sky_frame(&sky, &now, 0.02));
    check_near("air shown, km", (double)sky.at.visibility_km, 25, 1e-6);
    const size_t work = sky.work_bytes;
    cockpit_sky_build(&sky, 3, 0); // turned on before it was done
    cockpit_sky_build(&sky, 3, INT64_MAX / 2);
    assert_true(sky.builds == 2 && cockpit_sky_frame(&sky, &now, 0.02));
    check_near("air shown, km", (double)sky.at.visibility_km, 3, 1e-6);
    assert_true(fabs((double)sky.vertex[0].luminance - clear) > 0.05 * clear);
    cockpit_sky_build(&sky, 3.03, 0); // 1 %: nothing
    assert_true(!sky.building && sky.work_bytes <= 2 * work);
    cockpit_sky_build(&sky, 1e9, INT64_MAX / 2); // clearer than air can be
    assert_true(cockpit_sky_frame(&sky, &now, 0.02));
    cockpit_sky_end(&sky);
}

// Suns, heights and visibilities of every kind: finite, and no negative luminance.
static void any_sky_is_finite(void **state) {
    (void)state;
    static const double km[] = {0.02, 1, 60}, suns[] = {-90, -30, -12, -5.01, -0.5, 0, 3, 90},
                        heights[] = {-1000, 0, 12000, 30000, 90000, 4e7};
    for (int v = 0; v < 3; v++) {
        cockpit_sky sky;
        const cockpit_sky_options options = {SKV_PRESET_EARTH_HAZY, 3 + v % 2, SKV_TIER_FAST, 600, km[v]};
        assert_int_equal(cockpit_sky_begin(&sky, &options), 0);
        cockpit_sky_build(&sky, km[v], INT64_MAX / 2);
        for (int i = 0; i < 8; i++)
            for (int h = 0; h < 6; h++) {
                const cockpit_now now = a_moment(suns[i], heights[h]);
                if (!cockpit_sky_frame(&sky, &now, 0.016))
                    fail_msg("visibility %g km, sun %g deg, %g m: refused", km[v], suns[i], heights[h]);
                for (uint32_t k = 0; k < sky.vertices; k++)
                    if (!isfinite(sky.vertex[k].rgb[0] + sky.vertex[k].rgb[1] + sky.vertex[k].rgb[2]) ||
                        !(sky.vertex[k].luminance >= 0))
                        fail_msg("visibility %g km, sun %g deg, %g m: vertex %u is %g", km[v], suns[i], heights[h], k,
                                 (double)sky.vertex[k].luminance);
                if (!isfinite(sky.exposure) || !(sky.exposure > 0))
                    fail_msg("exposure %g", sky.exposure);
            }
        cockpit_sky_end(&sky);
    }
}

int main(void) {
    snprintf(name, sizeof name, "/skyvert-test-%d", (int)getpid());
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(equals_the_core),
        cmocka_unit_test(sizes_and_names),
        cmocka_unit_test(one_writer),
        cmocka_unit_test(never_torn),
        cmocka_unit_test(odd_while_it_is_written),
        cmocka_unit_test(air_is_rebuilt),
        cmocka_unit_test(any_sky_is_finite),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
