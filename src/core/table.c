#include "skyvert/table.h"

#include <string.h>

#include "skyvert/radiance.h"

#include "core/fine_fit.h"
#include "core/gather.h"
#include "core/table_pack.h"

#if SKV_TERM_DIFFUSE

skv_status skv_table_spec_kind(skv_table_spec *spec, skv_table_kind kind) {
    static const skv_table_spec kinds[SKV_TABLE_KINDS] = {
        {10, 3, 21, 0, {6, 4}, {8, 6}, {8, 7}, 0.0f, SKV_TABLE_PACKED},
        {8, 2, 16, 3, {6, 4}, {6, 4}, {6, 5}, 0.0f, SKV_TABLE_PACKED},
    };
    if (!spec)
        return SKV_ERR_NULL;
    if ((int)kind < 0 || (int)kind >= SKV_TABLE_KINDS)
        return SKV_ERR_UNSUPPORTED;
    *spec = kinds[kind];
    return SKV_OK;
}

static int skv_table_within(int32_t x, int32_t lo, int32_t hi) {
    return x >= lo && x <= hi;
}

static skv_status skv_table_spec_check(const skv_table_spec *s) {
    int ok = skv_table_within(s->altitudes, 4, 32) && skv_table_within(s->detailed, 0, s->altitudes) &&
             skv_table_within(s->suns, 8, 64) && skv_table_within(s->format, 0, 1) &&
             (s->orders == 0 || skv_table_within(s->orders, 2, 64)) && s->ground_km >= -12.0f && s->ground_km <= 12.0f;
    for (int i = 0; i < 2; i++)
        ok = ok && skv_table_within(s->samples[i], 2, 16) && skv_table_within(s->polar[i], 2, 16) &&
             skv_table_within(s->azimuths[i], 2, 16);
    return ok ? SKV_OK : SKV_ERR_RANGE;
}

static void skv_table_header(skv_table *t, const skv_table_spec *spec, int bands, int format) {
    memset(t, 0, sizeof *t);
    t->magic = SKV_TABLE_MAGIC;
    t->version = SKV_TABLE_VERSION;
    t->format = (uint8_t)format;
    t->bands = (uint8_t)bands;
    t->altitudes = (uint8_t)spec->altitudes;
    t->detailed = (uint8_t)spec->detailed;
    t->suns = (uint8_t)spec->suns;
    t->ground_km = spec->ground_km;
    for (int k = 0; k < SKV_TABLE_TERMS - 1; k++)
        t->ratio_scale[k] = 1.0f;
    t->bytes = (uint32_t)skv_cells_bytes(t);
}

/// Floats of the work space behind the float table.
static size_t skv_table_rest(const skv_table *t) {
    return (skv_cells_count(t) * SKV_TABLE_TERMS + t->suns) * t->bands;
}

size_t skv_table_size(const skv_table_spec *spec, int bands) {
    skv_table t;
    if (!spec || skv_table_spec_check(spec) != SKV_OK || (bands != 3 && bands != 4))
        return 0;
    skv_table_header(&t, spec, bands, spec->format);
    return t.bytes;
}

size_t skv_table_work_size(const skv_table_spec *spec, int bands) {
    skv_table t;
    if (skv_table_size(spec, bands) == 0)
        return 0;
    skv_table_header(&t, spec, bands, SKV_TABLE_FLOAT);
    return t.bytes + sizeof(float) * skv_table_rest(&t);
}

/// Passes that leave less than the error of the rest of the method: more where light is scattered more often.
static int32_t skv_table_orders(const skv_model *m) {
    float tau = 0.0f;
    for (int b = 0; b < skv_bands(m); b++) {
        float sum = 0.0f;
        for (int k = 0; k < SKV_SCATTERERS; k++)
            sum += m->scattering_per_km[k][b] * m->species[k].scale_height_km;
        tau = skv_maxf(tau, sum);
    }
    return tau < 0.5f ? 4 : tau < 8.0f ? 4 + (int32_t)(4.0f * tau) : 40;
}

/// Rows up to where hardly anything scatters; columns down to a sun 11 degrees below the last one that the air sees (18
/// degrees below the horizon on Earth).
static void skv_table_axes(skv_table *t, const skv_model *m) {
    float scale = 0.0f;
    for (int s = 0; s < SKV_SCATTERERS; s++)
        if (m->species[s].kind != SKV_PROFILE_NONE)
            scale = skv_maxf(scale, m->species[s].scale_height_km);
    const float radius = m->radius_km + t->ground_km, top = m->top_km - t->ground_km, inv = 1.0f / (radius + top);
    t->span_km = scale > 0.0f ? skv_minf(top, 7.5f * scale) : top;
    t->mu_first = -skv_minf(0.2f + 1.15f * skv_sqrtf(top * (2.0f * radius + top)) * inv, 0.95f);
}

