#include "skyvert/table.h"

#include "core/cells.h"
#include "core/gather.h"

#if SKV_TERM_DIFFUSE

static void skv_diffuse_moments(const skv_model *m, skv_frame_diffuse *d) {
    for (int l = 1; l <= 4; l++) {
        d->moment[SKV_RAYLEIGH][l - 1] = l == 2 ? 0.1f : 0.0f;
        for (int s = SKV_AEROSOL; s < SKV_SCATTERERS; s++)
            d->moment[s][l - 1] = skv_moment(m->phase[s] == SKV_PHASE_CS, m->g[s], l);
    }
    d->kept = skv_kept_species(m);
    // The aureole's shape times a phase function is the shape of another g: it is matched at degree 3.
    for (int s = 0; s < SKV_SCATTERERS; s++)
        d->aureole[s] = skv_third_root(d->moment[d->kept][2] * d->moment[s][2]);
}

skv_status skv_frame_table(skv_frame *frame, const skv_table *table) {
    if (!frame)
        return SKV_ERR_NULL;
    if (frame->layout != SKV_LAYOUT || !frame->model || frame->model->layout != SKV_LAYOUT)
        return SKV_ERR_LAYOUT;
    if (table && (table->magic != SKV_TABLE_MAGIC || table->version != SKV_TABLE_VERSION))
        return SKV_ERR_LAYOUT;
    if (table && (table->model != frame->model->hash || table->bands != skv_bands(frame->model)))
        return SKV_ERR_MODEL;
    skv_frame_diffuse *const d = &frame->diffuse;
    d->grid = NULL;
    d->table = NULL;
    if (!table)
        return SKV_OK;
    skv_diffuse_moments(frame->model, d);
    d->samples = skv_diffuse_nodes(frame->model);
    d->only = 0;
    d->inv_span = 1.0f / table->span_km;
    d->offset_km = frame->ground_km - table->ground_km;
    d->column_first = skv_cells_warp(table->mu_first);
    d->column_scale = (float)(table->suns - 1) / (skv_cells_warp(1.0f) - d->column_first);
    for (int32_t i = 0; i < frame->lights; i++) {
        const float *const s = frame->light[i].direction_enu, least = SKV_AUREOLE_LOWEST;
        const float flat = skv_sqrtf(s[0] * s[0] + s[1] * s[1]);
        const float scale = s[2] < least && flat > 1e-6f ? skv_sqrtf(1.0f - least * least) / flat : 1.0f;
        d->toward_enu[i][0] = s[0] * scale;
        d->toward_enu[i][1] = s[1] * scale;
        d->toward_enu[i][2] = skv_maxf(s[2], least);
    }
    d->table = table;
    return SKV_OK;
}

#else

skv_status skv_frame_table(skv_frame *frame, const skv_table *table) {
    (void)table;
    return frame ? SKV_ERR_UNSUPPORTED : SKV_ERR_NULL;
}

#endif
