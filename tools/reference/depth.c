/// Densities, their knots, and optical depths of the reference.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "inner.h"

// Gauss-Legendre abscissae and weights, positive half: Newton's method on the three-term recurrence in 50 digits.
static const double x6[3] = {0.932469514203152027812, 0.661209386466264513661, 0.238619186083196908630};
static const double w6[3] = {0.171324492379170345040, 0.360761573048138607569, 0.467913934572691047389};
static const double x16[8] = {0.989400934991649932596, 0.944575023073232576077, 0.865631202387831743880,
                              0.755404408355003033895, 0.617876244402643748446, 0.458016777657227386342,
                              0.281603550779258913230, 0.095012509837637440185};
static const double w16[8] = {0.027152459411754094851, 0.062253523938647892862, 0.095158511682492784809,
                              0.124628971255533872052, 0.149595988816576732081, 0.169156519395002538189,
                              0.182603415044923588866, 0.189450610455068496285};
static const double x24[12] = {0.995187219997021360179, 0.974728555971309498198, 0.938274552002732758523,
                               0.886415527004401034213, 0.820001985973902921953, 0.740124191578554364243,
                               0.648093651936975569252, 0.545421471388839535658, 0.433793507626045138487,
                               0.315042679696163374386, 0.191118867473616309158, 0.064056892862605626085};
static const double w24[12] = {0.012341229799987199546, 0.028531388628933663181, 0.044277438817419806168,
                               0.059298584915436780746, 0.073346481411080305734, 0.086190161531953275917,
                               0.097618652104113888269, 0.107444270115965634782, 0.115505668053725601353,
                               0.121670472927803391204, 0.125837456346828296121, 0.127938195346752156974};

static double table_density(const ref_profile *p, double h) {
    int low = 0, high = p->rows - 1;
    if (h <= p->table_km[low])
        return p->table_density[low];
    if (h >= p->table_km[high])
        return p->table_density[high];
    while (high - low > 1) {
        const int middle = (low + high) / 2;
        if (p->table_km[middle] <= h)
            low = middle;
        else
            high = middle;
    }
    const double t = (h - p->table_km[low]) / (p->table_km[high] - p->table_km[low]);
    return p->table_density[low] + t * (p->table_density[high] - p->table_density[low]);
}

static double lognormal(const ref_profile *p, double h) {
    if (h <= 0)
        return 0;
    const double peak = -0.5 / p->lognormal_k; // ln h - mu there
    const double d = log(h) - p->lognormal_mu;
    return exp(-p->lognormal_k * (d * d - peak * peak) - (d - peak));
}

double ref_density(const ref_profile *p, double h) {
    switch (p->kind) {
    case REF_EXPONENTIAL:
        return exp(-h / p->scale_km);
    case REF_EXP_BACKGROUND:
        return (exp(-h / p->scale_km) + p->background) / (1 + p->background);
    case REF_US76:
        return h <= 0 ? 1 : exp(-p->us76_a * pow(h, p->us76_b));
    case REF_TENT:
        return fmax(0, 1 - fabs(h - p->peak_km) / p->half_width_km);
    case REF_LOGNORMAL:
        return lognormal(p, h);
    case REF_TABLE:
        return table_density(p, h);
    default:
        return 0;
    }
}

static void knot(ref_world *w, double altitude_km, int kink) {
    const double y = altitude_km - w->atmosphere->ground_km;
    const double e = y * (2 * w->ground + y);
    if (!(y > 0) || !(e < w->top))
        return;
    w->piece[w->pieces++] = e;
    if (kink)
        w->kink[w->kinks++] = e;
}

