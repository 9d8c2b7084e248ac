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
    SIZE(skv_table_builder);
    SIZE(skv_sun);
    SIZE(skv_moon);
    for (int kind = 0; kind < SKV_TABLE_KINDS; kind++) {
        static const char *const names[SKV_TABLE_KINDS] = {"accurate", "small", "large"};
        skv_table_spec spec;
        if (skv_table_spec_kind(&spec, (skv_table_kind)kind) != SKV_OK)
            break;
        printf("table_%s %u work_%s %u\n", names[kind], (unsigned)skv_table_size(&spec, 4), names[kind],
               (unsigned)skv_table_work_size(&spec, 4));
    }
    return 0;
}
