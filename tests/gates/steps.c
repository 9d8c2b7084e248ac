/// Steps of a table's build, each in a window of its own: those of some cells of every pass, and packing.
///
///     steps             every step of a cell in four rows, of the rest and of packing
///     steps accurate    one window about a whole build; steps small: the same
#include "window.h"

#include <stdio.h>
#include <string.h>

#include "skyvert/skyvert.h"

static skv_model model;
static skv_table_builder builder;
static uint32_t table[2048], work[20000];

static int begin(skv_table_kind kind) {
    skv_atmosphere air;
    skv_table_spec spec;
    return skv_atmosphere_preset(&air, SKV_PRESET_EARTH_HAZY, 4) == SKV_OK && skv_model_build(&model, &air) == SKV_OK &&
           skv_table_spec_kind(&spec, kind) == SKV_OK &&
           skv_table_begin(&builder, &model, &spec, (skv_table *)(void *)table, sizeof table, work, sizeof work) ==
               SKV_OK;
}

/// Steps alike differ in their cell only: one column stands for all, the rows for ground, detailed, first without, top.
static int is_wanted(void) {
    const int rows = builder.spec.altitudes;
    const int gathers = builder.pass <= builder.spec.orders;
    return !gathers || (builder.column == 10 && (builder.row < 1 || builder.row == 2 || builder.row == rows - 1));
}

int main(int argc, char **argv) {
    int done = 0, steps = 0;
    if (!begin(argc > 1 && strcmp(argv[1], "small") == 0 ? SKV_TABLE_SMALL : SKV_TABLE_ACCURATE))
        return 1;
    if (argc > 1) {
        WINDOW_BEGIN();
        while (done < 1000 && skv_table_step(&builder, &done) == SKV_OK)
            steps++;
        WINDOW_END(argv[1]);
        printf("%s %d\n", argv[1], steps);
        return 0;
    }
    while (done < 1000) {
        const int wanted = is_wanted(), pass = builder.pass, row = builder.row, ray = builder.ray;
        char name[64];
        snprintf(name, sizeof name, "pass-%d-row-%d-ray-%d-step-%d", pass, row, ray, steps++);
        if (wanted)
            WINDOW_BEGIN();
        if (skv_table_step(&builder, &done) != SKV_OK)
            return 1;
        if (wanted)
            WINDOW_END(name);
    }
    printf("steps %d\n", steps);
    return 0;
}
