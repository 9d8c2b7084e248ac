#include "core/rays.h"

#include "core/phase.h"

/// The caller's directions and lengths; lanes beyond the last ray repeat it.
SKV_INLINE void skv_block_gather(size_t n, size_t first, const skv_rays *rays, skv_block *b) {
    const size_t left = n - first, stride = rays->direction_stride ? rays->direction_stride : 3 * sizeof(float);
    const char *at = (const char *)rays->direction_enu + first * stride;
    b->count = left < SKV_LANES ? (int)left : SKV_LANES;
    for (int l = 0; l < SKV_LANES; l++) {
        const float *v = (const float *)(const void *)at;
        b->view[0].v[l] = v[0];
        b->view[1].v[l] = v[1];
        b->view[2].v[l] = v[2];
        at += l < b->count - 1 ? stride : 0;
    }
    SKV_EACH_LANE(l) b->length_km.v[l] = SKV_FAR_KM;
    if (rays->length_km)
        for (int l = 0; l < b->count; l++)
            b->length_km.v[l] = *skv_at(rays->length_km, rays->length_stride, 1, first + (size_t)l);
}

/// Unit view directions; a refused one becomes an empty ray to the zenith.
SKV_INLINE void skv_block_directions(skv_block *b) {
    uint32_t all = ~0u;
    SKV_EACH_LANE(l) {
        const float x = b->view[0].v[l], y = b->view[1].v[l], z = b->view[2].v[l], length = b->length_km.v[l];
        // The largest component first: squares of any float neither overflow nor vanish. x - x is 0 or NaN.
        const float m = skv_maxf(skv_maxf(skv_fabsf(x), skv_fabsf(y)), skv_fabsf(z));
        const float zero = (x - x) + (y - y) + (z - z);
        const int ok = (zero == 0.0f) & (m >= 1.17549435e-38f) & (length >= 0.0f);
        // In two steps: 1/m of a huge m is subnormal, and a host may flush that to 0.
        const float huge = m > 1e30f ? 1e-30f : 1.0f, inv = 1.0f / (ok ? m * huge : 1.0f);
        const float sx = ok ? x * huge * inv : 0.0f, sy = ok ? y * huge * inv : 0.0f, sz = ok ? z * huge * inv : 1.0f;
        const float norm = 1.0f / skv_root(sx * sx + sy * sy + sz * sz);
        b->view[0].v[l] = sx * norm;
        b->view[1].v[l] = sy * norm;
        b->view[2].v[l] = sz * norm;
        b->length_km.v[l] = ok ? skv_minf(length, SKV_FAR_KM) : -1.0f;
        b->valid.v[l] = ok ? 1.0f : 0.0f;
    }
    SKV_EACH_LANE(l) all &= skv_bits(b->valid.v[l]);
    b->bad = all != skv_bits(1.0f);
}

/// Where each ray enters the air: at the observer, or from above the top.
SKV_INLINE void skv_block_start(const skv_frame *frame, skv_block *b) {
    const float radius = frame->radius_km, h = frame->height_km, top = frame->top_km, r = radius + h;
    SKV_EACH_LANE(l) {
        const float x = b->view[0].v[l], y = b->view[1].v[l];
        b->p_km.v[l] = r * skv_root(x * x + y * y);
        b->rm.v[l] = r * b->view[2].v[l];
        b->h_km.v[l] = h;
        b->start_km.v[l] = 0.0f;
    }
    if (h <= top)
        return;
    const float c = (h - top) * (2.0f * radius + h + top), rt = radius + top;
    SKV_EACH_LANE(l) {
        // (r_top mu)^2 at the entry, by the form that cancels less.
        const float rm = b->rm.v[l], p = b->p_km.v[l];
        const float steep = (rt - p) * (rt + p), flat = rm * rm - c;
        const float root = skv_root(skv_maxf(skv_fabsf(rm) < p ? flat : steep, 0.0f));
        // The root alone decides: p and rt are floats with steps of half a metre on Earth.
        const int enters = (rm < 0.0f) & (root > 0.0f);
        const float entry = c / skv_maxf(skv_fabsf(rm) + root, 1e-30f);
        b->p_km.v[l] = skv_minf(p, rt);
        b->h_km.v[l] = top;
        b->rm.v[l] = enters ? -root : 0.0f;
        b->start_km.v[l] = enters ? entry : 0.0f;
        b->length_km.v[l] = enters ? b->length_km.v[l] - entry : -1.0f;
    }
}

