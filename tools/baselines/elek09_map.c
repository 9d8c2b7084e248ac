/// Coordinates of [Elek09]'s tables.
#include "elek09.h"

/// U = sqrt((r^2 - R^2)/(R_top^2 - R^2)) of radii, here by r^2 - R^2 = h (2 R + h).
double elek_u(const baseline_air *air, double altitude_km) {
    const double h = fmin(fmax(altitude_km, 0.0), air->top_km), twice = 2.0 * air->radius_km;
    return sqrt(h * (twice + h) / (air->top_km * (twice + air->top_km)));
}

double elek_u_inverse(const baseline_air *air, double u) {
    const double e = u * u * air->top_km * (2.0 * air->radius_km + air->top_km);
    return e / (air->radius_km + sqrt(air->radius_km * air->radius_km + e));
}

double elek_v(double mu) {
    return 0.5 * (1.0 + mu);
}

double elek_v_inverse(double v) {
    return 2.0 * v - 1.0;
}

/// W = (1 - exp(-2.8 mu_s - .8))/(1 - exp(-3.6)).
double elek_w(double mu_s) {
    return (1.0 - exp(-2.8 * mu_s - 0.8)) / (1.0 - exp(-3.6));
}

double elek_w_inverse(double w) {
    return fmin((-0.8 - log(1.0 - w * (1.0 - exp(-3.6)))) / 2.8, 1.0);
}

static int corner(double x, int n, float *share) {
    const double at = fmin(fmax(x, 0.0), 1.0) * (n - 1);
    const int i = at < n - 2 ? (int)at : n - 2;
    *share = (float)(at - i);
    return i;
}

int elek_cell_u(const baseline_air *air, int literal, double altitude_km, float *share) {
    return corner(literal ? 0.0 : elek_u(air, altitude_km), ELEK_U, share);
}

int elek_cell_v(double mu, float *share) {
    return corner(elek_v(mu), ELEK_V, share);
}

int elek_cell_w(int literal, double mu_s, float *share) {
    const double w = elek_w(mu_s);
    return corner(literal && w < 0.0 ? w - floor(w) : w, ELEK_W, share);
}

void elek_corners_of(const baseline_air *air, int literal, double altitude_km, double mu, double mu_s,
                     elek_corners *at) {
    float tu, tv, tw;
    const size_t u = (size_t)elek_cell_u(air, literal, altitude_km, &tu);
    const size_t v = (size_t)elek_cell_v(mu, &tv), w = (size_t)elek_cell_w(literal, mu_s, &tw);
    for (size_t c = 0; c < 8; c++) {
        at->cell[c] = ((u + c / 4) * ELEK_W + w + c / 2 % 2) * ELEK_V + v + c % 2;
        at->share[c] = (c / 4 ? tu : 1.0f - tu) * (c / 2 % 2 ? tw : 1.0f - tw) * (c % 2 ? tv : 1.0f - tv);
    }
}
