/// Stack that each public call really uses: the unused stack is painted first. Prints `function case bytes`.
#if !defined(__arm__)
#define _GNU_SOURCE // NOLINT: ucontext
#endif
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "skyvert/skyvert.h"

#if defined(__arm__)
enum { PAINT = 0xA5, STACK = 8 * 1024 };
#else
enum { PAINT = 0xA5, STACK = 12 * 1024 };
#endif
static unsigned char stack[STACK] __attribute__((aligned(64)));

#if defined(__arm__)
/// Calls run() with the stack pointer at `top`.
__attribute__((naked, noinline)) static void run_on(void (*run)(void), void *top) {
    (void)run, (void)top;
    __asm volatile("push {r4, lr}\n\t"
                   "mov r4, sp\n\t"
                   "mov sp, r1\n\t"
                   "blx r0\n\t"
                   "mov sp, r4\n\t"
                   "pop {r4, pc}");
}
#else
#include <ucontext.h>
static void run_on(void (*run)(void), void *top) {
    static ucontext_t here, there;
    (void)top;
    getcontext(&there);
    there.uc_stack.ss_sp = stack;
    there.uc_stack.ss_size = sizeof stack;
    there.uc_link = &here;
    makecontext(&there, run, 0);
    swapcontext(&here, &there);
}
#endif

/// Bytes below the top of a painted stack of its own.
static size_t used_by(void (*run)(void)) {
    memset(stack, PAINT, sizeof stack);
    run_on(run, stack + sizeof stack);
    size_t i = 0;
    while (i < sizeof stack && stack[i] == PAINT)
        ++i;
    return sizeof stack - i;
}

enum { RAYS = 70 };
static skv_atmosphere air;
static skv_model model;
static skv_frame frame;
static skv_quality quality;
static skv_light light[2];
static float direction[RAYS][3], radiance[RAYS][4], transmittance[RAYS][4], rgb[RAYS][3];
static float length_km[RAYS];
static skv_status status;

static void do_nothing(void) {}
static void do_model(void) {
    status = skv_model_build(&model, &air);
}
static void do_frame(void) {
    status = skv_frame_begin(&frame, &model, &quality, 1.0f, 0.1f, light, SKV_LIGHTS_MAX > 1 ? 2 : 1);
}
static const skv_rays rays = {direction[0], 0, length_km, 0};
static const skv_sky sky = {radiance[0], sizeof *radiance, transmittance[0], sizeof *transmittance};
static void do_radiance(void) {
    status = skv_radiance(&frame, RAYS, &rays, &sky);
}
// The least table: what lies on the stack does not depend on its size.
static uint32_t table[400];
static float work[3800];
static skv_table_builder builder;
static int diffuse_begin(void) {
    skv_table_spec spec;
    status = skv_table_spec_kind(&spec, SKV_TABLE_SMALL);
    if (status != SKV_OK)
        return 0;
    spec.altitudes = 4;
    spec.suns = 8;
    spec.orders = spec.polar[0] = spec.polar[1] = spec.azimuths[0] = spec.azimuths[1] = 2;
    status = skv_table_begin(&builder, &model, &spec, (skv_table *)(void *)table, sizeof table, work, sizeof work);
    return status == SKV_OK;
}
static int steps_done;
/// All of the kinds of steps, the deepest counts.
static void do_steps(void) {
    for (steps_done = 0; status == SKV_OK && steps_done < 1000;)
        status = skv_table_step(&builder, &steps_done);
}
static void do_frame_table(void) {
    status = skv_frame_table(&frame, (const skv_table *)(const void *)table);
}
static void do_grid(void) {
    status = skv_frame_grid(&frame, work, sizeof work);
}
static void do_irradiance(void) {
    static float out[RAYS][4];
    status = skv_irradiance(&frame, SKV_IRRADIANCE_ALL, RAYS, direction[0], 0, out[0], 0);
}
static const skv_rays free_rays = {direction[0], 0, NULL, 0};
static void do_radiance_grid(void) {
    status = skv_radiance(&frame, RAYS, &free_rays, &sky);
}
static void do_colour(void) {
    skv_colour_matrix matrix;
    status = skv_colour_matrix_fitted(&matrix, model.bands, model.wavelength_nm);
    if (status == SKV_OK)
        status = skv_colour(&matrix, model.bands, RAYS, radiance[0], sizeof *radiance, rgb[0], 0, NULL, 0);
}
static void do_sun(void) {
    const skv_utc utc = {8000, 1000.0f};
    const skv_position position = {47.0f, 8.0f, 0.5f};
    skv_sun sun;
    status = skv_sun_at(&sun, &utc, &position);
}
static void do_moon(void) {
    const skv_utc utc = {8000, 1000.0f};
    const skv_position position = {47.0f, 8.0f, 0.5f};
    skv_moon moon;
    status = skv_moon_at(&moon, &utc, &position);
}
static void do_expose(void) {
    status = skv_expose(1.0f, RAYS, rgb[0], 0, rgb[0], 0);
}
static void do_pack(void) {
    static uint32_t packed[2 * RAYS];
    status = skv_pack(SKV_FORMAT_RGBA16F, RAYS, rgb[0], 0, packed, 0);
}

