#include "skyvert/atmosphere.h"

#include <string.h>

#include "core/arithmetic.h"
#include "core/column_table.h"
#include "core/lanes.h"

/// Comparisons are written so that NaN fails them.
static int skv_within(float x, float lo, float hi) {
    return x >= lo && x <= hi;
}

static int skv_all_within(const float *x, int n, float lo, float hi) {
    int ok = 1;
    for (int i = 0; i < n; i++)
        ok &= skv_within(x[i], lo, hi);
    return ok;
}

static skv_status skv_check_table(const skv_profile *p) {
    if (!p->table_altitude_km || !p->table_density)
        return SKV_ERR_NULL;
    if (p->table_rows < 2 || p->table_rows > SKV_TABLE_ROWS_MAX)
        return SKV_ERR_RANGE;
    for (uint32_t i = 0; i < p->table_rows; i++) {
        if (!skv_within(p->table_altitude_km[i], -1e4f, 1e4f) || !skv_within(p->table_density[i], 0.0f, 1e6f))
            return SKV_ERR_RANGE;
        if (i > 0 && !(p->table_altitude_km[i] > p->table_altitude_km[i - 1]))
            return SKV_ERR_RANGE;
    }
    return SKV_OK;
}

static skv_status skv_check_profile(const skv_profile *p, int species) {
    const int scale = skv_within(p->scale_height_km, 0.001f, 1000.0f);
    switch (p->kind) {
    case SKV_PROFILE_NONE:
        return SKV_OK;
    case SKV_PROFILE_EXPONENTIAL:
        return scale ? SKV_OK : SKV_ERR_RANGE;
    case SKV_PROFILE_EXP_BACKGROUND:
        return scale && (species == SKV_AEROSOL || species == SKV_DUST) && skv_within(p->background, 0.0f, 1.0f)
                   ? SKV_OK
                   : SKV_ERR_RANGE;
    case SKV_PROFILE_US76:
        return skv_within(p->us76_a, 1e-6f, 10.0f) && skv_within(p->us76_b, 0.5f, 3.0f) ? SKV_OK : SKV_ERR_RANGE;
    case SKV_PROFILE_TENT:
        return skv_within(p->peak_km, 0.0f, 1000.0f) && skv_within(p->half_width_km, 0.01f, 1000.0f) ? SKV_OK
                                                                                                     : SKV_ERR_RANGE;
    case SKV_PROFILE_LOGNORMAL:
        return skv_within(p->lognormal_mu, -3.0f, 7.0f) && skv_within(p->lognormal_k, 0.05f, 200.0f) ? SKV_OK
                                                                                                     : SKV_ERR_RANGE;
    case SKV_PROFILE_TABLE:
        return skv_check_table(p);
    default:
        return SKV_ERR_RANGE;
    }
}

/// The coefficients and the phase function of aerosol or dust.
static skv_status skv_check_particles(const float scattering[4], const float extinction[4], int n, skv_phase phase,
                                      float g) {
    if (!skv_all_within(scattering, n, 0.0f, 1e4f) || !skv_within(g, -0.9999f, 0.9999f))
        return SKV_ERR_RANGE;
    for (int b = 0; b < n; b++)
        if (!skv_within(extinction[b], scattering[b], 1e4f))
            return SKV_ERR_RANGE;
    if (phase == SKV_PHASE_HG)
        return SKV_PHASE_HENYEY_GREENSTEIN ? SKV_OK : SKV_ERR_UNSUPPORTED;
    if (phase == SKV_PHASE_CS)
        return SKV_PHASE_CORNETTE_SHANKS ? SKV_OK : SKV_ERR_UNSUPPORTED;
    return SKV_ERR_RANGE;
}

static skv_status skv_check_layers(const skv_atmosphere *a) {
    skv_status status = SKV_OK;
    const int any = a->aerosol.kind != SKV_PROFILE_NONE || a->dust.kind != SKV_PROFILE_NONE;
    if (any && !skv_within(a->turbidity, 0.0f, 1e4f))
        return SKV_ERR_RANGE;
    if (a->aerosol.kind != SKV_PROFILE_NONE)
        status = skv_check_particles(a->aerosol_scattering_per_km, a->aerosol_extinction_per_km, a->bands,
                                     a->aerosol_phase, a->aerosol_g);
    if (status == SKV_OK && a->dust.kind != SKV_PROFILE_NONE)
        status = skv_check_particles(a->dust_scattering_per_km, a->dust_extinction_per_km, a->bands, a->dust_phase,
                                     a->dust_g);
    // Without its dust a planet of dust would be wrong in silence.
    return status == SKV_OK && a->dust.kind != SKV_PROFILE_NONE && !SKV_TERM_DUST ? SKV_ERR_UNSUPPORTED : status;
}

