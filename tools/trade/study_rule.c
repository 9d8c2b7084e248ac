/// The rule gauss-exp once more, in double, with exact columns and with or without its splits.
#include "study_rule.h"

#include <math.h>

enum { PARTS_MAX = 4, SAMPLES_MAX = 16 };

/// A piece of the ray that is mapped by itself; from the observer, km.
typedef struct part {
    double from, to;
} part;

typedef struct line {
    double r, mu, mu_s, nu, sine2; ///< sine2: 1 - nu^2
    double ground, top, end;
    double tangent;            ///< where it is nearest to the ground; 0: at the observer
    int hits;                  ///< ends on the ground
    double dark_from, dark_to; ///< in the planet's shadow; equal: nowhere
} line;

static double height_at(const line *l, double s) {
    const double e = (l->r - l->ground) * (l->r + l->ground) + s * (2 * l->r * l->mu + s);
    return fmax(e / (l->ground + sqrt(l->ground * l->ground + fmax(e, 0))), 0);
}

/// The half cylinder behind the planet meets a line in one piece.
static void find_shadow(line *l) {
    const double b = l->r * (l->mu - l->mu_s * l->nu), across = l->r * sqrt(fmax(1 - l->mu_s * l->mu_s, 0)),
                 c = (across - l->ground) * (across + l->ground), q = b * b - l->sine2 * c;
    l->dark_from = l->dark_to = 0;
    if (q <= 0 || l->sine2 < 1e-14)
        return;
    double from = (-b - sqrt(q)) / l->sine2, to = (-b + sqrt(q)) / l->sine2;
    const double level = -l->r * l->mu_s / l->nu; // where the sun is level
    if (l->nu > 0)
        to = fmin(to, level);
    else
        from = fmax(from, level);
    from = fmax(from, 0);
    to = fmin(to, l->end);
    if (to > from)
        l->dark_from = from, l->dark_to = to;
}

static line begin(const ref_atmosphere *air, const ref_ray *ray) {
    const double ground = air->radius_km + air->ground_km, top = air->radius_km + air->top_km;
    line l = {.r = ground + fmax(ray->height_km, 0), .mu = ray->mu, .mu_s = ray->mu_s, .nu = ray->nu};
    l.ground = ground;
    l.top = top;
    l.sine2 = ray->nu_minus * ray->nu_plus;
    const double b = l.r * l.mu, down = b * b - (l.r - ground) * (l.r + ground);
    l.hits = l.mu < 0 && down >= 0;
    l.end = l.hits ? -b - sqrt(down) : -b + sqrt(b * b + (top - l.r) * (top + l.r));
    l.tangent = l.mu < 0 && !l.hits ? -b : 0;
    find_shadow(&l);
    return l;
}

static int cut(const part *from, int n, double at, part *to) {
    int made = 0;
    for (int i = 0; i < n; i++) {
        const int inside = at > from[i].from && at < from[i].to;
        to[made++] = (part){from[i].from, inside ? at : from[i].to};
        if (inside)
            to[made++] = (part){at, from[i].to};
    }
    return made;
}

/// Pieces between the cuts, those in the dark left out.
static int lay_parts(const line *l, const study_rule *rule, part out[PARTS_MAX]) {
    part a[PARTS_MAX] = {{0, l->end}}, b[PARTS_MAX];
    int n = 1, kept = 0;
    if (rule->tangent_split)
        n = cut(a, n, l->tangent, b);
    else
        b[0] = a[0];
    if (rule->shadow_split && l->dark_to > l->dark_from) {
        n = cut(b, n, l->dark_from, a);
        n = cut(a, n, l->dark_to, b);
    }
    for (int i = 0; i < n; i++) {
        const double middle = 0.5 * (b[i].from + b[i].to);
        if (!rule->shadow_split || !(middle > l->dark_from && middle < l->dark_to))
            out[kept++] = b[i];
    }
    return kept;
}

/// Altitude scale of the map against the sun's height, 6 km by day to 14 km in twilight.
static double map_scale(double mu_s) {
    const double x = fmin(fmax((0.2 - mu_s) * 2.5, 0), 1);
    return 6 + 8 * x * x * (3 - 2 * x);
}

