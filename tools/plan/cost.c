#include "tools/plan/cost.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tools/plan/grid_rays.h"

/// Events that cost instructions; tools/plan/costs.py has the same list.
enum plan_event {
    EVENT_CALL,
    EVENT_BLOCK,
    EVENT_PART,
    EVENT_SHADOW,
    EVENT_COPY,
    EVENT_RUN,
    EVENT_RUN_NODE,
    EVENT_LOW_RUN,
    EVENT_LOW_NODE,
    EVENT_ENDS_BLOCK,
    EVENT_ENDS_TANGENT,
    EVENT_GROUND_BLOCK,
    EVENT_GROUND_RAY,
    EVENT_GROUND_TABLE,
    EVENT_TRANSMITTANCE_RAY,
    EVENT_GRID_BLOCK,
    EVENT_GRID_RAY,
    EVENT_GRID_ALONE,
    EVENT_DIFFUSE_PART,
    EVENT_DIFFUSE_SLICE,
    EVENT_DIFFUSE_NODE,
    EVENT_FINE,
    EVENT_FADING,
    EVENT_LOAD,
    EVENT_GRID,
    EVENTS
};

typedef struct plan_rate {
    const char *target;
    double per_us; ///< 0: not measured
} plan_rate;

typedef struct plan_costs {
    const char *target;
    int bands;
    unsigned species;
    int lanes;
    long model, frame, flash_single, flash; ///< bytes
    long stack[3];                          ///< single, with a table, making a grid
    double begin;
    double per[EVENTS];
} plan_costs;

#include "tools/plan/costs_data.h"

const char *const plan_target_names[] = {"x86-avx2", "x86-sse2", "cortex-m4f", "cortex-m7", "cortex-a53", NULL};

/// Clock and cycles per instruction that are assumed where nothing can be measured.
static const struct {
    double per_us;
    const char *text;
} assumed[PLAN_TARGETS] = {
    {3500, "assumed: 2.5 GHz, 1.4 instructions a cycle"},
    {5000, "assumed: 2.5 GHz, 2 instructions a cycle"},
    {129, "assumed: 168 MHz, 1.3 cycles an instruction"},
    {480, "assumed: 480 MHz, 1 cycle an instruction, code and data in tightly coupled memory"},
    {960, "assumed: 1.2 GHz, 1.25 cycles an instruction"},
};

static double measured_rate(plan_target target) {
    for (size_t i = 0; i < sizeof plan_rates / sizeof plan_rates[0]; i++)
        if (strcmp(plan_rates[i].target, plan_target_names[target]) == 0)
            return plan_rates[i].per_us;
    return 0;
}

double plan_rate_of(plan_target target) {
    const double measured = measured_rate(target);
    return measured > 0 ? measured : assumed[target].per_us;
}

const char *plan_rate_source(plan_target target) {
    return measured_rate(target) > 0 ? "measured where the counts were made" : assumed[target].text;
}

static const plan_costs *find_costs(plan_target target, int bands, unsigned species) {
    for (size_t i = 0; i < sizeof plan_cost_rows / sizeof plan_cost_rows[0]; i++) {
        const plan_costs *const c = &plan_cost_rows[i];
        if (c->bands == bands && c->species == species && strcmp(c->target, plan_target_names[target]) == 0)
            return c;
    }
    return NULL;
}

bool plan_cost_known(plan_target target, const plan_config *config) {
    return find_costs(target, config->bands, config->species) != NULL;
}

bool plan_general(const plan_scene *scene, unsigned species) {
    skv_atmosphere air;
    plan_air(scene, 0, 4, &air);
    const skv_profile *const profile[3] = {&air.rayleigh, &air.aerosol, &air.dust};
    for (int s = 0; s < 3; s++)
        if ((species >> s & 1u) != 0 && profile[s]->kind > SKV_PROFILE_EXPONENTIAL)
            return true;
    return false;
}

// --- work ---

enum { FRAMES = 16, COUNTED_MOST = 1024 };

/// Of one frame: the dome's rays, those with a length, the grid's.
typedef struct frame_work {
    skv_work dome, terrain, grid;
    int has_grid;
} frame_work;

typedef struct known_work {
    unsigned species;
    int light, grid;
    frame_work frame[FRAMES];
    struct known_work *next;
} known_work;

struct plan_counter {
    plan_shop *shop;
    const plan_scene *scene;
    plan_target target;
    plan_vertices vertices;
    int dome, terrain; ///< of these looked at
    known_work *known;
};

