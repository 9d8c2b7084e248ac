// The library from C++11: its structs are plain, its functions link.
#include "skyvert/skyvert.h"

#include <cstdio>
#include <memory>
#include <type_traits>

static_assert(std::is_standard_layout<skv_model>::value && std::is_trivially_copyable<skv_model>::value, "plain data");
static_assert(std::is_trivially_copyable<skv_frame>::value, "plain data");

int main() {
    skv_atmosphere air;
    std::unique_ptr<skv_model> model(new skv_model);
    const float up[3] = {0.0f, 0.0f, 1.0f};
    skv_light sun;
    skv_frame frame;
    float radiance[3] = {0.0f, 0.0f, 0.0f};
    if (skv_atmosphere_preset(&air, SKV_PRESET_EARTH_CLEAR, 3) != SKV_OK ||
        skv_model_build(model.get(), &air) != SKV_OK || skv_light_sun(&sun, model.get(), up) != SKV_OK ||
        skv_frame_begin(&frame, model.get(), nullptr, 0.0f, 0.0f, &sun, 1) != SKV_OK)
        return 1;
    const skv_rays rays = {up, 0, nullptr, 0};
    const skv_sky sky = {radiance, 0, nullptr, 0};
    const bool blue = skv_radiance(&frame, 1, &rays, &sky) == SKV_OK && radiance[0] > radiance[2] && radiance[2] > 0.0f;
    if (!blue)
        std::puts("C++: the zenith is not blue");
    return blue ? 0 : 1;
}
