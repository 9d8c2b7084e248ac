/// Tabulated air of the path tracer.
#include <math.h>
#include <pthread.h>
#include <stdlib.h>

#include "air.h"

#define STEEP 14.0 // of t = 1/(1 + STEEP mu)
#define LEAST (1 / (1 + STEEP))

typedef struct job {
    ref_air *air;
    int first, step;
} job;

static void fill_row(ref_air *air, int i) {
    const ref_world *w = &air->world;
    const ref_atmosphere *a = w->atmosphere;
    const double v = (double)i / air->rows, y = air->top_km * v * v, h = y + a->ground_km;
    const double e = y * (2 * air->ground + y), r = air->ground + y;
    const double rayleigh = ref_density(&a->rayleigh, h), aerosol = ref_density(&a->aerosol, h);
    for (int k = 0; k < a->bands; k++) {
        air->rayleigh[i * REF_BANDS + k] = a->rayleigh_scattering[k] * rayleigh;
        air->aerosol[i * REF_BANDS + k] = a->aerosol_scattering[k] * aerosol;
    }
    for (int j = 0; j <= air->columns; j++) {
        const double t = LEAST + (1 - LEAST) * j / air->columns, mu = (1 / t - 1) / STEEP;
        double column[REF_SPECIES] = {0};
        ref_stretch(w, e, r * mu, ref_to_top(w, e, r * mu), column);
        double *out = air->depth + ((size_t)i * (size_t)(air->columns + 1) + (size_t)j) * REF_BANDS;
        for (int k = 0; k < a->bands; k++)
            out[k] = (a->rayleigh_scattering[k] * column[0] + a->aerosol_extinction[k] * column[1] +
                      a->ozone_absorption[k] * column[2]) /
                     t;
    }
}

static void *fill(void *user) {
    const job *j = user;
    for (int i = j->first; i <= j->air->rows; i += j->step)
        fill_row(j->air, i);
    return NULL;
}

// The length over which depth is gathered: depth of a vertical ray over the extinction at the ground, of the grey mean.
static double stretch_of(const ref_air *air) {
    const ref_atmosphere *a = air->world.atmosphere;
    double extinction = 0, depth = 0;
    for (int k = 0; k < a->bands; k++) {
        extinction += a->rayleigh_scattering[k] * ref_density(&a->rayleigh, a->ground_km) +
                      a->aerosol_extinction[k] * ref_density(&a->aerosol, a->ground_km);
        depth += air->depth[k] * LEAST;
    }
    const double least = 0.08 * air->top_km;
    return extinction > 0 ? fmin(fmax(depth / extinction, least), 0.5 * air->top_km) : least;
}

int ref_air_make(ref_air *air, const ref_atmosphere *a, int rows, int columns, int threads) {
    enum { MOST = 64 };
    pthread_t thread[MOST];
    job jobs[MOST];
    *air = (ref_air){.rows = rows, .columns = columns, .top_km = a->top_km - a->ground_km};
    ref_world_make(&air->world, a, 16);
    air->ground = air->world.ground;
    air->top = air->world.top;
    const size_t heights = (size_t)rows + 1;
    air->depth = calloc(heights * (size_t)(columns + 1) * REF_BANDS, sizeof *air->depth);
    air->rayleigh = calloc(heights * REF_BANDS, sizeof *air->rayleigh);
    air->aerosol = calloc(heights * REF_BANDS, sizeof *air->aerosol);
    if (!air->depth || !air->rayleigh || !air->aerosol) {
        ref_air_free(air);
        return -1;
    }
    for (int k = 0; k < a->bands; k++)
        air->albedo[k] = a->albedo[k];
    threads = threads < 1 ? 1 : threads > MOST ? MOST : threads;
    for (int i = 0; i < threads; i++)
        jobs[i] = (job){air, i, threads};
    int started = 1;
    while (started < threads && pthread_create(&thread[started], NULL, fill, &jobs[started]) == 0)
        started++;
    for (int i = started; i < threads; i++)
        fill(&jobs[i]);
    fill(&jobs[0]);
    for (int i = 1; i < started; i++)
        pthread_join(thread[i], NULL);
    air->stretch_km = stretch_of(air);
    return 0;
}

void ref_air_free(ref_air *air) {
    free(air->depth);
    free(air->rayleigh);
    free(air->aerosol);
    air->depth = air->rayleigh = air->aerosol = NULL;
}

typedef struct place {
    double radius, height01, part;
    int row;
} place;

