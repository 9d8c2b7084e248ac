/// Error of domes that are interpolated between their vertices: `skyvert trade --study dome`.
///
/// A dome's triangles are flat and what their corners hold is interpolated linearly on them, as rasterisers do.
/// `whole`: the corners hold radiance. `apart`: they hold the light scattered once by each kind of matter divided by
/// its phase function, which is multiplied in again at each direction, and the rest as it is. Each kind's light comes
/// from a frame of an air in which the others' scattering is absorption instead: extinction, and so every
/// transmittance, stays.
///
/// Compared with direct evaluation by the same settings (high tier, accurate table, no grid): interpolation alone.
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "convert.h"
#include "metric.h"
#include "study_sky.h"

enum { KINDS = 3, WAYS = 2, SIZES = 7, PROBES = 1536, VERTICES_MAX = 4200, INDICES_MAX = 26000, MATTERS = 3 };

static const char *const kind_name[KINDS] = {"even", "horizon", "adaptive"};
static const char *const way_name[WAYS] = {"whole", "apart"};
static const int ring_count[SIZES] = {7, 10, 14, 18, 25, 33, 45}; // twice as many azimuths

enum { SCENES = 6 };
static const struct {
    double height_km, sun_deg;
} scenes[SCENES] = {{0, 40}, {0, 88.5}, {0, 94}, {12, 40}, {12, 88.5}, {12, 94}};

/// An air whose light is taken apart: all of it, and that scattered once by each kind of matter.
typedef struct light {
    study_sky all, once[MATTERS];
    int matters[MATTERS]; ///< present
    ref_file phases;      ///< of the same air
} light;

/// Everything known of some directions.
typedef struct field {
    size_t n;
    float direction[VERTICES_MAX][3];
    float whole[VERTICES_MAX][4];
    double part[1 + MATTERS][VERTICES_MAX][4]; ///< 0: the rest; then light scattered once over the phase function
    double phase[1 + MATTERS][VERTICES_MAX];
} field;

typedef struct dome {
    field at;
    size_t vertices, triangles;
    uint32_t index[INDICES_MAX];
    int azimuths;
} dome;

typedef struct study {
    const trade_study *how;
    light light;
    float sun[3];
    field probes;
    size_t hidden; ///< of the probes, those within 10 deg of the sun: they come last
    double truth[PROBES][4];
    dome dome;
    trade_error error[SIZES][KINDS][WAYS][2]; ///< [..][0] off the sun, [1] all
} study;

// --- light ---

static skv_atmosphere alone(const skv_atmosphere *air, int matter) {
    skv_atmosphere a = *air;
    for (int b = 0; b < 4; b++) {
        if (matter != 0) {
            a.rayleigh_absorption_per_km[b] += a.rayleigh_scattering_per_km[b];
            a.rayleigh_scattering_per_km[b] = 0;
        }
        if (matter != 1)
            a.aerosol_scattering_per_km[b] = 0;
        if (matter != 2)
            a.dust_scattering_per_km[b] = 0;
    }
    return a;
}

static void free_light(light *l) {
    free((void *)(uintptr_t)l->all.table);
    free((void *)(uintptr_t)l->all.model);
    for (int m = 0; m < MATTERS; m++)
        free((void *)(uintptr_t)l->once[m].model);
}

static int make_light(light *l, const skv_atmosphere *air) {
    const skv_profile_kind kind[MATTERS] = {air->rayleigh.kind, air->aerosol.kind, air->dust.kind};
    memset(l, 0, sizeof *l);
    (void)skv_quality_tier(&l->all.quality, SKV_TIER_HIGH);
    l->all.model = study_model(air);
    if (l->all.model != NULL)
        l->all.table = study_table(l->all.model, NULL);
    int status = l->all.table == NULL ? TRADE_STUDY_FAILED : TRADE_STUDY_DONE;
    for (int m = 0; status == TRADE_STUDY_DONE && m < MATTERS; m++) {
        const skv_atmosphere only = alone(air, m);
        l->matters[m] = kind[m] != SKV_PROFILE_NONE;
        if (!l->matters[m])
            continue;
        l->once[m] = (study_sky){.model = study_model(&only), .quality = l->all.quality};
        if (l->once[m].model == NULL)
            status = TRADE_STUDY_FAILED;
    }
    ref_from_skyvert(air, 0, &l->phases);
    return status;
}

