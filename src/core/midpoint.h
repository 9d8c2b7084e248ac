/// The rules of equal and of growing steps: midpoints of N steps along the ray, steps ending at L (i/N)^3 [Keller08] or
/// L i/N; the optical depths by M steps each, ending at (j/M)^2 or j/M of the way from the sample, or in closed form.
#ifndef SKV_CORE_MIDPOINT_H
#define SKV_CORE_MIDPOINT_H

#include "core/scatter.h"
#include "core/rays.h"

#if SKV_RULE_KELLER || SKV_RULE_UNIFORM

/// Which of the two, where both are compiled in.
#define SKV_IS_KELLER(frame) (SKV_RULE_KELLER && (!SKV_RULE_UNIFORM || (frame)->quality.rule == SKV_KELLER))

typedef struct skv_midpoint_ray {
    skv_lanes length_km, rms, nu; ///< from the start of the air
    skv_columns in, out;          ///< K before and behind the lowest point (closed form)
} skv_midpoint_ray;

#if SKV_DEPTH_INNER
/// Columns along a straight piece of length_km that starts at (h, rm).
SKV_INLINE void skv_midpoint_columns(const skv_frame *frame, unsigned has, const skv_lanes *h_km, const skv_lanes *rm,
                                     const skv_lanes *length_km, skv_columns *out) {
    const int m = frame->quality.depth_samples, square = SKV_IS_KELLER(frame);
    const float radius = frame->radius_km, step = 1.0f / (float)m;
    SKV_EACH_SPECIES(s)
    if (SKV_PRESENT(has, s))
        SKV_EACH_LANE(l) out->of[s].v[l] = 0.0f;
    for (int j = 0; j < m; j++) {
        const float x0 = (float)j * step, x1 = (float)(j + 1) * step;
        const float y0 = square ? x0 * x0 : x0, y1 = square ? x1 * x1 : x1;
        const float middle = 0.5f * (y0 + y1), width = y1 - y0;
        skv_columns rho;
        skv_lanes e;
        SKV_EACH_LANE(l) {
            const float s = middle * length_km->v[l], h = h_km->v[l];
            e.v[l] = skv_maxf(h * (2.0f * radius + h) + s * (2.0f * rm->v[l] + s), 0.0f);
        }
        skv_densities(frame, has, &e, &rho);
        SKV_EACH_SPECIES(s)
        if (SKV_PRESENT(has, s))
            SKV_EACH_LANE(l) out->of[s].v[l] += width * rho.of[s].v[l];
    }
    SKV_EACH_SPECIES(s)
    if (SKV_PRESENT(has, s))
        SKV_EACH_LANE(l) out->of[s].v[l] *= length_km->v[l];
}
#endif

/// The whole ray from the start of the air to its end.
static SKV_NOINLINE void skv_midpoint_begin(const skv_frame *frame, unsigned has, int light, const skv_block *block,
                                            const skv_block_light *toward, skv_midpoint_ray *ray) {
    const float rms0 = (frame->radius_km + frame->height_km) * frame->light[light].mu_s;
    skv_columns k[2];
    SKV_EACH_LANE(l) {
        const float first = block->leg[0].b.v[l] - block->leg[0].a.v[l];
        ray->length_km.v[l] = first + (block->parts == 2 ? skv_maxf(block->leg[1].b.v[l], 0.0f) : 0.0f);
        ray->nu.v[l] = toward->nu.v[l];
        ray->rms.v[l] = rms0 + block->start_km.v[l] * toward->nu.v[l];
    }
    if ((has & SKV_HAS_INNER) != 0)
        return;
    skv_block_columns(frame, has, block, k);
    SKV_EACH_SPECIES(s) {
        if (!SKV_PRESENT(has, s))
            continue;
        ray->in.of[s] = k[0].of[s];
        ray->out.of[s] = k[0].of[s];
        if (block->parts == 2)
            SKV_EACH_LANE(l)
        ray->out.of[s].v[l] = block->rm.v[l] < 0.0f ? k[1].of[s].v[l] : k[0].of[s].v[l];
    }
}

