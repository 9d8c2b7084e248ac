#include "skyvert/frame.h"

#include <string.h>

#include "core/gauss_legendre.h"
#include "core/geometry.h"
#include "core/lanes.h"

skv_status skv_quality_tier(skv_quality *quality, skv_tier tier) {
    static const int8_t samples[3] = {4, 6, 8};
    if (!quality)
        return SKV_ERR_NULL;
    if ((int)tier < 0 || (int)tier > 2)
        return SKV_ERR_UNSUPPORTED;
    const skv_quality q = {SKV_GAUSS_EXP, SKV_DEPTH_BY_CHAPMAN, samples[tier], 16,
                           SKV_WITH_ALL & ~(uint32_t)SKV_WITH_GROUND};
    *quality = q;
    return SKV_OK;
}

static skv_status skv_check_quality(const skv_quality *q) {
    const int built[3] = {SKV_RULE_UNIFORM, SKV_RULE_KELLER, SKV_RULE_GAUSS_EXP};
    if ((int)q->rule < 0 || (int)q->rule > 2 || !built[q->rule])
        return SKV_ERR_UNSUPPORTED;
    if (q->depth == SKV_DEPTH_BY_CHAPMAN ? !SKV_DEPTH_CHAPMAN : q->depth != SKV_DEPTH_BY_INNER || !SKV_DEPTH_INNER)
        return SKV_ERR_UNSUPPORTED;
    const int gauss = q->rule == SKV_GAUSS_EXP, most = gauss ? 16 : SKV_SAMPLES_MAX, least = gauss ? 2 : 1;
    if (q->samples < least || q->samples > most)
        return SKV_ERR_RANGE;
    if (q->depth == SKV_DEPTH_BY_INNER && (q->depth_samples < least || q->depth_samples > most))
        return SKV_ERR_RANGE;
    if ((q->terms & ~(uint32_t)SKV_WITH_ALL) != 0)
        return SKV_ERR_RANGE;
    if ((q->terms & SKV_WITH_GROUND) != 0 && !SKV_TERM_GROUND)
        return SKV_ERR_UNSUPPORTED;
    return SKV_OK;
}

static skv_status skv_frame_lights(skv_frame *f, const skv_light *lights, int32_t n) {
    f->lights = n;
    for (int32_t i = 0; i < n; i++) {
        if (!skv_unit(lights[i].direction_enu, f->light[i].direction_enu))
            return SKV_ERR_DIRECTION;
        f->light[i].mu_s = f->light[i].direction_enu[2];
        for (int b = 0; b < skv_bands(f->model); b++) {
            if (!(lights[i].irradiance[b] >= 0.0f && lights[i].irradiance[b] <= 1e6f))
                return SKV_ERR_RANGE;
            f->light[i].irradiance[b] = lights[i].irradiance[b] * f->model->absorption_colour[b];
        }
    }
    return SKV_OK;
}

/// Species above the ground of this frame. Exponentials are taken relative to the ground, so no exponential of a
/// negative altitude is formed in the air of a ground below the sea.
static void skv_frame_species_init(skv_frame *f, int s) {
    const skv_species *sp = &f->model->species[s];
    skv_frame_species *out = &f->species[s];
    const float scale = sp->scale_height_km, at_ground = skv_minf(skv_exp2f(-f->ground_km * sp->inv_scale_log2e), 1e6f);
    out->kind = (f->quality.terms & (1u << s)) != 0 ? sp->kind : SKV_PROFILE_NONE;
    out->inv_scale_log2e = sp->inv_scale_log2e;
    const float k = 1.0f / skv_sqrtf(2.0f * scale);
    out->chapman_ck = SKV_ERFCX_C * k;
    out->chapman_a = scale * 1.77245385f * k * (sp->column != 0 ? at_ground : 1.0f);
    out->chapman_z = 0.375f * scale;
    out->background = sp->background / skv_maxf(at_ground, 1e-30f);
    const float beyond = 2.0f * scale * skv_exp2f(-f->top_km * sp->inv_scale_log2e);
    // Negligible where even forty times it, along the horizon, is under 1e-6 of optical depth.
    float most = 0.0f;
    for (int b = 0; b < skv_bands(f->model); b++)
        most = skv_maxf(most, f->extinction_log2e_per_km[s][b]);
    out->top_column = sp->column == 0 && 40.0f * beyond * most > 1e-6f ? beyond : 0.0f;
    out->top_k = 2.54647909f * scale / (f->radius_km + f->top_km);
}

