/// Elements of the caller's arrays: stride in bytes, 0 = packed.
#ifndef SKV_SCENE_STRIDED_H
#define SKV_SCENE_STRIDED_H

#include <stdbool.h>
#include <stddef.h>

/// Stride meant by the caller for elements of `size` bytes.
static inline size_t skv_stride(size_t stride, size_t size) {
    return stride == 0 ? size : stride;
}

/// Long enough for an array of floats of `size` bytes each, and aligned?
static inline bool skv_stride_ok(size_t stride, size_t size) {
    return stride == 0 || (stride >= size && stride % sizeof(float) == 0);
}

static inline const float *skv_const_at(const float *base, size_t stride, size_t i) {
    return (const float *)(const void *)((const unsigned char *)base + i * stride);
}

static inline float *skv_at(float *base, size_t stride, size_t i) {
    return (float *)(void *)((unsigned char *)base + i * stride);
}

#endif
