/// The far end of each ray: transmittance from it to the observer, and the light of the ground where it meets it.
#ifndef SKV_CORE_ENDS_H
#define SKV_CORE_ENDS_H

#include "core/rays.h"

/// Columns from the observer to the end of the ray.
SKV_INLINE void skv_end_columns(const skv_frame *frame, const skv_block *block, const skv_columns k[2],
                                skv_columns *out) {
    const float radius = frame->radius_km;
    skv_points p;
    skv_lanes mu, sin_chi, past;
    SKV_EACH_LANE(l) {
        const int second = block->parts == 2 && block->leg[1].b.v[l] > 0.0f;
        const float h = second ? block->leg[1].h_km.v[l] : block->leg[0].h_km.v[l];
        const float rm = second ? 0.0f : block->leg[0].rm.v[l];
        const int inward = !second && block->leg[0].dir.v[l] < 0.0f;
        const float s = second ? block->leg[1].b.v[l] : inward ? block->leg[0].a.v[l] : block->leg[0].b.v[l];
        const float e = h * (2.0f * radius + h) + s * (2.0f * rm + s);
        p.h_km.v[l] = skv_clampf(skv_altitude(radius, skv_maxf(e, 0.0f), &p.r_km.v[l]), 0.0f, frame->top_km);
        mu.v[l] = skv_clampf((rm + s) / p.r_km.v[l], 0.0f, 1.0f);
        sin_chi.v[l] = skv_minf(block->p_km.v[l] / p.r_km.v[l], 1.0f);
        past.v[l] = second ? 1.0f : 0.0f;
    }
    skv_points_densities(frame, &p);
    skv_columns_up(frame, &p, &mu, &sin_chi, out);
    for (int s = 0; s < SKV_SPECIES; s++)
        if (skv_present(frame, s))
            SKV_EACH_LANE(l) {
                const int second = past.v[l] > 0.0f;
                const float from = second && block->parts == 2 ? k[1].of[s].v[l] : k[0].of[s].v[l];
                const float sigma = second ? -1.0f : -block->leg[0].dir.v[l];
                // A ray of no length meets nothing, whatever the forms round to.
                const int empty = !second && !(block->leg[0].b.v[l] > block->leg[0].a.v[l]);
                out->of[s].v[l] = empty ? 0.0f : skv_maxf(from + sigma * out->of[s].v[l], 0.0f);
            }
}

SKV_INLINE float skv_optical_depth_log2e(const skv_frame *frame, const skv_columns *c, int band, int l) {
    float tau = 0.0f;
    if (skv_present(frame, SKV_RAYLEIGH))
        tau += frame->rayleigh_log2e_per_km[band] * c->of[SKV_RAYLEIGH].v[l];
    if (skv_present(frame, SKV_AEROSOL))
        tau += frame->aerosol_log2e_per_km[band] * c->of[SKV_AEROSOL].v[l];
    if (skv_present(frame, SKV_OZONE))
        tau += frame->ozone_log2e_per_km[band] * c->of[SKV_OZONE].v[l];
    return tau;
}

#if SKV_TERM_GROUND
/// Lambert's ground lit by one light: albedo/pi E mu_s T_light T_view.
SKV_INLINE void skv_ground_lit(const skv_frame *frame, int light, size_t first, const skv_block *block,
                               const skv_columns *view, const skv_sky *sky) {
    const skv_model *model = frame->model;
    const size_t bands = (size_t)skv_bands(model);
    const float radius = frame->radius_km, rms0 = (radius + frame->height_km) * frame->light[light].mu_s;
    skv_block_light toward;
    skv_points g;
    skv_lanes rms;
    skv_columns c;
    skv_block_toward(frame, light, block, &toward);
    SKV_EACH_LANE(l) {
        g.h_km.v[l] = 0.0f;
        g.r_km.v[l] = radius;
        rms.v[l] = skv_clampf(rms0 + block->leg[0].from_km.v[l] * toward.nu.v[l], 0.0f, radius);
    }
    skv_points_densities(frame, &g);
    skv_columns_light(frame, &g, &rms, 0, &c);
    for (int s = 0; s < SKV_SPECIES; s++)
        if (skv_present(frame, s))
            SKV_EACH_LANE(l) c.of[s].v[l] = skv_maxf(c.of[s].v[l], 0.0f) + view->of[s].v[l];
    for (int l = 0; l < block->count; l++) {
        if (!(block->meets_ground.v[l] > 0.0f))
            continue;
        float *out = skv_at_mutable(sky->radiance, sky->radiance_stride, bands, first + (size_t)l);
        for (size_t b = 0; b < bands; b++)
            out[b] += model->albedo[b] * 0.318309886f * frame->light[light].irradiance[b] * (rms.v[l] / radius) *
                      skv_exp2f(-skv_optical_depth_log2e(frame, &c, (int)b, l));
    }
}
#endif

/// @return whether any ray was refused.
static int skv_ends(const skv_frame *frame, size_t n, const skv_rays *rays, const skv_sky *sky) {
    const size_t bands = (size_t)skv_bands(frame->model);
    const int ground = SKV_TERM_GROUND && (frame->quality.terms & SKV_WITH_GROUND) != 0 && frame->lights > 0;
    int bad = 0;
    if (!ground && !sky->transmittance && frame->lights > 0)
        return 0;
    for (size_t first = 0; first < n; first += SKV_LANES) {
        skv_block block;
        skv_columns k[2], view;
        skv_block_load(frame, n, first, rays, &block);
        bad |= block.bad;
        skv_block_columns(frame, &block, k);
        skv_end_columns(frame, &block, k, &view);
#if SKV_TERM_GROUND
        for (int light = 0; ground && light < frame->lights; light++)
            skv_ground_lit(frame, light, first, &block, &view, sky);
#endif
#if SKV_OUT_TRANSMITTANCE
        for (int l = 0; sky->transmittance && l < block.count; l++) {
            float *out = skv_at_mutable(sky->transmittance, sky->transmittance_stride, bands, first + (size_t)l);
            for (size_t b = 0; b < bands; b++)
                out[b] = block.valid.v[l] *
                         skv_minf(skv_exp2f(-skv_optical_depth_log2e(frame, &view, (int)b, l)), 1.0f);
        }
#endif
    }
    return bad;
}

#endif
