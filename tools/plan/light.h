/// Configurations of the library and what they make of a scene's samples: colours, and their error.
#ifndef TOOLS_PLAN_LIGHT_H
#define TOOLS_PLAN_LIGHT_H

#include "tools/plan/sample.h"
#include "tools/trade/metric.h"

typedef enum plan_light_kind { PLAN_SINGLE = 0, PLAN_SMALL = 1, PLAN_ACCURATE = 2, PLAN_LARGE = 3 } plan_light_kind;
/// The kind of table; not for PLAN_SINGLE.
skv_table_kind plan_table_kind(plan_light_kind light);

/// What can be chosen.
typedef struct plan_config {
    int bands;        ///< 3, 4
    unsigned species; ///< SKV_WITH_RAYLEIGH ... SKV_WITH_OZONE: what is kept of the air
    bool ground;      ///< lit at the end of rays
    plan_light_kind light;
    bool grid;
    int samples; ///< of gauss-exp per lit leg
} plan_config;

/// Rays of a scene that errors are measured at: `views` and then `terrains` of each frame.
typedef struct plan_samples {
    const plan_scene *scene;
    int frames, views, terrains;
    size_t rays;
    plan_frame *frame; ///< [frames]
    plan_ray *ray;     ///< [frames][views + terrains]
} plan_samples;

/// @return false iff memory ran out.
bool plan_samples_make(plan_samples *samples, const plan_scene *scene, unsigned seed, int frames, int views);
void plan_samples_free(plan_samples *samples);

/// Models and tables that were built so far, for each air, number of bands and choice of species.
typedef struct plan_shop plan_shop;
plan_shop *plan_shop_open(const plan_scene *scene); ///< NULL: out of memory
void plan_shop_close(plan_shop *shop);

/// Species of a scene's air, SKV_WITH_* bits.
unsigned plan_species(const plan_scene *scene);
/// Takes what is not in `species` out of an air.
void plan_trim(skv_atmosphere *air, unsigned species);

typedef struct plan_built {
    skv_atmosphere air;
    skv_model model;
    skv_table *table[SKV_TABLE_KINDS]; ///< by skv_table_kind; NULL: not yet
} plan_built;

/// @return NULL where memory ran out or the library refuses (status).
const plan_built *plan_build(plan_shop *shop, int air, const plan_config *config, skv_status *status);

/// A frame as a configuration makes it. @param grid  room for one, NULL: none is made
skv_status plan_begin(const plan_built *built, const plan_config *config, const plan_scene *scene, const plan_frame *at,
                      skv_frame *frame, float *grid, size_t grid_bytes);

/// Linear BT.709 of all samples. @return SKV_OK, or what the library says
skv_status plan_colours(plan_shop *shop, const plan_config *config, const plan_samples *samples,
                        float (*rgb)[TRADE_BANDS]);

#define PLAN_GRID_FLOATS 8192

#endif
