/// The path tracer of the reference against laws and closed forms: energy, thin air, plane slabs, and a plain tracer.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "paths.h"
#include "random.h"
#include "reference_air.h"

static ref_tracer tracer;
static ref_view view;

// With coarser tables than ref_tracer_make() has, which are made in a quarter of the time.
static void make(const ref_atmosphere *a) {
    assert_int_equal(ref_air_make(&tracer.air, a, 512, 128, 2), 0);
    assert_int_equal(ref_guide_make(&tracer.guide, &tracer.air, 2), 0);
}

// As many times the air, over ground of this albedo.
static ref_atmosphere earth_of(double times, double albedo) {
    ref_atmosphere a = earth();
    a.g = 0.7;
    for (int k = 0; k < 4; k++) {
        a.albedo[k] = albedo;
        a.rayleigh_scattering[k] *= times;
        a.aerosol_scattering[k] *= times;
        a.aerosol_extinction[k] *= times;
        a.ozone_absorption[k] *= times;
    }
    return a;
}

// The known answers that [Salmon11] ship with Random123.
static void philox_is_philox(void **state) {
    (void)state;
    static const uint32_t key[3][2] = {{0, 0}, {~0u, ~0u}, {0xa4093822u, 0x299f31d0u}};
    static const uint32_t counter[3][4] = {
        {0, 0, 0, 0}, {~0u, ~0u, ~0u, ~0u}, {0x243f6a88u, 0x85a308d3u, 0x13198a2eu, 0x03707344u}};
    static const uint32_t want[3][4] = {{0x6627e8d5u, 0xe169c58du, 0xbc57ac4cu, 0x9b00dbd8u},
                                        {0x408f276du, 0x41c83b0eu, 0xa20bc7c6u, 0x6d5451fdu},
                                        {0xd16cfe09u, 0x94fdccebu, 0x5001e420u, 0x24126ea1u}};
    for (int i = 0; i < 3; i++) {
        uint32_t got[4];
        ref_philox(key[i], counter[i], got);
        for (int j = 0; j < 4; j++)
            if (got[j] != want[i][j])
                fail_msg("philox case %d word %d: got %08x, want %08x", i, j, got[j], want[i][j]);
    }
}

// Seeds of scrambled sets.
static uint32_t spread(int n) {
    ref_random r = ref_random_start(4711, (uint64_t)n);
    return (uint32_t)(ref_uniform(&r) * 0x1p32);
}

// A scrambled batch has one point in each 64th of every axis, and in each 8 by 8 cell of the first two.
static void batches_are_spread_evenly(void **state) {
    (void)state;
    int one[4][REF_BATCH] = {{0}}, two[8][8] = {{0}};
    for (uint32_t i = 0; i < REF_BATCH; i++) {
        double u[4];
        for (int d = 0; d < 4; d++) {
            u[d] = ref_sobol(i, d, spread(d));
            one[d][(int)(u[d] * REF_BATCH)]++;
        }
        two[(int)(u[0] * 8)][(int)(u[1] * 8)]++;
    }
    for (int i = 0; i < REF_BATCH; i++) {
        for (int d = 0; d < 4; d++)
            assert_int_equal(one[d][i], 1);
        assert_int_equal(two[i / 8][i % 8], 1);
    }
}

