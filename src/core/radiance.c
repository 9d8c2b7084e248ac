#include "skyvert/radiance.h"

#include <string.h>

#include "core/gauss.h"
#include "core/midpoint.h"
#include "core/shadow.h"
#include "core/slices.h"
#include "core/stages.h"

/// Written one by one: a call of memset() costs more than these few bytes.
SKV_INLINE void skv_clear(const skv_sky *sky, size_t bands, size_t first, size_t n) {
    const size_t stride = sky->radiance_stride ? sky->radiance_stride : bands * sizeof(float);
    char *at = (char *)sky->radiance + first * stride;
    for (size_t i = 0; i < n; i++, at += stride) {
        float *out = (float *)(void *)at;
        out[0] = out[1] = out[2] = 0.0f;
        if (bands == 4)
            out[3] = 0.0f;
    }
}

#if SKV_RULE_GAUSS_EXP
/// One part of the rays of a block as legs for a light: what is lit before the planet's shadow, and in `resume` where
/// it is lit again. A function of its own, so that its stack is free again when the kernel runs; a second part, which
/// few rays have, does the geometry again. The grid's light comes first in every sum, while the block is at hand.
/// @return SKV_LEGS_* bits.
enum { SKV_LEGS_SPLIT = 1, SKV_LEGS_PART = 2, SKV_LEGS_BAD = 4 };

static SKV_NOINLINE unsigned skv_legs_make(const skv_frame *frame, int light, size_t n, size_t first,
                                           const skv_rays *rays, const skv_sky *sky, int part, skv_legs *restrict leg,
                                           skv_lanes *restrict resume) {
    const unsigned has = frame->has & SKV_HAS_BUILT;
    skv_block block;
    skv_block_light toward;
    skv_columns k[2];
    skv_lanes dark_from;
    (void)sky;
    skv_block_load(frame, n, first, rays, &block);
    skv_block_columns(frame, has, &block, k);
#if SKV_TERM_DIFFUSE
    for (int i = 0; i < frame->lights && light == 0 && part == 0 && skv_grid_used(frame, rays); i++)
        skv_grid_add(frame, i, first, &block, k, sky);
#endif
    skv_block_toward(frame, has, light, &block, &toward);
    skv_legs_fill(frame, has, light, &block, part, &toward, &k[part], leg);
    unsigned what = block.bad ? (unsigned)SKV_LEGS_BAD : 0u;
    what |= part + 1 < block.parts ? (unsigned)SKV_LEGS_PART : 0u;
    if (skv_leg_shadow(frame, &block, part, &toward, &leg->rms, &leg->nu, &dark_from, resume)) {
        leg->b = dark_from;
        what |= SKV_LEGS_SPLIT;
    }
    return what;
}

SKV_INLINE void skv_legs_outputs(const skv_sky *sky, size_t bands, size_t first, int count, float *out[]) {
    const size_t stride = sky->radiance_stride ? sky->radiance_stride : bands * sizeof(float);
    char *at = (char *)sky->radiance + first * stride;
    for (int l = 0; l < count; l++, at += stride)
        out[l] = (float *)(void *)at;
}

SKV_INLINE void skv_legs_copy(const skv_legs *from, unsigned l, skv_legs *to, unsigned q) {
    to->h_km.v[q] = from->h_km.v[l];
    to->rm.v[q] = from->rm.v[l];
    to->rms.v[q] = from->rms.v[l];
    to->nu.v[q] = from->nu.v[l];
    to->a.v[q] = from->a.v[l];
    to->b.v[q] = from->b.v[l];
    to->p_km.v[q] = from->p_km.v[l];
    to->sigma.v[q] = from->sigma.v[l];
    SKV_EACH_SCATTERER(s)
    if (SKV_PRESENT(SKV_HAS_BUILT, s))
        to->phase[s].v[q] = from->phase[s].v[l];
    SKV_EACH_SPECIES(s)
    if (SKV_PRESENT(SKV_HAS_BUILT, s))
        to->k.of[s].v[q] = from->k.of[s].v[l];
    to->out[q] = from->out[l];
}

/// A queue keeps every lane of a block busy with a lit leg, whatever the rays.
typedef struct skv_queue {
    skv_legs leg;
    unsigned count;
} skv_queue;

static SKV_NOINLINE void skv_queue_flush(const skv_frame *frame, int light, skv_queue *queue) {
    if (queue->count == 0)
        return;
    for (unsigned q = queue->count; q < SKV_LANES; q++)
        skv_legs_copy(&queue->leg, 0, &queue->leg, q);
    skv_gauss_legs(frame, &queue->leg, (int)queue->count, frame->light[light].irradiance);
    queue->count = 0;
}

/// Takes lit legs from lane l on until the queue is full. @return the lane to go on with.
static SKV_NOINLINE unsigned skv_queue_take(const skv_legs *leg, unsigned l, unsigned count, skv_queue *queue) {
    for (; l < count && queue->count < SKV_LANES; l++)
        if (leg->b.v[l] > leg->a.v[l])
            skv_legs_copy(leg, l, &queue->leg, queue->count++);
    return l;
}

