/// Vectors of three floats.
#ifndef SKV_SCENE_VECTOR_H
#define SKV_SCENE_VECTOR_H

#include <stdbool.h>

#include "core/elementary.h"

typedef struct skv_vec3 {
    float x, y, z;
} skv_vec3;

static inline float skv_dot(skv_vec3 a, skv_vec3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline skv_vec3 skv_cross(skv_vec3 a, skv_vec3 b) {
    return (skv_vec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// a x + b y
static inline skv_vec3 skv_combine(float a, skv_vec3 x, float b, skv_vec3 y) {
    return (skv_vec3){a * x.x + b * y.x, a * x.y + b * y.y, a * x.z + b * y.z};
}

/// v at length 1. False where a component is infinite or NaN or none is a normal float. Scaled by the largest component
/// first: squares neither overflow nor vanish.
static inline bool skv_unit3(const float v[3], skv_vec3 *unit) {
    const float most = skv_maxf(skv_maxf(skv_fabsf(v[0]), skv_fabsf(v[1])), skv_fabsf(v[2]));
    if (!skv_isfinite(v[0]) || !skv_isfinite(v[1]) || !skv_isfinite(v[2]) || !(most >= FLT_MIN))
        return false;
    const skv_vec3 s = {v[0] / most, v[1] / most, v[2] / most};
    const float length = skv_sqrtf(skv_dot(s, s));
    *unit = (skv_vec3){s.x / length, s.y / length, s.z / length};
    return true;
}

#endif
