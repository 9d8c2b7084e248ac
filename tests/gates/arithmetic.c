/// Exit status 0 when a model can be built, 3 when the library refuses because of the arithmetic it was compiled with.
#include "skyvert/skyvert.h"

static skv_model model;

int main(void) {
    skv_atmosphere air;
    if (skv_atmosphere_preset(&air, SKV_PRESET_EARTH_CLEAR, 3) != SKV_OK)
        return 1;
    const skv_status status = skv_model_build(&model, &air);
    return status == SKV_OK ? 0 : status == SKV_ERR_UNSUPPORTED ? 3 : 1;
}
