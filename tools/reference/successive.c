/// Successive orders of scattering.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "successive.h"

#define PI 3.14159265358979323846

enum { SOURCES = 2 * REF_BANDS, NODES_MAX = 32 };

// Gauss-Legendre on [0, 1] by Newton's method on the three-term recurrence.
static void gauss(int n, double *x, double *weight) {
    for (int i = 0; i < n; i++) {
        double z = cos(PI * (i + 0.75) / (n + 0.5)), slope = 1;
        for (int round = 0; round < 50; round++) {
            double p = 1, before = 0;
            for (int k = 1; k <= n; k++) {
                const double next = ((2 * k - 1) * z * p - (k - 1) * before) / k;
                before = p;
                p = next;
            }
            slope = n * (z * p - before) / (z * z - 1);
            z -= p / slope;
            if (fabs(p / slope) < 1e-15)
                break;
        }
        x[i] = 0.5 * (1 - z);
        weight[i] = 1 / ((1 - z * z) * slope * slope);
    }
}

// A direction that light comes from, in the frame of up and sun; weight: of its solid angle, both sides of the sun's
// plane.
typedef struct inlet {
    double mu, cos_turn, turn, weight;
} inlet;

static int inlets(const ref_grid *g, double horizon, inlet *in) {
    double x[NODES_MAX], w[NODES_MAX], y[NODES_MAX], v[NODES_MAX];
    int n = 0;
    gauss(g->polars, x, w);
    gauss(g->azimuths, y, v);
    for (int side = 0; side < 2; side++) // t^2 from the horizon up and down
        for (int i = 0; i < g->polars; i++)
            for (int j = 0; j < g->azimuths; j++) {
                const double size = side ? 1 - horizon : -1 - horizon;
                // More azimuths toward the sun.
                const double turn = PI * pow(y[j], 1.5), rate = 1.5 * PI * sqrt(y[j]);
                in[n++] = (inlet){horizon + size * x[i] * x[i], cos(turn), turn,
                                  fabs(size) * 2 * x[i] * w[i] * 2 * rate * v[j]};
            }
    return n;
}

static double *node(const ref_successive *s, double *source, int i, int j) {
    return source + (size_t)(i * s->grid.suns + j) * (size_t)(s->grid.thetas * s->grid.turns * SOURCES);
}

typedef struct axis {
    int low;
    double part;
} axis;

static axis place(double x, int nodes) {
    const double at = fmax(0, fmin(nodes - 1, x));
    const int low = at < nodes - 1 ? (int)at : nodes - 2;
    return (axis){low, at - low};
}

static double sun_place(const ref_grid *g, double mu_s) {
    const double deg = acos(fmax(-1, fmin(1, mu_s))) * 180 / PI;
    return (deg - g->sun_low_deg) / (g->sun_high_deg - g->sun_low_deg) * (g->suns - 1);
}

// The averages at a point for a direction: linear between the nodes of all four axes.
static void look_up(const ref_successive *s, const double *source, const ref_point *q, double mu, double nu,
                    double out[SOURCES]) {
    const ref_grid *g = &s->grid;
    const double sines = sqrt(fmax(0, 1 - mu * mu) * fmax(0, 1 - q->mu_s * q->mu_s));
    const double turn = sines > 1e-9 ? acos(fmax(-1, fmin(1, (nu - mu * q->mu_s) / sines))) : 0;
    const axis a[4] = {place(q->height01 * (g->heights - 1), g->heights), place(sun_place(g, q->mu_s), g->suns),
                       place(acos(fmax(-1, fmin(1, mu))) / PI * (g->thetas - 1), g->thetas),
                       place(turn / PI * (g->turns - 1), g->turns)};
    memset(out, 0, SOURCES * sizeof *out);
    for (int corner = 0; corner < 16; corner++) {
        double weight = 1;
        int at[4];
        for (int d = 0; d < 4; d++) {
            const int high = corner >> d & 1;
            weight *= high ? a[d].part : 1 - a[d].part;
            at[d] = a[d].low + high;
        }
        if (!(weight > 0))
            continue;
        const double *from =
            source +
            ((size_t)((at[0] * g->suns + at[1]) * g->thetas + at[2]) * (size_t)g->turns + (size_t)at[3]) * SOURCES;
        for (int k = 0; k < SOURCES; k++)
            out[k] += weight * from[k];
    }
}

static void look_up_ground(const ref_successive *s, const double *ground, double mu_s, double out[REF_BANDS]) {
    const axis a = place(sun_place(&s->grid, mu_s), s->grid.suns);
    for (int k = 0; k < REF_BANDS; k++)
        out[k] = (1 - a.part) * ground[a.low * REF_BANDS + k] + a.part * ground[(a.low + 1) * REF_BANDS + k];
}

