/// Phase functions, 1/sr.
#include <math.h>

#include "common.h"

double baseline_phase_rayleigh(double c) {
    return 3.0 / (16.0 * BASELINE_PI) * (1.0 + c * c);
}

/// 1 + g^2 - 2 g c, without cancellation for sharp peaks.
static double denominator(double g, double c) {
    const double a = fabs(g), d = g < 0.0 ? 1.0 + c : 1.0 - c;
    return (1.0 - a) * (1.0 - a) + 2.0 * a * d;
}

double baseline_phase_hg(double g, double c) {
    const double d = denominator(g, c);
    return (1.0 - g * g) / (4.0 * BASELINE_PI * d * sqrt(d));
}

double baseline_phase_cs(double g, double c) {
    return baseline_phase_hg(g, c) * 1.5 * (1.0 + c * c) / (2.0 + g * g);
}

double baseline_phase(const baseline_air *air, int species, double c) {
    if (species == GAS)
        return baseline_phase_rayleigh(c);
    return air->phase[species] == SKV_PHASE_HG ? baseline_phase_hg(air->g[species], c)
                                               : baseline_phase_cs(air->g[species], c);
}
