/// The far end of each ray: transmittance from it to the observer, and the light of the ground where it meets it.
#include "core/cells.h"
#include "core/rays.h"
#include "core/stages.h"

/// Columns from the observer to the end of the ray.
static SKV_NOINLINE void skv_end_columns(const skv_frame *frame, unsigned has, const skv_block *block,
                                         const skv_columns k[2], skv_columns *restrict out) {
    const float radius = frame->radius_km;
    skv_points p;
    skv_lanes mu, sin_chi, past, e;
    SKV_EACH_LANE(l) {
        const int second = block->parts == 2 && block->leg[1].b.v[l] > 0.0f;
        const float h = second ? block->leg[1].h_km.v[l] : block->leg[0].h_km.v[l];
        const float rm = second ? 0.0f : block->leg[0].rm.v[l];
        const int inward = !second && block->leg[0].dir.v[l] < 0.0f;
        const float s = second ? block->leg[1].b.v[l] : inward ? block->leg[0].a.v[l] : block->leg[0].b.v[l];
        e.v[l] = skv_maxf(h * (2.0f * radius + h) + s * (2.0f * rm + s), 0.0f);
        mu.v[l] = rm + s;
        past.v[l] = second ? 1.0f : 0.0f;
    }
    skv_points_at(frame, has, &e, &p);
    SKV_EACH_LANE(l) {
        mu.v[l] = skv_clampf(mu.v[l] * p.inv_r.v[l], 0.0f, 1.0f);
        sin_chi.v[l] = skv_minf(block->p_km.v[l] * p.inv_r.v[l], 1.0f);
    }
    skv_columns_up(frame, has, &p, &mu, &sin_chi, out);
    SKV_EACH_SPECIES(s)
    if (SKV_PRESENT(has, s))
        SKV_EACH_LANE(l) {
            const int second = past.v[l] > 0.0f;
            const float from = second && block->parts == 2 ? k[1].of[s].v[l] : k[0].of[s].v[l];
            const float sigma = second ? -1.0f : -block->leg[0].dir.v[l];
            // A ray of no length meets nothing, whatever the forms round to.
            const int empty = !second && !(block->leg[0].b.v[l] > block->leg[0].a.v[l]);
            out->of[s].v[l] = empty ? 0.0f : skv_maxf(from + sigma * out->of[s].v[l], 0.0f);
        }
}

#if SKV_TERM_GROUND
/// Lambert's ground lit by one light: albedo/pi E mu_s T_light T_view.
static SKV_NOINLINE void skv_ground_lit(const skv_frame *frame, unsigned has, int light, size_t first,
                                        const skv_block *block, const skv_columns *view, const skv_sky *sky) {
    const skv_model *model = frame->model;
    const size_t bands = (size_t)SKV_BANDS_OF(has);
    const float radius = frame->radius_km, rms0 = (radius + frame->height_km) * frame->light[light].mu_s;
    skv_block_light toward;
    skv_points g;
    skv_lanes rms, h, mu_s;
    skv_columns c;
    skv_block_toward(frame, has, light, block, &toward);
    SKV_EACH_LANE(l) {
        h.v[l] = 0.0f;
        const float along = rms0 + block->leg[0].from_km.v[l] * toward.nu.v[l];
        mu_s.v[l] = along / radius;
        rms.v[l] = skv_clampf(along, 0.0f, radius);
    }
    skv_points_above(frame, has, &h, &g);
    skv_columns_light(frame, has, &g, &rms, &c);
    SKV_EACH_SPECIES(s)
    if (SKV_PRESENT(has, s))
        SKV_EACH_LANE(l) c.of[s].v[l] += view->of[s].v[l];
    for (int l = 0; l < block->count; l++) {
        if (!(block->meets_ground.v[l] > 0.0f))
            continue;
        float *out = skv_at_mutable(sky->radiance, sky->radiance_stride, bands, first + (size_t)l);
        for (size_t b = 0; b < bands && !frame->diffuse.only; b++)
            out[b] += model->albedo[b] * 0.318309886f * frame->light[light].irradiance[b] * (rms.v[l] / radius) *
                      skv_exp2f(-skv_optical_depth_log2e(frame, has, &c, (int)b, l));
        if (SKV_TERM_DIFFUSE && frame->diffuse.table) {
            const float column = skv_cells_column(&frame->diffuse, mu_s.v[l]);
            for (size_t b = 0; b < bands; b++)
                out[b] += model->albedo[b] * 0.318309886f * frame->light[light].irradiance[b] *
                          skv_exp2f(skv_ground_log2(frame->diffuse.table, column, (int)b) -
                                    skv_optical_depth_log2e(frame, has, view, (int)b, l));
        }
    }
}
#endif

int skv_ends(const skv_frame *frame, size_t n, const skv_rays *rays, const skv_sky *sky) {
    const unsigned has = frame->has & SKV_HAS_BUILT;
    const int ground = SKV_TERM_GROUND && (frame->quality.terms & SKV_WITH_GROUND) != 0 && frame->lights > 0;
    int bad = 0;
    const int grid = frame->quality.rule != SKV_GAUSS_EXP && skv_grid_used(frame, rays);
    if (!ground && !grid && !sky->transmittance && frame->lights > 0)
        return 0;
    for (size_t first = 0; first < n; first += SKV_LANES) {
        skv_block block;
        skv_columns k[2], view;
        skv_block_load(frame, n, first, rays, &block);
        bad |= block.bad;
        skv_block_columns(frame, has, &block, k);
#if SKV_TERM_DIFFUSE
        for (int light = 0; grid && light < frame->lights; light++)
            skv_grid_add(frame, light, first, &block, k, sky);
#endif
        if (!ground && !sky->transmittance)
            continue;
        skv_end_columns(frame, has, &block, k, &view);
#if SKV_TERM_GROUND
        for (int light = 0; ground && light < frame->lights; light++)
            skv_ground_lit(frame, has, light, first, &block, &view, sky);
#endif
#if SKV_OUT_TRANSMITTANCE
        for (int l = 0; sky->transmittance && l < block.count; l++) {
            const size_t bands = (size_t)SKV_BANDS_OF(has);
            float *out = skv_at_mutable(sky->transmittance, sky->transmittance_stride, bands, first + (size_t)l);
            for (size_t b = 0; b < bands; b++)
                out[b] = block.valid.v[l] *
                         skv_minf(skv_exp2f(-skv_optical_depth_log2e(frame, has, &view, (int)b, l)), 1.0f);
        }
#endif
    }
    return bad;
}
