/// Straight rays through the air. With E = h (2 R + h) = r^2 - R^2 small altitudes keep their digits.
#include <math.h>

#include "common.h"

static double energy(const baseline_air *air, double h) {
    return h * (2.0 * air->radius_km + h);
}

static double altitude_of(const baseline_air *air, double e) {
    return e > 0.0 ? e / (air->radius_km + sqrt(air->radius_km * air->radius_km + e)) : 0.0;
}

double baseline_altitude(const baseline_air *air, double h, double mu, double s) {
    const double r = air->radius_km + h;
    return altitude_of(air, energy(air, h) + s * (2.0 * r * mu + s));
}

int baseline_ray(const baseline_air *air, double h, double mu, double *length) {
    const double b = (air->radius_km + h) * mu;
    const double e = energy(air, h);
    const int ground = mu < 0.0 && b * b >= e;
    if (!length)
        return ground;
    if (ground) {
        *length = e / (-b + sqrt(b * b - e));
    } else {
        const double c = fmax(energy(air, air->top_km) - e, 0.0), root = sqrt(b * b + c);
        *length = b > 0.0 ? c / (b + root) : root - b;
    }
    return ground;
}

int baseline_enter(const baseline_air *air, double *h, double *mu, double *s) {
    *s = 0.0;
    if (*h <= air->top_km)
        return 1;
    const double r = air->radius_km + *h, b = r * *mu, c = energy(air, *h) - energy(air, air->top_km);
    if (*mu >= 0.0 || b * b <= c)
        return 0;
    *s = c / (-b + sqrt(b * b - c));
    *mu = fmax(-1.0, (b + *s) / (air->radius_km + air->top_km));
    *h = air->top_km;
    return 1;
}

double baseline_horizon(const baseline_air *air, double h) {
    return h > 0.0 ? -sqrt(energy(air, h)) / (air->radius_km + h) : 0.0;
}

void baseline_columns(const baseline_air *air, double h, double mu, double length, int steps, double column[]) {
    for (int i = 0; i < BASELINE_SPECIES; i++)
        column[i] = 0.0;
    for (int k = 0; k <= steps; k++) {
        const double weight = (k == 0 || k == steps ? 0.5 : 1.0) * length / steps;
        const double altitude = baseline_altitude(air, h, mu, length * k / steps);
        for (int i = 0; i < BASELINE_SPECIES; i++)
            if (air->profile[i].kind != SKV_PROFILE_NONE)
                column[i] += weight * baseline_density(air, i, fmin(altitude, air->top_km));
    }
}

/// Simpson's rule in t, s = length t^2: fine where the ray starts, at its lowest point.
static void upward(const baseline_air *air, double h, double mu, double weight, double column[]) {
    enum { STEPS = 128 };
    double length;
    (void)baseline_ray(air, h, mu, &length);
    for (int k = 1; k <= STEPS; k++) {
        const double t = (double)k / STEPS;
        const double w = weight * (k == STEPS ? 1.0 : k % 2 ? 4.0 : 2.0) / (3.0 * STEPS) * 2.0 * t * length;
        const double altitude = fmin(baseline_altitude(air, h, mu, length * t * t), air->top_km);
        for (int i = 0; i < BASELINE_SPECIES; i++)
            if (air->profile[i].kind != SKV_PROFILE_NONE)
                column[i] += w * baseline_density(air, i, altitude);
    }
}

void baseline_columns_to_top(const baseline_air *air, double h, double mu, double column[]) {
    for (int i = 0; i < BASELINE_SPECIES; i++)
        column[i] = 0.0;
    if (mu < 0.0) {
        const double e = energy(air, h), b = (air->radius_km + h) * mu;
        upward(air, altitude_of(air, e - b * b), 0.0, 2.0, column);
        upward(air, h, -mu, -1.0, column);
    } else {
        upward(air, h, mu, 1.0, column);
    }
    for (int i = 0; i < BASELINE_SPECIES; i++)
        column[i] = fmax(column[i], 0.0);
}

void baseline_transmit(const baseline_air *air, const double column[], double transmittance[4]) {
    for (int b = 0; b < 4; b++) {
        double depth = 0.0;
        for (int i = 0; b < air->bands && i < BASELINE_SPECIES; i++)
            depth += column[i] * air->extinction[i][b];
        transmittance[b] = b < air->bands ? exp(-depth) : 0.0;
    }
}
