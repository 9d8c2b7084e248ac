/// Transmittance and light scattered once.
#include "elek09.h"

double elek_phase(const baseline_air *air, int kind, double cosine) {
    return 4.0 * BASELINE_PI * baseline_phase(air, kind, cosine);
}

double elek_phase_gas(double cosine) {
    return 0.8 * (1.4 + 0.5 * cosine);
}

void elek_make_layers(elek_build *build) {
    const baseline_air *const air = build->air;
    for (int i = 0; i < ELEK_LAYERS; i++) {
        const double h = air->top_km * i / (ELEK_LAYERS - 1);
        double extinction[4];
        baseline_extinction(air, h, extinction);
        for (int kind = 0; kind < ELEK_KINDS; kind++)
            build->layer[i].density[kind] = (float)baseline_density(air, kind, h);
        for (int b = 0; b < 4; b++)
            build->layer[i].extinction[b] = (float)extinction[b];
    }
    for (int kind = 0; kind < ELEK_KINDS; kind++)
        for (int b = 0; b < 4; b++)
            build->beta[kind][b] = (float)(air->scattering[kind][b] / (4.0 * BASELINE_PI));
}

/// Density and extinction at a sample; `before` is the extinction at the one before, and becomes that here.
static void fill(const elek_build *build, double altitude, float step, float depth[4], float before[4],
                 elek_sample *at) {
    const double x = fmin(fmax(altitude / build->air->top_km, 0.0), 1.0) * (ELEK_LAYERS - 1);
    const int i = x < ELEK_LAYERS - 2 ? (int)x : ELEK_LAYERS - 2;
    const float t = (float)(x - i);
    const elek_layer *const layer = &build->layer[i];
    for (int kind = 0; kind < ELEK_KINDS; kind++)
        at->density[kind] = layer[0].density[kind] + t * (layer[1].density[kind] - layer[0].density[kind]);
    for (int b = 0; b < 4; b++) {
        const float here = layer[0].extinction[b] + t * (layer[1].extinction[b] - layer[0].extinction[b]);
        depth[b] += 0.5f * step * (before[b] + here);
        before[b] = here;
        at->left[b] = expf(-depth[b]);
    }
}

void elek_samples(const elek_build *build, double h, double mu, elek_sample sample[ELEK_SAMPLES]) {
    const baseline_air *const air = build->air;
    double length;
    float depth[4] = {0.0f, 0.0f, 0.0f, 0.0f}, before[4] = {0.0f, 0.0f, 0.0f, 0.0f};
    (void)baseline_ray(air, h, mu, &length);
    const float step = (float)(length / (ELEK_SAMPLES - 1));
    for (int k = 0; k < ELEK_SAMPLES; k++) {
        elek_sample *const at = &sample[k];
        at->s = length * k / (ELEK_SAMPLES - 1);
        at->altitude = fmin(baseline_altitude(air, h, mu, at->s), air->top_km);
        at->radius = air->radius_km + at->altitude;
        at->mu = fmin(fmax(((air->radius_km + h) * mu + at->s) / at->radius, -1.0), 1.0);
        fill(build, at->altitude, k == 0 ? 0.0f : step, depth, before, at);
        const float weight = step * (k == 0 || k == ELEK_SAMPLES - 1 ? 0.5f : 1.0f);
        for (int b = 0; b < 4; b++)
            at->left[b] *= weight;
    }
}

double elek_sun_at(const elek_sample *start, const elek_sample *at, double mu_s) {
    const double mu = start->mu, nu = mu * mu_s + sqrt(fmax((1.0 - mu * mu) * (1.0 - mu_s * mu_s), 0.0));
    return fmin(fmax((start->radius * mu_s + at->s * nu) / at->radius, -1.0), 1.0);
}

/// To the top of the air; 0 where the ground is in the way.
void elek_transmittance_row(void *context, size_t u) {
    elek_build *const build = context;
    const baseline_air *const air = build->air;
    const double h = elek_u_inverse(air, (double)u / (ELEK_T - 1));
    for (int v = 0; v < ELEK_T; v++) {
        const double mu = elek_v_inverse((double)v / (ELEK_T - 1));
        double column[BASELINE_SPECIES], t[4] = {0.0, 0.0, 0.0, 0.0};
        if (!baseline_ray(air, h, mu, NULL)) {
            baseline_columns_to_top(air, h, mu, column);
            baseline_transmit(air, column, t);
        }
        for (int b = 0; b < 4; b++)
            build->transmittance[u * ELEK_T + (size_t)v][b] = (float)t[b];
    }
}

void elek_sun(const elek_build *build, double altitude_km, double mu_s, float transmittance[4]) {
    const double u = elek_u(build->air, altitude_km) * (ELEK_T - 1), v = elek_v(mu_s) * (ELEK_T - 1);
    const size_t i = u < ELEK_T - 2 ? (size_t)u : ELEK_T - 2, j = v < ELEK_T - 2 ? (size_t)v : ELEK_T - 2;
    const float tu = (float)(u - (double)i), tv = (float)(v - (double)j);
    const size_t at = i * ELEK_T + j;
    for (int b = 0; b < 4; b++) {
        const float low = build->transmittance[at][b], low_next = build->transmittance[at + 1][b];
        const float high = build->transmittance[at + ELEK_T][b], high_next = build->transmittance[at + ELEK_T + 1][b];
        const float under = low + tv * (low_next - low), over = high + tv * (high_next - high);
        transmittance[b] = under + tu * (over - under);
    }
}

static void once(const elek_build *build, const elek_sample sample[ELEK_SAMPLES], double mu_s, elek_light *cell) {
    elek_light sum = {{{0.0f}}};
    for (int k = 0; k < ELEK_SAMPLES; k++) {
        float sun[4];
        elek_sun(build, sample[k].altitude, elek_sun_at(sample, &sample[k], mu_s), sun);
        for (int kind = 0; kind < ELEK_KINDS; kind++)
            for (int b = 0; b < 4; b++)
                sum.of[kind][b] += sample[k].density[kind] * sample[k].left[b] * sun[b];
    }
    for (int kind = 0; kind < ELEK_KINDS; kind++)
        for (int b = 0; b < 4; b++)
            cell->of[kind][b] = build->beta[kind][b] * sum.of[kind][b];
}

void elek_once_path(void *context, size_t path) {
    elek_build *const build = context;
    const size_t u = path / ELEK_V, v = path % ELEK_V;
    elek_sample sample[ELEK_SAMPLES];
    elek_samples(build, elek_u_inverse(build->air, (double)u / (ELEK_U - 1)), elek_v_inverse((double)v / (ELEK_V - 1)),
                 sample);
    for (size_t w = 0; w < ELEK_W; w++)
        once(build, sample, elek_w_inverse((double)w / (ELEK_W - 1)), &build->order[(u * ELEK_W + w) * ELEK_V + v]);
}