static const skv_quality *skv_table_quality(skv_quality *q, int32_t samples) {
    q->rule = SKV_GAUSS_EXP;
    q->depth = SKV_DEPTH_CHAPMAN ? SKV_DEPTH_BY_CHAPMAN : SKV_DEPTH_BY_INNER;
    q->samples = samples;
    q->depth_samples = 16;
    q->terms = SKV_WITH_ALL & ~(SKV_TERM_GROUND ? 0u : (uint32_t)SKV_WITH_GROUND);
    return q;
}

/// Whether frames of this model can be made at all: what they refuse would leave the cells empty.
static skv_status skv_table_frame_check(const skv_model *model, float ground_km) {
    skv_frame frame;
    skv_quality q;
    return skv_frame_begin(&frame, model, skv_table_quality(&q, 6), ground_km, ground_km, NULL, 0);
}

skv_status skv_table_begin(skv_table_builder *builder, const skv_model *model, const skv_table_spec *spec,
                           skv_table *table, size_t table_bytes, void *work, size_t work_bytes) {
    skv_table_spec accurate;
    if (!builder || !model || !table || !work)
        return SKV_ERR_NULL;
    if (model->layout != SKV_LAYOUT)
        return SKV_ERR_LAYOUT;
    (void)skv_table_spec_kind(&accurate, SKV_TABLE_ACCURATE);
    const skv_table_spec *const s = spec ? spec : &accurate;
    if (skv_table_spec_check(s) != SKV_OK || !(s->ground_km < model->top_km) ||
        !(s->ground_km > -0.5f * model->radius_km))
        return SKV_ERR_RANGE;
    const skv_status frames = skv_table_frame_check(model, s->ground_km);
    if (frames != SKV_OK)
        return frames;
    const int bands = skv_bands(model);
    if (table_bytes < skv_table_size(s, bands) || work_bytes < skv_table_work_size(s, bands) ||
        ((uintptr_t)table | (uintptr_t)work) % sizeof(float) != 0)
        return SKV_ERR_SIZE;
    memset(builder, 0, sizeof *builder);
    builder->spec = *s;
    builder->model = model;
    builder->table = table;
    builder->work = work;
    skv_table_header(builder->work, s, bands, SKV_TABLE_FLOAT);
    skv_table_axes(builder->work, model);
    builder->work->model = model->hash;
    builder->first = (float *)(void *)((char *)work + builder->work->bytes);
    builder->pass = 1;
    if (builder->spec.orders == 0)
        builder->spec.orders = skv_table_orders(model);
    builder->layout = SKV_LAYOUT;
    return SKV_OK;
}

/// The frame of a cell, its light in the direction of azimuth 0 with irradiance 1.
static void skv_table_cell_begin(skv_table_builder *b) {
    const skv_table *t = b->work;
    const float mu_s = skv_cells_mu_s(t, b->column);
    const float observer_km = skv_minf(skv_cells_altitude(t, b->row), b->model->top_km);
    skv_quality q;
    skv_light light;
    memset(&light, 0, sizeof light);
    light.direction_enu[0] = skv_sqrtf(skv_maxf((1.0f - mu_s) * (1.0f + mu_s), 0.0f));
    light.direction_enu[2] = mu_s;
    (void)skv_frame_begin(&b->frame, b->model, skv_table_quality(&q, b->spec.samples[0]), observer_km,
                          b->spec.ground_km, &light, 1);
    for (int i = 0; i < SKV_BANDS_MAX; i++)
        b->frame.light[0].irradiance[i] = 1.0f;
    (void)skv_frame_table(&b->frame, t);
    b->frame.diffuse.samples = b->spec.samples[1];
    b->frame.diffuse.only = b->pass > 1;
    if (b->pass == 1)
        b->frame.diffuse.table = NULL;
    memset(b->moment, 0, sizeof b->moment);
    memset(b->source, 0, sizeof b->source);
}

static int skv_table_rays(const skv_table_builder *b) {
    const int later = b->pass > 1;
    return 2 * b->spec.polar[later] * b->spec.azimuths[later];
}

/// What gathered rays add to the source of the kept species.
static SKV_NOINLINE void skv_table_source(skv_table_builder *b, const skv_gather_ray *ray, int count,
                                          const float radiance[]) {
    const int kept = b->frame.diffuse.kept, bands = skv_bands(b->model);
    skv_fine_directions directions;
    float phase[SKV_FINE_DIRECTIONS];
    skv_fine_directions_init(&directions);
    for (int i = 0; i < count; i++) {
        skv_fine_phases(b->model->phase[kept] == SKV_PHASE_CS, b->model->g[kept], &directions, ray[i].direction, phase);
        for (int band = 0; band < bands; band++) {
            const float light = ray[i].weight * radiance[i * bands + band];
            for (int k = 0; k < SKV_FINE_DIRECTIONS; k++)
                b->source[band][k] += phase[k] * light;
        }
    }
}