static skv_status skv_check(const skv_atmosphere *a) {
    const int n = a->bands;
    if (n != 3 && n != 4)
        return SKV_ERR_RANGE;
    if (SKV_BANDS != 0 && n != SKV_BANDS)
        return SKV_ERR_UNSUPPORTED;
    if (!skv_within(a->radius_km, 1.0f, 1e5f) || !skv_within(a->top_km, 0.1f, 1000.0f) || !(a->top_km <= a->radius_km))
        return SKV_ERR_RANGE;
    int ok = skv_all_within(a->wavelength_nm, n, 200.0f, 3000.0f) &&
             skv_all_within(a->solar_irradiance, n, 0.0f, 1e6f) && skv_all_within(a->albedo, n, 0.0f, 1.0f) &&
             skv_all_within(a->absorption_colour, n, 1e-6f, 1.0f);
    for (int b = 1; b < n; b++)
        ok &= a->wavelength_nm[b] > a->wavelength_nm[b - 1];
    if (a->rayleigh.kind != SKV_PROFILE_NONE)
        ok &= skv_all_within(a->rayleigh_scattering_per_km, n, 0.0f, 1e4f) &&
              skv_all_within(a->rayleigh_absorption_per_km, n, 0.0f, 1e4f);
    if (a->ozone.kind != SKV_PROFILE_NONE)
        ok &= skv_all_within(a->ozone_absorption_per_km, n, 0.0f, 1e4f);
    if (!ok)
        return SKV_ERR_RANGE;
    const skv_profile *profile[SKV_SPECIES] = {&a->rayleigh, &a->aerosol, &a->dust, &a->ozone};
    for (int s = 0; s < SKV_SPECIES; s++) {
        const skv_status status = skv_check_profile(profile[s], s);
        if (status != SKV_OK)
            return status;
        if (!SKV_PROFILE_TABULATED && s != SKV_OZONE && profile[s]->kind > SKV_PROFILE_EXP_BACKGROUND)
            return SKV_ERR_UNSUPPORTED;
    }
    return skv_check_layers(a);
}

/// Parameters of a density, and which form its column takes.
static void skv_species_init(skv_species *sp, const skv_profile *p, int species, float top_km) {
    const float log2e = 1.44269504f;
    sp->kind = (int32_t)p->kind;
    sp->column = species == SKV_OZONE ? 2 : p->kind <= SKV_PROFILE_EXP_BACKGROUND ? 0 : 1;
    const int exponential = p->kind == SKV_PROFILE_EXPONENTIAL || p->kind == SKV_PROFILE_EXP_BACKGROUND;
    sp->scale_height_km = exponential ? p->scale_height_km : 1.0f; // never 0: it is divided by
    sp->inv_scale_log2e = log2e / sp->scale_height_km;
    if (p->kind == SKV_PROFILE_EXP_BACKGROUND)
        sp->background = p->background;
    if (p->kind == SKV_PROFILE_US76) {
        sp->p0 = -p->us76_a * log2e;
        sp->p1 = p->us76_b;
    } else if (p->kind == SKV_PROFILE_TENT) {
        sp->p0 = p->peak_km;
        sp->p1 = 1.0f / p->half_width_km;
    } else if (p->kind == SKV_PROFILE_LOGNORMAL) {
        // At the peak ln h = mu - 1/(2k) the exponent is 1/(4k) - mu.
        sp->p0 = p->lognormal_mu;
        sp->p1 = p->lognormal_k;
        sp->p2 = (p->lognormal_mu - 0.25f / p->lognormal_k) * log2e;
    }
#if SKV_PROFILE_TABULATED
    if (sp->column == 1 && p->kind != SKV_PROFILE_NONE) {
        sp->scale_height_km = skv_profile_centroid_km(p, sp, top_km);
        sp->inv_scale_log2e = log2e / sp->scale_height_km;
    }
#endif
    (void)top_km;
}