// Light along a line: the sun's (source NULL), or that of the averages of the order before.
static void along(const ref_successive *s, const double *source, const double *ground, const ref_line *l, int cells,
                  int with_ground, double out[REF_BANDS]) {
    const ref_air *air = s->air;
    double edges[REF_CELLS_MAX + 1], averages[SOURCES];
    const int n = ref_line_cells(air, l, cells, cells, edges);
    const double rayleigh = ref_phase_rayleigh(l->nu);
    const double aerosol = ref_phase_aerosol(air->world.atmosphere, 1 - l->nu, 1 + l->nu);
    memset(out, 0, REF_BANDS * sizeof *out);
    for (int i = 0; i < 2 * n; i++) {
        const double from = edges[i / 2], size = edges[i / 2 + 1] - from;
        const double at = from + size * (0.5 + (i % 2 ? 0.5 : -0.5) / sqrt(3)); // two Gauss points
        ref_point q;
        ref_line_at(air, l, at, &q);
        if (!source && !q.lit)
            continue;
        if (source)
            look_up(s, source, &q, (l->b + at) / q.radius, l->nu, averages);
        for (int k = 0; k < REF_BANDS; k++) {
            const double scattered = source ? q.rayleigh[k] * averages[k] + q.aerosol[k] * averages[REF_BANDS + k]
                                            : (q.rayleigh[k] * rayleigh + q.aerosol[k] * aerosol) * exp(-q.sun[k]);
            out[k] += 0.5 * size * exp(-q.depth[k]) * scattered;
        }
    }
    if (!l->ground || !with_ground)
        return;
    double depth[REF_BANDS], light[REF_BANDS];
    const double mu_s = (l->b_sun + l->length * l->nu) / air->ground;
    if (source) {
        look_up_ground(s, ground, mu_s, light);
    } else {
        ref_air_sun(air, mu_s, light);
        for (int k = 0; k < REF_BANDS; k++)
            light[k] = mu_s > 0 ? mu_s * exp(-light[k]) : 0;
    }
    ref_line_end(air, l, depth);
    for (int k = 0; k < REF_BANDS; k++)
        out[k] += exp(-depth[k]) * air->albedo[k] / PI * light[k];
}

// How light from each inlet is shared among the directions of the grid; rows are scaled so that even light stays even.
static void make_kernel(const ref_successive *s, const inlet *in, int n, double *kernel) {
    const ref_grid *g = &s->grid;
    for (int out = 0; out < g->thetas * g->turns; out++) {
        const double theta = PI * (out / g->turns) / (g->thetas - 1), turn = PI * (out % g->turns) / (g->turns - 1);
        double *row = kernel + (size_t)out * (size_t)(2 * n), sum[2] = {0, 0};
        for (int i = 0; i < n; i++) {
            const double across = sin(theta) * sqrt(fmax(0, 1 - in[i].mu * in[i].mu)), up = cos(theta) * in[i].mu;
            row[2 * i] = row[2 * i + 1] = 0;
            for (int side = -1; side <= 1; side += 2) {
                const double nu = fmax(-1, fmin(1, up + across * cos(turn - side * in[i].turn)));
                row[2 * i] += 0.5 * in[i].weight * ref_phase_rayleigh(nu);
                row[2 * i + 1] += 0.5 * in[i].weight * ref_phase_aerosol(s->air->world.atmosphere, 1 - nu, 1 + nu);
            }
            sum[0] += row[2 * i];
            sum[1] += row[2 * i + 1];
        }
        for (int i = 0; i < 2 * n; i++)
            row[i] /= sum[i % 2];
    }
}

typedef struct work {
    inlet *in;
    double *kernel, *radiance;
} work;

// Gathers at one node of height and sun, and averages.
static void gather(const ref_successive *s, const work *w, int n, int i, int j, const double *source,
                   const double *ground, double *next, double *next_ground) {
    const ref_grid *g = &s->grid;
    const double v = (double)i / (g->heights - 1), y = s->air->top_km * v * v, r = s->air->ground + y;
    const double e = y * (2 * s->air->ground + y);
    const double deg = g->sun_low_deg + (g->sun_high_deg - g->sun_low_deg) * j / (g->suns - 1);
    const double mu_s = cos(deg * PI / 180), sin_s = sin(deg * PI / 180);
    double *irradiance = next_ground + j * REF_BANDS;
    if (i == 0)
        memset(irradiance, 0, REF_BANDS * sizeof *irradiance);
    for (int d = 0; d < n; d++) {
        const inlet *in = &w->in[d];
        const double nu = mu_s * in->mu + sin_s * sqrt(fmax(0, 1 - in->mu * in->mu)) * in->cos_turn;
        double *light = w->radiance + d * REF_BANDS;
        ref_line line;
        ref_line_begin(s->air, &line, e, r * in->mu, r * mu_s, fmax(-1, fmin(1, nu)));
        along(s, source, ground, &line, g->cells, 1, light);
        for (int k = 0; k < REF_BANDS && i == 0; k++)
            irradiance[k] += fmax(0, in->mu) * in->weight * light[k];
    }
    double *to = node(s, next, i, j);
    for (int out = 0; out < g->thetas * g->turns; out++, to += SOURCES) {
        const double *row = w->kernel + (size_t)out * (size_t)(2 * n);
        memset(to, 0, SOURCES * sizeof *to);
        for (int d = 0; d < n; d++)
            for (int k = 0; k < REF_BANDS; k++) {
                to[k] += row[2 * d] * w->radiance[d * REF_BANDS + k];
                to[REF_BANDS + k] += row[2 * d + 1] * w->radiance[d * REF_BANDS + k];
            }
    }
}

