/// [Keller08]. The paper itself could not be looked up when this was written. It follows what the project's design and
/// notes say of it: the steps above; its terms (gas and aerosol with exponential profiles, Henyey-Greenstein,
/// turbidity, a constant colour for what absorbs; multiplied into the light by baseline_air_copy()); its two slips. Of
/// the second, "segment ends start at viewPos while midpoints start at scatteringPoint", the reading is: with the
/// direction from the observer to the point, ends lie at viewPos + d l (j/M)^2 and midpoints at scatteringPoint + d l
/// (middle of two ends), so that densities beyond the point are taken for those in front of it. Toward the sun only
/// lengths come from the ends, and nothing is lost.
#include "keller08.h"

#include <math.h>
#include <stdlib.h>

#include "march.h"

struct keller08 {
    baseline_air air;
    keller08_form form;
    baseline_view view;
};

/// Column of a profile from the ground up over its density there: the scale height of the exponential that stands for
/// it.
static double scale_height(const baseline_air *air, int species) {
    enum { STEPS = 4000 };
    double sum = 0.0;
    for (int i = 0; i < STEPS; i++)
        sum += baseline_density(air, species, air->top_km * (i + 0.5) / STEPS);
    const double at_ground = baseline_density(air, species, 0.0);
    return at_ground > 0.0 ? sum * air->top_km / STEPS / at_ground : 0.0;
}

static void leave_out(baseline_air *air, int species) {
    for (int b = 0; b < 4; b++) {
        air->extinction[species][b] = 0.0;
        if (species < BASELINE_SCATTERERS)
            air->scattering[species][b] = 0.0;
    }
    air->profile[species].kind = SKV_PROFILE_NONE;
}

/// Keeps the paper's terms only.
static void own_terms(baseline_air *air) {
    leave_out(air, DUST);
    leave_out(air, OZONE);
    air->phase[AEROSOL] = SKV_PHASE_HG;
    for (int i = GAS; i <= AEROSOL; i++) {
        skv_profile *const p = &air->profile[i];
        for (int b = 0; b < 4; b++)
            air->extinction[i][b] = air->scattering[i][b];
        if (p->kind == SKV_PROFILE_NONE || p->kind == SKV_PROFILE_EXPONENTIAL)
            continue;
        const double height = scale_height(air, i), density = baseline_density(air, i, 0.0);
        if (height <= 0.0) {
            leave_out(air, i);
            continue;
        }
        for (int b = 0; b < 4; b++)
            air->extinction[i][b] = air->scattering[i][b] *= density;
        p->kind = SKV_PROFILE_EXPONENTIAL;
        p->scale_height_km = (float)height;
    }
}

/// End of step i of n.
static double end_of(int i, int n, int power, int even) {
    const double x = (double)i / n;
    return even ? x : power == 3 ? x * x * x : x * x;
}

/// Optical depths along `length` km from altitude h, mu.
static void depth_along(const keller08 *s, double h, double mu, double length, double depth[4]) {
    const int m = s->form.depth_steps, even = s->form.even;
    for (int j = 0; j < m; j++) {
        const double from = end_of(j, m, 2, even), to = end_of(j + 1, m, 2, even);
        const double altitude = baseline_altitude(&s->air, h, mu, length * 0.5 * (from + to));
        double extinction[4];
        baseline_extinction(&s->air, altitude, extinction);
        for (int b = 0; b < s->air.bands; b++)
            depth[b] += extinction[b] * length * (to - from);
    }
}

/// Henyey-Greenstein as printed: the square of the cosine within.
static double printed_phase(double g, double c) {
    const double d = 1.0 + g * g - 2.0 * g * c * c;
    return (1.0 - g * g) / (4.0 * BASELINE_PI * d * sqrt(d));
}

static void phases(const keller08 *s, double nu, double phase[BASELINE_SCATTERERS]) {
    for (int i = 0; i < BASELINE_SCATTERERS; i++)
        phase[i] = baseline_phase(&s->air, i, nu);
    if (s->form.literal)
        phase[AEROSOL] = printed_phase(s->air.g[AEROSOL], nu);
}

/// What the point `at` km along the ray sends to the observer, per km.
static void scattered_at(const keller08 *s, const march_ray *ray, const double phase[], double at, double out[4]) {
    const baseline_air *const air = &s->air;
    const double h = baseline_altitude(air, ray->altitude_km, ray->mu, at), r = air->radius_km + h;
    const double r0 = air->radius_km + ray->altitude_km;
    const double mu = fmin(1.0, fmax(-1.0, (r0 * ray->mu + at) / r));
    const double mu_s = fmin(1.0, fmax(-1.0, (r0 * ray->mu_s + at * ray->nu) / r));
    double to_top, depth[4] = {0};
    for (int b = 0; b < 4; b++)
        out[b] = 0.0;
    if (h > air->top_km || baseline_ray(air, h, mu_s, &to_top))
        return;
    depth_along(s, h, mu_s, to_top, depth);
    depth_along(s, h, s->form.literal ? mu : -mu, at, depth);
    for (int i = 0; i < BASELINE_SCATTERERS; i++) {
        const double density = air->profile[i].kind == SKV_PROFILE_NONE ? 0.0 : baseline_density(air, i, h);
        for (int b = 0; b < air->bands; b++)
            out[b] += air->scattering[i][b] * density * phase[i] * exp(-depth[b]);
    }
}