/// Coefficients per unit of the species' relative density; the species is dropped where all are 0.
static void skv_coefficients(skv_model *m, const skv_atmosphere *a, const skv_profile *const profile[SKV_SPECIES]) {
    const float *const scattering[SKV_SCATTERERS] = {a->rayleigh_scattering_per_km, a->aerosol_scattering_per_km,
                                                     a->dust_scattering_per_km};
    const float *const extinction[SKV_SPECIES] = {a->rayleigh_absorption_per_km, a->aerosol_extinction_per_km,
                                                  a->dust_extinction_per_km, a->ozone_absorption_per_km};
    for (int s = 0; s < SKV_SPECIES; s++) {
        const skv_profile *p = profile[s];
        const float norm = p->kind == SKV_PROFILE_EXP_BACKGROUND ? 1.0f / (1.0f + p->background) : 1.0f;
        const float amount = s == SKV_AEROSOL || s == SKV_DUST ? a->turbidity : 1.0f;
        float most = 0.0f;
        for (int b = 0; b < a->bands && p->kind != SKV_PROFILE_NONE; b++) {
            if (s < SKV_SCATTERERS)
                m->scattering_per_km[s][b] = scattering[s][b] * amount * norm;
            m->extinction_per_km[s][b] = extinction[s][b] * amount * norm;
            if (s == SKV_RAYLEIGH) // what is given is the absorption alone
                m->extinction_per_km[s][b] += m->scattering_per_km[s][b];
            most = skv_maxf(most, m->extinction_per_km[s][b]);
        }
        if (!(most > 0.0f))
            m->species[s].kind = SKV_PROFILE_NONE;
    }
}

static void skv_tables(skv_model *m, const skv_profile *const profile[SKV_SPECIES]) {
#if SKV_TERM_OZONE
    if (m->species[SKV_OZONE].kind != SKV_PROFILE_NONE) {
        const skv_species *sp = &m->species[SKV_OZONE];
        skv_column_table_build(&m->ozone_column, profile[SKV_OZONE], sp, m->radius_km, m->top_km);
        skv_density_table_build(m->ozone_density, profile[SKV_OZONE], sp, m->top_km);
    }
#endif
#if SKV_PROFILE_TABULATED
    for (int s = 0; s < 2 + SKV_TERM_DUST; s++) {
        skv_species *sp = &m->species[s];
        if (sp->kind == SKV_PROFILE_NONE || sp->column == 0)
            continue;
        sp->knots = skv_knots_build(&m->column[s], profile[s], sp, m->radius_km, m->top_km);
        if (sp->knots > 0) {
            sp->column = SKV_COLUMN_KNOTS;
            continue;
        }
        skv_column_table_build(&m->column[s], profile[s], sp, m->radius_km, m->top_km);
        skv_density_table_build(m->density[s], profile[s], sp, m->top_km);
    }
#endif
    (void)profile;
    (void)m;
}

static void skv_break(skv_model *m, float h_km) {
    if (h_km > 0.0f && h_km < m->top_km && m->breaks < SKV_MODEL_BREAKS)
        m->break_km[m->breaks++] = h_km;
}

/// Corners of a table: where its slope changes by a good part of its largest density within a step.
static void skv_breaks_table(skv_model *m, const skv_profile *p) {
    const float *h = p->table_altitude_km, *d = p->table_density;
    float most = 0.0f;
    for (uint32_t i = 0; i < p->table_rows; i++)
        most = skv_maxf(most, d[i]);
    for (uint32_t i = 0; i < p->table_rows; i++) {
        const float below = i > 0 ? h[i] - h[i - 1] : 1e9f, above = i + 1 < p->table_rows ? h[i + 1] - h[i] : 1e9f;
        const float s0 = i > 0 ? (d[i] - d[i - 1]) / below : 0.0f;
        const float s1 = i + 1 < p->table_rows ? (d[i + 1] - d[i]) / above : 0.0f;
        if (skv_fabsf(s1 - s0) * skv_minf(below, above) > 0.15f * most)
            skv_break(m, h[i]);
    }
}

/// Where legs are cut; a lognormal at its peak and where it is down to a hundredth of that.
static void skv_breaks(skv_model *m, const skv_profile *p) {
    if (p->kind == SKV_PROFILE_TABLE) {
        skv_breaks_table(m, p);
    } else if (p->kind == SKV_PROFILE_TENT) {
        for (int i = -1; i <= 1; i++)
            skv_break(m, p->peak_km + (float)i * p->half_width_km);
    } else if (p->kind == SKV_PROFILE_LOGNORMAL) {
        const float peak = p->lognormal_mu - 0.5f / p->lognormal_k, width = skv_sqrtf(4.6f / p->lognormal_k);
        for (int i = -1; i <= 1; i++)
            skv_break(m, skv_expf(peak + (float)i * width));
    }
}