/// The kernel is called from here and not from below: its stack is the deepest.
SKV_INLINE void skv_queue_push(const skv_frame *frame, int light, const skv_legs *leg, unsigned count,
                               skv_queue *queue) {
    for (unsigned l = 0; l < count;) {
        l = skv_queue_take(leg, l, count, queue);
        if (queue->count == SKV_LANES)
            skv_queue_flush(frame, light, queue);
    }
}

/// A lit stretch [a, b] of each leg, slice by slice; a and b are used up.
SKV_INLINE void skv_queue_slices(const skv_frame *frame, int light, skv_legs *leg, unsigned count, skv_queue *queue) {
    const int slices = skv_slices(frame, leg);
    const skv_lanes last = leg->b;
    for (int i = 0; i < slices; i++) {
        if (i < slices - 1)
            skv_slice_end(frame, leg, i, &last);
        else
            leg->b = last;
        skv_queue_push(frame, light, leg, count, queue);
        leg->a = leg->b;
    }
}

SKV_INLINE int skv_legs_full(const skv_legs *leg, int count) {
    uint32_t signs = 0; // of a - b: all negative where every lane has something
    SKV_EACH_LANE(l) signs |= ~skv_bits(leg->a.v[l] - leg->b.v[l]);
    return count == SKV_LANES && (signs & 0x80000000u) == 0;
}

static SKV_NOINLINE int skv_rule_gauss(const skv_frame *frame, int light, size_t n, const skv_rays *rays,
                                       const skv_sky *sky) {
    const size_t bands = (size_t)SKV_BANDS_OF(frame->has);
    skv_queue queue;
    skv_legs leg;
    unsigned seen = 0;
    memset(&queue, 0, sizeof queue);
    for (size_t first = 0; first < n; first += SKV_LANES) {
        const int count = n - first < SKV_LANES ? (int)(n - first) : SKV_LANES;
        unsigned what = SKV_LEGS_PART;
        if (light == 0)
            skv_clear(sky, bands, first, (size_t)count);
        for (int part = 0; (what & SKV_LEGS_PART) != 0; part++) {
            skv_lanes resume;
            skv_legs_outputs(sky, bands, first, count, leg.out);
            what = skv_legs_make(frame, light, n, first, rays, sky, part, &leg, &resume);
            seen |= what;
            const int whole = (what & SKV_LEGS_SPLIT) == 0 && skv_slices(frame, &leg) == 1;
            if (whole && queue.count == 0 && skv_legs_full(&leg, count)) {
                skv_gauss_legs(frame, &leg, SKV_LANES, frame->light[light].irradiance);
                continue;
            }
            skv_queue_slices(frame, light, &leg, (unsigned)count, &queue);
            if ((what & SKV_LEGS_SPLIT) != 0) {
                leg.a = resume;
                leg.b = leg.end;
                skv_queue_slices(frame, light, &leg, (unsigned)count, &queue);
            }
        }
    }
    skv_queue_flush(frame, light, &queue);
    return (seen & SKV_LEGS_BAD) != 0;
}
#endif

static skv_status skv_check_strides(const skv_rays *rays, const skv_sky *sky, size_t bands) {
    const size_t stride[4] = {rays->direction_stride, rays->length_stride, sky->radiance_stride,
                              sky->transmittance_stride};
    const size_t fields[4] = {3, 1, bands, bands};
    for (int i = 0; i < 4; i++)
        if (stride[i] % sizeof(float) != 0 || (stride[i] != 0 && stride[i] < fields[i] * sizeof(float)))
            return SKV_ERR_SIZE;
    return SKV_OK;
}

skv_status skv_radiance(const skv_frame *frame, size_t n, const skv_rays *rays, const skv_sky *sky) {
    if (!frame || !rays || !sky || !rays->direction_enu || !sky->radiance)
        return SKV_ERR_NULL;
    if (frame->layout != SKV_LAYOUT || !frame->model || frame->model->layout != SKV_LAYOUT)
        return SKV_ERR_LAYOUT;
    const size_t bands = (size_t)skv_bands(frame->model);
    const skv_status strides = skv_check_strides(rays, sky, bands);
    if (strides != SKV_OK)
        return strides;
#if !SKV_OUT_TRANSMITTANCE
    if (sky->transmittance)
        return SKV_ERR_UNSUPPORTED;
#endif
    if (frame->lights == 0 || frame->quality.rule != SKV_GAUSS_EXP || frame->diffuse.only)
        skv_clear(sky, bands, 0, n);
    int bad = 0;
    for (int light = 0; light < frame->lights && !frame->diffuse.only; light++) {
#if SKV_RULE_GAUSS_EXP
        if (frame->quality.rule == SKV_GAUSS_EXP)
            bad |= skv_rule_gauss(frame, light, n, rays, sky);
#endif
#if SKV_RULE_KELLER || SKV_RULE_UNIFORM
        if (frame->quality.rule != SKV_GAUSS_EXP)
            bad |= skv_rule_midpoint(frame, light, n, rays, sky);
#endif
    }
#if SKV_TERM_DIFFUSE
    const int direct = frame->diffuse.table && !skv_grid_used(frame, rays);
    for (int light = 0; light < frame->lights && direct; light++)
        skv_diffuse_add(frame, light, n, rays, sky);
#endif
    bad |= skv_ends(frame, n, rays, sky);
    return bad ? SKV_ERR_DIRECTION : SKV_OK;
}