/// Extinction of the densest band, 1/km, the gas' own and the haze's.
static double extinction(const ref_atmosphere *air, double height_km) {
    double most = 0;
    const double r = ref_density(&air->rayleigh, height_km + air->ground_km),
                 a = ref_density(&air->aerosol, height_km + air->ground_km);
    for (int b = 0; b < air->bands; b++)
        most = fmax(most,
                    r * (air->rayleigh_scattering[b] + air->rayleigh_absorption[b]) + a * air->aerosol_extinction[b]);
    return most;
}

/// One sample of path length ds at s.
static void add_sample(const ref_atmosphere *air, const line *l, const ref_ray *ray, double s, double ds,
                       double radiance[REF_BANDS]) {
    double seen[3], lit[3];
    if (s > l->dark_from && s < l->dark_to)
        return;
    const double height = height_at(l, s), radius = l->ground + height;
    ref_ray sun = {.height_km = height, .mu = fmin(fmax((l->r * l->mu_s + s * l->nu) / radius, -1), 1)};
    sun.mu_s = sun.mu;
    sun.nu = 1;
    sun.nu_plus = 2;
    // At the shadow's very edge rounding may let the sun's ray touch the ground.
    const double graze = -sqrt(fmax(1 - (l->ground / radius) * (l->ground / radius), 0));
    sun.mu = fmax(sun.mu, graze * (1 - 1e-12));
    const double past = -radius * sun.mu;
    ref_column(air, &sun, past + sqrt(past * past + (l->top - radius) * (l->top + radius)), lit);
    ref_column(air, ray, s, seen);
    const double sea = height + air->ground_km, rayleigh = ref_density(&air->rayleigh, sea) * ref_phase_rayleigh(l->nu),
                 aerosol = ref_density(&air->aerosol, sea) * ref_phase_aerosol(air, ray->nu_minus, ray->nu_plus);
    for (int b = 0; b < air->bands; b++) {
        const double depth = (air->rayleigh_scattering[b] + air->rayleigh_absorption[b]) * (lit[0] + seen[0]) +
                             air->aerosol_extinction[b] * (lit[1] + seen[1]) +
                             air->ozone_absorption[b] * (lit[2] + seen[2]);
        radiance[b] += air->irradiance[b] * ds * exp(-depth) *
                       (air->rayleigh_scattering[b] * rayleigh + air->aerosol_scattering[b] * aerosol);
    }
}

/// Nodes and weights on [0, 1] by Newton's method on the Legendre polynomial.
static void gauss(int n, double node[SAMPLES_MAX], double weight[SAMPLES_MAX]) {
    for (int i = 0; i < n; i++) {
        double x = cos(3.14159265358979323846 * (i + 0.75) / (n + 0.5)), slope = 1;
        for (int round = 0; round < 40; round++) {
            double p = 1, before = 0;
            for (int k = 1; k <= n; k++) {
                const double next = ((2 * k - 1) * x * p - (k - 1) * before) / k;
                before = p;
                p = next;
            }
            slope = n * (before - x * p) / (1 - x * x);
            x -= p / slope;
        }
        node[i] = 0.5 * (1 - x);
        weight[i] = 1 / ((1 - x * x) * slope * slope);
    }
}

int study_rule_radiance(const ref_atmosphere *air, const study_rule *rule, const ref_ray *ray,
                        double radiance[REF_BANDS]) {
    const line l = begin(air, ray);
    part parts[PARTS_MAX];
    double node[SAMPLES_MAX], weight[SAMPLES_MAX];
    const int n = lay_parts(&l, rule, parts);
    gauss(rule->samples, node, weight);
    for (int b = 0; b < REF_BANDS; b++)
        radiance[b] = 0;
    for (int i = 0; i < n; i++) {
        const double from = parts[i].from, to = parts[i].to, high = height_at(&l, from), low = height_at(&l, to);
        const int back = low < high; // mapped from its densest end
        const double at = back ? to : from, radius = l.ground + fmin(high, low), way = back ? -1 : 1;
        const double mu = way * (l.r * l.mu + at) / radius, scale = map_scale((l.r * l.mu_s + at * l.nu) / radius);
        const double slope = (mu / 2 + sqrt(mu * mu / 4 + scale / (2 * radius))) / scale,
                     length = 1 / (slope + 0.15 * extinction(air, radius - l.ground)), k = log1p((to - from) / length);
        for (int j = 0; j < rule->samples; j++) {
            const double grown = exp(k * node[j]);
            add_sample(air, &l, ray, at + way * length * (grown - 1), weight[j] * k * length * grown, radiance);
        }
    }
    return n * rule->samples;
}
