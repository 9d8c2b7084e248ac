/// What is counted: one case per rule and tier, and one per macro of config.h with that thing switched off at run time.
/// Prints `name vertices` for each case that this build has; counts.sh puts the instructions beside it.
#include "window.h"

#include <stdio.h>
#include <string.h>

#include "skyvert/skyvert.h"

enum { RINGS = 13, AROUND = 24, VERTICES = RINGS * AROUND };

#if !defined(__x86_64__)
__attribute__((noinline)) void window_begin(void) {
    __asm volatile("" ::: "memory");
}
__attribute__((noinline)) void window_end(void) {
    __asm volatile("" ::: "memory");
}
#endif

typedef struct count_case {
    const char *name;
    int bands;
    skv_rule rule;
    skv_depth depth;
    int samples;
    int depth_samples;
    unsigned species; ///< SKV_WITH_RAYLEIGH, _AEROSOL, _OZONE: those that are there
    int ground;
    int transmittance;
    int tabulated; ///< Rayleigh by US76 instead of an exponential
    skv_phase phase;
    int diffuse; ///< 1: with a table, 2: with a table and a grid
} count_case;

enum { RA = SKV_WITH_RAYLEIGH | SKV_WITH_AEROSOL, RAO = RA | SKV_WITH_OZONE };
#define G     SKV_GAUSS_EXP
#define CHAP  SKV_DEPTH_BY_CHAPMAN
#define INNER SKV_DEPTH_BY_INNER
#define HG    SKV_PHASE_HG
#define CS    SKV_PHASE_CS

static const count_case cases[] = {
    {"3-bands-2-species-gauss-exp-4", 3, G, CHAP, 4, 1, RA, 0, 0, 0, HG, 0},
    {"3-bands-2-species-gauss-exp-6", 3, G, CHAP, 6, 1, RA, 0, 0, 0, HG, 0},
    {"3-bands-2-species-gauss-exp-8", 3, G, CHAP, 8, 1, RA, 0, 0, 0, HG, 0},
    {"4-bands-ozone-gauss-exp-4", 4, G, CHAP, 4, 1, RAO, 0, 0, 0, HG, 0},
    {"4-bands-ozone-gauss-exp-6", 4, G, CHAP, 6, 1, RAO, 0, 0, 0, HG, 0},
    {"4-bands-ozone-gauss-exp-8", 4, G, CHAP, 8, 1, RAO, 0, 0, 0, HG, 0},
    {"3-bands-2-species-keller-4x4", 3, SKV_KELLER, INNER, 4, 4, RA, 0, 0, 0, HG, 0},
    {"3-bands-2-species-keller-5x5", 3, SKV_KELLER, INNER, 5, 5, RA, 0, 0, 0, HG, 0},
    {"3-bands-2-species-keller-16x16", 3, SKV_KELLER, INNER, 16, 16, RA, 0, 0, 0, HG, 0},
    {"3-bands-2-species-uniform-16x16", 3, SKV_UNIFORM, INNER, 16, 16, RA, 0, 0, 0, HG, 0},
    {"4-bands-ozone-gauss-exp-6-table", 4, G, CHAP, 6, 1, RAO, 0, 0, 0, HG, 1},
    {"4-bands-ozone-gauss-exp-6-grid", 4, G, CHAP, 6, 1, RAO, 0, 0, 0, HG, 2},
    // Each macro's thing is off in its case, everything else is as in `off:nothing`.
    {"off:nothing", 4, G, CHAP, 6, 4, RAO, 1, 1, 1, HG, 0},
    {"off:SKV_BANDS=3", 3, G, CHAP, 6, 4, RAO, 1, 1, 1, HG, 0},
    {"off:SKV_BANDS=4", 4, G, CHAP, 6, 4, RAO, 1, 1, 1, HG, 0},
    {"off:SKV_RULE_UNIFORM=0", 4, G, CHAP, 6, 4, RAO, 1, 1, 1, HG, 0},
    {"off:SKV_RULE_KELLER=0", 4, G, CHAP, 6, 4, RAO, 1, 1, 1, HG, 0},
    {"off:SKV_RULE_GAUSS_EXP=0", 4, SKV_KELLER, CHAP, 6, 4, RAO, 1, 1, 1, HG, 0},
    {"off:SKV_DEPTH_CHAPMAN=0", 4, G, INNER, 6, 4, RAO, 1, 1, 0, HG, 0},
    {"off:SKV_DEPTH_INNER=0", 4, G, CHAP, 6, 4, RAO, 1, 1, 1, HG, 0},
    {"off:SKV_TERM_RAYLEIGH=0", 4, G, CHAP, 6, 4, RAO & ~1u, 1, 1, 0, HG, 0},
    {"off:SKV_TERM_AEROSOL=0", 4, G, CHAP, 6, 4, RAO & ~2u, 1, 1, 1, HG, 0},
    {"off:SKV_TERM_DUST=0", 4, G, CHAP, 6, 4, RAO, 1, 1, 1, HG, 0},
    {"off:SKV_TERM_OZONE=0", 4, G, CHAP, 6, 4, RA, 1, 1, 1, HG, 0},
    {"off:SKV_TERM_GROUND=0", 4, G, CHAP, 6, 4, RAO, 0, 1, 1, HG, 0},
    {"off:SKV_TERM_DIFFUSE=0", 4, G, CHAP, 6, 4, RAO, 1, 1, 1, HG, 0},
    {"off:SKV_OUT_TRANSMITTANCE=0", 4, G, CHAP, 6, 4, RAO, 1, 0, 1, HG, 0},
    {"off:SKV_PHASE_HENYEY_GREENSTEIN=0", 4, G, CHAP, 6, 4, RAO, 1, 1, 1, CS, 0},
    {"off:SKV_PHASE_CORNETTE_SHANKS=0", 4, G, CHAP, 6, 4, RAO, 1, 1, 1, HG, 0},
    {"off:SKV_PROFILE_TABULATED=0", 4, G, CHAP, 6, 4, RAO, 1, 1, 0, HG, 0},
    {"off:SKV_LIGHTS_MAX=1", 4, G, CHAP, 6, 4, RAO, 1, 1, 1, HG, 0},
};

