#include "tools/plan/light.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// --- samples ---

bool plan_samples_make(plan_samples *samples, const plan_scene *scene, unsigned seed, int frames, int views) {
    const int terrains = scene->terrain_share > 0 ? (views + 2) / 3 : 0, per = views + terrains;
    *samples = (plan_samples){scene, frames, views, terrains, (size_t)(frames * per), NULL, NULL};
    samples->frame = malloc((size_t)frames * sizeof *samples->frame);
    samples->ray = malloc(samples->rays * sizeof *samples->ray);
    if (!samples->frame || !samples->ray) {
        plan_samples_free(samples);
        return false;
    }
    for (int i = 0; i < frames; i++) {
        plan_ray *const ray = samples->ray + i * per;
        samples->frame[i] = plan_frame_at(scene, seed, i);
        for (int j = 0; j < views; j++)
            ray[j] = plan_view_at(scene, seed, i, j, views);
        for (int j = 0; j < terrains; j++)
            ray[views + j] = plan_terrain_at(scene, seed, i, j, terrains);
    }
    return true;
}

void plan_samples_free(plan_samples *samples) {
    free(samples->frame);
    free(samples->ray);
    samples->frame = NULL;
    samples->ray = NULL;
}

// --- models and tables ---

struct plan_shop {
    const plan_scene *scene;
    plan_built *built[PLAN_AIRS_MAX][2][16]; ///< [air][bands - 3][species]
};

plan_shop *plan_shop_open(const plan_scene *scene) {
    plan_shop *const shop = calloc(1, sizeof *shop);
    if (shop)
        shop->scene = scene;
    return shop;
}

void plan_shop_close(plan_shop *shop) {
    if (!shop)
        return;
    plan_built **const all = &shop->built[0][0][0];
    for (size_t i = 0; i < sizeof shop->built / sizeof *all; i++)
        if (all[i]) {
            for (int k = 0; k < SKV_TABLE_KINDS; k++)
                free(all[i]->table[k]);
            free(all[i]);
        }
    free(shop);
}

unsigned plan_species(const plan_scene *scene) {
    skv_atmosphere a;
    plan_air(scene, 0, 4, &a);
    return (a.rayleigh.kind ? SKV_WITH_RAYLEIGH : 0) | (a.aerosol.kind ? SKV_WITH_AEROSOL : 0) |
           (a.dust.kind ? SKV_WITH_DUST : 0) | (a.ozone.kind ? SKV_WITH_OZONE : 0);
}

void plan_trim(skv_atmosphere *air, unsigned species) {
    skv_profile *const profile[4] = {&air->rayleigh, &air->aerosol, &air->dust, &air->ozone};
    for (int s = 0; s < 4; s++)
        if ((species >> s & 1u) == 0)
            profile[s]->kind = SKV_PROFILE_NONE;
}

static skv_status build_table(plan_built *built, skv_table_kind kind, double ground_km) {
    skv_table_spec spec;
    skv_status status = skv_table_spec_for(&spec, &built->model, kind);
    if (status != SKV_OK)
        return status;
    spec.ground_km = (float)ground_km;
    const size_t size = skv_table_size(&spec, built->model.bands);
    const size_t work_size = skv_table_work_size(&spec, built->model.bands);
    skv_table *const table = malloc(size);
    void *const work = malloc(work_size);
    status = SKV_ERR_SIZE;
    if (table && work)
        status = skv_table_build(table, size, work, work_size, &built->model, &spec);
    free(work);
    if (status == SKV_OK)
        built->table[kind] = table;
    else
        free(table);
    return status;
}

skv_table_kind plan_table_kind(plan_light_kind light) {
    return light == PLAN_SMALL ? SKV_TABLE_SMALL : light == PLAN_LARGE ? SKV_TABLE_LARGE : SKV_TABLE_ACCURATE;
}

const plan_built *plan_build(plan_shop *shop, int air, const plan_config *config, skv_status *status) {
    plan_built **const at = &shop->built[air][config->bands - 3][config->species & 15u];
    *status = SKV_OK;
    if (!*at) {
        plan_built *const made = calloc(1, sizeof *made);
        *status = SKV_ERR_SIZE;
        if (!made)
            return NULL;
        plan_air(shop->scene, air, config->bands, &made->air);
        plan_trim(&made->air, config->species);
        *status = skv_model_build(&made->model, &made->air);
        if (*status != SKV_OK) {
            free(made);
            return NULL;
        }
        *at = made;
    }
    const skv_table_kind kind = plan_table_kind(config->light);
    if (config->light != PLAN_SINGLE && !(*at)->table[kind])
        *status = build_table(*at, kind, 0.001 * shop->scene->ground_m);
    return *status == SKV_OK ? *at : NULL;
}