plan_counter *plan_counter_open(plan_shop *shop, const plan_scene *scene, plan_target target, int vertices) {
    plan_counter *const c = calloc(1, sizeof *c);
    if (!c)
        return NULL;
    *c = (plan_counter){.shop = shop, .scene = scene, .target = target, .vertices = plan_share(scene, vertices)};
    c->dome = c->vertices.dome < COUNTED_MOST ? c->vertices.dome : COUNTED_MOST;
    c->terrain = c->vertices.terrain < COUNTED_MOST ? c->vertices.terrain : COUNTED_MOST;
    return c;
}

void plan_counter_close(plan_counter *c) {
    for (known_work *k = c ? c->known : NULL; k;) {
        known_work *const next = k->next;
        free(k);
        k = next;
    }
    free(c);
}

static void work_of(const plan_counter *c, const skv_frame *frame, int i, int lanes, frame_work *w) {
    static float direction[COUNTED_MOST][3], length[COUNTED_MOST];
    const int one_lane = lanes == 1;
    for (int k = 0; k < c->dome; k++) {
        const plan_ray ray = plan_dome_at(c->scene, k, c->dome);
        plan_direction(&ray, direction[k]);
    }
    const skv_rays dome = {direction[0], 0, NULL, 0};
    plan_work_add(frame, (size_t)c->dome, &dome, one_lane, &w->dome);
    for (int k = 0; k < c->terrain; k++) {
        const plan_ray ray = plan_terrain_at(c->scene, 1, i, k, c->terrain);
        plan_direction(&ray, direction[k]);
        length[k] = (float)ray.length_km;
    }
    const skv_rays terrain = {direction[0], 0, length, 0};
    if (c->terrain > 0)
        plan_work_add(frame, (size_t)c->terrain, &terrain, one_lane, &w->terrain);
}

static skv_status make_work(plan_counter *c, const plan_config *config, int lanes, known_work *known) {
    static float grid[PLAN_GRID_FLOATS];
    plan_config any = *config;
    any.samples = 6; // work does not depend on them
    for (int i = 0; i < FRAMES; i++) {
        frame_work *const w = &known->frame[i];
        const plan_frame at = plan_frame_at(c->scene, 1, i);
        skv_frame frame, bare;
        skv_status status;
        const plan_built *const built = plan_build(c->shop, at.air, &any, &status);
        if (built)
            status = plan_begin(built, &any, c->scene, &at, &frame, grid, sizeof grid);
        if (built && status == SKV_OK)
            status = plan_begin(built, &any, c->scene, &at, &bare, NULL, 0);
        if (!built || status != SKV_OK)
            return status;
        work_of(c, &frame, i, lanes, w);
        w->has_grid = frame.diffuse.grid != NULL;
        if (w->has_grid)
            plan_grid_work(&bare, lanes == 1, &w->grid);
    }
    return SKV_OK;
}

static const known_work *know(plan_counter *c, const plan_config *config, int lanes, skv_status *status) {
    *status = SKV_OK;
    for (const known_work *k = c->known; k; k = k->next)
        if (k->species == config->species && k->light == (int)config->light && k->grid == (config->grid ? 1 : 0))
            return k;
    known_work *const made = calloc(1, sizeof *made);
    *status = SKV_ERR_SIZE;
    if (!made)
        return NULL;
    *made = (known_work){.species = config->species, .light = (int)config->light, .grid = config->grid ? 1 : 0};
    *status = make_work(c, config, lanes, made);
    if (*status != SKV_OK) {
        free(made);
        return NULL;
    }
    made->next = c->known;
    c->known = made;
    return made;
}

// --- instructions ---

static double diffuse_cost(const double *per, const skv_work *w) {
    return per[EVENT_DIFFUSE_PART] * w->diffuse_parts + per[EVENT_DIFFUSE_SLICE] * w->diffuse_slices +
           per[EVENT_DIFFUSE_NODE] * w->diffuse_nodes + per[EVENT_FINE] * w->diffuse_fine +
           per[EVENT_FADING] * w->diffuse_fading + per[EVENT_LOAD] * w->diffuse_loads;
}

