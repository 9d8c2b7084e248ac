/// plan-case SCENE.ini TRUTH-SEED FRAMES RAYS VERTICES BANDS SPECIES TABLE STARS > case.h: a scene as constants, for a
/// program that is built with the planner's header on any target. TABLE as SKV_PLAN_TABLE.
///
/// Frames for counting instructions are others than those that the planner looked at.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "tools/plan/light.h"

enum { COUNTED = 10, COUNT_SEED = 5 };

static void print_float(float x) {
    printf("(float)%.9g", isinf(x) ? 3.0e38 : (double)x);
}

static void print_number(const char *name, float x) {
    printf(".%s = (float)%.9g, ", name, (double)x);
}

static void print_list(const char *name, const float x[4]) {
    printf(".%s = {(float)%.9g, (float)%.9g, (float)%.9g, (float)%.9g}, ", name, (double)x[0], (double)x[1],
           (double)x[2], (double)x[3]);
}

static void print_profile(const char *name, const skv_profile *p) {
    printf(".%s = {.kind = (skv_profile_kind)%d, ", name, (int)p->kind);
    print_number("scale_height_km", p->scale_height_km);
    print_number("background", p->background);
    print_number("peak_km", p->peak_km);
    print_number("half_width_km", p->half_width_km);
    printf("}, ");
}

static void print_air(const skv_atmosphere *a) {
    printf("    {");
    print_number("radius_km", a->radius_km);
    print_number("top_km", a->top_km);
    printf(".bands = %d, ", (int)a->bands);
    print_list("wavelength_nm", a->wavelength_nm);
    print_list("solar_irradiance", a->solar_irradiance);
    print_list("albedo", a->albedo);
    print_list("rayleigh_scattering_per_km", a->rayleigh_scattering_per_km);
    print_list("rayleigh_absorption_per_km", a->rayleigh_absorption_per_km);
    print_profile("rayleigh", &a->rayleigh);
    print_list("aerosol_scattering_per_km", a->aerosol_scattering_per_km);
    print_list("aerosol_extinction_per_km", a->aerosol_extinction_per_km);
    print_profile("aerosol", &a->aerosol);
    printf(".aerosol_phase = (skv_phase)%d, ", (int)a->aerosol_phase);
    print_number("aerosol_g", a->aerosol_g);
    print_number("turbidity", a->turbidity);
    print_list("dust_scattering_per_km", a->dust_scattering_per_km);
    print_list("dust_extinction_per_km", a->dust_extinction_per_km);
    print_profile("dust", &a->dust);
    printf(".dust_phase = (skv_phase)%d, ", (int)a->dust_phase);
    print_number("dust_g", a->dust_g);
    print_list("ozone_absorption_per_km", a->ozone_absorption_per_km);
    print_profile("ozone", &a->ozone);
    print_list("absorption_colour", a->absorption_colour);
    printf("},\n");
}

static void print_table(const skv_table *table, int which) {
    const uint32_t *const word = (const uint32_t *)(const void *)table;
    printf("static const uint32_t case_table_%d[] = {", which);
    for (size_t i = 0; i < (table->bytes + 3) / 4; i++)
        printf("%s0x%08lxu,", i % 8 ? " " : "\n    ", (unsigned long)word[i]);
    printf("\n};\n");
}

static int print_airs(const plan_scene *scene, const plan_config *config) {
    plan_shop *const shop = plan_shop_open(scene);
    const plan_built *built[PLAN_AIRS_MAX] = {NULL};
    for (int i = 0; shop && i < plan_airs(scene); i++) {
        skv_status status;
        built[i] = plan_build(shop, i, config, &status);
        if (!built[i])
            return 1;
        if (config->light != PLAN_SINGLE)
            print_table(built[i]->table[plan_table_kind(config->light)], i);
    }
    printf("static const skv_atmosphere case_air[] = {\n");
    for (int i = 0; i < plan_airs(scene); i++)
        print_air(&built[i]->air);
    printf("};\nstatic const uint32_t *const case_table[] = {");
    for (int i = 0; i < plan_airs(scene); i++)
        if (config->light == PLAN_SINGLE)
            printf("0, ");
        else
            printf("case_table_%d, ", i);
    printf("};\n");
    plan_shop_close(shop);
    return 0;
}