// --- evaluation ---

skv_status plan_begin(const plan_built *built, const plan_config *config, const plan_scene *scene, const plan_frame *at,
                      skv_frame *frame, float *grid, size_t grid_bytes) {
    skv_quality quality;
    skv_light sun;
    float toward[3];
    plan_sun_direction(at, toward);
    skv_status status = skv_quality_tier(&quality, SKV_TIER_STANDARD);
    quality.samples = config->samples;
    if (config->ground)
        quality.terms |= SKV_WITH_GROUND;
    if (status == SKV_OK)
        status = skv_light_sun(&sun, &built->model, toward);
    if (status == SKV_OK)
        status = skv_frame_begin(frame, &built->model, &quality, (float)at->height_km, (float)(0.001 * scene->ground_m),
                                 &sun, 1);
    if (status == SKV_OK && config->light != PLAN_SINGLE)
        status = skv_frame_table(frame, built->table[plan_table_kind(config->light)]);
    if (status != SKV_OK || config->light == PLAN_SINGLE || !config->grid || !grid)
        return status;
    // High up a grid is refused: rays are integrated there.
    status = skv_frame_grid(frame, grid, grid_bytes);
    return status == SKV_ERR_RANGE ? SKV_OK : status;
}

static void to_rgb(const skv_colour_matrix *m, int bands, const float *radiance, float rgb[TRADE_BANDS]) {
    for (int c = 0; c < 3; c++) {
        double sum = 0;
        for (int b = 0; b < bands; b++)
            sum += (double)m->rgb[c][b] * (double)radiance[b];
        rgb[c] = (float)sum;
    }
    rgb[3] = 0;
}

/// Rays of one frame, all with a length or none.
static skv_status shine(const skv_frame *frame, int n, const plan_ray *ray, const skv_colour_matrix *matrix,
                        float (*rgb)[TRADE_BANDS]) {
    enum { BATCH = 64 };
    float direction[BATCH][3], length[BATCH], radiance[BATCH][4];
    const int bands = frame->model->bands;
    for (int from = 0; from < n; from += BATCH) {
        const int count = n - from < BATCH ? n - from : BATCH;
        for (int i = 0; i < count; i++) {
            plan_direction(&ray[from + i], direction[i]);
            length[i] = (float)ray[from + i].length_km;
        }
        const skv_rays rays = {direction[0], 0, isinf(ray[from].length_km) ? NULL : length, 0};
        const skv_sky sky = {radiance[0], sizeof radiance[0], NULL, 0};
        const skv_status status = skv_radiance(frame, (size_t)count, &rays, &sky);
        if (status != SKV_OK)
            return status;
        for (int i = 0; i < count; i++)
            to_rgb(matrix, bands, radiance[i], rgb[from + i]);
    }
    return SKV_OK;
}

skv_status plan_colours(plan_shop *shop, const plan_config *config, const plan_samples *samples,
                        float (*rgb)[TRADE_BANDS]) {
    static float grid[PLAN_GRID_FLOATS];
    const int per = samples->views + samples->terrains;
    for (int i = 0; i < samples->frames; i++) {
        const plan_frame *const at = &samples->frame[i];
        const plan_ray *const ray = samples->ray + i * per;
        skv_colour_matrix matrix;
        skv_frame frame;
        skv_status status;
        const plan_built *const built = plan_build(shop, at->air, config, &status);
        if (!built)
            return status;
        status = skv_colour_matrix_for(&matrix, config->bands, built->air.wavelength_nm, built->air.solar_irradiance);
        if (status == SKV_OK)
            status = plan_begin(built, config, samples->scene, at, &frame, grid, sizeof grid);
        if (status == SKV_OK)
            status = shine(&frame, samples->views, ray, &matrix, rgb + i * per);
        if (status == SKV_OK)
            status = shine(&frame, samples->terrains, ray + samples->views, &matrix, rgb + i * per + samples->views);
        if (status != SKV_OK)
            return status;
    }
    return SKV_OK;
}
