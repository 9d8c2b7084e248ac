/// The caller's rays one by one, for calls that add light to what skv_radiance() gave.
#ifndef SKV_SCENE_VIEW_H
#define SKV_SCENE_VIEW_H

#include "skyvert/radiance.h"

#include "scene/strided.h"
#include "scene/vector.h"

typedef struct skv_view {
    skv_vec3 unit;
    float length_km; ///< +infinity where the ray has no end of its own
} skv_view;

/// Rays and results with the strides written out.
typedef struct skv_batch {
    const skv_rays *rays;
    const skv_sky *sky;
    size_t direction_stride, length_stride, radiance_stride, transmittance_stride;
    size_t bands;
} skv_batch;

/// Was the frame begun, with a model that was built? (Which selection of config.h it was is skv_radiance()'s check.)
static inline bool skv_frame_ok(const skv_frame *frame) {
    return frame->layout != 0 && frame->model != NULL && frame->model->layout == frame->layout &&
           (frame->model->bands == 3 || frame->model->bands == 4);
}

static inline bool skv_model_ok(const skv_model *model) {
    return model->layout != 0 && (model->bands == 3 || model->bands == 4);
}

/// Checks what skv_radiance() checks. `sky` may be NULL: rays alone.
static inline skv_status skv_batch_of(skv_batch *batch, const skv_frame *frame, const skv_rays *rays,
                                      const skv_sky *sky) {
    if (frame == NULL || rays == NULL || rays->direction_enu == NULL || (sky != NULL && sky->radiance == NULL))
        return SKV_ERR_NULL;
    if (!skv_frame_ok(frame))
        return SKV_ERR_LAYOUT;
    const size_t bands = (size_t)frame->model->bands, one = sizeof(float);
    if (!skv_stride_ok(rays->direction_stride, 3 * one) || !skv_stride_ok(rays->length_stride, one))
        return SKV_ERR_SIZE;
    if (sky != NULL &&
        (!skv_stride_ok(sky->radiance_stride, bands * one) || !skv_stride_ok(sky->transmittance_stride, bands * one)))
        return SKV_ERR_SIZE;
    *batch = (skv_batch){rays,
                         sky,
                         skv_stride(rays->direction_stride, 3 * one),
                         skv_stride(rays->length_stride, one),
                         sky != NULL ? skv_stride(sky->radiance_stride, bands * one) : 0,
                         sky != NULL ? skv_stride(sky->transmittance_stride, bands * one) : 0,
                         bands};
    return SKV_OK;
}

/// Ray i. False where skv_radiance() refuses it.
static inline bool skv_batch_view(const skv_batch *batch, size_t i, skv_view *view) {
    view->length_km = skv_from_bits(0x7f800000u);
    if (batch->rays->length_km != NULL)
        view->length_km = *skv_const_at(batch->rays->length_km, batch->length_stride, i);
    return view->length_km >= 0.0f &&
           skv_unit3(skv_const_at(batch->rays->direction_enu, batch->direction_stride, i), &view->unit);
}

/// Transmittance of ray i in a band, [0, 1]; 1 where the caller gave none.
static inline float skv_batch_transmittance(const skv_batch *batch, size_t i, size_t band) {
    if (batch->sky->transmittance == NULL)
        return 1.0f;
    return skv_clampf(skv_const_at(batch->sky->transmittance, batch->transmittance_stride, i)[band], 0.0f, 1.0f);
}

/// Adds light to ray i. What was there counts as 0 where it is negative or NaN.
static inline void skv_batch_add(const skv_batch *batch, size_t i, size_t band, float more) {
    float *const at = skv_at(batch->sky->radiance, batch->radiance_stride, i) + band;
    const float sum = skv_maxf(*at, 0.0f) + skv_maxf(more, 0.0f);
    *at = skv_minf(sum, SKV_RADIANCE_MAX);
}

/// Where a straight ray meets the ground's sphere, as skv_radiance() decides it.
typedef struct skv_ground {
    bool hit;
    float distance_km; ///< of the sphere along the ray, whatever the ray's length; 0 where there is none
    float mu;          ///< cosine of incidence there, (0, 1]
} skv_ground;

/// r mu and R^2 - p^2 (p the ray's distance from the centre) by the forms that cancel least: from the altitude within
/// the air, from p itself far outside.
static inline skv_ground skv_view_ground(const skv_frame *frame, skv_vec3 v) {
    const float radius = frame->radius_km, h = frame->height_km, r = radius + h;
    const float rm = r * v.z, p = r * skv_sqrtf(v.x * v.x + v.y * v.y), c = h * (2.0f * radius + h);
    const float square = h <= frame->top_km || -rm < p ? rm * rm - c : (radius - p) * (radius + p);
    const bool hit = v.z < 0.0f && square > 0.0f;
    const float root = skv_sqrtf(square);
    if (!hit)
        return (skv_ground){false, 0.0f, 0.0f};
    return (skv_ground){true, c / skv_maxf(root - rm, 1e-30f), skv_minf(root / radius, 1.0f)};
}

#endif