static void one_ray(const keller08 *s, const double direction[3], double radiance[4]) {
    march_ray ray = march_ray_of(&s->view, direction);
    double length, phase[BASELINE_SCATTERERS];
    for (int b = 0; b < 4; b++)
        radiance[b] = 0.0;
    if (!march_enter(&s->air, &ray))
        return;
    baseline_ray(&s->air, ray.altitude_km, ray.mu, &length);
    phases(s, ray.nu, phase);
    const int n = s->form.view_steps;
    for (int i = 0; i < n; i++) {
        const double from = end_of(i, n, 3, s->form.even), to = end_of(i + 1, n, 3, s->form.even);
        double out[4];
        scattered_at(s, &ray, phase, length * 0.5 * (from + to), out);
        for (int b = 0; b < s->air.bands; b++)
            radiance[b] += out[b] * length * (to - from) * s->air.light[b];
    }
}

int keller08_build(keller08 **state, const skv_atmosphere *air, const keller08_form *form, baseline_cost *cost) {
    const double start = baseline_cpu_s();
    keller08 *const s = calloc(1, sizeof *s);
    if (!s)
        return -1;
    if (baseline_air_copy(&s->air, air)) {
        free(s);
        return -1;
    }
    s->form = *form;
    if (form->own_terms)
        own_terms(&s->air);
    *cost = (baseline_cost){0, 0, baseline_cpu_s() - start};
    *state = s;
    return 0;
}

void keller08_frame(keller08 *s, const baseline_view *view) {
    s->view = *view;
}

void keller08_radiance(const keller08 *s, size_t n, const float (*direction_enu)[3], float (*out)[4]) {
    for (size_t i = 0; i < n; i++) {
        const double d[] = {(double)direction_enu[i][0], (double)direction_enu[i][1], (double)direction_enu[i][2]};
        double value[4];
        one_ray(s, d, value);
        for (int b = 0; b < 4; b++)
            out[i][b] = (float)value[b];
    }
}

void keller08_release(keller08 *s) {
    baseline_air_free(&s->air);
    free(s);
}

// --- the baselines ---

static int start(void **state, const skv_atmosphere *air, const keller08_form *form, baseline_cost *cost) {
    keller08 *s = NULL;
    const int status = keller08_build(&s, air, form, cost);
    *state = s;
    return status;
}

#define KELLER08_BUILD(name, own, slips)                                                                               \
    static int name(void **state, const skv_atmosphere *air, const baseline_wants *wants, baseline_cost *cost,         \
                    const char **why) {                                                                                \
        (void)wants, (void)why;                                                                                        \
        return start(state, air, &(keller08_form){4, 4, 0, own, slips}, cost);                                         \
    }
KELLER08_BUILD(build_all_terms, 0, 0)
KELLER08_BUILD(build_own_terms, 1, 0)
KELLER08_BUILD(build_literal, 1, 1)

static int frame(void *state, const baseline_view *view, const char **why) {
    (void)why;
    keller08_frame(state, view);
    return 0;
}

static void radiance(const void *state, size_t n, const float (*direction_enu)[3], float (*out)[4]) {
    keller08_radiance(state, n, direction_enu, out);
}

static void release(void *state) {
    keller08_release(state);
}

#define KELLER08_SOURCE "[Keller08] Keller, Bohn: non-equidistant sampling of the scattering integral"
#define KELLER08_CAN    (BASELINE_SINGLE | BASELINE_SPACE | BASELINE_TWILIGHT)

extern const baseline keller08_baseline, keller08_table1, keller08_literal;
const baseline keller08_baseline = {
    .name = "keller08",
    .title = "Keller & Bohn 2008, 4x4, all terms of the air",
    .source = KELLER08_SOURCE,
    .slips = "Henyey-Greenstein takes the cosine, not its square; depth's midpoints lie within their steps",
    .can = KELLER08_CAN,
    .cannot = "light scattered once; no ground",
    .build = build_all_terms,
    .frame = frame,
    .radiance = radiance,
    .release = release,
};
const baseline keller08_table1 = {
    .name = "keller08-table1",
    .title = "Keller & Bohn 2008, 4x4, its own terms",
    .source = KELLER08_SOURCE,
    .slips = "as keller08",
    .can = KELLER08_CAN,
    .cannot = "light scattered once; no ground; exponential profiles, no ozone, dust or absorption of aerosol",
    .build = build_own_terms,
    .frame = frame,
    .radiance = radiance,
    .release = release,
};
const baseline keller08_literal = {
    .name = "keller08-literal",
    .title = "Keller & Bohn 2008, 4x4, as printed",
    .source = KELLER08_SOURCE,
    .slips = "cos^2 in Henyey-Greenstein; the depth's midpoints lie beyond the scattering point",
    .literal = 1,
    .can = KELLER08_CAN,
    .cannot = "as keller08-table1",
    .build = build_literal,
    .frame = frame,
    .radiance = radiance,
    .release = release,
};