static void pass(const ref_successive *s, const work *w, const double *source, const double *ground, double *next,
                 double *next_ground) {
    for (int i = 0; i < s->grid.heights; i++) {
        const double v = (double)i / (s->grid.heights - 1), y = s->air->top_km * v * v;
        const int n = inlets(&s->grid, -sqrt(y * (2 * s->air->ground + y)) / (s->air->ground + y), w->in);
        make_kernel(s, w->in, n, w->kernel);
        for (int j = 0; j < s->grid.suns; j++)
            gather(s, w, n, i, j, source, ground, next, next_ground);
    }
}

// Adds an order; returns its largest share of the sum.
static double add(double *sum, const double *order, size_t n) {
    double share = 0;
    for (size_t i = 0; i < n; i++) {
        sum[i] += order[i];
        share = sum[i] > 0 ? fmax(share, order[i] / sum[i]) : share;
    }
    return share;
}

// The orders to come, each in the ratio of the last two.
static void add_tail(double *sum, const double *last, const double *before, size_t n) {
    for (size_t i = 0; i < n; i++) {
        const double ratio = before[i] > 0 ? fmin(0.95, last[i] / before[i]) : 0;
        sum[i] += last[i] * ratio / (1 - ratio);
    }
}

static void solve(ref_successive *s, const work *w, double *a, double *b, double *ground_a, double *ground_b,
                  size_t n) {
    const size_t m = (size_t)(s->grid.suns * REF_BANDS);
    double *last = a, *before = b, *ground_last = ground_a, *ground_before = ground_b;
    pass(s, w, NULL, NULL, last, ground_last);
    for (s->orders = 1;; s->orders++) {
        s->rest = add(s->source, last, n);
        add(s->ground, ground_last, m);
        if (s->orders > s->grid.orders || s->rest < 1e-4)
            break;
        double *swap = before;
        before = last;
        last = swap;
        swap = ground_before;
        ground_before = ground_last;
        ground_last = swap;
        pass(s, w, before, ground_before, last, ground_last);
    }
    if (s->orders > 1) {
        add_tail(s->source, last, before, n);
        add_tail(s->ground, ground_last, ground_before, m);
    }
}

int ref_successive_make(ref_successive *s, const ref_air *air, const ref_grid *grid) {
    const size_t outlets = (size_t)(grid->thetas * grid->turns),
                 inlets_all = (size_t)(2 * grid->polars * grid->azimuths);
    const size_t n = (size_t)(grid->heights * grid->suns) * outlets * SOURCES, m = (size_t)(grid->suns * REF_BANDS);
    *s = (ref_successive){.air = air, .grid = *grid};
    s->source = calloc(n, sizeof(double));
    s->ground = calloc(m, sizeof(double));
    double *orders = calloc(2 * n + 2 * m, sizeof(double));
    const work w = {malloc(inlets_all * sizeof(inlet)), malloc(outlets * 2 * inlets_all * sizeof(double)),
                    malloc(inlets_all * REF_BANDS * sizeof(double))};
    const int good = s->source && s->ground && orders && w.in && w.kernel && w.radiance;
    if (good)
        solve(s, &w, orders, orders + n, orders + 2 * n, orders + 2 * n + m, n);
    else
        ref_successive_free(s);
    free(orders);
    free(w.in);
    free(w.kernel);
    free(w.radiance);
    return good ? 0 : -1;
}

void ref_successive_free(ref_successive *s) {
    free(s->source);
    free(s->ground);
    s->source = s->ground = NULL;
}

int ref_successive_radiance(const ref_successive *s, double height_km, double sun_deg, double view_deg,
                            double azimuth_deg, int lit_ground, double radiance[REF_BANDS]) {
    const ref_air *air = s->air;
    const ref_ray ray = ref_ray_from_angles(height_km, sun_deg, view_deg, azimuth_deg);
    const double y = fmax(0, fmin(air->top_km, height_km)), r = air->ground + y;
    double later[REF_BANDS];
    ref_answer first;
    ref_line line;
    const int status = ref_single(air->world.atmosphere, &ray, lit_ground, NULL, &first);
    ref_line_begin(air, &line, y * (2 * air->ground + y), r * ray.mu, r * ray.mu_s, ray.nu);
    along(s, s->source, s->ground, &line, 32, lit_ground, later);
    for (int k = 0; k < REF_BANDS; k++)
        radiance[k] = first.radiance[k] + air->world.atmosphere->irradiance[k] * later[k];
    return status;
}