static void skv_frame_coefficients(skv_frame *f) {
    const skv_model *m = f->model;
    const float log2e = 1.44269504f;
    const int bands = skv_bands(m);
    for (int s = 0; s < SKV_SPECIES; s++) {
        const skv_species *sp = &m->species[s];
        const float at_ground = sp->column == 0 ? skv_minf(skv_exp2f(-f->ground_km * sp->inv_scale_log2e), 1e6f) : 1.0f;
        for (int b = 0; b < bands; b++) {
            const float extinction = m->extinction_per_km[s][b] * at_ground;
            f->extinction_log2e_per_km[s][b] = extinction * log2e;
            if (s >= SKV_SCATTERERS)
                continue;
            f->scattering_per_km[s][b] = m->scattering_per_km[s][b] * at_ground;
            f->map_per_km[s] += extinction / (float)bands;
        }
    }
    float lo = 1e30f, hi = 0.0f;
    for (int s = 0; s < SKV_SPECIES; s++) {
        skv_frame_species_init(f, s);
        if (s == SKV_OZONE || f->species[s].kind == SKV_PROFILE_NONE)
            continue;
        lo = skv_minf(lo, m->species[s].scale_height_km);
        hi = skv_maxf(hi, m->species[s].scale_height_km);
    }
    f->map_scale = hi > 0.0f ? 0.125f * hi : 1.0f;
    f->inner_scale_km = hi > 0.0f ? skv_sqrtf(lo * hi) : 8.0f;
}

/// Keeps the altitudes ascending.
static void skv_frame_break(skv_frame *f, float z_km, uint32_t inbound) {
    if (!(z_km > 0.0f && z_km < f->top_km) || f->breaks == SKV_FRAME_BREAKS)
        return;
    int i = f->breaks++;
    for (; i > 0 && f->break_km[i - 1] > z_km; i--) {
        f->break_km[i] = f->break_km[i - 1];
        const uint32_t bit = f->break_inbound >> (i - 1) & 1u;
        f->break_inbound = (f->break_inbound & ~(1u << i)) | bit << i;
    }
    f->break_km[i] = z_km;
    f->break_inbound = (f->break_inbound & ~(1u << i)) | inbound << i;
}

/// Sine of the elevation of the lowest light.
static float skv_frame_lowest(const skv_frame *f) {
    float lowest = 1.0f;
    for (int32_t i = 0; i < f->lights; i++)
        lowest = skv_minf(lowest, f->light[i].mu_s);
    return lowest;
}