static double phase_of(const light *l, int matter, const float d[3], const float s[3]) {
    double minus = 0, plus = 0;
    for (int c = 0; c < 3; c++) {
        minus += 0.5 * ((double)d[c] - (double)s[c]) * ((double)d[c] - (double)s[c]);
        plus += 0.5 * ((double)d[c] + (double)s[c]) * ((double)d[c] + (double)s[c]);
    }
    const ref_atmosphere *const a = &l->phases.atmosphere;
    return matter == 0   ? ref_phase_rayleigh(0.5 * (plus - minus))
           : matter == 1 ? ref_phase_aerosol(a, minus, plus)
                         : ref_phase_dust(a, minus, plus);
}

/// @param apart  0: the phase functions alone, not the radiances scattered once.
static int shine(const light *l, double height_km, const float sun[3], int apart, field *f) {
    static float once[VERTICES_MAX][4];
    int status = study_radiance(&l->all, height_km, sun, f->n, (const float(*)[3])f->direction, f->whole);
    for (size_t i = 0; i < f->n; i++) {
        f->phase[0][i] = 1;
        for (int b = 0; b < 4; b++)
            f->part[0][i][b] = (double)f->whole[i][b];
    }
    for (int m = 0; status == TRADE_STUDY_DONE && m < MATTERS; m++) {
        if (!l->matters[m])
            continue;
        if (apart)
            status = study_radiance(&l->once[m], height_km, sun, f->n, (const float(*)[3])f->direction, once);
        for (size_t i = 0; i < f->n; i++) {
            f->phase[1 + m][i] = phase_of(l, m, f->direction[i], sun);
            for (int b = 0; apart && b < 4; b++) {
                f->part[1 + m][i][b] = (double)once[i][b] / f->phase[1 + m][i];
                f->part[0][i][b] -= (double)once[i][b];
            }
        }
    }
    return status;
}

// --- directions ---

/// Sky down to the horizon, evenly in the elevation; every third within 10 deg of the horizon. Those near the sun last.
static void lay_probes(study *s, double horizon_deg, size_t n) {
    field *const f = &s->probes;
    size_t near = 0;
    for (size_t i = 0; i < n; i++) {
        float d[3];
        const double t = study_halton((int)i + 1, 2), z = i % 3 == 0 ? horizon_deg - 10 * t : horizon_deg * t;
        trade_direction(d, 0.9999 * z, 360 * study_halton((int)i + 1, 3));
        const double cosine = (double)(d[0] * s->sun[0] + d[1] * s->sun[1] + d[2] * s->sun[2]);
        const int is_near = cosine > cos(10 * STUDY_DEGREE);
        memcpy(f->direction[is_near ? n - 1 - near : i - near], d, sizeof d);
        near += (size_t)is_near;
    }
    f->n = n;
    s->hidden = near;
}

static int lay_dome(study *s, int kind, int size, const skv_atmosphere *air, double height_km) {
    const double horizon = (90 - study_horizon_deg(air, height_km)) * STUDY_DEGREE;
    skv_dome shape = {.kind = (skv_dome_kind)kind,
                      .rings = ring_count[size],
                      .azimuths = 2 * ring_count[size],
                      .horizon_rad = (float)fmin(horizon, 0),
                      .height_km = (float)height_km,
                      .radius_km = air->radius_km,
                      .top_km = air->top_km};
    size_t indices;
    memcpy(shape.sun_enu, s->sun, sizeof shape.sun_enu);
    dome *const d = &s->dome;
    d->azimuths = shape.azimuths;
    if (skv_dome_size(&shape, &d->vertices, &indices) != SKV_OK ||
        skv_dome_build(&shape, d->at.direction[0], 0, VERTICES_MAX, d->index, INDICES_MAX) != SKV_OK) {
        fprintf(stderr, "trade: skv_dome_build failed\n");
        return TRADE_STUDY_FAILED;
    }
    d->triangles = indices / 3;
    d->at.n = d->vertices;
    return TRADE_STUDY_DONE;
}

// --- interpolation ---

static double determinant(const float a[3], const float b[3], const float c[3]) {
    return (double)a[0] * ((double)b[1] * (double)c[2] - (double)b[2] * (double)c[1]) -
           (double)a[1] * ((double)b[0] * (double)c[2] - (double)b[2] * (double)c[0]) +
           (double)a[2] * ((double)b[0] * (double)c[1] - (double)b[1] * (double)c[0]);
}