// Table against the reference's own integral, as transmittance: what the paths' weights see.
static void tables_agree_with_the_integral(void **state) {
    (void)state;
    ref_air air;
    ref_atmosphere airs[2] = {earth_of(1, 0), earth_of(1, 0)};
    airs[1].aerosol.scale_km = 0.1;
    for (int n = 0; n < 2; n++) {
        ref_random r = ref_random_start(5, (uint64_t)n);
        double worst = 0;
        assert_int_equal(ref_air_make(&air, &airs[n], REF_AIR_ROWS, REF_AIR_COLUMNS, 2), 0);
        for (int i = 0; i < 4000; i++) {
            const double u = ref_uniform(&r), h = 59.9 * u * u * u, dip = sqrt(2 * h / 6360);
            const double mu = i % 2 ? ref_uniform(&r) : (2 * ref_uniform(&r) - 1) * dip;
            const ref_ray ray = {h, mu, mu, 1, 0, 2, INFINITY};
            double column[3];
            ref_line line;
            ref_point q;
            ref_column(&airs[n], &ray, INFINITY, column);
            const double radius = 6360 + h;
            ref_line_begin(&air, &line, h * (2 * 6360 + h), radius * mu, radius * mu, 1);
            if (line.ground)
                continue;
            ref_line_at(&air, &line, 0, &q);
            for (int k = 0; k < 4; k++) {
                const ref_atmosphere *a = &airs[n];
                const double want = a->rayleigh_scattering[k] * column[0] + a->aerosol_extinction[k] * column[1] +
                                    a->ozone_absorption[k] * column[2];
                worst = fmax(worst, fabs(exp(-q.sun[k]) - exp(-want)));
            }
        }
        printf("figure: tables of the path tracer, aerosol scale height %g km: transmittance wrong by at most %.1e\n",
               airs[n].aerosol.scale_km, worst);
        // A tenth of the smallest standard error that is asked of it (0.2 %).
        check_at_most("transmittance from the table", worst, 2e-4);
        ref_air_free(&air);
    }
}

// Light that was scattered twice goes with the square of the density.
static void thin_air_scatters_once(void **state) {
    (void)state;
    static const double angles[4][3] = {{30, 60, 100}, {70, 85, 10}, {85, 20, 150}, {88, 110, 60}};
    double later[2][4] = {{0}};
    for (int n = 0; n < 2; n++) {
        const ref_atmosphere a = earth_of(n ? 1e-4 : 1e-3, 0);
        make(&a);
        for (int i = 0; i < 4; i++) {
            ref_tally t = {0};
            double radiance[4], error[4];
            if (ref_view_make(&view, &tracer, i, angles[i][0], angles[i][1], angles[i][2], 0, 1) != 0)
                fail_msg("case %d: first order did not converge", i);
            while (t.batches < 200)
                ref_view_batch(&view, &t);
            ref_view_result(&view, &t, radiance, error);
            later[n][i] = radiance[0] / view.single[0] - 1;
        }
        ref_tracer_free(&tracer);
    }
    for (int i = 0; i < 4; i++) {
        printf("figure: air thinned to 1e-4, case %d: later orders %.1e of the first\n", i, later[1][i]);
        check_at_most("later orders in thin air", later[1][i], 1e-3);
        // Linear but for the third order (1e-3 times a few) and the noise of both (1 % each).
        check_near("ten times the density, ten times the share", later[0][i] / later[1][i], 10, 0.6);
    }
}

// Flux that the limb lets through untouched, over the sun's flux on the disc of the top.
static double straight_through(const ref_atmosphere *a, int band) {
    enum { STEPS = 4000 };
    const double top = a->radius_km + a->top_km;
    double sum = 0;
    for (int i = 0; i < STEPS; i++) {
        const double h = a->top_km * (i + 0.5) / STEPS, p = a->radius_km + h;
        const ref_ray ray = {h, 0, 0, 1, 0, 2, INFINITY};
        double c[3];
        ref_column(a, &ray, INFINITY, c);
        const double depth = 2 * (a->rayleigh_scattering[band] * c[0] + a->aerosol_extinction[band] * c[1]);
        sum += 2 * p * exp(-depth) * a->top_km / STEPS;
    }
    return sum / (top * top);
}

