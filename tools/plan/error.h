/// How far a configuration is from the truth over a scene.
///
/// Error: that of tools/trade/metric.h with linear BT.709 as channels and each frame's light relative to the mean of
/// its directions, so that a dark frame counts like a bright one. The truth that is at hand is the best there is
/// (accurate table, 16 samples, all species, 4 bands) less what that is off from the path tracer in the most similar
/// of some hundred rays (floor_data.h, made by `make plan-floor`).
#ifndef TOOLS_PLAN_ERROR_H
#define TOOLS_PLAN_ERROR_H

#include "tools/plan/kind.h"
#include "tools/plan/light.h"

/// What is promised over what is expected: the error of other samples of the scene is at most that in nearly all
/// scenes (tests/plan). Where the worst fiftieth lies even beyond, few rays would decide whether a promise holds: then
/// it is promised.
#define PLAN_MARGIN 1.7
#define PLAN_BEYOND 0.98

typedef struct plan_judge {
    const plan_samples *samples;
    float (*best)[TRADE_BANDS]; ///< [rays]
    double (*off)[TRADE_BANDS]; ///< [rays]: best less truth
    double *mean;               ///< [frames] of the largest channels of the views
    double distance;            ///< mean distance to the similar rays; over 1: little is known about such air
    // room for work
    float (*got)[TRADE_BANDS];
    double (*truth)[TRADE_BANDS];
    double *scratch;
} plan_judge;

/// The best there is of a scene.
plan_config plan_best(const plan_scene *scene);
/// @return SKV_OK, or what the library says; SKV_ERR_SIZE also where memory ran out.
skv_status plan_judge_make(plan_judge *judge, plan_shop *shop, const plan_samples *samples);
void plan_judge_free(plan_judge *judge);
/// @param rgb  [rays], from plan_colours() of the same samples.
/// @return what can be promised
double plan_judge_error(const plan_judge *judge, const float (*rgb)[TRADE_BANDS], trade_error *error);
/// How far one configuration's light is from another's.
void plan_judge_between(const plan_judge *judge, const float (*from)[TRADE_BANDS], const float (*to)[TRADE_BANDS],
                        trade_error *error);

#endif