static inline place place_of(const ref_air *air, double e) {
    place p;
    e = e > 0 ? e : 0;
    p.radius = sqrt(air->ground * air->ground + e);
    const double y = e / (air->ground + p.radius);
    p.height01 = sqrt(y / air->top_km);
    p.height01 = p.height01 < 1 ? p.height01 : 1;
    const double x = p.height01 * air->rows;
    p.row = (int)x < air->rows ? (int)x : air->rows - 1;
    p.part = x - p.row;
    return p;
}

static inline void depth_up(const ref_air *air, const place *p, double mu, double depth[REF_BANDS]) {
    mu = mu > 0 ? mu < 1 ? mu : 1 : 0;
    const double t = 1 / (1 + STEEP * mu), x = (t - LEAST) * (air->columns / (1 - LEAST));
    const int j = x > 0 ? (int)x < air->columns ? (int)x : air->columns - 1 : 0;
    const double f = x - j;
    const double *low = air->depth + ((size_t)p->row * (size_t)(air->columns + 1) + (size_t)j) * REF_BANDS;
    const double *high = low + (size_t)(air->columns + 1) * REF_BANDS;
    const double a = t * (1 - p->part) * (1 - f), b = t * (1 - p->part) * f, c = t * p->part * (1 - f),
                 d = t * p->part * f;
    for (int k = 0; k < REF_BANDS; k++)
        depth[k] = a * low[k] + b * low[REF_BANDS + k] + c * high[k] + d * high[REF_BANDS + k];
}

// Depth to the top for b of any sign; 0 when the ground is in the way.
static inline int depth_any(const ref_air *air, const place *p, double e, double b, double depth[REF_BANDS]) {
    depth_up(air, p, fabs(b) / p->radius, depth);
    if (b >= 0)
        return 1;
    const double lowest = e - b * b;
    if (lowest < 0)
        return 0;
    double twice[REF_BANDS];
    const place q = place_of(air, lowest);
    depth_up(air, &q, 0, twice);
    for (int k = 0; k < REF_BANDS; k++)
        depth[k] = 2 * twice[k] - depth[k];
    return 1;
}

void ref_air_sun(const ref_air *air, double mu_s, double depth[REF_BANDS]) {
    const place p = {air->ground, 0, 0, 0};
    depth_up(air, &p, mu_s, depth);
}

void ref_line_begin(const ref_air *air, ref_line *l, double e, double b, double b_sun, double nu) {
    l->e = e;
    l->b = b;
    l->b_sun = b_sun;
    l->nu = nu;
    l->ground = b < 0 && b * b > e;
    l->length = l->ground ? e / (sqrt(b * b - e) - b) : ref_to_top(&air->world, e, b);
    const place p = place_of(air, e);
    depth_up(air, &p, fabs(b) / p.radius, l->near);
    if (b < 0 && !l->ground) {
        const place q = place_of(air, e - b * b);
        depth_up(air, &q, 0, l->tangent);
        for (int k = 0; k < REF_BANDS; k++)
            l->tangent[k] *= 2;
    }
}

static inline void depth_between(const ref_air *air, const ref_line *l, double s, const place *p,
                                 double depth[REF_BANDS]) {
    const double b = l->b + s;
    double far[REF_BANDS];
    depth_up(air, p, fabs(b) / p->radius, far);
    for (int k = 0; k < REF_BANDS; k++) {
        const double d = l->b >= 0            ? l->near[k] - far[k]
                         : b < 0 || l->ground ? far[k] - l->near[k]
                                              : l->tangent[k] - l->near[k] - far[k];
        depth[k] = d > 0 ? d : 0;
    }
}

void ref_line_at(const ref_air *air, const ref_line *l, double s, ref_point *q) {
    q->e = l->e + s * (2 * l->b + s);
    const place p = place_of(air, q->e);
    const double b_sun = l->b_sun + s * l->nu;
    q->radius = p.radius;
    q->height01 = p.height01;
    q->mu_s = b_sun / p.radius;
    depth_between(air, l, s, &p, q->depth);
    q->lit = depth_any(air, &p, q->e, b_sun, q->sun);
    const double *rayleigh = air->rayleigh + p.row * REF_BANDS, *aerosol = air->aerosol + p.row * REF_BANDS;
    for (int k = 0; k < REF_BANDS; k++) {
        q->rayleigh[k] = (1 - p.part) * rayleigh[k] + p.part * rayleigh[REF_BANDS + k];
        q->aerosol[k] = (1 - p.part) * aerosol[k] + p.part * aerosol[REF_BANDS + k];
    }
}