// Air that absorbs nothing over white ground returns all: a quarter of the sun's flux per area of the top.
static void energy_is_conserved(void **state) {
    (void)state;
    enum { SETS = 12 };
    ref_atmosphere a = earth_of(1, 1);
    memcpy(a.aerosol_extinction, a.aerosol_scattering, sizeof a.aerosol_extinction);
    memset(a.ozone_absorption, 0, sizeof a.ozone_absorption);
    make(&a);
    double sum[4] = {0}, squares[4] = {0};
    for (int n = 0; n < SETS; n++) {
        double mean[4] = {0};
        for (uint32_t i = 0; i < 128; i++) {
            double u[3], radiance[4], error[4];
            ref_tally t = {0};
            for (int d = 0; d < 3; d++)
                u[d] = ref_sobol(i, d, spread(3 * n + d));
            const double deg = 180 / PI;
            if (ref_view_make(&view, &tracer, a.top_km, acos(2 * u[0] - 1) * deg, 180 - acos(sqrt(u[1])) * deg,
                              360 * u[2], 1, (uint64_t)n) != 0)
                fail_msg("set %d ray %u: first order did not converge", n, i);
            ref_view_batch(&view, &t);
            ref_view_result(&view, &t, radiance, error);
            for (int k = 0; k < 4; k++)
                mean[k] += 4 * PI * radiance[k] / 128;
        }
        for (int k = 0; k < 4; k++)
            sum[k] += mean[k] / SETS, squares[k] += mean[k] * mean[k] / SETS;
    }
    for (int k = 0; k < 4; k++) {
        const double through = straight_through(&a, k), error = sqrt((squares[k] - sum[k] * sum[k]) / (SETS - 1));
        printf("figure: energy, band %d: scattered %.4f + straight %.4f = %.4f of the sun's, standard error %.4f\n", k,
               sum[k], through, sum[k] + through, error);
        // The rays' directions are the noise: it must be small enough to tell, and the balance within it.
        check_at_most("standard error of the flux", error, 0.006);
        check_near("outgoing flux", sum[k] + through, 1, 3.5 * error);
    }
    ref_tracer_free(&tracer);
}

// A slab: 1 km on a planet of 600000 km, black below.
static ref_atmosphere slab(double g, const double depth[4], const double albedo[4]) {
    ref_atmosphere a = {.bands = 4, .radius_km = 6e5, .top_km = 1, .irradiance = {1, 1, 1, 1}, .g = g};
    a.phase = REF_HENYEY_GREENSTEIN;
    a.aerosol = uniform_profile();
    for (int k = 0; k < 4; k++) {
        a.aerosol_extinction[k] = depth[k];
        a.aerosol_scattering[k] = depth[k] * albedo[k];
    }
    return a;
}

// [vanDeHulst80] as [Wang95] quotes it: depth 2, albedo .9, Henyey-Greenstein .75, normal incidence: total reflection
// .09739, total transmission .66096 with what passes straight.
static void slab_of_van_de_hulst(void **state) {
    (void)state;
    enum { SETS = 8, RAYS = 96 };
    static const double depth[4] = {2, 2, 2, 2}, albedo[4] = {.9, .9, .9, .9}, want[2] = {.09739, .66096};
    const ref_atmosphere a = slab(.75, depth, albedo);
    make(&a);
    for (int below = 0; below < 2; below++) {
        double sum = 0, squares = 0;
        for (int n = 0; n < SETS; n++) {
            double mean = 0;
            for (uint32_t i = 0; i < RAYS; i++) {
                ref_tally t = {0};
                double radiance[4], error[4];
                const double down = acos(sqrt(ref_sobol(i, 0, spread(n)))) * 180 / PI;
                if (ref_view_make(&view, &tracer, below ? 0 : 1, 0, below ? down : 180 - down, 0, 0, (uint64_t)n) != 0)
                    fail_msg("ray %u: first order did not converge", i);
                while (t.batches < 2)
                    ref_view_batch(&view, &t);
                ref_view_result(&view, &t, radiance, error);
                mean += PI * radiance[0] / RAYS;
            }
            sum += mean / SETS, squares += mean * mean / SETS;
        }
        const double error = sqrt((squares - sum * sum) / (SETS - 1)), got = sum + (below ? exp(-2) : 0);
        printf("figure: slab, %s %.5f, table %.5f, standard error %.5f\n", below ? "transmission" : "reflection", got,
               want[below], error);
        check_at_most("standard error of a slab", error, 0.004 * want[below]);
        check_near("slab", got, want[below], 3.5 * error + 5e-6); // the table has five digits
    }
    ref_tracer_free(&tracer);
}

