#include "core.h"

#include "config.h"

static const trade_core as_it_is = {TRADE_EXP_DEGREE,    skv_model_build, skv_table_spec_for, skv_table_size,
                                    skv_table_work_size, skv_table_build, skv_light_sun,      skv_frame_begin,
                                    skv_frame_table,     skv_grid_size,   skv_frame_grid,     skv_radiance};

#ifdef TRADE_HAVE_EXP_DEGREES
/// Declares the core of a degree; its symbols were renamed after compiling (build.mk).
#define CORE_OF_DEGREE(d)                                                                                              \
    extern __typeof__(skv_model_build) skv_model_build_exp##d;                                                         \
    extern __typeof__(skv_table_spec_for) skv_table_spec_for_exp##d;                                                   \
    extern __typeof__(skv_table_size) skv_table_size_exp##d;                                                           \
    extern __typeof__(skv_table_work_size) skv_table_work_size_exp##d;                                                 \
    extern __typeof__(skv_table_build) skv_table_build_exp##d;                                                         \
    extern __typeof__(skv_light_sun) skv_light_sun_exp##d;                                                             \
    extern __typeof__(skv_frame_begin) skv_frame_begin_exp##d;                                                         \
    extern __typeof__(skv_frame_table) skv_frame_table_exp##d;                                                         \
    extern __typeof__(skv_grid_size) skv_grid_size_exp##d;                                                             \
    extern __typeof__(skv_frame_grid) skv_frame_grid_exp##d;                                                           \
    extern __typeof__(skv_radiance) skv_radiance_exp##d;                                                               \
    static const trade_core degree_##d = {d,                                                                           \
                                          skv_model_build_exp##d,                                                      \
                                          skv_table_spec_for_exp##d,                                                   \
                                          skv_table_size_exp##d,                                                       \
                                          skv_table_work_size_exp##d,                                                  \
                                          skv_table_build_exp##d,                                                      \
                                          skv_light_sun_exp##d,                                                        \
                                          skv_frame_begin_exp##d,                                                      \
                                          skv_frame_table_exp##d,                                                      \
                                          skv_grid_size_exp##d,                                                        \
                                          skv_frame_grid_exp##d,                                                       \
                                          skv_radiance_exp##d};
CORE_OF_DEGREE(3)
CORE_OF_DEGREE(5)
const trade_core *const trade_cores[] = {&as_it_is, &degree_3, &degree_5, NULL};
#else
const trade_core *const trade_cores[] = {&as_it_is, NULL};
#endif