/// The legs of each ray.
SKV_INLINE void skv_block_legs(const skv_frame *frame, skv_block *b) {
    const float radius = frame->radius_km, top = frame->top_km;
    uint32_t tangents = 0;
    SKV_EACH_LANE(l) {
        const float h = b->h_km.v[l], rm = b->rm.v[l], length = skv_maxf(b->length_km.v[l], 0.0f);
        const float c = h * (2.0f * radius + h), e = c - rm * rm;
        const float root = skv_root(skv_maxf(-e, 0.0f)), lowest = skv_maxf(e, 0.0f);
        const float to_ground = c / skv_maxf(root - rm, 1e-30f);
        const int down = rm < 0.0f, hit = down & (e < 0.0f), miss = down & (e >= 0.0f);
        const float ht = skv_minf(lowest / (radius + skv_root(radius * radius + lowest)), h);
        const float up = skv_minf(skv_to_top(radius, top, h, rm), length);
        const float from = hit ? to_ground : miss ? -rm : 0.0f;
        const float a = skv_maxf(from - length, 0.0f);
        b->leg[0].h_km.v[l] = hit ? 0.0f : miss ? ht : h;
        b->leg[0].rm.v[l] = hit ? root : miss ? 0.0f : rm;
        b->leg[0].from_km.v[l] = b->start_km.v[l] + from;
        b->leg[0].dir.v[l] = down ? -1.0f : 1.0f;
        b->leg[0].a.v[l] = a;
        // Refused, or past the air: nothing at all.
        b->leg[0].b.v[l] = b->length_km.v[l] > 0.0f ? (down ? from : up) : a;
        b->meets_ground.v[l] = (hit & (length >= from)) != 0 ? 1.0f : 0.0f;
        b->leg[1].b.v[l] = miss ? skv_maxf(length - from, 0.0f) : 0.0f;
    }
    SKV_EACH_LANE(l) tangents |= skv_bits(b->leg[1].b.v[l]);
    b->parts = tangents != 0 ? 2 : 1;
    if (b->parts == 1)
        return;
    SKV_EACH_LANE(l) {
        // From the tangent point to the top, without the digits that its altitude loses near the top.
        const float h = b->h_km.v[l], rm = b->rm.v[l];
        const float out = skv_root(skv_maxf(top - h, 0.0f) * (2.0f * radius + top + h) + rm * rm);
        b->leg[1].h_km.v[l] = b->leg[0].h_km.v[l];
        b->leg[1].rm.v[l] = 0.0f;
        b->leg[1].from_km.v[l] = b->leg[0].from_km.v[l];
        b->leg[1].dir.v[l] = 1.0f;
        b->leg[1].a.v[l] = 0.0f;
        b->leg[1].b.v[l] = skv_minf(out, b->leg[1].b.v[l]);
    }
}

void skv_block_load(const skv_frame *frame, size_t n, size_t first, const skv_rays *rays, skv_block *restrict b) {
    skv_block_gather(n, first, rays, b);
    skv_block_directions(b);
    skv_block_start(frame, b);
    skv_block_legs(frame, b);
}

void skv_block_columns(const skv_frame *frame, unsigned has, const skv_block *b, skv_columns k[restrict 2]) {
    skv_points o;
    skv_lanes mu, sin_chi;
    skv_points_above(frame, has, &b->h_km, &o);
    SKV_EACH_LANE(l) {
        mu.v[l] = skv_minf(skv_fabsf(b->rm.v[l]) * o.inv_r.v[l], 1.0f);
        sin_chi.v[l] = skv_minf(b->p_km.v[l] * o.inv_r.v[l], 1.0f);
    }
    skv_columns_up(frame, has, &o, &mu, &sin_chi, &k[0]);
    if (b->parts == 2) {
        skv_points_above(frame, has, &b->leg[1].h_km, &o);
        skv_columns_tangent(frame, has, &o, &k[1]);
    }
    SKV_EACH_SPECIES(s) {
        if (!SKV_PRESENT(has, s))
            continue;
        if (b->parts == 2)
            SKV_EACH_LANE(l) k[1].of[s].v[l] -= k[0].of[s].v[l];
        SKV_EACH_LANE(l) k[0].of[s].v[l] *= b->leg[0].dir.v[l];
    }
}