// Chandrasekhar's X and Y of an isotropic slab of depth t and albedo w, by their equations of growth [Chandrasekhar60]
// section 54: dX/dt = Y S, dY/dt = -Y/mu + X S, S = w/2 int Y dmu/mu, from X = Y = 1. Midpoints in sqrt(mu).
enum { NODES = 400 };
typedef struct functions {
    double mu[NODES], weight[NODES], x[NODES], y[NODES];
} functions;

static double growth(const functions *f, const double *y, double w) {
    double sum = 0;
    for (int i = 0; i < NODES; i++)
        sum += f->weight[i] / f->mu[i] * y[i];
    return w / 2 * sum;
}

// One step of the trapezoid rule, the decay exact.
static void grow(functions *f, double step, double w) {
    double x[NODES], y[NODES];
    const double first = growth(f, f->y, w);
    for (int i = 0; i < NODES; i++) {
        const double decay = exp(-step / f->mu[i]), filled = f->mu[i] * (1 - decay);
        x[i] = f->x[i] + step * f->y[i] * first;
        y[i] = f->y[i] * decay + filled * f->x[i] * first;
    }
    const double second = growth(f, y, w);
    for (int i = 0; i < NODES; i++) {
        const double decay = exp(-step / f->mu[i]), filled = f->mu[i] * (1 - decay);
        const double grown = f->y[i] * decay + filled * 0.5 * (f->x[i] * first + x[i] * second);
        f->x[i] += step * 0.5 * (f->y[i] * first + y[i] * second);
        f->y[i] = grown;
    }
}

static void solve_xy(functions *f, double depth, double w) {
    double x = 0, y = 0;
    for (int i = 0; i < NODES; i++) {
        const double u = (i + 0.5) / NODES;
        f->mu[i] = u * u;
        f->weight[i] = 2 * u / NODES;
        f->x[i] = f->y[i] = 1;
    }
    for (double t = 0; t < depth;) {
        const double step = fmin(depth - t, 1e-7 + 0.01 * t);
        grow(f, step, w);
        t = step < depth - t ? t + step : depth;
    }
    for (int i = 0; i < NODES; i++)
        x += w / 2 * f->weight[i] * f->x[i], y += w / 2 * f->weight[i] * f->y[i];
    // [Chandrasekhar60] section 58, theorem 3: int Psi X = 1 - sqrt(1 - 2 int Psi + (int Psi Y)^2).
    check_near("X and Y keep their integral", x, 1 - sqrt(1 - w + y * y), 2e-4);
}