static void report(const char *function, const char *variant, void (*run)(void)) {
    run(); // what the loader resolves at first use is not the library's
    used_by(run);
    const size_t none = used_by(do_nothing), used = used_by(run);
    if (status == SKV_OK)
        printf("%s %s %u\n", function, variant, (unsigned)(used > none ? used - none : 0));
    else if (status != SKV_ERR_UNSUPPORTED)
        printf("failed %s %s %d\n", function, variant, (int)status);
}

static void all_rules(void) {
    static const char *const rule[3] = {"uniform", "keller", "gauss-exp"};
    char text[48];
    for (int i = 0; i < 6; ++i) {
        quality = (skv_quality){(skv_rule)(i % 3), (skv_depth)(i / 3), 6, 6, SKV_WITH_ALL};
        do_frame();
        if (status != SKV_OK)
            continue;
        snprintf(text, sizeof text, "%s-%s-%d-bands", rule[i % 3], i / 3 == 0 ? "chapman" : "inner", (int)model.bands);
        report("skv_radiance", text, do_radiance);
    }
}

static void report_diffuse(void) {
    const char *const variant = model.bands == 3 ? "diffuse-3-bands" : "diffuse-4-bands";
    quality = (skv_quality){SKV_GAUSS_EXP, SKV_DEPTH_BY_CHAPMAN, 6, 6, SKV_WITH_ALL};
    if (!diffuse_begin())
        return;
    used_by(do_steps);
    (void)diffuse_begin();
    const size_t none = used_by(do_nothing), used = used_by(do_steps);
    printf("skv_table_step %s %u\n", variant, (unsigned)(used - none));
    do_frame();
    report("skv_frame_table", variant, do_frame_table);
    report("skv_radiance", variant, do_radiance);
    report("skv_frame_grid", variant, do_grid);
    report("skv_radiance", variant, do_radiance_grid);
    report("skv_irradiance", variant, do_irradiance);
}

int main(void) {
    for (int i = 0; i < RAYS; ++i) {
        direction[i][0] = 1.0f;
        direction[i][1] = (float)(i % 7) - 3.0f;
        direction[i][2] = (float)(i % 11) * 0.5f - 1.0f;
        length_km[i] = i % 3 == 0 ? 20.0f : 3.0e38f;
    }
    for (int bands = 3; bands <= 4; ++bands) {
        status = skv_atmosphere_preset(&air, SKV_PRESET_EARTH_HAZY, bands);
        if (status != SKV_OK)
            continue;
        air.rayleigh.kind = SKV_PROFILE_US76; // a tabulated column
        air.rayleigh.us76_a = 0.07771971f;
        air.rayleigh.us76_b = 1.16364243f;
        report("skv_model_build", bands == 3 ? "3-bands" : "4-bands", do_model);
        if (status != SKV_OK)
            continue;
        skv_light_sun(&light[0], &model, (const float[3]){0.7f, 0.1f, -0.05f}); // the shadow's edge is met
        skv_light_sun(&light[1], &model, (const float[3]){-0.7f, 0.1f, 0.5f});
        skv_quality_tier(&quality, SKV_TIER_STANDARD);
        report("skv_frame_begin", bands == 3 ? "3-bands" : "4-bands", do_frame);
        all_rules();
        report_diffuse();
        report("skv_colour", bands == 3 ? "3-bands" : "4-bands", do_colour);
    }
    report("skv_sun_at", "-", do_sun);
    report("skv_moon_at", "-", do_moon);
    report("skv_expose", "-", do_expose);
    report("skv_pack", "rgba16f", do_pack);
    return 0;
}