void ref_line_end(const ref_air *air, const ref_line *l, double depth[REF_BANDS]) {
    const place p = place_of(air, l->ground ? 0 : air->top);
    depth_between(air, l, l->length, &p, depth);
}

// Where the sun's ray is tangent to the ground: the shadow's edge.
static int shadow_edges(const ref_line *l, double at[2]) {
    const double sin2 = 1 - l->nu * l->nu, half = l->b - l->b_sun * l->nu, c = l->e - l->b_sun * l->b_sun;
    const double root = half * half - sin2 * c;
    if (!(root >= 0) || sin2 < 1e-14)
        return 0;
    const double q = -(half + copysign(sqrt(root), half)), roots[2] = {q / sin2, c / q};
    int n = 0;
    for (int i = 0; i < 2; i++)
        if (l->b_sun + roots[i] * l->nu < 0 && roots[i] > 0 && roots[i] < l->length)
            at[n++] = roots[i];
    if (n == 2 && at[0] > at[1]) {
        const double swap = at[0];
        at[0] = at[1];
        at[1] = swap;
    }
    return n;
}

static int is_dark(const ref_line *l, double s) {
    const double b = l->b_sun + s * l->nu, e = l->e + s * (2 * l->b + s);
    return b < 0 && e < b * b;
}

// Share of the light that passes from the start to s, mean of the bands that the air has.
static double passing(const ref_air *air, const ref_line *l, double s) {
    const int bands = air->world.atmosphere->bands;
    const place p = place_of(air, l->e + s * (2 * l->b + s));
    double depth[REF_BANDS], sum = 0;
    depth_between(air, l, s, &p, depth);
    for (int k = 0; k < bands; k++)
        sum += exp(-depth[k]);
    return sum / bands;
}

// Where most of the light is lost, roughly; INFINITY when it gets through.
static double veil(const ref_air *air, const ref_line *l) {
    const double seen = 0.25;
    double low = 0, high = l->length;
    if (!(passing(air, l, high) < 0.5 * seen))
        return INFINITY;
    for (int i = 0; i < 12; i++) {
        const double middle = i < 4 ? low + 0.25 * (high - low) : 0.5 * (low + high), t = passing(air, l, middle);
        if (t > seen)
            low = middle;
        else
            high = middle;
        if (t > 0.5 * seen && t < 1.5 * seen)
            return middle;
    }
    return high;
}

// Edges of n cells of [from, to], growing by a constant factor from the near or the far end.
static void lay(double from, double to, int near, double scale, int n, double *edges) {
    const double factor = pow(1 + (to - from) / scale, 1.0 / n);
    double reach = scale;
    for (int i = 1; i < n; i++) {
        reach *= factor;
        edges[near ? i : n - i] = near ? from + (reach - scale) : to - (reach - scale);
    }
    edges[0] = from;
    edges[n] = to;
}

static void lay_to_dense(const ref_air *air, const ref_line *l, double from, double to, int n, double *edges) {
    const double e0 = l->e + from * (2 * l->b + from), e1 = l->e + to * (2 * l->b + to);
    const int near = e0 <= e1;
    const double mu = fabs(l->b + (near ? from : to)) / air->ground, h = air->stretch_km;
    lay(from, to, near, h / (mu / 2 + sqrt(mu * mu / 4 + h / (2 * air->ground))), n, edges);
}

static int ascending(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

int ref_line_cells(const ref_air *air, const ref_line *l, int lit_cells, int dark_cells, double *edges) {
    double cuts[6];
    int n = shadow_edges(l, cuts + 1) + 1, cells = 0;
    const double hidden = veil(air, l);
    cuts[0] = 0;
    if (l->b < 0 && !l->ground && -l->b < l->length)
        cuts[n++] = -l->b;
    if (hidden < l->length)
        cuts[n++] = hidden;
    cuts[n++] = l->length;
    qsort(cuts, (size_t)n, sizeof *cuts, ascending);
    for (int i = 0; i + 1 < n; i++) {
        if (!(cuts[i + 1] > cuts[i]))
            continue;
        const int beyond = cuts[i] >= hidden, dark = is_dark(l, 0.5 * (cuts[i] + cuts[i + 1]));
        const int count = dark || beyond ? dark_cells : lit_cells;
        if (beyond)
            lay(cuts[i], cuts[i + 1], 1, 0.5 * hidden, count, edges + cells);
        else
            lay_to_dense(air, l, cuts[i], cuts[i + 1], count, edges + cells);
        cells += count;
    }
    return cells;
}
