/// The coarse map of the light: a few orders of scattering, the later ones as if the source were isotropic.
#include <math.h>
#include <pthread.h>
#include <stdlib.h>

#include "guide.h"

#define PI 3.14159265358979323846

enum { LIT_CELLS = 6, DARK_CELLS = 3 };

static double sun_axis(double mu_s) {
    const double u = mu_s + 0.05;
    return u / (0.3 + fabs(u));
}

// The axis' ends: mu_s = -1 and 1.
#define AXIS_LOW  (-0.95 / 1.25)
#define AXIS_HIGH (1.05 / 1.35)

static double sun_at(double place) {
    const double w = AXIS_LOW + (AXIS_HIGH - AXIS_LOW) * place / GUIDE_SUNS;
    const double u = w >= 0 ? 0.3 * w / (1 - w) : 0.3 * w / (1 + w);
    return fmax(-1, fmin(1, u - 0.05));
}

static double sun_place(double mu_s) {
    const double x = (sun_axis(mu_s) - AXIS_LOW) * (GUIDE_SUNS / (AXIS_HIGH - AXIS_LOW));
    return fmax(0, fmin(GUIDE_SUNS, x));
}

void ref_guide_mean(const ref_guide *g, double height01, double mu_s, double mean[REF_BANDS]) {
    const double x = height01 * GUIDE_HEIGHTS, y = sun_place(mu_s);
    const int i = (int)x < GUIDE_HEIGHTS ? (int)x : GUIDE_HEIGHTS - 1,
              j = (int)y < GUIDE_SUNS ? (int)y : GUIDE_SUNS - 1;
    const double f = x - i, h = y - j;
    const double *low = g->mean + (i * (GUIDE_SUNS + 1) + j) * REF_BANDS, *high = low + (GUIDE_SUNS + 1) * REF_BANDS;
    for (int k = 0; k < REF_BANDS; k++)
        mean[k] =
            (1 - f) * ((1 - h) * low[k] + h * low[REF_BANDS + k]) + f * ((1 - h) * high[k] + h * high[REF_BANDS + k]);
}

ref_outlook ref_guide_outlook(const ref_guide *g, const ref_air *air, double e, double mu_s) {
    ref_outlook o = {.mu_s = mu_s, .sin_s = sqrt(fmax(0, 1 - mu_s * mu_s))};
    const double r = sqrt(air->ground * air->ground + e), y = fmax(0, e) / (air->ground + r);
    const int i = (int)fmin(GUIDE_HEIGHTS - 1, sqrt(y / air->top_km) * GUIDE_HEIGHTS);
    const int j = (int)fmin(GUIDE_SUNS - 1, sun_place(mu_s));
    o.horizon = -sqrt(fmax(0, e)) / r;
    o.cell = g->glow + (i * GUIDE_SUNS + j) * (GUIDE_POLARS * GUIDE_TURNS);
    return o;
}

const ref_glow *ref_guide_glow(const ref_outlook *o, double mu, double nu) {
    const double t = mu > o->horizon ? sqrt((mu - o->horizon) / (1 - o->horizon))
                                     : sqrt((o->horizon - mu) / (1 + o->horizon + 1e-12));
    const int polar = mu > o->horizon ? GUIDE_BELOW + (int)fmin(GUIDE_ABOVE - 1, t * GUIDE_ABOVE)
                                      : GUIDE_BELOW - 1 - (int)fmin(GUIDE_BELOW - 1, t * GUIDE_BELOW);
    const double sines = o->sin_s * sqrt(fmax(0, 1 - mu * mu));
    const double turn = sines > 1e-6 ? (nu - mu * o->mu_s) / sines : 0;
    const double x = sqrt(fmax(0, 0.5 * (1 - turn))); // sine of half the azimuth
    return o->cell + polar * GUIDE_TURNS + (int)fmin(GUIDE_TURNS - 1, x * GUIDE_TURNS);
}

// Middle of a cell of directions, and the cell's share of the sphere.
static void direction(double horizon, int polar, int turn, double *mu, double *cos_turn, double *share) {
    const int above = polar >= GUIDE_BELOW;
    const double n = above ? GUIDE_ABOVE : GUIDE_BELOW, i = above ? polar - GUIDE_BELOW : GUIDE_BELOW - 1 - polar;
    const double size = above ? 1 - horizon : 1 + horizon, t = (i + 0.5) / n;
    *mu = above ? horizon + size * t * t : horizon - size * t * t;
    const double x = (turn + 0.5) / GUIDE_TURNS;
    *cos_turn = 1 - 2 * x * x;
    const double a = asin((double)turn / GUIDE_TURNS), b = asin((turn + 1.0) / GUIDE_TURNS);
    *share = size * (2 * i + 1) / (n * n) / 2 * (b - a) / (PI / 2);
}

typedef struct build {
    ref_guide *guide;
    const ref_air *air;
    double *next; // means of this pass
    int pass, first, step;
} build;

