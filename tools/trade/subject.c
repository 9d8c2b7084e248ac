#include "subject.h"

#include <stdlib.h>
#include <string.h>

#include "clock.h"

static void leave_out(skv_atmosphere *air, int terms) {
    if (terms != TRADE_ALL_TERMS)
        air->ozone.kind = SKV_PROFILE_NONE;
    if (terms == TRADE_GAS_ONLY)
        air->aerosol.kind = air->dust.kind = SKV_PROFILE_NONE;
}

static int build_table(trade_subject *s) {
    const trade_config *const c = s->config;
    skv_table_spec spec;
    if (s->core->table_spec_for(&spec, &s->model, (skv_table_kind)c->table) != SKV_OK)
        return TRADE_CORE;
    spec.format = (int32_t)c->format;
    if (c->suns > 0) {
        spec.altitudes = c->altitudes;
        spec.detailed = c->detailed;
        spec.suns = c->suns;
    }
    s->table_bytes = s->core->table_size(&spec, s->model.bands);
    s->work_bytes = s->core->table_work_size(&spec, s->model.bands);
    void *const work = malloc(s->work_bytes);
    s->table = malloc(s->table_bytes);
    const int room = work && s->table;
    const skv_status status =
        room ? s->core->table_build(s->table, s->table_bytes, work, s->work_bytes, &s->model, &spec) : SKV_OK;
    free(work);
    return !room ? TRADE_NO_MEMORY : status == SKV_OK ? TRADE_OK : TRADE_CORE;
}

/// Room for the grid of one light; its size does not depend on the place.
static int make_grid(trade_subject *s) {
    const float up[3] = {0, 0, 1};
    skv_light light;
    if (s->core->light_sun(&light, &s->model, up) != SKV_OK ||
        s->core->frame_begin(&s->frame, &s->model, &s->config->quality, 0, 0, &light, 1) != SKV_OK ||
        s->core->frame_table(&s->frame, s->table) != SKV_OK)
        return TRADE_CORE;
    s->grid_bytes = s->core->grid_size(&s->frame);
    s->grid = malloc(s->grid_bytes);
    return s->grid ? TRADE_OK : TRADE_NO_MEMORY;
}

static int open_ours(trade_subject *s) {
    const double start_s = trade_processor_s();
    if (s->core->model_build(&s->model, &s->air) != SKV_OK)
        return TRADE_CORE;
    int result = s->config->table >= 0 ? build_table(s) : TRADE_OK;
    s->build_s = trade_processor_s() - start_s;
    if (result == TRADE_OK && s->config->grid)
        result = make_grid(s);
    return result;
}

static int open_baseline(trade_subject *s, const trade_making *making, const char **why) {
    const baseline_wants wants = {
        s->config->light == TRADE_FULL, 1, making->threads, making->progress, making->context, making->cache};
    baseline_cost cost = {0, 0, 0};
    const int result = s->config->baseline->build(&s->state, &s->air, &wants, &cost, why);
    s->table_bytes = cost.table_bytes;
    s->work_bytes = cost.work_bytes;
    s->build_s = cost.build_s;
    return result == 0 ? TRADE_OK : result == 1 ? TRADE_STOPPED : result == -2 ? TRADE_BEYOND : TRADE_NO_MEMORY;
}

static const trade_core *core_of(int exp_degree) {
    for (size_t i = 0; trade_cores[i]; i++)
        if (trade_cores[i]->exp_degree == exp_degree)
            return trade_cores[i];
    return trade_cores[0];
}

int trade_subject_open(trade_subject *s, const trade_config *config, const trade_truth *truth,
                       const trade_making *making, const char **why) {
    *s = (trade_subject){.config = config, .core = core_of(config->exp_degree), .air = truth->atmosphere};
    leave_out(&s->air, config->terms);
    *why = "";
    const int result = config->baseline ? open_baseline(s, making, why) : open_ours(s);
    if (result != TRADE_OK && !config->baseline)
        trade_subject_close(s);
    return result;
}

void trade_subject_close(trade_subject *s) {
    if (s->config && s->config->baseline && s->state)
        s->config->baseline->release(s->state);
    free(s->table);
    free(s->grid);
    *s = (trade_subject){0};
}

static int frame_ours(trade_subject *s, const trade_scene *scene) {
    skv_light light;
    if (s->core->light_sun(&light, &s->model, scene->sun_enu) != SKV_OK ||
        s->core->frame_begin(&s->frame, &s->model, &s->config->quality, (float)scene->height_km, 0, &light, 1) !=
            SKV_OK ||
        (s->table && s->core->frame_table(&s->frame, s->table) != SKV_OK))
        return 0;
    // High up a grid is refused: rays are integrated there whatever was asked for.
    const skv_status status = s->grid ? s->core->frame_grid(&s->frame, s->grid, s->grid_bytes) : SKV_OK;
    return status == SKV_OK || status == SKV_ERR_RANGE;
}

int trade_subject_frame(trade_subject *s, const trade_scene *scene) {
    if (!s->config->baseline)
        return frame_ours(s, scene);
    if (scene->sun == TRADE_TWILIGHT && !(s->config->baseline->can & BASELINE_TWILIGHT))
        return 0;
    baseline_view view = {.observer_km = scene->height_km};
    const char *why;
    for (int i = 0; i < 3; i++)
        view.sun_enu[i] = (double)scene->sun_enu[i];
    return s->config->baseline->frame(s->state, &view, &why) == 0;
}

void trade_subject_radiance(const trade_subject *s, size_t n, const float (*direction)[3],
                            float (*radiance)[TRADE_BANDS]) {
    const skv_rays rays = {direction[0], 0, NULL, 0};
    const skv_sky sky = {radiance[0], sizeof radiance[0], NULL, 0};
    if (s->config->baseline)
        s->config->baseline->radiance(s->state, n, direction, radiance);
    else
        (void)s->core->radiance(&s->frame, n, &rays, &sky);
}

int trade_subject_sees_ground(const trade_config *config) {
    return !config->baseline || (config->baseline->can & BASELINE_GROUND) != 0;
}