static float direction[VERTICES][3];
static float radiance[VERTICES][4];
static float transmittance[VERTICES][4];
static skv_model model;
static skv_frame frame;
// A table with few cells: what a vertex costs does not depend on their number. The grid takes the work space's place.
static uint32_t table[400];
static float work[3200];

/// Rings of a square seen from its middle: directions need no length. All rays above the horizon of 1 km but the last
/// ring.
static void make_directions(void) {
    static const float slope[RINGS] = {20.0f, 5.0f, 2.5f,  1.5f,  1.0f,  0.7f, 0.45f,
                                       0.3f,  0.2f, 0.12f, 0.06f, 0.02f, -0.2f};
    for (int i = 0; i < VERTICES; ++i) {
        const int side = i % AROUND / 6;
        const float along = (float)(i % 6) * (1.0f / 3.0f) - 1.0f;
        direction[i][0] = side == 0 ? 1.0f : side == 1 ? -along : side == 2 ? -1.0f : along;
        direction[i][1] = side == 0 ? along : side == 1 ? 1.0f : side == 2 ? -along : -1.0f;
        direction[i][2] = slope[i / AROUND];
    }
}

static skv_status set_up_diffuse(const count_case *c) {
    skv_table_spec spec;
    skv_status status = skv_table_spec_kind(&spec, SKV_TABLE_SMALL);
    if (status != SKV_OK)
        return status;
    spec.altitudes = 4;
    spec.suns = 8;
    spec.orders = spec.polar[0] = spec.polar[1] = spec.azimuths[0] = spec.azimuths[1] = 2;
    status = skv_table_build((skv_table *)(void *)table, sizeof table, work, sizeof work, &model, &spec);
    if (status == SKV_OK)
        status = skv_frame_table(&frame, (const skv_table *)(const void *)table);
    return status == SKV_OK && c->diffuse == 2 ? skv_frame_grid(&frame, work, sizeof work) : status;
}

static skv_status set_up(const count_case *c) {
    static const float sun_enu[3] = {0.6f, 0.3f, 0.5f};
    skv_atmosphere air;
    skv_light sun;
    skv_quality quality = {c->rule, c->depth, c->samples, c->depth_samples,
                           c->species | (c->ground ? SKV_WITH_GROUND : 0)};
    skv_status status = skv_atmosphere_preset(&air, SKV_PRESET_EARTH_HAZY, c->bands);
    air.rayleigh.kind = c->tabulated ? SKV_PROFILE_US76 : SKV_PROFILE_EXPONENTIAL;
    air.rayleigh.scale_height_km = 8.0f;
    air.rayleigh.us76_a = 0.07771971f;
    air.rayleigh.us76_b = 1.16364243f;
    air.aerosol.kind = SKV_PROFILE_EXPONENTIAL;
    air.aerosol.scale_height_km = 1.2f;
    air.aerosol_phase = c->phase;
    if (!(c->species & SKV_WITH_RAYLEIGH))
        air.rayleigh.kind = SKV_PROFILE_NONE;
    if (!(c->species & SKV_WITH_AEROSOL))
        air.aerosol.kind = SKV_PROFILE_NONE;
    if (!(c->species & SKV_WITH_OZONE))
        air.ozone.kind = SKV_PROFILE_NONE;
    if (status == SKV_OK)
        status = skv_model_build(&model, &air);
    if (status == SKV_OK)
        status = skv_light_sun(&sun, &model, sun_enu);
    if (status == SKV_OK)
        status = skv_frame_begin(&frame, &model, &quality, 1.0f, 0.0f, &sun, 1);
    return status == SKV_OK && c->diffuse ? set_up_diffuse(c) : status;
}

static void count(const count_case *c) {
    const skv_rays rays = {direction[0], 0, NULL, 0};
    const skv_sky sky = {radiance[0], sizeof *radiance, c->transmittance ? transmittance[0] : NULL,
                         sizeof *transmittance};
    if (set_up(c) != SKV_OK || skv_radiance(&frame, 1, &rays, &sky) != SKV_OK)
        return; // left out of this build
    WINDOW_BEGIN();
    const skv_status status = skv_radiance(&frame, VERTICES, &rays, &sky);
    WINDOW_END(c->name);
    printf("%s %d\n", status == SKV_OK ? c->name : "failed", VERTICES);
}

int main(void) {
    make_directions();
    WINDOW_BEGIN(); // what an empty window counts
    WINDOW_END("empty");
    puts("empty 1");
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i)
        count(&cases[i]);
    return 0;
}