// [Chandrasekhar60] section 60: reflected w/4 mu0/(mu + mu0) (X X0 - Y Y0), transmitted w/4 mu0/(mu - mu0) (Y X0 - X
// Y0) per flux pi F = 1, that is over pi.
static void slabs_of_chandrasekhar(void **state) {
    (void)state;
    static const double depth[4] = {1, 1, .25, 2}, albedo[4] = {.95, .5, .99, .8};
    static const int at[3] = {120, 250, 380};
    const ref_atmosphere a = slab(0, depth, albedo);
    static functions f[4];
    double worst = 0, z2 = 0;
    int count = 0;
    make(&a);
    for (int k = 0; k < 4; k++)
        solve_xy(&f[k], depth[k], albedo[k]);
    for (int n = 0; n < 18; n++) {
        const int below = n / 9, i = at[n / 3 % 3], j = at[n % 3];
        const double mu = f[0].mu[i], sun = f[0].mu[j], deg = 180 / PI;
        if (below && i == j)
            continue;
        ref_tally t = {0};
        double radiance[4], error[4];
        if (ref_view_make(&view, &tracer, below ? 0 : 1, acos(sun) * deg, below ? acos(mu) * deg : 180 - acos(mu) * deg,
                          33, 0, 3) != 0)
            fail_msg("case %d: first order did not converge", n);
        while (t.batches < 60)
            ref_view_batch(&view, &t);
        ref_view_result(&view, &t, radiance, error);
        for (int k = 0; k < 4; k++) {
            const double *x = f[k].x, *y = f[k].y;
            const double want =
                albedo[k] / (4 * PI) * sun *
                (below ? (y[i] * x[j] - x[i] * y[j]) / (mu - sun) : (x[i] * x[j] - y[i] * y[j]) / (mu + sun));
            const double z = (radiance[k] - want) / hypot(error[k], 2e-4 * want);
            worst = fmax(worst, fabs(radiance[k] / want - 1));
            z2 += z * z, count++;
            check_at_most("standard error of a slab's radiance", error[k], 0.02 * want);
            // The X and Y are good to 1e-4 (halving the nodes); four standard errors in 60 values.
            check_near("slab's radiance over Chandrasekhar's", radiance[k], want, 4.2 * hypot(error[k], 2e-4 * want));
        }
    }
    printf("figure: isotropic slabs against X and Y: at most %.2f %%, mean square of error over standard error %.2f\n",
           100 * worst, z2 / count);
    check_at_most("errors are what the standard errors say", z2 / count, 1.8);
    ref_tracer_free(&tracer);
}

// --- a plain tracer: delta tracking, phase functions sampled as they are, no tables, no guide ---

typedef struct plain {
    const ref_atmosphere *air;
    int band, lit;
    double sun[3];
    ref_random random;
} plain;