static void look(const build *b, const ref_line *l, ref_glow *glow) {
    const ref_air *air = b->air;
    double edges[REF_CELLS_MAX], smooth[REF_BANDS] = {0}, aerosol[REF_BANDS] = {0}, mean[REF_BANDS] = {0};
    const double rayleigh = ref_phase_rayleigh(l->nu);
    const int n = ref_line_cells(air, l, LIT_CELLS, DARK_CELLS, edges);
    for (int i = 0; i < n; i++) {
        ref_point q;
        ref_line_at(air, l, 0.5 * (edges[i] + edges[i + 1]), &q);
        if (b->pass > 0)
            ref_guide_mean(b->guide, q.height01, q.mu_s, mean);
        for (int k = 0; k < REF_BANDS; k++) {
            const double t = (edges[i + 1] - edges[i]) * exp(-q.depth[k]), sun = q.lit ? exp(-q.sun[k]) : 0;
            smooth[k] += t * (q.rayleigh[k] * rayleigh * sun + (q.rayleigh[k] + q.aerosol[k]) * mean[k]);
            aerosol[k] += t * q.aerosol[k] * sun;
        }
    }
    if (l->ground) {
        double depth[REF_BANDS], sun[REF_BANDS];
        const double mu_s = (l->b_sun + l->length * l->nu) / air->ground;
        ref_line_end(air, l, depth);
        ref_air_sun(air, mu_s, sun);
        if (b->pass > 0)
            ref_guide_mean(b->guide, 0, mu_s, mean);
        for (int k = 0; k < REF_BANDS; k++)
            smooth[k] += exp(-depth[k]) * air->albedo[k] * (mean[k] + (mu_s > 0 ? mu_s / PI * exp(-sun[k]) : 0));
    }
    for (int k = 0; k < REF_BANDS; k++) {
        glow->smooth[k] = (float)smooth[k];
        glow->aerosol[k] = (float)aerosol[k];
    }
}

// All directions around one place; the mean of what comes in.
static void gather(const build *b, double height01, double mu_s, ref_glow *glows, double mean[REF_BANDS]) {
    const ref_air *air = b->air;
    const double y = air->top_km * height01 * height01, e = y * (2 * air->ground + y), r = air->ground + y;
    const double horizon = -sqrt(e) / r, sin_s = sqrt(fmax(0, 1 - mu_s * mu_s));
    for (int k = 0; k < REF_BANDS; k++)
        mean[k] = 0;
    for (int p = 0; p < GUIDE_POLARS; p++)
        for (int a = 0; a < GUIDE_TURNS; a++) {
            double mu, turn, share;
            direction(horizon, p, a, &mu, &turn, &share);
            const double nu = fmax(-1, fmin(1, mu * mu_s + sqrt(fmax(0, 1 - mu * mu)) * sin_s * turn));
            ref_line line;
            ref_glow glow;
            ref_line_begin(air, &line, e, r * mu, r * mu_s, nu);
            look(b, &line, &glow);
            if (glows)
                glows[p * GUIDE_TURNS + a] = glow;
            const double phase = ref_phase_aerosol(air->world.atmosphere, 1 - nu, 1 + nu);
            for (int k = 0; k < REF_BANDS; k++)
                mean[k] += share * ((double)glow.smooth[k] + fmin(phase, 1) * (double)glow.aerosol[k]);
        }
}

static void *pass(void *user) {
    const build *b = user;
    const int last = b->pass == 2, heights = GUIDE_HEIGHTS + !last, suns = GUIDE_SUNS + !last;
    for (int n = b->first; n < heights * suns; n += b->step) {
        const int i = n / suns, j = n % suns;
        const double half = last ? 0.5 : 0;
        double unused[REF_BANDS];
        if (last)
            gather(b, (i + half) / GUIDE_HEIGHTS, sun_at(j + half), b->guide->glow + n * (GUIDE_POLARS * GUIDE_TURNS),
                   unused);
        else
            gather(b, (double)i / GUIDE_HEIGHTS, sun_at(j), NULL, b->next + (i * (GUIDE_SUNS + 1) + j) * REF_BANDS);
    }
    return NULL;
}

static void run(build *b, int number, int threads) {
    enum { MOST = 64 };
    pthread_t thread[MOST];
    build part[MOST];
    threads = threads < 1 ? 1 : threads > MOST ? MOST : threads;
    int started = 1;
    for (int i = 0; i < threads; i++) {
        part[i] = *b;
        part[i].pass = number;
        part[i].first = i;
        part[i].step = threads;
    }
    while (started < threads && pthread_create(&thread[started], NULL, pass, &part[started]) == 0)
        started++;
    for (int i = started; i < threads; i++)
        pass(&part[i]);
    pass(&part[0]);
    for (int i = 1; i < started; i++)
        pthread_join(thread[i], NULL);
}

// The first two orders' ratio stands for all later ones; nothing is quite dark.
static void extrapolate(double *mean, const double *next, int n) {
    double most = 0;
    for (int i = 0; i < n; i++) {
        const double first = mean[i], second = next[i] - first;
        const double ratio = first > 0 ? fmin(0.9, fmax(0, second / first)) : 0.9;
        mean[i] = first > 0 ? fmax(next[i], first / (1 - ratio)) : next[i];
        most = fmax(most, mean[i]);
    }
    for (int i = 0; i < n; i++)
        mean[i] = fmax(mean[i], 1e-9 * most + 1e-30);
}

int ref_guide_make(ref_guide *g, const ref_air *air, int threads) {
    const int n = (GUIDE_HEIGHTS + 1) * (GUIDE_SUNS + 1) * REF_BANDS;
    *g = (ref_guide){0};
    g->mean = calloc((size_t)n, sizeof *g->mean);
    g->glow = calloc((size_t)GUIDE_HEIGHTS * GUIDE_SUNS * GUIDE_POLARS * GUIDE_TURNS, sizeof *g->glow);
    double *next = calloc((size_t)n, sizeof *next);
    if (!g->mean || !g->glow || !next) {
        free(next);
        ref_guide_free(g);
        return -1;
    }
    build b = {.guide = g, .air = air, .next = g->mean};
    run(&b, 0, threads);
    b.next = next;
    run(&b, 1, threads);
    extrapolate(g->mean, next, n);
    run(&b, 2, threads);
    free(next);
    return 0;
}

void ref_guide_free(ref_guide *g) {
    free(g->mean);
    free(g->glow);
    *g = (ref_guide){0};
}