/// Gathers the next rays of a cell. They are added one by one: the sum does not depend on how many come at a time.
static void skv_table_gather(skv_table_builder *b, int count) {
    const int later = b->pass > 1, bands = skv_bands(b->model);
    const float h = b->frame.height_km, r = b->frame.radius_km + h;
    const float horizon = -skv_sqrtf(h * (b->frame.radius_km + r)) / r;
    const int even = b->frame.light[0].mu_s > 0.3f;
    skv_gather_ray ray[SKV_TABLE_STEP_RAYS];
    float radiance[SKV_TABLE_STEP_RAYS * SKV_BANDS_MAX];
    for (int i = 0; i < count; i++)
        ray[i] = skv_gather_direction(horizon, b->spec.polar[later], b->spec.azimuths[later], even, b->ray + i);
    const skv_rays rays = {ray[0].direction, sizeof ray[0], NULL, 0};
    const skv_sky sky = {radiance, 0, NULL, 0};
    (void)skv_radiance(&b->frame, (size_t)count, &rays, &sky);
    for (int i = 0; i < count; i++) {
        float factor[SKV_GATHER_MOMENTS];
        skv_gather_factors(&ray[i], factor);
        for (int k = 0; k < SKV_GATHER_MOMENTS; k++)
            for (int band = 0; band < bands; band++)
                b->moment[k][band] += ray[i].weight * radiance[i * bands + band] * factor[k];
    }
    if (b->row < b->work->detailed)
        skv_table_source(b, ray, count, radiance);
    b->ray += count;
}

/// The numbers of a cell after a pass: light scattered once and what was gathered of the table so far. The last pass
/// adds the rest as a geometric series, whose rate is that of the whole table: single cells may still be gaining.
/// @return weight of that rest.
static float skv_table_cell_update(skv_table_builder *b, int band, float now[SKV_TABLE_TERMS], const float old[],
                                   float first[]) {
    const int terms = b->row < b->work->detailed ? SKV_TABLE_TERMS : 6;
    for (int k = 0; k < terms && b->pass == 1; k++)
        first[k] = now[k];
    for (int k = 0; k < terms && b->pass > 1; k++)
        now[k] += first[k];
    b->change[band] += skv_fabsf(now[0] - old[0]);
    const float more = b->pass == b->spec.orders ? b->rate[band] / (1.0f - b->rate[band]) : 0.0f;
    for (int k = 0; k < terms; k++)
        now[k] += more * (now[k] - old[k]);
    return more;
}

/// The rate at which passes change less and less, once there are two to compare.
static void skv_table_pass_end(skv_table_builder *b) {
    for (int band = 0; band < SKV_BANDS_MAX; band++) {
        const float rate = b->pass > 2 && b->before[band] > 0.0f ? b->change[band] / b->before[band] : 0.0f;
        b->rate[band] = skv_clampf(rate, 0.0f, 0.9f);
        b->before[band] = b->change[band];
        b->change[band] = 0.0f;
    }
    b->pass++;
}

/// log2 of a radiance that the table keeps.
static float skv_table_log2(float x) {
    return skv_log2f(skv_maxf(x, SKV_CELLS_LEAST));
}

/// No radiance >= 0 has larger ratios to its mean; those over sines stay finite, for radiance about a light in the
/// zenith is round.
static const float skv_table_bound[SKV_TABLE_TERMS - 1] = {3.0f,  6.0f,  5.0f,  10.0f, 8.0f,  40.0f,
                                                           40.0f, 40.0f, 40.0f, 40.0f, 40.0f, 40.0f};