static uint32_t skv_hash(uint32_t hash, const float *x, size_t n) {
    for (size_t i = 0; i < n; i++)
        hash = (hash ^ skv_bits(x[i])) * 16777619u; // [FNV] over words
    return hash;
}

/// Padding and what config.h leaves out do not count: a table that a workstation built fits a model on a small target.
static uint32_t skv_model_hash(const skv_model *m) {
    uint32_t hash = 2166136261u ^ (uint32_t)m->bands;
    const float planet[2] = {m->radius_km, m->top_km};
    hash = skv_hash(hash, planet, 2);
    hash = skv_hash(hash, m->albedo, 4);
    hash = skv_hash(hash, m->scattering_per_km[0], SKV_SCATTERERS * 4);
    hash = skv_hash(hash, m->extinction_per_km[0], SKV_SPECIES * 4);
    for (int s = 0; s < SKV_SPECIES; s++) {
        const skv_species *const sp = &m->species[s];
        const float of[] = {(float)sp->kind, sp->scale_height_km, sp->background, sp->p0, sp->p1, sp->p2};
        hash = skv_hash(hash, of, sizeof of / sizeof of[0]);
    }
    for (int s = SKV_AEROSOL; s < SKV_SCATTERERS; s++) {
        const float phase[2] = {(float)m->phase[s], m->g[s]};
        hash = skv_hash(hash, phase, 2);
    }
#if SKV_TERM_OZONE
    hash = m->species[SKV_OZONE].kind == SKV_PROFILE_TABLE ? skv_hash(hash, m->ozone_density, SKV_DENSITY_ROWS) : hash;
#endif
#if SKV_PROFILE_TABULATED
    for (int s = 0; s < 2 + SKV_TERM_DUST; s++)
        if (m->species[s].column == SKV_COLUMN_KNOTS)
            hash = skv_hash(hash, m->column[s].column, 3 * SKV_KNOTS_MAX);
        else if (m->species[s].kind == SKV_PROFILE_TABLE)
            hash = skv_hash(hash, m->density[s], SKV_DENSITY_ROWS);
#endif
    return hash;
}

skv_status skv_model_build(skv_model *model, const skv_atmosphere *a) {
    if (!model || !a)
        return SKV_ERR_NULL;
    if (skv_arithmetic_changed())
        return SKV_ERR_UNSUPPORTED;
    const skv_status status = skv_check(a);
    if (status != SKV_OK)
        return status;
    memset(model, 0, sizeof *model);
    model->bands = a->bands;
    model->radius_km = a->radius_km;
    model->top_km = a->top_km;
    for (int b = 0; b < a->bands; b++) {
        model->wavelength_nm[b] = a->wavelength_nm[b];
        model->solar_irradiance[b] = a->solar_irradiance[b];
        model->albedo[b] = a->albedo[b];
        model->absorption_colour[b] = a->absorption_colour[b];
    }
    const skv_profile *const profile[SKV_SPECIES] = {&a->rayleigh, &a->aerosol, &a->dust, &a->ozone};
    for (int s = 0; s < SKV_SPECIES; s++)
        skv_species_init(&model->species[s], profile[s], s, a->top_km);
    model->phase[SKV_AEROSOL] = (int32_t)a->aerosol_phase;
    model->phase[SKV_DUST] = (int32_t)a->dust_phase;
    model->g[SKV_AEROSOL] = a->aerosol.kind == SKV_PROFILE_NONE ? 0.0f : a->aerosol_g;
    model->g[SKV_DUST] = a->dust.kind == SKV_PROFILE_NONE ? 0.0f : a->dust_g;
    skv_coefficients(model, a, profile);
    model->chapman_valid = 1;
    for (int s = 0; s < SKV_SCATTERERS; s++)
        if (model->species[s].kind != SKV_PROFILE_NONE && model->species[s].column == 0 &&
            model->species[s].scale_height_km * 100.0f > a->radius_km)
            model->chapman_valid = 0;
    skv_breaks(model, &a->aerosol);
    skv_breaks(model, &a->dust);
    skv_breaks(model, &a->rayleigh);
    skv_tables(model, profile);
    model->hash = skv_model_hash(model);
    model->layout = SKV_LAYOUT;
    return SKV_OK;
}