/// Shares of the corners where direction d meets the flat triangle; sum 1. @return the least of them: >= 0 inside.
static double shares_of(const dome *d, size_t triangle, const float v[3], double share[3]) {
    const uint32_t *const k = d->index + 3 * triangle;
    const float *const a = d->at.direction[k[0]], *const b = d->at.direction[k[1]], *const c = d->at.direction[k[2]];
    share[0] = determinant(v, b, c);
    share[1] = determinant(a, v, c);
    share[2] = determinant(a, b, v);
    const double volume = determinant(a, b, c), sum = share[0] + share[1] + share[2];
    if (!(volume != 0) || !(sum / volume > 0))
        return -INFINITY;
    for (int i = 0; i < 3; i++)
        share[i] /= sum;
    return fmin(fmin(share[0], share[1]), share[2]);
}

/// The triangle that holds a direction: the columns on both sides of its azimuth hold all candidates.
static size_t find_triangle(const dome *d, const float v[3], double best_share[3]) {
    const size_t az = (size_t)d->azimuths, strips = d->triangles / az;
    size_t column = 0, best = 0;
    double most = -INFINITY, share[3];
    for (size_t j = 0; j < az; j++) { // clockwise: j on the left, j + 1 on the right
        const float *const a = d->at.direction[1 + j], *const b = d->at.direction[1 + (j + 1) % az];
        if (a[0] * v[1] - a[1] * v[0] <= 0 && b[0] * v[1] - b[1] * v[0] > 0)
            column = j;
    }
    // The fan, then two triangles a column in each strip between rings; neighbours too, for directions on an edge.
    for (int side = -1; side <= 1; side++) {
        const size_t j = (column + az + (size_t)(side + 1) - 1) % az;
        for (size_t k = 0; k < strips; k++) {
            const size_t triangle = k == 0 ? j : az + ((k - 1) / 2) * 2 * az + 2 * j + (k - 1) % 2;
            const double inside = shares_of(d, triangle, v, share);
            if (inside > most)
                most = inside, best = triangle, memcpy(best_share, share, sizeof share);
        }
    }
    return best;
}

static void interpolate(const study *s, size_t i, float whole[4], float apart[4]) {
    double share[3] = {0, 0, 0}, sum[WAYS][4] = {{0}};
    const dome *const d = &s->dome;
    const uint32_t *const corner = d->index + 3 * find_triangle(d, s->probes.direction[i], share);
    for (int k = 0; k < 3; k++)
        for (int b = 0; b < 4; b++) {
            sum[0][b] += share[k] * (double)d->at.whole[corner[k]][b];
            for (int m = 0; m <= MATTERS; m++)
                if (m == 0 || s->light.matters[m - 1])
                    sum[1][b] += share[k] * d->at.part[m][corner[k]][b] * s->probes.phase[m][i];
        }
    for (int b = 0; b < 4; b++)
        whole[b] = (float)sum[0][b], apart[b] = (float)sum[1][b];
}

static void measure(study *s, int bands, trade_error result[WAYS][2]) {
    static float got[WAYS][PROBES][4];
    static double scratch[PROBES];
    const size_t n = s->probes.n;
    for (size_t i = 0; i < n; i++)
        interpolate(s, i, got[0][i], got[1][i]);
    for (int way = 0; way < WAYS; way++)
        for (int all = 0; all < 2; all++)
            trade_measure(all ? n : n - s->hidden, bands, (const float(*)[TRADE_BANDS])got[way],
                          (const double(*)[TRADE_BANDS])s->truth, scratch, &result[way][all]);
}

// --- output ---

static size_t vertices_of(int size) {
    return 1 + 2 * (size_t)ring_count[size] * (size_t)ring_count[size];
}

static void print_percent(FILE *to, const trade_error *e) {
    const double x[3] = {100 * e->mean, 100 * e->p95, 100 * e->max};
    char text[48];
    int n = 0;
    for (int i = 0; i < 3; i++)
        n += snprintf(text + n, sizeof text - (size_t)n, "%s%.*f", i ? "/" : "",
                      x[i] < 0.995  ? 2
                      : x[i] < 9.95 ? 1
                                    : 0,
                      x[i]);
    fprintf(to, " %17s", text);
}