#if SKV_TERM_AEROSOL || SKV_TERM_DUST
/// The phase function of aerosol or dust. @param d skv_phase_distance().
SKV_INLINE void skv_block_phase(const skv_model *model, int s, const skv_lanes *d, const skv_lanes *nu,
                                skv_lanes *phase) {
    const float g = model->g[s];
#if SKV_PHASE_CORNETTE_SHANKS
    if (!SKV_PHASE_HENYEY_GREENSTEIN || model->phase[s] == SKV_PHASE_CS)
        SKV_EACH_LANE(l) phase->v[l] = skv_phase_cornette_shanks(g, d->v[l], nu->v[l]);
#endif
#if SKV_PHASE_HENYEY_GREENSTEIN
    if (!SKV_PHASE_CORNETTE_SHANKS || model->phase[s] == SKV_PHASE_HG)
        SKV_EACH_LANE(l) phase->v[l] = skv_phase_henyey_greenstein(g, d->v[l]);
#endif
    (void)nu;
}
#endif

#if SKV_TERM_DUST
/// On its own: the frames without dust do not pay for it.
static SKV_NOINLINE void skv_block_dust(const skv_frame *frame, int light, const skv_block *b,
                                        skv_block_light *restrict out) {
    const float g = frame->model->g[SKV_DUST], sign = g < 0.0f ? -1.0f : 1.0f;
    const float *s = frame->light[light].direction_enu;
    skv_lanes d;
    SKV_EACH_LANE(l) {
        const float dx = b->view[0].v[l] - sign * s[0], dy = b->view[1].v[l] - sign * s[1];
        const float dz = b->view[2].v[l] - sign * s[2];
        d.v[l] = skv_phase_distance(g, 0.5f * (dx * dx + dy * dy + dz * dz));
    }
    skv_block_phase(frame->model, SKV_DUST, &d, &out->nu, &out->phase[SKV_DUST]);
}
#endif

void skv_block_toward(const skv_frame *frame, unsigned has, int light, const skv_block *b,
                      skv_block_light *restrict out) {
    const float *s = frame->light[light].direction_enu;
    const float g = frame->model->g[SKV_AEROSOL], sz = s[2];
    skv_lanes d;
    SKV_EACH_LANE(l) {
        const float x = b->view[0].v[l], y = b->view[1].v[l], z = b->view[2].v[l];
        const float dx = x - s[0], dy = y - s[1], dz = z - sz, ex = x + s[0], ey = y + s[1], ez = z + sz;
        const float near = 0.5f * (dx * dx + dy * dy + dz * dz), far = 0.5f * (ex * ex + ey * ey + ez * ez);
        const float nu = near < far ? 1.0f - near : far - 1.0f;
        out->nu.v[l] = skv_clampf(nu, -1.0f, 1.0f);
        out->cross2.v[l] = skv_maxf(near * far, 1e-10f);
        out->climb.v[l] = near < far ? dz + sz * near : ez - sz * far;
        out->phase[SKV_RAYLEIGH].v[l] = skv_phase_rayleigh(out->nu.v[l]);
        d.v[l] = skv_phase_distance(g, g < 0.0f ? far : near);
    }
#if SKV_TERM_AEROSOL
    if (SKV_PRESENT(has, SKV_AEROSOL))
        skv_block_phase(frame->model, SKV_AEROSOL, &d, &out->nu, &out->phase[SKV_AEROSOL]);
#endif
#if SKV_TERM_DUST
    if (SKV_PRESENT(has, SKV_DUST))
        skv_block_dust(frame, light, b, out);
#endif
    (void)has;
    (void)d;
}
