/// Irradiance of surfaces at the observer: what an aircraft, a cockpit panel or a light sensor receives.
#ifndef SKYVERT_IRRADIANCE_H
#define SKYVERT_IRRADIANCE_H

#include <stddef.h>

#include "skyvert/frame.h"

#ifdef __cplusplus
extern "C" {
#endif

/// What of the light is wanted: bits.
enum {
    SKV_IRRADIANCE_DIRECT = 1,  ///< the lights themselves, through the air
    SKV_IRRADIANCE_DIFFUSE = 2, ///< sky and ground; needs a table (skv_frame_table())
    SKV_IRRADIANCE_ALL = 3
};

/// Spectral irradiance of n surfaces at the frame's observer, any orientation.
/// @param[in]  frame
/// @param[in]  parts             SKV_IRRADIANCE_* bits.
/// @param[in]  n
/// @param[in]  normal_enu        [n][3], any normal length.
/// @param[in]  normal_stride     bytes; 0 = packed.
/// @param[out] irradiance        [n][bands], W m^-2 nm^-1, finite and >= 0.
/// @param[in]  irradiance_stride bytes; 0 = packed.
/// @return SKV_OK; SKV_ERR_NULL; SKV_ERR_RANGE (parts); SKV_ERR_UNSUPPORTED iff SKV_OUT_TRANSMITTANCE is 0 and direct
/// light
///         is wanted; SKV_ERR_LAYOUT iff the frame was not built, or has no table and
///         diffuse light is wanted; SKV_ERR_SIZE (strides); SKV_ERR_DIRECTION iff some normal is zero or not finite:
///         its irradiance is 0, all others are valid.
/// Source: radiance of the table up to degree 4 times the moments of the clamped cosine [Ramamoorthi01].
/// Error:  README "Tables".
///         Above the air 192 directions towards the planet are integrated for each surface instead.
/// Cost:   one transmittance and one cell of the table per light and call; some 100 instructions a surface. Above the
///         air 192 radiances a surface.
skv_status skv_irradiance(const skv_frame *frame, uint32_t parts, size_t n, const float *normal_enu,
                          size_t normal_stride, float *irradiance, size_t irradiance_stride);

#ifdef __cplusplus
}
#endif
#endif
