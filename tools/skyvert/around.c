#include "around.h"

skv_status around_add(surroundings *around, const skv_frame *frame, size_t n, const float *direction_enu,
                      const skv_sky *sky) {
    const skv_rays rays = {.direction_enu = direction_enu};
    skv_status status = around->has_water ? around_add_sea(around, frame, n, &rays, sky) : SKV_OK;
    if (status == SKV_OK && around->has_night)
        status = skv_night_add(&around->night, frame, n, &rays, sky);
    for (int i = 0; i < around->discs && status == SKV_OK; i++)
        status = skv_disc_add(&around->disc[i], frame, n, &rays, sky);
    return status;
}
