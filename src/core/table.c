#include "skyvert/table.h"

#include <string.h>

#include "skyvert/radiance.h"

#include "core/fine_fit.h"
#include "core/gather.h"
#include "core/phase.h"
#include "core/table_fit.h"
#include "core/table_pack.h"

#if SKV_TERM_DIFFUSE

skv_status skv_table_spec_kind(skv_table_spec *spec, skv_table_kind kind) {
    static const skv_table_spec kinds[SKV_TABLE_KINDS] = {
        {10, 3, 21, 0, {6, 4}, {8, 6}, {8, 7}, 0.0f, SKV_TABLE_PACKED},
        {8, 2, 16, 3, {6, 4}, {6, 4}, {6, 5}, 0.0f, SKV_TABLE_PACKED},
        {16, 5, 27, 0, {6, 4}, {8, 8}, {12, 10}, 0.0f, SKV_TABLE_PACKED},
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
    const float tau = skv_scattering_depth(m);
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

/// Bytes that a kind may take in four bands.
static const size_t skv_table_most[SKV_TABLE_KINDS] = {8192, 4800, 16384};

skv_status skv_table_spec_for(skv_table_spec *spec, const skv_model *model, skv_table_kind kind) {
    if (!spec || !model)
        return SKV_ERR_NULL;
    if (model->layout != SKV_LAYOUT)
        return SKV_ERR_LAYOUT;
    skv_table_spec s;
    const skv_status status = skv_table_spec_kind(&s, kind);
    if (status != SKV_OK)
        return status;
    skv_table t;
    skv_table_header(&t, &s, skv_bands(model), SKV_TABLE_FLOAT);
    skv_table_axes(&t, model);
    // Fine numbers as far up as there is forward-scattering matter: three and a half of its scale heights.
    const float high = 3.5f * model->species[skv_kept_species(model)].scale_height_km;
    while (s.detailed < s.altitudes && skv_cells_altitude(&t, s.detailed) - t.ground_km < high)
        s.detailed++;
    if (s.detailed > s.altitudes - 2 && s.altitudes > 8) {
        s.altitudes = s.altitudes * 4 / 5;
        s.detailed = s.altitudes;
    }
    // A peak of some degrees falls between fewer azimuths.
    if (model->g[skv_kept_species(model)] > 0.85f)
        s.azimuths[0] = s.azimuths[1] = 16;
    s.samples[1] = skv_diffuse_nodes(model);
    if (skv_scattering_depth(model) >= 0.5f)
        s.orders = 0;
    while (s.suns > 8 && skv_table_size(&s, 4) > skv_table_most[kind])
        s.suns--;
    *spec = s;
    return SKV_OK;
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
    (void)skv_table_spec_for(&accurate, model, SKV_TABLE_ACCURATE);
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
    b->seen = 0.0f;
}

/// Rays of a cell; in the first pass one more, towards the light.
static int skv_table_rays(const skv_table_builder *b) {
    const int later = b->pass > 1;
    return 2 * b->spec.polar[later] * b->spec.azimuths[later] + !later;
}

/// The phase function of the kept species between a direction and the light.
static float skv_table_phase(const skv_table_builder *b, const float v[3]) {
    const int s = b->frame.diffuse.kept;
    const float *const to = b->frame.light[0].direction_enu, g = b->model->g[s], side = g < 0.0f ? -1.0f : 1.0f;
    const float x = v[0] - side * to[0], y = v[1] - side * to[1], z = v[2] - side * to[2];
    const float near = 0.5f * (x * x + y * y + z * z), d = skv_phase_distance(g, near);
    return b->model->phase[s] == SKV_PHASE_CS ? skv_phase_cornette_shanks(g, d, side * (1.0f - near))
                                              : skv_phase_henyey_greenstein(g, d);
}

/// The ray towards the light. Its weight is what the others miss of a phase function too peaked for them (a third of
/// the light where g = .93); none below the horizon, nor for matter that does not scatter forward.
static skv_gather_ray skv_table_ray_to_light(const skv_table_builder *b, float horizon) {
    const float *const to = b->frame.light[0].direction_enu;
    const int kept = b->frame.diffuse.kept;
    skv_gather_ray ray = {{to[0], to[1], to[2]}, 1.0f, 0.0f};
    if (to[2] > horizon && b->model->g[kept] > 0.0f && b->frame.species[kept].kind != SKV_PROFILE_NONE)
        ray.weight = skv_maxf(1.0f - b->seen, 0.0f) / skv_table_phase(b, to);
    return ray;
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
    const float horizon = -skv_sqrtf(h * (b->frame.radius_km + r)) / r, mu_s = b->frame.light[0].mu_s;
    // Once the light has set, rays to the ground are in the planet's shadow: in the first pass they see nothing.
    const skv_gather_fan fan = {horizon, b->spec.polar[later], b->spec.azimuths[later], mu_s > 0.3f,
                                !later && mu_s < horizon};
    skv_gather_ray ray[SKV_TABLE_STEP_RAYS];
    float radiance[SKV_TABLE_STEP_RAYS * SKV_BANDS_MAX];
    for (int i = 0; i < count; i++) {
        const int last = !later && b->ray + i == skv_table_rays(b) - 1;
        ray[i] = last ? skv_table_ray_to_light(b, horizon) : skv_gather_direction(&fan, b->ray + i);
        b->seen += later ? 0.0f : ray[i].weight * skv_table_phase(b, ray[i].direction);
    }
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

/// The numbers of a cell after a pass: light scattered once and what was gathered of the table so far. What the last
/// pass changed is kept in the place of the first, which is not needed any more: the rest is a geometric series of it.
static void skv_table_cell_update(skv_table_builder *b, int band, float now[SKV_TABLE_TERMS], const float old[],
                                  float first[]) {
    const int terms = b->row < b->work->detailed ? SKV_TABLE_TERMS : 6, last = b->pass == b->spec.orders;
    for (int k = 0; k < terms; k++) {
        if (b->pass == 1)
            first[k] = now[k];
        else
            now[k] += first[k];
        first[k] = last ? now[k] - old[k] : first[k];
    }
    b->change[band] += skv_fabsf(now[0] - old[0]);
}

/// The rate at which passes change less and less, once there are two to compare.
static void skv_table_pass_end(skv_table_builder *b) {
    for (int band = 0; band < SKV_BANDS_MAX; band++) {
        const float rate = b->pass > 1 && b->before[band] > 0.0f ? b->change[band] / b->before[band] : 0.0f;
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

/// A cell of the work table: numbers to logarithm and ratios, and back.
typedef struct skv_table_cell {
    float *mean, *ratio, *ground, *first, *once;
    int terms;
} skv_table_cell;

static skv_table_cell skv_table_cell_at(const skv_table_builder *b, int column, int band) {
    const skv_table *const t = b->work;
    float *const log = (float *)(void *)(b->work + 1);
    const size_t bands = t->bands, suns = t->suns, cell = (size_t)b->row * suns + (size_t)column, i = (size_t)band;
    const skv_table_cell at = {log + (suns + cell) * bands + i,
                               log + (suns + skv_cells_count(t)) * bands + skv_cells_ratios(t, b->row, column) + i,
                               log + (size_t)column * bands + i,
                               b->first + (cell * bands + i) * SKV_TABLE_TERMS,
                               b->first + (skv_cells_count(t) * SKV_TABLE_TERMS + (size_t)column) * bands + i,
                               b->row < t->detailed ? SKV_TABLE_TERMS : 6};
    return at;
}

static void skv_table_cell_get(const skv_table_cell *at, int bands, float out[SKV_TABLE_TERMS]) {
    out[0] = skv_exp2f(*at->mean);
    for (int k = 1; k < at->terms; k++)
        out[k] = at->ratio[(k - 1) * bands] * out[0];
}

static void skv_table_cell_put(const skv_table_cell *at, int bands, const float now[SKV_TABLE_TERMS]) {
    const float inv = 1.0f / skv_maxf(now[0], SKV_CELLS_LEAST);
    // Deep in a white cloud over white ground it is .4; more is a quadrature that does not see a layer of some metres.
    *at->mean = skv_table_log2(skv_minf(now[0], 1.0f));
    for (int k = 1; k < at->terms; k++)
        at->ratio[(k - 1) * bands] = skv_clampf(now[k] * inv, -skv_table_bound[k - 1], skv_table_bound[k - 1]);
}

static void skv_table_cell_band(skv_table_builder *b, int band) {
    const int bands = b->work->bands, kept = b->frame.diffuse.kept, last = b->pass == b->spec.orders;
    const skv_frame_diffuse *const d = &b->frame.diffuse;
    const skv_table_cell at = skv_table_cell_at(b, b->column, band);
    const float mu_s = skv_cells_mu_s(b->work, b->column);
    float m[SKV_GATHER_MOMENTS], now[SKV_TABLE_TERMS], old[SKV_TABLE_TERMS] = {0.0f};
    for (int k = 0; k < SKV_GATHER_MOMENTS; k++)
        m[k] = b->moment[k][band];
    skv_gather_low(m, mu_s, now);
    if (at.terms > 6)
        skv_fine_fit(b->source[band], now, d->moment[kept], d->aureole[kept], d->toward_enu[0], mu_s, now + 6);
    if (b->pass > 1)
        skv_table_cell_get(&at, bands, old);
    skv_table_cell_update(b, band, now, old, at.first);
    skv_table_cell_put(&at, bands, now);
    if (b->row > 0)
        return;
    float sum = m[SKV_GATHER_DOWN];
    if (b->pass == 1)
        *at.once = sum;
    else
        sum += *at.once;
    *at.once = last ? sum - skv_exp2f(*at.ground) : *at.once;
    *at.ground = skv_table_log2(skv_minf(sum, 4.0f));
}

/// After the last pass: the rest of the series, row by row, and how large the ratios become.
static void skv_table_tail(skv_table_builder *b) {
    const int bands = b->work->bands;
    for (int column = 0; column < b->work->suns; column++)
        for (int band = 0; band < bands; band++) {
            const skv_table_cell at = skv_table_cell_at(b, column, band);
            const float more = b->rate[band] / (1.0f - b->rate[band]);
            float now[SKV_TABLE_TERMS];
            skv_table_cell_get(&at, bands, now);
            for (int k = 0; k < at.terms; k++)
                now[k] += more * at.first[k];
            skv_table_cell_put(&at, bands, now);
            for (int k = 0; k < at.terms - 1; k++)
                b->largest[k] = skv_maxf(b->largest[k], skv_fabsf(at.ratio[k * bands]));
            if (b->row == 0)
                *at.ground = skv_table_log2(skv_minf(skv_exp2f(*at.ground) + more * *at.once, 4.0f));
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

/// A step: some rays of a cell, or, once all are gathered, the numbers of one of its bands.
static void skv_table_work(skv_table_builder *b) {
    const int rays = skv_table_rays(b), left = rays - b->ray;
    if (b->ray == 0)
        skv_table_cell_begin(b);
    if (left > 0) {
        // Rays of one elevation at a time: they meet the same cells.
        const int fan = b->spec.azimuths[b->pass > 1], rest = fan - b->ray % fan, most = rest < left ? rest : left;
        skv_table_gather(b, most < SKV_TABLE_STEP_RAYS ? most : SKV_TABLE_STEP_RAYS);
        return;
    }
    skv_table_cell_band(b, b->ray - rays);
    if (++b->ray - rays == skv_bands(b->model))
        skv_table_next(b);
}

static int skv_table_permille(const skv_table_builder *b) {
    const int32_t cells = b->work->altitudes * b->work->suns, cell = b->row * b->work->suns + b->column;
    const int32_t once = 2 * b->spec.polar[0] * b->spec.azimuths[0], later = 2 * b->spec.polar[1] * b->spec.azimuths[1];
    const int32_t all = once + later * (b->spec.orders - 1);
    const int32_t before = b->pass == 1 ? 0 : once + later * (b->pass - 2), rays = b->pass == 1 ? once : later;
    return (int)((float)(before * cells + rays * cell) / (float)(all * cells) * 998.0f);
}

/// Whether a layer puts corners into the light of a column: then it is no smooth curve.
static int skv_table_layered(const skv_model *m) {
    int layered = 0;
    for (int s = 0; s < SKV_SCATTERERS; s++)
        layered |= m->species[s].kind >= SKV_PROFILE_TENT;
    return layered;
}

/// After the passes: on to the next of n rows or columns, and to the next thing to do behind the last one.
static void skv_table_line_end(skv_table_builder *b, int n) {
    if (++b->row < n)
        return;
    b->row = 0;
    b->pass++;
}

skv_status skv_table_step(skv_table_builder *builder, int *permille) {
    if (!builder)
        return SKV_ERR_NULL;
    if (builder->layout != SKV_LAYOUT)
        return SKV_ERR_LAYOUT;
    const int32_t tail = builder->spec.orders + 1, fit = tail + 1, pack = fit + 2;
    if (builder->pass < tail)
        skv_table_work(builder);
    else if (builder->pass == tail) {
        skv_table_tail(builder);
        skv_table_line_end(builder, builder->work->altitudes);
    } else if (builder->pass == fit) {
        skv_table_fit_row(builder->work, builder->row);
        skv_table_line_end(builder, builder->work->altitudes);
    } else if (builder->pass == fit + 1) {
        if (!skv_table_layered(builder->model))
            skv_table_fit_column(builder->work, builder->row);
        skv_table_line_end(builder, builder->work->suns);
    } else if (builder->pass == pack) {
        skv_table_pack_row(builder->work, builder->table, builder->row, builder->largest, builder->spec.format);
        skv_table_line_end(builder, builder->work->altitudes);
    } else if (builder->pass == pack + 1) {
        skv_table_seal(builder->table);
        builder->pass++;
    }
    if (permille)
        *permille = builder->pass < tail ? skv_table_permille(builder) : builder->pass < pack + 2 ? 999 : 1000;
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

skv_status skv_table_spec_for(skv_table_spec *spec, const skv_model *model, skv_table_kind kind) {
    (void)kind;
    return spec && model ? SKV_ERR_UNSUPPORTED : SKV_ERR_NULL;
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

skv_status skv_table_begin(skv_table_builder *builder, const skv_model *model, const skv_table_spec *spec,
                           skv_table *table, size_t table_bytes, void *work, size_t work_bytes) {
    (void)spec;
    (void)table_bytes;
    (void)work_bytes;
    return builder && model && table && work ? SKV_ERR_UNSUPPORTED : SKV_ERR_NULL;
}

skv_status skv_table_step(skv_table_builder *builder, int *permille) {
    (void)permille;
    return builder ? SKV_ERR_UNSUPPORTED : SKV_ERR_NULL;
}

skv_status skv_table_build(skv_table *table, size_t table_bytes, void *work, size_t work_bytes, const skv_model *model,
                           const skv_table_spec *spec) {
    (void)spec;
    (void)table_bytes;
    (void)work_bytes;
    return table && work && model ? SKV_ERR_UNSUPPORTED : SKV_ERR_NULL;
}

#endif
