/// Stage 3, per vertex: directions in, spectral radiance and transmittance out.
#ifndef SKYVERT_RADIANCE_H
#define SKYVERT_RADIANCE_H

#include <stddef.h>

#include "skyvert/frame.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Largest radiance that is written; sums beyond it stay there.
#define SKV_RADIANCE_MAX 3.0e38f

/// Where the rays are read from: fields of the caller's vertices, any stride.
typedef struct skv_rays {
    const float *direction_enu; ///< [n][3], from the observer; any length but 0 or subnormal (a dome vertex will do)
    size_t direction_stride;    ///< bytes from one to the next; 0 = 3 floats, packed
    const float *length_km; ///< [n], distance to what the ray meets (a mountain, an aircraft), >= 0, +infinity = none;
                            ///< NULL = none for all. The ground ends a ray in any case.
    size_t length_stride;   ///< bytes; 0 = packed
} skv_rays;

/// Where the results are written to.
typedef struct skv_sky {
    float *radiance;             ///< [n][bands], W m^-2 sr^-1 nm^-1; finite and >= 0 always
    size_t radiance_stride;      ///< bytes; 0 = packed
    float *transmittance;        ///< [n][bands], from the end of the ray to the observer, [0, 1]; NULL = not wanted
    size_t transmittance_stride; ///< bytes; 0 = packed
} skv_sky;

/// Sky radiance towards n directions (in-scattered light; the discs of the lights are not drawn).
/// @param[in]  frame  from skv_frame_begin().
/// @param[in]  n      number of rays.
/// @param[in]  rays   may lie in the same vertices as the results, but in other fields.
/// @param[out] sky
/// @return SKV_OK; SKV_ERR_NULL; SKV_ERR_LAYOUT; SKV_ERR_SIZE iff a stride is no multiple of 4 or shorter than its
/// field:
///         nothing is written. SKV_ERR_DIRECTION iff some ray has a zero or non-finite direction or a negative or NaN
///         length: its radiance and transmittance are 0, all other rays are valid.
/// Cost:   O(n). Stack: see README "Sizes". No allocation. Thread-safe: any number of threads may share a frame.
skv_status skv_radiance(const skv_frame *frame, size_t n, const skv_rays *rays, const skv_sky *sky);

#ifdef __cplusplus
}
#endif
#endif
