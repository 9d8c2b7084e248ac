/// Tabulated columns at run time. Tables: rows evenly spaced in h/top (base t) or in its square root (base: the closed
/// form), columns evenly in t = 1/(1 + 14 mu) on [1/15, 1]. Gathers stand in loops of their own: gcc 12 does not
/// vectorise them, and the arithmetic around them it then does.
#ifndef SKV_CORE_LOOKUP_H
#define SKV_CORE_LOOKUP_H

#include "core/knots.h"

#if SKV_TERM_OZONE || SKV_PROFILE_TABULATED

SKV_INLINE const skv_column_table *skv_column_table_of(const skv_model *model, int species) {
#if SKV_TERM_OZONE
    if (species == SKV_OZONE)
        return &model->ozone_column;
#endif
#if SKV_PROFILE_TABULATED
    return &model->column[species < 2 + SKV_TERM_DUST ? species : 0];
#else
    (void)model;
    return NULL;
#endif
}

/// What a look-up works in; handed down, so that several in a row share their stack.
typedef struct skv_lookup {
    int32_t at[SKV_LANES];
    skv_lanes wx, wy, v00, v01, v10, v11;
} skv_lookup;

SKV_INLINE void skv_lookup_rows(const skv_frame *frame, int by_root, int rows, const skv_lanes *h_km, int32_t row[],
                                skv_lanes *w) {
    const float ground = frame->ground_km, scale = 1.0f / frame->model->top_km;
    skv_lanes x;
    SKV_EACH_LANE(l) x.v[l] = skv_clampf((h_km->v[l] + ground) * scale, 0.0f, 1.0f);
    if (by_root)
        SKV_EACH_LANE(l) x.v[l] = skv_sqrtf(x.v[l]);
    SKV_EACH_LANE(l) {
        const float y = x.v[l] * (float)(rows - 1);
        int32_t i = (int32_t)y;
        i = i > rows - 2 ? rows - 2 : i;
        row[l] = i;
        w->v[l] = y - (float)i;
    }
}

/// Ratio at (h, t).
SKV_INLINE void skv_lookup_column(const skv_frame *frame, const skv_column_table *table, int by_root,
                                  const skv_lanes *h_km, const skv_lanes *t, skv_lookup *k, skv_lanes *value) {
    skv_lookup_rows(frame, by_root, SKV_COLUMN_ROWS, h_km, k->at, &k->wx);
    SKV_EACH_LANE(l) {
        const float y = skv_maxf(t->v[l] - 1.0f / 15.0f, 0.0f) * (15.0f / 14.0f * (float)(SKV_COLUMN_COLS - 1));
        int32_t i = (int32_t)y;
        i = i > SKV_COLUMN_COLS - 2 ? SKV_COLUMN_COLS - 2 : i;
        k->at[l] = k->at[l] * SKV_COLUMN_COLS + i;
        k->wy.v[l] = y - (float)i;
    }
    for (int l = 0; l < SKV_LANES; l++) {
        const float *p = table->column + k->at[l];
        k->v00.v[l] = p[0];
        k->v01.v[l] = p[1];
        k->v10.v[l] = p[SKV_COLUMN_COLS];
        k->v11.v[l] = p[SKV_COLUMN_COLS + 1];
    }
    SKV_EACH_LANE(l) {
        const float a = k->v00.v[l] + k->wy.v[l] * (k->v01.v[l] - k->v00.v[l]);
        const float b = k->v10.v[l] + k->wy.v[l] * (k->v11.v[l] - k->v10.v[l]);
        value->v[l] = a + k->wx.v[l] * (b - a);
    }
}

SKV_INLINE void skv_lookup_tangent(const skv_frame *frame, const skv_column_table *table, int by_root,
                                   const skv_lanes *h_km, skv_lookup *k, skv_lanes *value) {
    skv_lookup_rows(frame, by_root, SKV_COLUMN_TANGENTS, h_km, k->at, &k->wx);
    for (int l = 0; l < SKV_LANES; l++) {
        k->v00.v[l] = table->tangent[k->at[l]];
        k->v01.v[l] = table->tangent[k->at[l] + 1];
    }
    SKV_EACH_LANE(l) value->v[l] = k->v00.v[l] + k->wx.v[l] * (k->v01.v[l] - k->v00.v[l]);
}

/// Columns upward: ozone's written, those of what scatters multiplied by their ratio.
SKV_INLINE void skv_columns_tables_up(const skv_frame *frame, unsigned has, const skv_lanes *h_km, const skv_lanes *mu,
                                      skv_columns *out) {
    skv_lanes t, ratio;
    skv_lookup k;
    SKV_EACH_LANE(l) t.v[l] = 1.0f / (1.0f + 14.0f * mu->v[l]);
#if SKV_PROFILE_TABULATED
    SKV_EACH_SCATTERER(s)
    if (skv_is_layer(frame, has, s)) {
        skv_columns_knots(frame, s, h_km, mu, 1.0f, &out->of[s]);
    } else if ((has & SKV_HAS_RATIO) != 0 && SKV_PRESENT(has, s) && frame->model->species[s].column != 0) {
        skv_lookup_column(frame, skv_column_table_of(frame->model, s), 1, h_km, &t, &k, &ratio);
        SKV_EACH_LANE(l) out->of[s].v[l] *= ratio.v[l];
    }
#endif
#if SKV_TERM_OZONE
    if (SKV_PRESENT(has, SKV_OZONE)) {
        skv_lookup_column(frame, &frame->model->ozone_column, 0, h_km, &t, &k, &ratio);
        SKV_EACH_LANE(l) out->of[SKV_OZONE].v[l] = t.v[l] * ratio.v[l];
    }
#endif
}

/// The same for whole rays that are tangent at h.
SKV_INLINE void skv_columns_tables_tangent(const skv_frame *frame, unsigned has, const skv_lanes *h_km,
                                           skv_columns *out) {
    skv_lanes ratio;
    skv_lookup k;
#if SKV_PROFILE_TABULATED
    SKV_EACH_SCATTERER(s)
    if (skv_is_layer(frame, has, s)) {
        skv_columns_knots(frame, s, h_km, NULL, 2.0f, &out->of[s]);
    } else if ((has & SKV_HAS_RATIO) != 0 && SKV_PRESENT(has, s) && frame->model->species[s].column != 0) {
        skv_lookup_tangent(frame, skv_column_table_of(frame->model, s), 1, h_km, &k, &ratio);
        SKV_EACH_LANE(l) out->of[s].v[l] *= ratio.v[l];
    }
#endif
#if SKV_TERM_OZONE
    if (SKV_PRESENT(has, SKV_OZONE)) {
        skv_lookup_tangent(frame, &frame->model->ozone_column, 0, h_km, &k, &ratio);
        SKV_EACH_LANE(l) out->of[SKV_OZONE].v[l] = 2.0f * ratio.v[l];
    }
#endif
}
#endif

#endif
