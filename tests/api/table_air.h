/// Tables, their buffers and frames for the tests of light scattered more than once.
#ifndef TESTS_API_TABLE_AIR_H
#define TESTS_API_TABLE_AIR_H

#include "core_air.h"
#include "random.h"
#include "skyvert/irradiance.h"
#include "skyvert/table.h"

#if SMALL_TARGET
enum { TABLE_WORDS = 1060, WORK_WORDS = 2800, GRID_WORDS = 1880 };
#else
enum { TABLE_WORDS = 8192, WORK_WORDS = 40000, GRID_WORDS = 2 * 1900 };
#endif

static skv_model table_model;
static uint32_t table_words[TABLE_WORDS], table_work[WORK_WORDS];
static skv_table *const table_here = (skv_table *)(void *)table_words;

/// The least spec: all of the code, the shortest build.
static inline skv_table_spec spec_least(void) {
    skv_table_spec s;
    check_status("skv_table_spec_kind", skv_table_spec_kind(&s, SKV_TABLE_SMALL), SKV_OK);
    s.altitudes = 4;
    s.detailed = 1;
    s.suns = 8;
    s.orders = 2;
    for (int i = 0; i < 2; i++)
        s.samples[i] = s.polar[i] = s.azimuths[i] = 2;
    return s;
}

/// What the target has room for.
static inline skv_table_spec spec_of(skv_table_kind kind) {
    skv_table_spec s = spec_least();
    if (!SMALL_TARGET)
        check_status("skv_table_spec_kind", skv_table_spec_kind(&s, kind), SKV_OK);
    return s;
}

static inline void table_into(uint32_t *words, const skv_model *model, const skv_table_spec *spec) {
    check_status("skv_table_build",
                 skv_table_build((skv_table *)(void *)words, TABLE_WORDS * sizeof *words, table_work, sizeof table_work,
                                 model, spec),
                 SKV_OK);
}

/// Model and table of an air.
static inline void table_make(const skv_atmosphere *air, const skv_table_spec *spec) {
    build(&table_model, air);
    table_into(table_words, &table_model, spec);
}

/// A frame with the table, all terms.
static inline void table_frame(skv_frame *frame, double observer_km, double ground_km, double sun_deg) {
    const skv_quality q = tier_of(SKV_TIER_STANDARD, SKV_WITH_ALL);
    begin(frame, &table_model, &q, observer_km, ground_km, sun_deg);
    check_status("skv_frame_table", skv_frame_table(frame, table_here), SKV_OK);
}

#endif