static void print_frames(const char *name, const plan_scene *scene, unsigned seed, int frames) {
    printf("static const case_frame %s[] = {\n", name);
    for (int i = 0; i < frames; i++) {
        const plan_frame f = plan_frame_at(scene, seed, i);
        float sun[3];
        plan_sun_direction(&f, sun);
        printf("    {%d, ", f.air);
        print_float((float)f.height_km);
        printf(", {(float)%.9g, (float)%.9g, (float)%.9g}},\n", (double)sun[0], (double)sun[1], (double)sun[2]);
    }
    printf("};\n");
}

static void print_direction(const plan_ray *ray) {
    float d[3];
    plan_direction(ray, d);
    printf("    {(float)%.9g, (float)%.9g, (float)%.9g},\n", (double)d[0] + 0.0, (double)d[1] + 0.0,
           (double)d[2] + 0.0);
}

static void print_rays(const plan_scene *scene, unsigned seed, int frames, int rays, plan_vertices n) {
    printf("static const float case_view[][3] = {\n");
    for (int i = 0; i < frames * rays; i++) {
        const plan_ray r = plan_view_at(scene, seed, i / rays, i % rays, rays);
        print_direction(&r);
    }
    printf("};\nstatic const float case_dome[][3] = {\n");
    for (int i = 0; i < n.dome; i++) {
        const plan_ray r = plan_dome_at(scene, i, n.dome);
        print_direction(&r);
    }
    printf("};\nstatic const float case_terrain[][3] = {\n");
    for (int i = 0; i < n.terrain; i++) {
        const plan_ray r = plan_terrain_at(scene, COUNT_SEED, 0, i, n.terrain);
        print_direction(&r);
    }
    printf("    {0.0f, 0.0f, 1.0f}};\nstatic const float case_length_km[] = {\n");
    for (int i = 0; i < n.terrain; i++)
        printf("    (float)%.9g,\n", plan_terrain_at(scene, COUNT_SEED, 0, i, n.terrain).length_km);
    printf("    0.0f};\n");
}

int main(int argc, char **argv) {
    plan_scene scene;
    if (argc != 10 || plan_scene_load(&scene, argv[1]) != 0) {
        fprintf(stderr, "usage: plan-case SCENE.ini TRUTH-SEED FRAMES RAYS VERTICES BANDS SPECIES TABLE STARS\n");
        return 2;
    }
    long x[8];
    for (int i = 0; i < 8; i++)
        x[i] = strtol(argv[2 + i], NULL, 10);
    const plan_config config = {
        .bands = (int)x[4], .species = (unsigned)x[5] & 15u, .light = (plan_light_kind)x[6], .samples = 6};
    const plan_vertices n = plan_share(&scene, (int)x[3]);
    printf("#define CASE_COUNTED %d\n#define CASE_FRAMES %ld\n#define CASE_RAYS %ld\n#define CASE_DOME %d\n"
           "#define CASE_TERRAIN %d\n#define CASE_STARS %ld\n#define CASE_GROUND_KM ((float)%.9g)\n",
           COUNTED, x[1], x[2], n.dome, n.terrain, x[7], 0.001 * scene.ground_m + 0.0);
    const int status = print_airs(&scene, &config);
    print_frames("case_counted", &scene, COUNT_SEED, COUNTED);
    print_frames("case_frames", &scene, (unsigned)x[0], (int)x[1]);
    print_rays(&scene, (unsigned)x[0], (int)x[1], (int)x[2], n);
    plan_scene_free(&scene);
    return status;
}
