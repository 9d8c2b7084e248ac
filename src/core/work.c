#include "skyvert/work.h"

#include <string.h>

#include "core/cells.h"
#include "core/gauss_legendre.h"
#include "core/legs.h"
#include "core/rays.h"
#include "core/shadow.h"
#include "core/slices.h"

#if SKV_RULE_GAUSS_EXP

/// One part of the rays of a block as legs. Columns and phases are not needed to know where they are lit.
static void skv_work_legs(const skv_frame *frame, int light, const skv_block *block, int part, skv_block_light *toward,
                          skv_legs *leg) {
    skv_columns none;
    memset(&none, 0, sizeof none);
    skv_block_toward(frame, frame->has & SKV_HAS_BUILT, light, block, toward);
    skv_legs_fill(frame, frame->has & SKV_HAS_BUILT, light, block, part, toward, &none, leg);
}

/// The queue of radiance.c without what stands in it.
typedef struct skv_work_queue {
    unsigned count;
    unsigned low; ///< one of them has the light below the horizontal
} skv_work_queue;

static void skv_work_flush(skv_work_queue *queue, skv_work *work) {
    if (queue->count == 0)
        return;
    work->runs++;
    work->low_runs += queue->low;
    queue->count = queue->low = 0;
}

/// Whether a leg's light may be below the horizontal of a sample (skv_legs_down()).
static uint32_t skv_work_down(const skv_legs *leg, int l) {
    const float rms = leg->rms.v[l], nu = leg->nu.v[l];
    return (skv_bits(rms + leg->a.v[l] * nu) | skv_bits(rms + leg->b.v[l] * nu)) >> 31;
}

static void skv_work_push(const skv_legs *leg, int count, skv_work_queue *queue, skv_work *work) {
    for (int l = 0; l < count; l++) {
        if (!(leg->b.v[l] > leg->a.v[l]))
            continue;
        const uint32_t low = skv_work_down(leg, l);
        queue->low |= low;
        work->low_legs += low;
        queue->count++;
        work->copies++;
        work->legs++;
        if (queue->count == SKV_LANES)
            skv_work_flush(queue, work);
    }
}

static void skv_work_slices(const skv_frame *frame, skv_legs *leg, int count, skv_work_queue *queue, skv_work *work) {
    const int slices = skv_slices(frame, leg);
    const skv_lanes last = leg->b;
    for (int i = 0; i < slices; i++) {
        if (i < slices - 1)
            skv_slice_end(frame, leg, i, &last);
        else
            leg->b = last;
        skv_work_push(leg, count, queue, work);
        leg->a = leg->b;
    }
}

/// All lanes lit: such legs do not wait.
static int skv_work_full(const skv_legs *leg, int count) {
    int full = count == SKV_LANES;
    for (int l = 0; l < SKV_LANES; l++)
        full &= leg->b.v[l] > leg->a.v[l];
    return full;
}

static void skv_work_at_once(const skv_legs *leg, skv_work *work) {
    uint32_t low = 0;
    for (int l = 0; l < SKV_LANES; l++)
        low += skv_work_down(leg, l);
    work->runs++;
    work->legs += SKV_LANES;
    work->low_runs += low > 0;
    work->low_legs += low;
}

/// Whether leg_shadow() has to do more than look at signs.
static uint32_t skv_work_low(const skv_block *block, int part, const skv_legs *leg) {
    uint32_t signs = 0;
    for (int l = 0; l < SKV_LANES; l++)
        signs |= skv_bits(leg->rms.v[l]) | skv_bits(leg->rms.v[l] + block->leg[part].b.v[l] * leg->nu.v[l]);
    return signs >> 31;
}

static void skv_work_block(const skv_frame *frame, int light, const skv_block *block, skv_work_queue *queue,
                           skv_work *work) {
    for (int part = 0; part < block->parts; part++) {
        skv_legs leg;
        skv_block_light toward;
        skv_lanes dark, resume;
        skv_work_legs(frame, light, block, part, &toward, &leg);
        work->parts++;
        work->shadows += skv_work_low(block, part, &leg);
        const int split = skv_leg_shadow(frame, block, part, &toward, &leg.rms, &leg.nu, &dark, &resume);
        if (split)
            leg.b = dark;
        if (!split && queue->count == 0 && skv_slices(frame, &leg) == 1 && skv_work_full(&leg, block->count)) {
            skv_work_at_once(&leg, work);
            continue;
        }
        skv_work_slices(frame, &leg, block->count, queue, work);
        if (split) {
            leg.a = resume;
            leg.b = leg.end;
            skv_work_slices(frame, &leg, block->count, queue, work);
        }
    }
}

