/// Bytes of the caller's structs. Prints `name bytes`.
#include <stdio.h>

#include "skyvert/skyvert.h"

#define SIZE(type) printf(#type " %u\n", (unsigned)sizeof(type))

int main(void) {
    SIZE(skv_atmosphere);
    SIZE(skv_model);
    SIZE(skv_frame);
    SIZE(skv_light);
    SIZE(skv_quality);
    SIZE(skv_colour_matrix);
    SIZE(skv_dome);
    SIZE(skv_sun);
    SIZE(skv_moon);
    return 0;
}
