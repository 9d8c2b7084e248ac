/// Light scattered more than once towards the observer: the integral of the diffuse source of a table along rays.
///
/// The source is the incoming radiance of the table's cells weighed by the moments of each phase function. With the
/// view direction v, the sun s and up z at a sample, mu = v.z, q = v.s - mu mu_s:
///
///     c0 (1 + a1 (k1 mu + k2 q) + a2 (k3 P2(mu) + k4 mu q + k5 (2 q^2 - (1-mu_s^2)(1-mu^2))) + fine part)
///
/// per species; the fine part (fine.h) is the seven numbers that detailed rows have.
/// No angle is divided by: with the sun in the zenith nothing has to be decided.
#include "core/cells.h"
#include "core/fine.h"
#include "core/gauss_legendre.h"
#include "core/legs.h"
#include "core/slices.h"
#include "core/stages.h"

#if SKV_TERM_DIFFUSE

/// Samples of up to SKV_LANES legs: what the source needs.
typedef struct skv_diffuse_samples {
    skv_lanes x, y; ///< coordinates in the table
    skv_lanes mu, q, mu_s;
    skv_lanes density[SKV_SCATTERERS]; ///< that scatters, times path length
} skv_diffuse_samples;

/// The functions of a sample that the ratios of its cell are coefficients of, per species, times the species' moments
/// and the scale of the ratios.
typedef struct skv_diffuse_basis {
    skv_lanes of[SKV_SCATTERERS][SKV_TABLE_TERMS - 1];
} skv_diffuse_basis;

SKV_INLINE void skv_diffuse_bases(const skv_frame *frame, unsigned has, const skv_diffuse_samples *q,
                                  const skv_lanes aureole[SKV_SCATTERERS], skv_diffuse_basis *restrict f) {
    const float *const scale = frame->diffuse.table->ratio_scale;
    SKV_EACH_SCATTERER(s) {
        const float *const a = frame->diffuse.moment[s];
        if (!SKV_PRESENT(has, s))
            continue;
        SKV_EACH_LANE(l) {
            const float mu = q->mu.v[l], x = q->q.v[l], mu_s = q->mu_s.v[l], mu2 = mu * mu;
            const float xy = 2.0f * x * x - (1.0f - mu_s * mu_s) * (1.0f - mu2);
            f->of[s][0].v[l] = scale[0] * a[0] * mu;
            f->of[s][1].v[l] = scale[1] * a[0] * x;
            f->of[s][2].v[l] = scale[2] * a[1] * (1.5f * mu2 - 0.5f);
            f->of[s][3].v[l] = scale[3] * a[1] * (mu * x);
            f->of[s][4].v[l] = scale[4] * a[1] * xy;
            if (s != SKV_RAYLEIGH) {
                float fine[SKV_TABLE_FINE];
                skv_fine_basis(a, aureole[s].v[l], mu, x, mu_s, fine);
                for (int i = 0; i < SKV_TABLE_FINE; i++)
                    f->of[s][5 + i].v[l] = scale[5 + i] * fine[i];
            }
        }
    }
}

/// What the samples' cells send towards the observer, ray by ray.
/// @param[out] log2_mean  of the cells' radiance.
/// @param[out] sent       per species and band, relative to it.
SKV_INLINE void skv_diffuse_read(const skv_table *t, unsigned has, int bands, const skv_diffuse_samples *q,
                                 const skv_diffuse_basis *f, skv_lanes log2_mean[restrict],
                                 skv_lanes sent[restrict SKV_SCATTERERS][SKV_BANDS_MAX]) {
    skv_cells_places p;
    skv_cells_square square;
    square.at = -1;
    skv_cells_find(t, bands, &q->x, &q->y, &p);
    for (int l = 0; l < SKV_LANES; l++) {
        float mean[SKV_BANDS_MAX], ratio[SKV_CELLS_RATIOS];
        const int terms = skv_cells_at(t, bands, &p, l, &square, mean, ratio) ? SKV_TABLE_TERMS - 1 : 5;
        for (int b = 0; b < bands; b++)
            log2_mean[b].v[l] = mean[b];
        SKV_EACH_SCATTERER(s) {
            const int first = s == SKV_RAYLEIGH ? 2 : 0, last = s == SKV_RAYLEIGH ? 5 : terms;
            float sum[SKV_BANDS_MAX];
            if (!SKV_PRESENT(has, s))
                continue;
            SKV_EACH_OF(b, bands) sum[b] = 1.0f;
            for (int k = first; k < last; k++) {
                const float x = f->of[s][k].v[l];
                SKV_EACH_OF(b, bands) sum[b] += x * ratio[k * bands + b];
            }
            for (int b = 0; b < bands; b++)
                sent[s][b].v[l] = sum[b];
        }
    }
    for (int b = 0; b < bands; b++)
        SKV_EACH_LANE(l) log2_mean[b].v[l] = skv_cells_log2(t, log2_mean[b].v[l]);
}

