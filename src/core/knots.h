/// Layers: densities that are linear between a few altitudes (tents, short tables; lognormals are made so). Along a ray
/// their columns are closed forms, segment by segment. Linear in E = r^2 - R^2 instead of in the altitude: within 10 km
/// that is 2 m of altitude. With rm = r mu at the point, q = sqrt(rm^2 + E_k - E) is r mu where the ray crosses knot k;
/// between two crossings
///
///     ds = (E_1 - E_0)/(q_0 + q_1),    column = ds (rho_0 + m (q_0 ds + ds^2/3)),    m = d rho/dE
///
/// and nothing cancels. E counts from the sea here.
#ifndef SKV_CORE_KNOTS_H
#define SKV_CORE_KNOTS_H

#include "core/geometry.h"
#include "core/lanes.h"

#if SKV_PROFILE_TABULATED

/// Where a layer's knots lie in its table.
SKV_INLINE const float *skv_knots_e(const skv_column_table *table) {
    return table->column;
}

SKV_INLINE const float *skv_knots_density(const skv_column_table *table) {
    return table->column + SKV_KNOTS_MAX;
}

SKV_INLINE const float *skv_knots_slope(const skv_column_table *table) {
    return table->column + 2 * SKV_KNOTS_MAX;
}

/// From the altitude above the ground to E from the sea.
SKV_INLINE float skv_knots_from_sea(const skv_frame *frame) {
    return frame->ground_km * (2.0f * frame->model->radius_km + frame->ground_km);
}

static SKV_NOINLINE void skv_density_knots(const skv_frame *frame, int s, const skv_lanes *h_km,
                                           skv_lanes *restrict density) {
    const skv_model *model = frame->model;
    const skv_column_table *table = &model->column[s];
    const float *at = skv_knots_e(table), *rho = skv_knots_density(table), *slope = skv_knots_slope(table);
    const float radius = frame->radius_km, from_sea = skv_knots_from_sea(frame);
    skv_lanes e;
    SKV_EACH_LANE(l) e.v[l] = h_km->v[l] * (2.0f * radius + h_km->v[l]) + from_sea;
    SKV_EACH_LANE(l) density->v[l] = 0.0f;
    for (int k = 0; k < model->species[s].knots; k++) {
        const float e0 = at[k], d0 = rho[k], m = slope[k];
        SKV_EACH_LANE(l) {
            const float d = skv_maxf(d0 + m * (e.v[l] - e0), 0.0f);
            density->v[l] = e.v[l] >= e0 ? d : density->v[l];
        }
    }
}

/// Column from h upward; mu NULL: level. Times `factor`.
static SKV_NOINLINE void skv_columns_knots(const skv_frame *frame, int s, const skv_lanes *h_km, const skv_lanes *mu,
                                           float factor, skv_lanes *restrict column) {
    const skv_model *model = frame->model;
    const skv_column_table *table = &model->column[s];
    const float *at = skv_knots_e(table), *rho = skv_knots_density(table), *slope = skv_knots_slope(table);
    const float radius = frame->radius_km, from_sea = skv_knots_from_sea(frame);
    skv_lanes e, rm2, c, q;
    SKV_EACH_LANE(l) {
        const float rm = mu ? (radius + h_km->v[l]) * mu->v[l] : 0.0f;
        e.v[l] = h_km->v[l] * (2.0f * radius + h_km->v[l]) + from_sea;
        rm2.v[l] = rm * rm;
        c.v[l] = skv_maxf(at[0] - e.v[l], 0.0f);
        q.v[l] = skv_root(rm2.v[l] + c.v[l]);
        column->v[l] = 0.0f;
    }
    for (int k = 0; k + 1 < model->species[s].knots; k++) {
        const float e0 = at[k], e1 = at[k + 1], d0 = rho[k], m = slope[k];
        SKV_EACH_LANE(l) {
            const float c1 = skv_maxf(e1 - e.v[l], 0.0f), q0 = q.v[l], q1 = skv_root(rm2.v[l] + c1);
            const float ds = (c1 - c.v[l]) / skv_maxf(q0 + q1, 1e-12f);
            const float near = d0 + m * skv_maxf(e.v[l] - e0, 0.0f);
            column->v[l] += factor * ds * skv_maxf(near + m * ds * (q0 + ds * 0.333333333f), 0.0f);
            c.v[l] = c1;
            q.v[l] = q1;
        }
    }
}
#endif

#endif
