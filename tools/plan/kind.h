/// What tells rays apart as far as the model's own error goes: coordinates in which similar rays are near.
#ifndef TOOLS_PLAN_KIND_H
#define TOOLS_PLAN_KIND_H

#include "tools/plan/sample.h"

typedef struct plan_kind_of_ray {
    float particles, gas, sun, height, view, azimuth;
} plan_kind_of_ray;
plan_kind_of_ray plan_ray_kind(const skv_atmosphere *air, const plan_frame *frame, const plan_ray *ray);

#endif