// The lognormal's logarithm falls by about j^2 at exp(mu + j/sqrt(k)); us76 is h^b at 0, so its pieces shrink to 0.
static void knots_of(ref_world *w, const ref_profile *p) {
    const double ground = w->atmosphere->ground_km;
    if (p->kind == REF_EXPONENTIAL || p->kind == REF_EXP_BACKGROUND) {
        for (int j = 1; j <= 5; j++)
            knot(w, ground + 8 * j * p->scale_km, j == 1);
        w->smooth_km = fmin(w->smooth_km, 0.3 * p->scale_km);
    } else if (p->kind == REF_US76) {
        static const double step[] = {0, 1e-3, 0.01, 0.1, 1, 6, 12, 18, 24, 30, 36};
        for (int j = 0; j < 11; j++)
            knot(w, pow(step[j] / p->us76_a, 1 / p->us76_b), j == 0);
        w->smooth_km = 0;
    } else if (p->kind == REF_TENT) {
        for (int j = -1; j <= 1; j++)
            knot(w, p->peak_km + j * p->half_width_km, 1);
    } else if (p->kind == REF_LOGNORMAL) {
        for (int j = -6; j <= 6; j++)
            knot(w, exp(p->lognormal_mu - 0.5 / p->lognormal_k + j / sqrt(p->lognormal_k)),
                 j == -3 || j == 0 || j == 3);
        w->smooth_km = 0;
    } else if (p->kind == REF_TABLE) {
        // Many small kinks are left to the adaptive view integral; optical depths are cut at each.
        for (int j = 0; j < p->rows; j++)
            knot(w, p->table_km[j], p->rows <= 24);
    }
}

static int ascending(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

void ref_world_make(ref_world *w, const ref_atmosphere *a, int nodes) {
    w->atmosphere = a;
    w->ground = a->radius_km + a->ground_km;
    const double y = a->top_km - a->ground_km;
    w->top = y * (2 * w->ground + y);
    w->nodes = nodes;
    w->smooth_km = 1e9;
    w->pieces = w->kinks = 0;
    knots_of(w, &a->rayleigh);
    knots_of(w, &a->aerosol);
    knots_of(w, &a->ozone);
    knots_of(w, &a->dust);
    qsort(w->piece, (size_t)w->pieces, sizeof *w->piece, ascending);
    qsort(w->kink, (size_t)w->kinks, sizeof *w->kink, ascending);
}

double ref_height(const ref_world *w, double e) {
    return e / (w->ground + sqrt(w->ground * w->ground + e));
}

static void sample(const ref_world *w, double e, double weight, double column[REF_SPECIES]) {
    const ref_atmosphere *a = w->atmosphere;
    const double h = ref_height(w, e) + a->ground_km;
    column[0] += weight * ref_density(&a->rayleigh, h);
    column[1] += weight * ref_density(&a->aerosol, h);
    column[2] += weight * ref_density(&a->ozone, h);
    column[3] += weight * ref_density(&a->dust, h);
}

static void piece(const ref_world *w, double e, double b, double s0, double s1, double column[REF_SPECIES]) {
    const double *x = w->nodes == 24 ? x24 : x16, *weight = w->nodes == 24 ? w24 : w16;
    int half = w->nodes / 2;
    const double rise = (s1 - s0) * (2 * b + s0 + s1) / (2 * w->ground);
    if (rise < w->smooth_km && s1 - s0 < 0.3 * w->ground && w->nodes == 16)
        x = x6, weight = w6, half = 3;
    const double middle = 0.5 * (s0 + s1), radius = 0.5 * (s1 - s0);
    for (int i = 0; i < half; i++) {
        const double p = middle + radius * x[i], m = middle - radius * x[i];
        sample(w, e + p * (2 * b + p), radius * weight[i], column);
        sample(w, e + m * (2 * b + m), radius * weight[i], column);
    }
}

// A stretch that never descends: b >= 0.
static void rising(const ref_world *w, double e, double b, double length, double column[REF_SPECIES]) {
    double s = 0;
    for (int i = 0; i < w->pieces; i++) {
        const double c = w->piece[i] - e;
        if (!(c > 0))
            continue;
        const double at = c / (b + sqrt(b * b + c));
        if (at >= length)
            break;
        if (at > s)
            piece(w, e, b, s, at, column);
        s = fmax(s, at);
    }
    if (length > s)
        piece(w, e, b, s, length, column);
}

void ref_stretch(const ref_world *w, double e, double b, double length, double column[REF_SPECIES]) {
    if (!(length > 0))
        return;
    if (b >= 0) {
        rising(w, e, b, length, column);
    } else if (length <= -b) {
        rising(w, e + length * (2 * b + length), -(b + length), length, column);
    } else {
        rising(w, e - b * b, 0, -b, column);
        rising(w, e - b * b, 0, length + b, column);
    }
}

double ref_to_top(const ref_world *w, double e, double b) {
    const double c = fmax(0, w->top - e), root = sqrt(b * b + c);
    return b > 0 ? c / (b + root) : root - b;
}