static SKV_NOINLINE void skv_diffuse_cells(const skv_frame *frame, const skv_lanes aureole[SKV_SCATTERERS],
                                           const skv_diffuse_samples *q, skv_lanes log2_mean[restrict],
                                           skv_lanes sent[restrict SKV_SCATTERERS][SKV_BANDS_MAX]) {
    const unsigned has = frame->has & SKV_HAS_BUILT;
    skv_diffuse_basis basis;
    skv_diffuse_bases(frame, has, q, aureole, &basis);
#if SKV_BANDS == 0
    if ((has & SKV_HAS_FOUR) != 0)
        skv_diffuse_read(frame->diffuse.table, has, 4, q, &basis, log2_mean, sent);
    else
        skv_diffuse_read(frame->diffuse.table, has, 3, q, &basis, log2_mean, sent);
#else
    skv_diffuse_read(frame->diffuse.table, has, SKV_BANDS, q, &basis, log2_mean, sent);
#endif
}

static SKV_NOINLINE void skv_diffuse_node(const skv_frame *frame, const skv_columns *c,
                                          const skv_lanes aureole[SKV_SCATTERERS], const skv_diffuse_samples *q,
                                          skv_lanes radiance[restrict]) {
    const unsigned has = frame->has & SKV_HAS_BUILT;
    const int bands = SKV_BANDS_OF(has);
    skv_lanes log2_mean[SKV_BANDS_MAX], sent[SKV_SCATTERERS][SKV_BANDS_MAX];
    skv_diffuse_cells(frame, aureole, q, log2_mean, sent);
    for (int b = 0; b < bands; b++) {
        skv_lanes sum;
        SKV_EACH_LANE(l) sum.v[l] = 0.0f;
        SKV_EACH_SCATTERER(s)
        if (SKV_PRESENT(has, s)) {
            const float scattering = frame->scattering_per_km[s][b];
            SKV_EACH_LANE(l) sum.v[l] += scattering * q->density[s].v[l] * skv_maxf(sent[s][b].v[l], 0.0f);
        }
        // Mean radiance of the cell, as far as it reaches the observer: both logarithms in one exponential.
        SKV_EACH_LANE(l)
        log2_mean[b].v[l] = skv_decay(&frame->limits, log2_mean[b].v[l] - skv_optical_depth_log2e(frame, has, c, b, l));
        SKV_EACH_LANE(l) radiance[b].v[l] += sum.v[l] * log2_mean[b].v[l];
    }
}

/// One slice of a leg, [a, b], of each lane.
static SKV_NOINLINE void skv_diffuse_slice(const skv_frame *frame, const skv_legs *leg,
                                           const skv_lanes aureole[SKV_SCATTERERS], skv_lanes radiance[restrict]) {
    const unsigned has = frame->has & SKV_HAS_BUILT;
    const int n = frame->diffuse.samples, bands = SKV_BANDS_OF(has);
    const float *node = skv_gauss_node + skv_gauss_offset(n), *weight = skv_gauss_weight + skv_gauss_offset(n);
    const skv_table *const t = frame->diffuse.table;
    const float inv_span = frame->diffuse.inv_span, offset = frame->diffuse.offset_km;
    (void)bands;
    skv_points p;
    skv_lanes e0, rm, rms, l_km, k, whole;
    skv_diffuse_samples q;
    skv_legs_start(frame, has, leg, &p, &e0, &rm, &rms);
    skv_legs_map(frame, has, leg, &p, &rm, &rms, &l_km, &k, &whole);
    for (int i = 0; i < n; i++) {
        skv_lanes e, ds, mu_leg, sin_view;
        skv_columns c;
        SKV_EACH_LANE(l) {
            const float g = skv_exp2f_d5(k.v[l] * (1.44269504f * node[i])), s = l_km.v[l] * (g - 1.0f);
            ds.v[l] = weight[i] * k.v[l] * l_km.v[l] * g;
            e.v[l] = skv_maxf(e0.v[l] + s * (2.0f * rm.v[l] + s), 0.0f);
            mu_leg.v[l] = rm.v[l] + s;
            q.mu_s.v[l] = rms.v[l] + s * leg->nu.v[l];
        }
        skv_points_at(frame, has, &e, &p);
        SKV_EACH_LANE(l) {
            const float inv_r = p.inv_r.v[l], m = skv_clampf(mu_leg.v[l] * inv_r, 0.0f, 1.0f);
            const float ms = skv_clampf(q.mu_s.v[l] * inv_r, -1.0f, 1.0f), dir = -leg->sigma.v[l];
            mu_leg.v[l] = m;
            sin_view.v[l] = skv_minf(leg->p_km.v[l] * inv_r, 1.0f);
            q.mu_s.v[l] = ms;
            q.mu.v[l] = dir * m;
            q.q.v[l] = dir * (leg->nu.v[l] - m * ms);
            q.x.v[l] = skv_cells_row(t, skv_clampf((p.h_km.v[l] + offset) * inv_span, 0.0f, 1.0f));
            q.y.v[l] = skv_cells_column(&frame->diffuse, ms);
        }
        skv_columns_up(frame, has, &p, &mu_leg, &sin_view, &c);
        SKV_EACH_SPECIES(s)
        if (SKV_PRESENT(has, s))
            SKV_EACH_LANE(l)
        c.of[s].v[l] = skv_maxf(leg->k.of[s].v[l] + leg->sigma.v[l] * c.of[s].v[l], 0.0f);
        SKV_EACH_SCATTERER(s)
        if (SKV_PRESENT(has, s)) {
            skv_scattering_density(frame, has, &p, s, &q.density[s]);
            SKV_EACH_LANE(l) q.density[s].v[l] *= ds.v[l];
        }
        skv_diffuse_node(frame, &c, aureole, &q, radiance);
    }
}

