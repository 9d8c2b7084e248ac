/// The smallest use on a microcontroller: no C library, no heap, the structs static, one dome column per call.
/// Built and run under QEMU by `make test`; prints nothing but its verdict.
#include "skyvert/skyvert.h"

#include "cortexm.h"

static skv_model model;
static skv_frame frame;

/// Radiance at the zenith and near the horizon, W m^-2 sr^-1 nm^-1.
static skv_status two_vertices(float radiance[2][3]) {
    static const float up[2][3] = {{0.0f, 0.0f, 1.0f}, {0.0f, 1.0f, 0.05f}};
    static const float sun_enu[3] = {0.5f, 0.0f, 0.5f};
    skv_atmosphere air;
    skv_light sun;
    skv_status status = skv_atmosphere_preset(&air, SKV_PRESET_EARTH_CLEAR, 3);
    if (status == SKV_OK)
        status = skv_model_build(&model, &air); // when the weather changes
    if (status == SKV_OK)
        status = skv_light_sun(&sun, &model, sun_enu);
    if (status == SKV_OK)
        status = skv_frame_begin(&frame, &model, NULL, 0.5f, 0.0f, &sun, 1); // once per picture
    if (status != SKV_OK)
        return status;
    const skv_rays rays = {&up[0][0], 0, NULL, 0};
    const skv_sky sky = {&radiance[0][0], 0, NULL, 0};
    return skv_radiance(&frame, 2, &rays, &sky);
}

int main(void) {
    float radiance[2][3];
    const skv_status status = two_vertices(radiance);
    const int right = status == SKV_OK && radiance[0][0] > radiance[0][2] && radiance[1][2] > radiance[0][2];
    skvm_write(right ? "demo: the zenith is blue and the horizon brighter\n" : "demo: FAILED\n");
    return right ? 0 : 1;
}
