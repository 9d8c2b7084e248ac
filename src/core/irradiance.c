#include "skyvert/irradiance.h"

#include "skyvert/radiance.h"

skv_status skv_irradiance(const skv_frame *frame, uint32_t parts, size_t n, const float *normal_enu,
                          size_t normal_stride, float *irradiance, size_t irradiance_stride) {
    (void)parts;
    (void)n;
    (void)normal_stride;
    (void)irradiance_stride;
    return frame && normal_enu && irradiance ? SKV_ERR_UNSUPPORTED : SKV_ERR_NULL;
}
