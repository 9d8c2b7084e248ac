/// The core as the trade calls it: compiled once or, where the sources have a macro for it, once more per degree of
/// 2^x.
#ifndef TOOLS_TRADE_CORE_H
#define TOOLS_TRADE_CORE_H

#include "skyvert/radiance.h"
#include "skyvert/table.h"

typedef struct trade_core {
    int exp_degree; ///< of the polynomial of 2^x in the inner loops
    skv_status (*model_build)(skv_model *, const skv_atmosphere *);
    skv_status (*table_spec_for)(skv_table_spec *, const skv_model *, skv_table_kind);
    size_t (*table_size)(const skv_table_spec *, int);
    size_t (*table_work_size)(const skv_table_spec *, int);
    skv_status (*table_build)(skv_table *, size_t, void *, size_t, const skv_model *, const skv_table_spec *);
    skv_status (*light_sun)(skv_light *, const skv_model *, const float[3]);
    skv_status (*frame_begin)(skv_frame *, const skv_model *, const skv_quality *, float, float, const skv_light *,
                              int32_t);
    skv_status (*frame_table)(skv_frame *, const skv_table *);
    size_t (*grid_size)(const skv_frame *);
    skv_status (*frame_grid)(skv_frame *, float *, size_t);
    skv_status (*radiance)(const skv_frame *, size_t, const skv_rays *, const skv_sky *);
} trade_core;

/// The core as it is, then the others; NULL at the end.
extern const trade_core *const trade_cores[];

#endif