static double ends_cost(const double *per, const skv_work *w, const plan_config *config, bool far, bool gridded,
                        double rays) {
    double sum = 0;
    if (config->ground || far)
        sum += per[EVENT_ENDS_BLOCK] * w->blocks + per[EVENT_ENDS_TANGENT] * (w->parts - w->blocks);
    if (config->ground)
        sum += per[EVENT_GROUND_BLOCK] * w->blocks + per[EVENT_GROUND_RAY] * w->grounds +
               (config->light == PLAN_SINGLE ? 0 : per[EVENT_GROUND_TABLE] * w->grounds);
    if (far)
        sum += per[EVENT_TRANSMITTANCE_RAY] * rays;
    if (gridded)
        sum += (per[EVENT_GRID_BLOCK] + (config->ground || far ? 0 : per[EVENT_GRID_ALONE])) * w->blocks +
               per[EVENT_GRID_RAY] * rays;
    return sum;
}

/// One call: `counted` of its `rays` were looked at.
static double call_cost(const plan_costs *c, const skv_work *w, const plan_config *config, bool far, bool gridded,
                        int counted, int rays) {
    const double *const per = c->per, n = config->samples;
    if (rays == 0)
        return 0;
    const double sum = per[EVENT_BLOCK] * w->blocks + per[EVENT_PART] * w->parts + per[EVENT_SHADOW] * w->shadows +
                       per[EVENT_COPY] * w->copies + (per[EVENT_RUN] + n * per[EVENT_RUN_NODE]) * w->runs +
                       (per[EVENT_LOW_RUN] + n * per[EVENT_LOW_NODE]) * w->low_runs + diffuse_cost(per, w) +
                       ends_cost(per, w, config, far, gridded, counted);
    return per[EVENT_CALL] + sum * rays / counted;
}

/// skv_frame_begin() takes 6 instead of 4 samples where 4 do not do.
static plan_config as_begun(const plan_counter *c, const plan_config *config, int i) {
    plan_config real = *config;
    const plan_frame at = plan_frame_at(c->scene, 1, i);
    skv_status status;
    skv_frame frame;
    plan_config single = *config;
    single.light = PLAN_SINGLE;
    const plan_built *const built = plan_build(c->shop, at.air, &single, &status);
    if (built && plan_begin(built, &single, c->scene, &at, &frame, NULL, 0) == SKV_OK)
        real.samples = frame.quality.samples;
    return real;
}

static void sizes(const plan_counter *c, const plan_costs *costs, const plan_config *config, plan_cost *cost) {
    skv_table_spec spec;
    skv_status status;
    const plan_built *const built = plan_build(c->shop, 0, config, &status);
    const bool all = config->light != PLAN_SINGLE;
    cost->model = costs->model;
    cost->frame = costs->frame;
    cost->flash = all ? costs->flash : costs->flash_single;
    cost->stack = costs->stack[!all ? 0 : config->grid ? 2 : 1];
    const skv_table_kind kind = plan_table_kind(config->light);
    if (!all || !built || skv_table_spec_for(&spec, &built->model, kind) != SKV_OK)
        return;
    cost->table = (long)skv_table_size(&spec, config->bands);
    cost->work = (long)(skv_table_work_size(&spec, config->bands) + sizeof(skv_table_builder));
    cost->grid_bytes = config->grid ? (long)sizeof(float) * PLAN_GRID_ROWS * PLAN_GRID_AZIMUTHS * config->bands : 0;
}

skv_status plan_cost_of(plan_counter *c, const plan_config *config, plan_cost *cost) {
    const plan_costs *const costs = find_costs(c->target, config->bands, config->species);
    skv_status status = SKV_ERR_UNSUPPORTED;
    *cost = (plan_cost){0};
    const known_work *const known = costs ? know(c, config, costs->lanes, &status) : NULL;
    if (!known)
        return status;
    const bool far = c->scene->stars, terrain_far = c->scene->terrain;
    for (int i = 0; i < FRAMES; i++) {
        const frame_work *const w = &known->frame[i];
        const plan_config real = as_begun(c, config, i);
        const double grid = w->has_grid ? costs->per[EVENT_GRID] + diffuse_cost(costs->per, &w->grid) : 0;
        const double sum = costs->begin + grid +
                           call_cost(costs, &w->dome, &real, far, w->has_grid, c->dome, c->vertices.dome) +
                           call_cost(costs, &w->terrain, &real, terrain_far, false, c->terrain, c->vertices.terrain);
        cost->mean += sum / FRAMES;
        cost->grid += grid / FRAMES;
        cost->worst = fmax(cost->worst, sum);
    }
    sizes(c, costs, config, cost);
    return SKV_OK;
}