/// 0 up to `from`, 1 beyond `to`, smooth between.
static float skv_smooth(float x, float from, float to) {
    const float t = skv_clampf((x - from) / (to - from), 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

/// Cuts for one layer. Each rises from the ground as the reason for it grows: one that came in at its full height would
/// be seen as a jump of the whole sky.
static void skv_frame_layer_breaks(skv_frame *f, int s, float lowest) {
    const float scale = f->model->species[s].scale_height_km, dense = f->map_per_km[s];
    // Optical depth of half the horizontal ray at the ground.
    const float half = dense * skv_sqrtf(1.5707963f * f->radius_km * scale);
    if (f->model->species[s].column == 0)
        skv_frame_break(f, 6.0f * scale * skv_smooth(-scale / (8.0f * f->map_scale), -0.09f, -0.06f), 0);
    // Rayleigh's layer is as thick as the map expects: it needs the cut later.
    const float from = s == SKV_RAYLEIGH ? 10.0f : 5.0f;
    const float opaque = skv_smooth(half, from, 2.0f * from);
    // From above the flight levels, rays through the dense half of the air cross this altitude.
    if (s == SKV_RAYLEIGH)
        skv_frame_break(f,
                        1.5f * scale * skv_smooth(half, 1.5f, 2.5f) * (1.0f - opaque) *
                            skv_smooth(f->height_km, 2.0f * scale, 3.0f * scale),
                        1);
    if (opaque > 0.0f)
        skv_frame_break(f, scale * skv_logf(half) * opaque, 1);
    if (half > 20.0f)
        skv_frame_break(f, 0.5f * scale * skv_logf(half) * skv_smooth(half, 20.0f, 40.0f), 1);
    // Where a low light is in gas that hides it, what there is comes from where it is no longer hidden.
    if (s == SKV_RAYLEIGH && opaque > 0.0f)
        skv_frame_break(f, scale * skv_logf(half) * opaque * (1.0f - skv_smooth(lowest, 0.2f, 0.35f)), 0);
}

/// Optical depth from the observer where legs in fog are cut.
#define SKV_FOG_DEPTH 6.0f

/// Where legs are cut (slices.h): corners; the upper end of a thin layer; where opaque air ends, seen from above.
static void skv_frame_breaks(skv_frame *f) {
    const float lowest = skv_frame_lowest(f);
    float fog = 0.0f;
    for (int i = 0; i < f->model->breaks; i++)
        skv_frame_break(f, f->model->break_km[i] - f->ground_km, 0);
    for (int s = 0; s < SKV_SCATTERERS; s++) {
        const skv_species *sp = &f->model->species[s];
        if (f->species[s].kind == SKV_PROFILE_NONE || sp->column == SKV_COLUMN_KNOTS)
            continue;
        skv_frame_layer_breaks(f, s, lowest);
        fog += f->map_per_km[s] * skv_exp2f(-f->height_km * sp->inv_scale_log2e);
    }
    // From the observer, where the fog begins to matter, far out.
    const float sure = skv_smooth(fog * f->map_scale, 0.1f, 0.2f);
    f->fog_km = sure > 0.0f ? SKV_FOG_DEPTH / (fog * sure) : 0.0f;
}

static uint32_t skv_frame_bits(const skv_frame *f) {
    uint32_t has = skv_bands(f->model) == 4 ? SKV_HAS_FOUR : 0;
    for (int s = 0; s < SKV_SPECIES; s++)
        if (f->species[s].kind != SKV_PROFILE_NONE) {
            has |= 1u << s;
            has |= s != SKV_OZONE && f->model->species[s].column != 0 ? SKV_HAS_RATIO : 0;
            has |= f->species[s].background > 0.0f ? SKV_HAS_BACKGROUND : 0;
            has |= s != SKV_OZONE && f->species[s].top_column > 0.0f ? SKV_HAS_CUT : 0;
        }
    if (f->quality.depth == SKV_DEPTH_BY_INNER)
        has = (has | SKV_HAS_INNER) & ~(uint32_t)SKV_HAS_CUT;
    return has & SKV_HAS_BUILT;
}

/// Six nodes between Gauss' four, with two more of weight 0, and his six: exact for polynomials of degree 5 on the way,
/// so that no input makes the sky jump. @param t  [0, 1].
static void skv_frame_nodes_between(skv_frame *f, float t) {
    // Distances from the middle: of the four, the two that do not move, and of the six; then their squares.
    static const float from[3] = {0.430568156f, 0.330604693f, 0.169990522f};
    static const float to[3] = {0.466234757f, 0.330604693f, 0.119309593f};
    float x[3], y[3];
    for (int i = 0; i < 3; i++) {
        x[i] = from[i] + t * (to[i] - from[i]);
        y[i] = x[i] * x[i];
    }
    for (int i = 0; i < 3; i++) {
        const float u = y[(i + 1) % 3], v = y[(i + 2) % 3];
        // Integrals over [-1/2, 1/2] of x^4, x^2 and 1.
        const float w = 0.5f * (0.0125f - (u + v) * (1.0f / 12.0f) + u * v) / ((y[i] - u) * (y[i] - v));
        f->node[i] = 0.5f - x[i];
        f->node[5 - i] = 0.5f + x[i];
        f->weight[i] = f->weight[5 - i] = w;
    }
}

/// The nodes of the rule gauss-exp. Four are not enough at height and under a low light: there the fast tier has six.
static void skv_frame_nodes(skv_frame *f, float lowest) {
    skv_quality *const q = &f->quality;
    const float high = skv_smooth(f->height_km / f->map_scale, 16.0f, 20.0f);
    const float low = 1.0f - skv_smooth(lowest, 0.0349f, 0.0872f), t = 1.0f - (1.0f - high) * (1.0f - low);
    if (q->rule != SKV_GAUSS_EXP)
        return;
    if (q->samples == 4 && t > 0.0f) {
        q->samples = 6;
        if (t < 1.0f) {
            skv_frame_nodes_between(f, t);
            return;
        }
    }
    for (int i = 0; i < q->samples; i++) {
        f->node[i] = skv_gauss_node[skv_gauss_offset(q->samples) + i];
        f->weight[i] = skv_gauss_weight[skv_gauss_offset(q->samples) + i];
    }
}

/// What the request has to become where the fast tier or the closed form does not hold.
static skv_status skv_frame_adjust(skv_frame *f) {
    skv_quality *q = &f->quality;
    skv_frame_nodes(f, skv_frame_lowest(f));
    // The cut at the top is a small correction of the closed form only where little air is above it.
    int closed = f->model->chapman_valid;
    for (int s = 0; s < SKV_SCATTERERS; s++)
        if (f->model->species[s].kind != SKV_PROFILE_NONE && f->model->species[s].column == 0)
            closed &= f->top_km * f->model->species[s].inv_scale_log2e > 5.6f;
    if (q->depth == SKV_DEPTH_BY_CHAPMAN && !closed && (SKV_DEPTH_INNER || !f->model->chapman_valid)) {
        q->depth = SKV_DEPTH_BY_INNER;
        q->depth_samples = 16;
        return SKV_DEPTH_INNER ? SKV_OK : SKV_ERR_UNSUPPORTED;
    }
    return SKV_OK;
}

skv_status skv_frame_begin(skv_frame *frame, const skv_model *model, const skv_quality *quality, float observer_km,
                           float ground_km, const skv_light *lights, int32_t n_lights) {
    if (!frame || !model || (!lights && n_lights > 0))
        return SKV_ERR_NULL;
    if (model->layout != SKV_LAYOUT)
        return SKV_ERR_LAYOUT;
    skv_frame f;
    memset(&f, 0, sizeof f);
    f.model = model;
    f.limits = (skv_frame_limits){0.0f, 1.0f, -126.0f};
    if (quality)
        f.quality = *quality;
    else
        (void)skv_quality_tier(&f.quality, SKV_TIER_STANDARD);
    skv_status status = skv_check_quality(&f.quality);
    if (status != SKV_OK)
        return status;
    if (!(observer_km >= -1e6f && observer_km <= 1e6f) || !(ground_km >= -12.0f && ground_km <= 12.0f) ||
        !(ground_km < model->top_km) || !(ground_km > -0.5f * model->radius_km) || n_lights < 0 ||
        n_lights > SKV_LIGHTS_MAX)
        return SKV_ERR_RANGE;
    f.radius_km = model->radius_km + ground_km;
    f.ground_km = ground_km;
    f.height_km = skv_maxf(observer_km - ground_km, 0.0f);
    f.top_km = model->top_km - ground_km;
    status = skv_frame_lights(&f, lights, n_lights);
    if (status != SKV_OK)
        return status;
    skv_frame_coefficients(&f);
    status = skv_frame_adjust(&f);
    if (status != SKV_OK)
        return status;
    skv_frame_breaks(&f);
    f.has = skv_frame_bits(&f);
    f.layout = SKV_LAYOUT;
    *frame = f;
    return SKV_OK;
}

skv_status skv_light_sun(skv_light *light, const skv_model *model, const float direction_enu[3]) {
    float unit[3];
    if (!light || !model || !direction_enu)
        return SKV_ERR_NULL;
    if (model->layout != SKV_LAYOUT)
        return SKV_ERR_LAYOUT;
    if (!skv_unit(direction_enu, unit))
        return SKV_ERR_DIRECTION;
    memset(light, 0, sizeof *light);
    memcpy(light->direction_enu, direction_enu, 3 * sizeof(float));
    for (int b = 0; b < skv_bands(model); b++)
        light->irradiance[b] = model->solar_irradiance[b];
    return SKV_OK;
}