static void skv_table_cell_band(skv_table_builder *b, int band) {
    skv_table *const t = b->work;
    float *const log = (float *)(void *)(t + 1);
    const size_t bands = t->bands, suns = t->suns, cell = (size_t)b->row * suns + (size_t)b->column, i = (size_t)band;
    float *const mean = log + (suns + cell) * bands + i, *const ground = log + (size_t)b->column * bands + i;
    float *const ratio = log + (suns + skv_cells_count(t)) * bands + skv_cells_ratios(t, b->row, b->column) + i;
    const int terms = b->row < t->detailed ? SKV_TABLE_TERMS : 6, kept = b->frame.diffuse.kept;
    const float mu_s = skv_cells_mu_s(t, b->column);
    const skv_frame_diffuse *const d = &b->frame.diffuse;
    float m[SKV_GATHER_MOMENTS];
    float now[SKV_TABLE_TERMS], old[SKV_TABLE_TERMS];
    for (int k = 0; k < SKV_GATHER_MOMENTS; k++)
        m[k] = b->moment[k][band];
    skv_gather_low(m, mu_s, now);
    if (terms > 6)
        skv_fine_fit(b->source[band], now, d->moment[kept], d->aureole[kept], d->toward_enu[0], mu_s, now + 6);
    old[0] = b->pass > 1 ? skv_exp2f(*mean) : 0.0f;
    for (int k = 1; k < terms; k++)
        old[k] = b->pass > 1 ? ratio[(size_t)(k - 1) * bands] * old[0] : 0.0f;
    const float more = skv_table_cell_update(b, band, now, old, b->first + (cell * bands + i) * SKV_TABLE_TERMS);
    if (b->row == 0) {
        float *const once = b->first + (skv_cells_count(t) * SKV_TABLE_TERMS + (size_t)b->column) * bands + i;
        float sum = m[SKV_GATHER_DOWN];
        if (b->pass == 1)
            *once = sum;
        else
            sum += *once;
        *ground = skv_table_log2(sum + more * (sum - skv_exp2f(*ground)));
    }
    *mean = skv_table_log2(now[0]);
    for (int k = 0; k < terms - 1; k++) {
        const float x = now[k + 1] / skv_maxf(now[0], SKV_CELLS_LEAST), bound = skv_table_bound[k];
        ratio[(size_t)k * bands] = skv_clampf(x, -bound, bound);
        if (b->pass == b->spec.orders)
            b->largest[k] = skv_maxf(b->largest[k], skv_fabsf(ratio[(size_t)k * bands]));
    }
}

/// On to the next cell; a pass ends with the last one.
static void skv_table_next(skv_table_builder *b) {
    b->ray = 0;
    if (++b->column < b->work->suns)
        return;
    b->column = 0;
    if (++b->row < b->work->altitudes)
        return;
    b->row = 0;
    skv_table_pass_end(b);
}

static void skv_table_work(skv_table_builder *b) {
    if (b->ray == 0)
        skv_table_cell_begin(b);
    const int left = skv_table_rays(b) - b->ray;
    skv_table_gather(b, left < SKV_TABLE_STEP_RAYS ? left : SKV_TABLE_STEP_RAYS);
    if (b->ray < skv_table_rays(b))
        return;
    for (int band = 0; band < skv_bands(b->model); band++)
        skv_table_cell_band(b, band);
    skv_table_next(b);
}

static int skv_table_permille(const skv_table_builder *b) {
    const int32_t cells = b->work->altitudes * b->work->suns, cell = b->row * b->work->suns + b->column;
    const int32_t once = 2 * b->spec.polar[0] * b->spec.azimuths[0], later = 2 * b->spec.polar[1] * b->spec.azimuths[1];
    const int32_t all = once + later * (b->spec.orders - 1);
    const int32_t before = b->pass == 1 ? 0 : once + later * (b->pass - 2), rays = b->pass == 1 ? once : later;
    return (int)((float)(before * cells + rays * cell) / (float)(all * cells) * 998.0f);
}

skv_status skv_table_step(skv_table_builder *builder, int *permille) {
    if (!builder)
        return SKV_ERR_NULL;
    if (builder->layout != SKV_LAYOUT)
        return SKV_ERR_LAYOUT;
    const int32_t pack = builder->spec.orders + 1;
    if (builder->pass < pack)
        skv_table_work(builder);
    else if (builder->pass == pack) {
        skv_table_pack_row(builder->work, builder->table, builder->row, builder->largest, builder->spec.format);
        if (++builder->row == builder->work->altitudes)
            builder->pass++;
    } else if (builder->pass == pack + 1) {
        skv_table_seal(builder->table);
        builder->pass++;
    }
    if (permille)
        *permille = builder->pass < pack ? skv_table_permille(builder) : builder->pass < pack + 2 ? 999 : 1000;
    return SKV_OK;
}

skv_status skv_table_build(skv_table *table, size_t table_bytes, void *work, size_t work_bytes, const skv_model *model,
                           const skv_table_spec *spec) {
    skv_table_builder builder;
    int done = 0;
    skv_status status = skv_table_begin(&builder, model, spec, table, table_bytes, work, work_bytes);
    while (status == SKV_OK && done < 1000)
        status = skv_table_step(&builder, &done);
    return status;
}

#else

skv_status skv_table_spec_kind(skv_table_spec *spec, skv_table_kind kind) {
    (void)spec;
    (void)kind;
    return SKV_ERR_UNSUPPORTED;
}

size_t skv_table_size(const skv_table_spec *spec, int bands) {
    (void)spec;
    (void)bands;
    return 0;
}

size_t skv_table_work_size(const skv_table_spec *spec, int bands) {
    (void)spec;
    (void)bands;
    return 0;
}

#endif
