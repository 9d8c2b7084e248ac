/// What a configuration costs: events of its calls (skyvert/work.h) times instructions per event, fitted to counts on
/// each target (costs_data.h, made by `make plan-costs`).
#ifndef TOOLS_PLAN_COST_H
#define TOOLS_PLAN_COST_H

#include "tools/plan/light.h"

typedef enum plan_target {
    PLAN_X86_AVX2,
    PLAN_X86_SSE2,
    PLAN_CORTEX_M4F,
    PLAN_CORTEX_M7,
    PLAN_CORTEX_A53,
    PLAN_TARGETS
} plan_target;
extern const char *const plan_target_names[]; ///< NULL at the end

/// Instructions that a target does in a microsecond, and where the number is from.
double plan_rate_of(plan_target target);
const char *plan_rate_source(plan_target target);

/// Instructions of a frame, its grid included, over a scene's ranges; a model's and a table's making is not in it.
typedef struct plan_cost {
    double mean, worst; ///< of the frames looked at
    double grid;        ///< of the mean: making the grid
    long model, frame, table, grid_bytes, work, stack, flash;
} plan_cost;

/// Work of a scene's frames under some configurations, kept.
typedef struct plan_counter plan_counter;
plan_counter *plan_counter_open(plan_shop *shop, const plan_scene *scene, plan_target target, int vertices);
void plan_counter_close(plan_counter *counter);

/// Whether there are counts for these bands and species on the target.
bool plan_cost_known(plan_target target, const plan_config *config);
/// @return SKV_OK, or what the library says; SKV_ERR_UNSUPPORTED where nothing was counted.
skv_status plan_cost_of(plan_counter *counter, const plan_config *config, plan_cost *cost);

/// Whether a profile of the kept air is none of the plain exponentials that were counted: it costs more.
bool plan_general(const plan_scene *scene, unsigned species);

#endif