#if SKV_TERM_DIFFUSE
/// Rows and columns of the table at one node of all lanes.
static void skv_work_places(const skv_table *t, int bands, const skv_lanes *x, const skv_lanes *y, skv_work *work) {
    const int32_t all = (SKV_TABLE_TERMS - 1) * bands;
    int32_t before = -1;
    skv_cells_places p;
    skv_cells_find(t, bands, x, y, &p);
    work->diffuse_nodes++;
    for (int l = 0; l < SKV_LANES; l++) {
        const int near = p.step[0][l] == all, far = p.step[1][l] == all;
        work->diffuse_fine += (uint32_t)far;
        work->diffuse_fading += (uint32_t)(near & !far);
        work->diffuse_loads += p.mean[l] != before;
        before = p.mean[l];
    }
}

/// The nodes of diffuse.c on a slice.
static void skv_work_nodes(const skv_frame *frame, const skv_legs *leg, skv_work *work) {
    const unsigned has = frame->has & SKV_HAS_BUILT;
    const int n = frame->diffuse.samples, bands = SKV_BANDS_OF(has);
    const skv_table *const t = frame->diffuse.table;
    const float *const node = skv_gauss_node + skv_gauss_offset(n);
    const float radius = frame->radius_km;
    skv_points p;
    skv_lanes e0, rm, rms, l_km, k, whole, x, y;
    skv_legs_start(frame, has, leg, &p, &e0, &rm, &rms);
    skv_legs_map(frame, has, leg, &p, &rm, &rms, &l_km, &k, &whole);
    for (int i = 0; i < n; i++) {
        SKV_EACH_LANE(l) {
            const float s = l_km.v[l] * (skv_exp2f_d5(k.v[l] * (1.44269504f * node[i])) - 1.0f);
            const float e = skv_maxf(e0.v[l] + s * (2.0f * rm.v[l] + s), 0.0f), r = skv_sqrtf(radius * radius + e);
            const float h = skv_minf(e / (radius + r), frame->top_km) + frame->diffuse.offset_km;
            x.v[l] = skv_cells_row(t, skv_clampf(h * frame->diffuse.inv_span, 0.0f, 1.0f));
            y.v[l] = skv_cells_column(&frame->diffuse, skv_clampf((rms.v[l] + s * leg->nu.v[l]) / r, -1.0f, 1.0f));
        }
        skv_work_places(t, bands, &x, &y, work);
    }
}

static void skv_work_diffuse(const skv_frame *frame, int light, const skv_block *block, skv_work *work) {
    for (int part = 0; part < block->parts; part++) {
        skv_legs leg;
        skv_block_light toward;
        skv_work_legs(frame, light, block, part, &toward, &leg);
        const int slices = skv_slices(frame, &leg);
        const skv_lanes last = leg.b;
        work->diffuse_parts++;
        for (int i = 0; i < slices; i++) {
            if (i < slices - 1)
                skv_slice_end(frame, &leg, i, &last);
            else
                leg.b = last;
            work->diffuse_slices++;
            skv_work_nodes(frame, &leg, work);
            leg.a = leg.b;
        }
    }
}
#endif

static void skv_work_light(const skv_frame *frame, int light, size_t n, const skv_rays *rays, skv_work *work) {
    skv_work_queue queue = {0, 0};
    const int diffuse = SKV_TERM_DIFFUSE && frame->diffuse.table && (!frame->diffuse.grid || rays->length_km);
    for (size_t first = 0; first < n; first += SKV_LANES) {
        skv_block block;
        skv_block_load(frame, n, first, rays, &block);
        work->blocks++;
        for (int l = 0; l < block.count; l++)
            work->grounds += block.meets_ground.v[l] > 0.0f;
        if (!frame->diffuse.only)
            skv_work_block(frame, light, &block, &queue, work);
#if SKV_TERM_DIFFUSE
        if (diffuse)
            skv_work_diffuse(frame, light, &block, work);
#endif
        (void)diffuse;
    }
    skv_work_flush(&queue, work);
}

skv_status skv_radiance_work(const skv_frame *frame, size_t n, const skv_rays *rays, skv_work *work) {
    if (!frame || !rays || !work || !rays->direction_enu)
        return SKV_ERR_NULL;
    if (frame->layout != SKV_LAYOUT || !frame->model || frame->model->layout != SKV_LAYOUT)
        return SKV_ERR_LAYOUT;
    if (frame->quality.rule != SKV_GAUSS_EXP)
        return SKV_ERR_UNSUPPORTED;
    skv_work sum;
    memset(&sum, 0, sizeof sum);
    for (int light = 0; light < frame->lights; light++)
        skv_work_light(frame, light, n, rays, &sum);
    *work = sum;
    return SKV_OK;
}

#else

skv_status skv_radiance_work(const skv_frame *frame, size_t n, const skv_rays *rays, skv_work *work) {
    (void)n;
    return frame && rays && work ? SKV_ERR_UNSUPPORTED : SKV_ERR_NULL;
}

#endif
