/// Which directions a pyramid of view sees.
#include "skyvert/dome.h"

#include "scene/strided.h"
#include "scene/vector.h"

/// Inner normals of the four planes and the axis, with the least cosine to each.
typedef struct pyramid {
    skv_vec3 normal[4];
    skv_vec3 forward;
    float least_side;    ///< -sin(margin)
    float least_forward; ///< cosine of the corners' angle and the margin
} pyramid;

static bool in_range(const skv_frustum *f) {
    const float t[4] = {f->tan_left, f->tan_right, f->tan_down, f->tan_up};
    for (int i = 0; i < 4; i++)
        if (!(t[i] >= 1.0e-4f && t[i] <= 1.0e4f))
            return false;
    return f->margin_rad >= 0.0f && f->margin_rad <= 1.5f;
}

/// Inner normal of the side plane at the half angle atan(t) from forward towards -across: across + t forward at
/// length 1.
static skv_vec3 side(skv_vec3 across, float sign, float t, skv_vec3 forward) {
    const float c = 1.0f / skv_sqrtf(1.0f + t * t);
    return skv_combine(sign * c, across, t * c, forward);
}

/// The planes alone would let through what lies behind, once the margin is wider than the pyramid: a cone about the
/// corner that is farthest from the axis, widened by the margin, shuts that out.
static float least_forward(const skv_frustum *f) {
    const float x = skv_maxf(f->tan_left, f->tan_right), y = skv_maxf(f->tan_down, f->tan_up);
    const float corner = skv_atan2f(skv_sqrtf(x * x + y * y), 1.0f) + f->margin_rad;
    return corner >= SKV_PI ? -2.0f : skv_cosf(corner);
}

static bool build(const skv_frustum *f, pyramid *out) {
    skv_vec3 forward, up, right;
    if (!skv_unit3(f->forward_enu, &forward) || !skv_unit3(f->up_enu, &up))
        return false;
    const skv_vec3 across = skv_cross(forward, up);
    if (!(skv_dot(across, across) >= 1.0e-6f))
        return false;
    const float length = skv_sqrtf(skv_dot(across, across));
    right = (skv_vec3){across.x / length, across.y / length, across.z / length};
    up = skv_cross(right, forward);
    out->forward = forward;
    out->normal[0] = side(right, 1.0f, f->tan_left, forward);
    out->normal[1] = side(right, -1.0f, f->tan_right, forward);
    out->normal[2] = side(up, 1.0f, f->tan_down, forward);
    out->normal[3] = side(up, -1.0f, f->tan_up, forward);
    out->least_side = -skv_sinf(f->margin_rad);
    out->least_forward = least_forward(f);
    return true;
}

static bool sees(const pyramid *p, skv_vec3 v) {
    bool in = skv_dot(p->forward, v) >= p->least_forward;
    for (int i = 0; i < 4; i++)
        in = in && skv_dot(p->normal[i], v) >= p->least_side;
    return in;
}

skv_status skv_frustum_select(const skv_frustum *frustum, size_t n, const float *direction_enu, size_t stride,
                              uint32_t *visible, size_t *count) {
    pyramid p;
    if (frustum == NULL || count == NULL || (n > 0 && (direction_enu == NULL || visible == NULL)))
        return SKV_ERR_NULL;
    if (!in_range(frustum))
        return SKV_ERR_RANGE;
    if (!skv_stride_ok(stride, 3 * sizeof(float)))
        return SKV_ERR_SIZE;
    if (!build(frustum, &p))
        return SKV_ERR_DIRECTION;
    const size_t step = skv_stride(stride, 3 * sizeof(float));
    skv_status status = SKV_OK;
    size_t found = 0;
    for (size_t i = 0; i < n; i++) {
        skv_vec3 v;
        if (!skv_unit3(skv_const_at(direction_enu, step, i), &v))
            status = SKV_ERR_DIRECTION;
        else if (sees(&p, v))
            visible[found++] = (uint32_t)i;
    }
    *count = found;
    return status;
}