/// Columns light -> sample and sample -> start of the air, summed.
/// @param rm, rms  at the sample p, which lies s km from the start.
SKV_INLINE void skv_midpoint_depth(const skv_frame *frame, unsigned has, const skv_midpoint_ray *ray,
                                   const skv_points *p, const skv_lanes *rm, const skv_lanes *rms,
                                   const skv_lanes *s_km, skv_columns *c) {
    skv_columns view;
#if SKV_DEPTH_INNER
    if (!SKV_DEPTH_CHAPMAN || (has & SKV_HAS_INNER) != 0) {
        skv_lanes length, back;
        SKV_EACH_LANE(l) {
            length.v[l] = skv_to_top(frame->radius_km, frame->top_km, p->h_km.v[l], rms->v[l]);
            back.v[l] = -rm->v[l];
        }
        skv_midpoint_columns(frame, has, &p->h_km, rms, &length, c);
        skv_midpoint_columns(frame, has, &p->h_km, &back, s_km, &view);
        SKV_EACH_SPECIES(s)
        if (SKV_PRESENT(has, s))
            SKV_EACH_LANE(l) c->of[s].v[l] += view.of[s].v[l];
        return;
    }
#endif
#if SKV_DEPTH_CHAPMAN
    skv_lanes mu, sin_chi;
    SKV_EACH_LANE(l) {
        const float x = skv_minf(skv_fabsf(rm->v[l]) / p->r_km.v[l], 1.0f);
        mu.v[l] = x;
        sin_chi.v[l] = skv_root(1.0f - x * x);
    }
    skv_columns_up(frame, has, p, &mu, &sin_chi, &view);
    skv_columns_light(frame, has | SKV_HAS_DOWN, p, rms, c);
    SKV_EACH_SPECIES(s)
    if (SKV_PRESENT(has, s))
        SKV_EACH_LANE(l) {
            const float toward =
                rm->v[l] < 0.0f ? ray->in.of[s].v[l] + view.of[s].v[l] : ray->out.of[s].v[l] - view.of[s].v[l];
            c->of[s].v[l] += skv_maxf(toward, 0.0f);
        }
#endif
    (void)ray;
    (void)s_km;
}

static SKV_NOINLINE void skv_midpoint_block(const skv_frame *frame, unsigned has, const skv_block *block,
                                            const skv_block_light *toward, const skv_midpoint_ray *ray,
                                            skv_lanes radiance[]) {
    const int n = frame->quality.samples, cube = SKV_IS_KELLER(frame);
    const float radius = frame->radius_km, step = 1.0f / (float)n;
    for (int b = 0; b < SKV_BANDS_OF(has); b++)
        SKV_EACH_LANE(l) radiance[b].v[l] = 0.0f;
    for (int i = 0; i < n; i++) {
        const float x0 = (float)i * step, x1 = (float)(i + 1) * step;
        const float y0 = cube ? x0 * x0 * x0 : x0, y1 = cube ? x1 * x1 * x1 : x1;
        skv_points p;
        skv_lanes s_km, rm, rms, ds, e;
        skv_columns c;
        SKV_EACH_LANE(l) {
            const float s = 0.5f * (y0 + y1) * ray->length_km.v[l], h = block->h_km.v[l];
            e.v[l] = skv_maxf(h * (2.0f * radius + h) + s * (2.0f * block->rm.v[l] + s), 0.0f);
            s_km.v[l] = s;
            rm.v[l] = block->rm.v[l] + s;
            rms.v[l] = ray->rms.v[l] + s * ray->nu.v[l];
            const int dark = rms.v[l] < 0.0f && e.v[l] - rms.v[l] * rms.v[l] < 0.0f;
            ds.v[l] = dark ? 0.0f : (y1 - y0) * ray->length_km.v[l];
        }
        skv_points_at(frame, has, &e, &p);
        skv_midpoint_depth(frame, has, ray, &p, &rm, &rms, &s_km, &c);
        skv_scatter(frame, has, &p, toward->phase, &ds, &c, radiance);
    }
}

/// @return whether any ray was refused.
static SKV_NOINLINE int skv_rule_midpoint(const skv_frame *frame, int light, size_t n, const skv_rays *rays,
                                          const skv_sky *sky) {
    const unsigned has = frame->has & SKV_HAS_BUILT;
    const size_t bands = (size_t)SKV_BANDS_OF(has);
    int bad = 0;
    for (size_t first = 0; first < n; first += SKV_LANES) {
        skv_block block;
        skv_block_light toward;
        skv_midpoint_ray ray;
        skv_lanes radiance[SKV_BANDS_MAX];
        skv_block_load(frame, n, first, rays, &block);
        skv_block_toward(frame, has, light, &block, &toward);
        skv_midpoint_begin(frame, has, light, &block, &toward, &ray);
        skv_midpoint_block(frame, has, &block, &toward, &ray, radiance);
        bad |= block.bad;
        for (int l = 0; l < block.count; l++) {
            float *out = skv_at_mutable(sky->radiance, sky->radiance_stride, bands, first + (size_t)l);
            for (size_t b = 0; b < bands; b++)
                out[b] = skv_minf(out[b] + radiance[b].v[l] * frame->light[light].irradiance[b], SKV_RADIANCE_MAX);
        }
    }
    return bad;
}
#endif

#endif