static double dot(const double *a, const double *b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static double sunlight(const plain *p, const double *x) {
    const ref_atmosphere *a = p->air;
    const double r = sqrt(dot(x, x)), mu = dot(x, p->sun) / r;
    double c[3];
    if (mu < 0 && r * r * (1 - mu * mu) < a->radius_km * a->radius_km)
        return 0;
    const ref_ray ray = {r - a->radius_km, mu, mu, 1, 0, 2, INFINITY};
    ref_column(a, &ray, INFINITY, c);
    return exp(-(a->rayleigh_scattering[p->band] * c[0] + a->aerosol_extinction[p->band] * c[1] +
                 a->ozone_absorption[p->band] * c[2]));
}

static void bend(plain *p, double *direction, double cosine) {
    const double turn = 2 * PI * ref_uniform(&p->random), sine = sqrt(fmax(0, 1 - cosine * cosine));
    const double *d = direction;
    double other[3] = {0}, x[3], y[3], out[3];
    other[fabs(d[0]) < 0.6 ? 0 : 1] = 1;
    for (int i = 0; i < 3; i++)
        x[i] = d[(i + 1) % 3] * other[(i + 2) % 3] - d[(i + 2) % 3] * other[(i + 1) % 3];
    const double size = sqrt(dot(x, x));
    for (int i = 0; i < 3; i++)
        x[i] /= size;
    for (int i = 0; i < 3; i++)
        y[i] = d[(i + 1) % 3] * x[(i + 2) % 3] - d[(i + 2) % 3] * x[(i + 1) % 3];
    for (int i = 0; i < 3; i++)
        out[i] = cosine * d[i] + sine * (cos(turn) * x[i] + sin(turn) * y[i]);
    memcpy(direction, out, sizeof out);
}

static double draw_cosine(plain *p, int aerosol) {
    const double g = p->air->g;
    for (;;) {
        double c = 2 * ref_uniform(&p->random) - 1;
        if (aerosol) {
            const double x = (1 - g * g) / (1 + g * c);
            c = (1 + g * g - x * x) / (2 * g);
        }
        if (2 * ref_uniform(&p->random) < 1 + c * c)
            return c;
    }
}

// Scattering coefficients at x; returns the extinction.
static double air_at(const plain *p, const double *x, double *rayleigh, double *aerosol) {
    const ref_atmosphere *a = p->air;
    const double h = sqrt(dot(x, x)) - a->radius_km, dust = ref_density(&a->aerosol, h);
    *rayleigh = a->rayleigh_scattering[p->band] * ref_density(&a->rayleigh, h);
    *aerosol = a->aerosol_scattering[p->band] * dust;
    return *rayleigh + a->aerosol_extinction[p->band] * dust + a->ozone_absorption[p->band] * ref_density(&a->ozone, h);
}

// Goes to the next collision. 1: air, 2: ground, 0: out.
static int fly(plain *p, double *x, const double *d, double *rayleigh, double *aerosol, double *extinction) {
    const ref_atmosphere *a = p->air;
    const double b = dot(x, d), rr = dot(x, x), top = a->radius_km + a->top_km, low = rr - a->radius_km * a->radius_km;
    const double most = a->rayleigh_scattering[p->band] + a->aerosol_extinction[p->band] + a->ozone_absorption[p->band];
    const int ground = b < 0 && b * b > low;
    const double end = ground ? -b - sqrt(b * b - low) : -b + sqrt(b * b + top * top - rr);
    for (double s = 0;;) {
        double at[3];
        s -= log(ref_uniform(&p->random)) / most;
        for (int i = 0; i < 3; i++)
            at[i] = x[i] + fmin(s, end) * d[i];
        if (s >= end) {
            memcpy(x, at, sizeof at);
            return ground ? 2 : 0;
        }
        *extinction = air_at(p, at, rayleigh, aerosol);
        if (ref_uniform(&p->random) * most < *extinction) {
            memcpy(x, at, sizeof at);
            return 1;
        }
    }
}

static double plain_path(plain *p, double *x, double *d) {
    double weight = 1, sum = 0, rayleigh, aerosol, extinction;
    for (int order = 0; order < 100; order++) {
        const int met = fly(p, x, d, &rayleigh, &aerosol, &extinction);
        if (met == 0 || (met == 2 && order == 0 && !p->lit))
            return sum;
        if (met == 2) {
            const double r = sqrt(dot(x, x));
            for (int i = 0; i < 3; i++)
                x[i] *= (1 + 1e-12) * p->air->radius_km / r;
            weight *= p->air->albedo[p->band];
            sum += weight / PI * fmax(0, dot(x, p->sun) / p->air->radius_km) * sunlight(p, x);
            for (int i = 0; i < 3; i++)
                d[i] = x[i] / p->air->radius_km;
            bend(p, d, sqrt(ref_uniform(&p->random)));
            continue;
        }
        const double nu = dot(d, p->sun), all = rayleigh + aerosol;
        if (!(all > 0))
            return sum;
        weight *= all / extinction;
        sum += weight * sunlight(p, x) *
               (rayleigh * ref_phase_rayleigh(nu) + aerosol * ref_phase_aerosol(p->air, 1 - nu, 1 + nu)) / all;
        bend(p, d, draw_cosine(p, ref_uniform(&p->random) * all >= rayleigh));
    }
    return sum;
}

static void a_plain_tracer_agrees(void **state) {
    (void)state;
    enum { PATHS = 6000 };
    static const double rays[6][4] = {{0, 40, 70, 30},   {2, 70, 95, 120},  {10, 60, 120, 60},
                                      {0.5, 30, 89, 90}, {30, 80, 100, 90}, {1, 88, 80, 150}};
    const ref_atmosphere a = earth_of(1, 0.3);
    double z2 = 0;
    make(&a);
    for (int n = 0; n < 6; n++) {
        const double *q = rays[n], rad = PI / 180;
        plain p = {.air = &a, .band = n % 2 ? 3 : 0, .lit = 1};
        double sum = 0, squares = 0, radiance[4], error[4];
        p.sun[0] = sin(q[1] * rad), p.sun[2] = cos(q[1] * rad);
        for (uint64_t i = 0; i < PATHS; i++) {
            double x[3] = {0, 0, 6360 + q[0]};
            double d[3] = {sin(q[2] * rad) * cos(q[3] * rad), sin(q[2] * rad) * sin(q[3] * rad), cos(q[2] * rad)};
            p.random = ref_random_start(1000 + (uint64_t)n, i);
            const double l = plain_path(&p, x, d);
            sum += l / PATHS, squares += l * l / PATHS;
        }
        const double plain_error = sqrt((squares - sum * sum) / PATHS);
        ref_tally t = {0};
        if (ref_view_make(&view, &tracer, q[0], q[1], q[2], q[3], 1, 1) != 0)
            fail_msg("ray %d: first order did not converge", n);
        while (t.batches < 100)
            ref_view_batch(&view, &t);
        ref_view_result(&view, &t, radiance, error);
        const double got = radiance[p.band], z = (got - sum) / hypot(plain_error, error[p.band]);
        printf("figure: ray %d: plain tracer %.4e +- %.1f %%, ours %.4e +- %.2f %%, apart by %.1f standard errors\n", n,
               sum, 100 * plain_error / sum, got, 100 * error[p.band] / got, z);
        check_at_most("standard error of the plain tracer", plain_error, 0.03 * sum);
        check_at_most("apart, in standard errors", fabs(z), 4);
        z2 += z * z;
    }
    check_at_most("mean square of errors over standard errors", z2 / 6, 3);
    ref_tracer_free(&tracer);
}

// Matter by another name: aerosol as dust, in halves, ozone as absorption of a gas.
static void names_of_matter_do_not_count(void **state) {
    (void)state;
    static const double rays[4][4] = {{0, 60, 40, 30}, {1, 80, 100, 90}, {0.2, 91, 80, 20}, {10, 50, 95, 120}};
    double light[3][4][4], error[3][4][4];
    for (int n = 0; n < 3; n++) {
        ref_atmosphere a = earth_of(1, 0.3);
        const double share = n == 0 ? 0 : n == 1 ? 0.5 : 1;
        a.dust = a.aerosol;
        a.dust_phase = a.phase;
        a.dust_g = a.g;
        a.ozone = a.rayleigh;
        for (int k = 0; k < 4; k++) {
            a.dust_scattering[k] = share * a.aerosol_scattering[k];
            a.dust_extinction[k] = share * a.aerosol_extinction[k];
            a.rayleigh_absorption[k] = share * a.ozone_absorption[k];
            a.aerosol_scattering[k] *= 1 - share;
            a.aerosol_extinction[k] *= 1 - share;
            a.ozone_absorption[k] *= 1 - share;
        }
        make(&a);
        for (int i = 0; i < 4; i++) {
            ref_tally t = {0};
            assert_int_equal(
                ref_view_make(&view, &tracer, rays[i][0], rays[i][1], rays[i][2], rays[i][3], 1, (uint64_t)n), 0);
            while (t.batches < 100)
                ref_view_batch(&view, &t);
            ref_view_result(&view, &t, light[n][i], error[n][i]);
            for (int k = 0; k < 4; k++) {
                check_at_most("standard error", error[n][i][k], 0.015 * light[n][i][k]);
                check_near("light of the same air by another name", light[n][i][k], light[0][i][k],
                           4.2 * hypot(error[n][i][k], error[0][i][k]));
            }
        }
        ref_tracer_free(&tracer);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(philox_is_philox),
        cmocka_unit_test(batches_are_spread_evenly),
        cmocka_unit_test(tables_agree_with_the_integral),
        cmocka_unit_test(thin_air_scatters_once),
        cmocka_unit_test(energy_is_conserved),
        cmocka_unit_test(slab_of_van_de_hulst),
        cmocka_unit_test(slabs_of_chandrasekhar),
        cmocka_unit_test(a_plain_tracer_agrees),
        cmocka_unit_test(names_of_matter_do_not_count),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