static void print_scene(const study *s, FILE *text, const char *air, int k, const int *sizes, int count) {
    fprintf(text, "\n%s, %g km, sun zenith %g deg: error in %%, mean/95th percentile/largest\n%8s", air,
            scenes[k].height_km, scenes[k].sun_deg, "vertices");
    for (int c = 0; c < KINDS * WAYS; c++)
        fprintf(text, " %11s %5s", kind_name[c / WAYS], way_name[c % WAYS]);
    fprintf(text, "\n");
    for (int i = 0; i < count; i++) {
        fprintf(text, "%8zu", vertices_of(sizes[i]));
        for (int c = 0; c < KINDS * WAYS; c++)
            print_percent(text, &s->error[sizes[i]][c / WAYS][c % WAYS][1]);
        fprintf(text, "\n");
    }
}

static void write_row(const study *s, FILE *csv, const char *air, int k, int size, int kind) {
    for (int way = 0; way < WAYS; way++)
        for (int all = 0; all < 2; all++) {
            const trade_error *const e = &s->error[size][kind][way][all];
            const float *const d = s->probes.direction[e->worst];
            const double azimuth = atan2((double)d[0], -(double)d[1]) / STUDY_DEGREE;
            fprintf(csv, "%s,%g,%g,%s,%s,%zu,%s,%.4f,%.4f,%.4f,%.3f,%.3f\n", air, scenes[k].height_km,
                    scenes[k].sun_deg, kind_name[kind], way_name[way], vertices_of(size), all ? "all" : "off-sun",
                    100 * e->mean, 100 * e->p95, 100 * e->max, acos(fmin(1, (double)d[2])) / STUDY_DEGREE,
                    azimuth < 0 ? azimuth + 360 : azimuth);
        }
}

// --- the study ---

static int study_scene_of(study *s, const trade_study_air *air, int k, const int *sizes, int count, FILE *csv) {
    const double height = scenes[k].height_km;
    trade_direction(s->sun, scenes[k].sun_deg, 0);
    lay_probes(s, study_horizon_deg(air->atmosphere, height), s->how->quick ? 384 : PROBES);
    int status = shine(&s->light, height, s->sun, 0, &s->probes);
    for (size_t i = 0; i < s->probes.n; i++)
        for (int b = 0; b < 4; b++)
            s->truth[i][b] = (double)s->probes.whole[i][b];
    for (int i = 0; i < count; i++)
        for (int kind = 0; status == TRADE_STUDY_DONE && kind < KINDS; kind++) {
            status = lay_dome(s, kind, sizes[i], air->atmosphere, height);
            if (status == TRADE_STUDY_DONE)
                status = shine(&s->light, height, s->sun, 1, &s->dome.at);
            if (status != TRADE_STUDY_DONE)
                break;
            measure(s, air->atmosphere->bands, s->error[sizes[i]][kind]);
            write_row(s, csv, air->name, k, sizes[i], kind);
        }
    return status;
}

int trade_dome(FILE *text, FILE *csv, const trade_study *how) {
    static study s;
    static const int full[SIZES] = {0, 1, 2, 3, 4, 5, 6}, few[] = {1, 3, 5};
    const int *const sizes = how->quick ? few : full, count = how->quick ? 3 : SIZES;
    int status = TRADE_STUDY_DONE;
    s.how = how;
    fprintf(
        text,
        "Domes interpolated between their vertices, against direct evaluation by the same settings (high tier, "
        "accurate\n"
        "table, no grid): the error of interpolation alone. N rings above the horizon, 2 N azimuths. Where the sky is\n"
        "mirrored about the sun's azimuth half the vertices need evaluation. whole: radiance is interpolated. apart: "
        "light\n"
        "scattered once by each kind of matter without its phase function, and the rest. The CSV has the directions "
        "over 10\n"
        "deg from the sun by themselves too.\n");
    fprintf(csv, "air,height_km,sun_zenith_deg,dome,interpolated,vertices,directions,error_mean_percent,"
                 "error_p95_percent,error_max_percent,worst_view_zenith_deg,worst_rel_azimuth_deg\n");
    for (int a = 0; status == TRADE_STUDY_DONE && a < how->airs; a++) {
        status = make_light(&s.light, how->air[a].atmosphere);
        for (int k = 0; status == TRADE_STUDY_DONE && k < SCENES; k++) {
            status = study_scene_of(&s, &how->air[a], k, sizes, count, csv);
            if (status == TRADE_STUDY_DONE)
                print_scene(&s, text, how->air[a].name, k, sizes, count);
            if (status == TRADE_STUDY_DONE && study_stop(how, (a + (k + 1.0) / SCENES) / how->airs))
                status = TRADE_STUDY_STOPPED;
        }
        free_light(&s.light);
    }
    return status;
}