/// One part of the rays of a block as legs; the planet's shadow does not matter here.
static SKV_NOINLINE int skv_diffuse_legs(const skv_frame *frame, int light, size_t n, size_t first,
                                         const skv_rays *rays, int part, skv_legs *restrict leg,
                                         skv_lanes aureole[restrict SKV_SCATTERERS]) {
    const unsigned has = frame->has & SKV_HAS_BUILT;
    const float *const to = frame->diffuse.toward_enu[light];
    skv_block block;
    skv_block_light toward;
    skv_columns k[2];
    skv_block_load(frame, n, first, rays, &block);
    skv_block_columns(frame, has, &block, k);
    skv_block_toward(frame, has, light, &block, &toward);
    skv_legs_fill(frame, has, light, &block, part, &toward, &k[part], leg);
    SKV_EACH_LANE(l) {
        const float x = block.view[0].v[l] - to[0], y = block.view[1].v[l] - to[1], z = block.view[2].v[l] - to[2];
        const float near = 0.5f * (x * x + y * y + z * z);
        for (int s = 0; s < SKV_SCATTERERS; s++)
            aureole[s].v[l] =
                SKV_PRESENT(has, s) && s != SKV_RAYLEIGH ? skv_aureole(frame->diffuse.aureole[s], near) : 0.0f;
    }
    return part + 1 < block.parts;
}

/// Adds light scattered at least twice along each ray.
void skv_diffuse_add(const skv_frame *frame, int light, size_t n, const skv_rays *rays, const skv_sky *sky) {
    const int bands = skv_bands(frame->model);
    for (size_t first = 0; first < n; first += SKV_LANES) {
        const int count = n - first < SKV_LANES ? (int)(n - first) : SKV_LANES;
        skv_lanes radiance[SKV_BANDS_MAX];
        for (int b = 0; b < SKV_BANDS_MAX; b++)
            SKV_EACH_LANE(l) radiance[b].v[l] = 0.0f;
        for (int part = 0, more = 1; part < 2 && more; part++) {
            skv_legs leg;
            skv_lanes aureole[SKV_SCATTERERS];
            more = skv_diffuse_legs(frame, light, n, first, rays, part, &leg, aureole);
            const int slices = skv_slices(frame, &leg);
            const skv_lanes last = leg.b;
            for (int i = 0; i < slices; i++) {
                if (i < slices - 1)
                    skv_slice_end(frame, &leg, i, &last);
                else
                    leg.b = last;
                skv_diffuse_slice(frame, &leg, aureole, radiance);
                leg.a = leg.b;
            }
        }
        for (int l = 0; l < count; l++) {
            float *out = skv_at_mutable(sky->radiance, sky->radiance_stride, (size_t)bands, first + (size_t)l);
            for (int b = 0; b < bands; b++)
                out[b] = skv_minf(out[b] + radiance[b].v[l] * frame->light[light].irradiance[b], SKV_RADIANCE_MAX);
        }
    }
}

#endif
