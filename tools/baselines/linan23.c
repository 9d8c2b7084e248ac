/// [Linan23], F. Garcia Linan's master's thesis. Its text could not be looked up when this was written; the method is
/// known from the author's public shader and its descendants (MIT licence), written anew here, and from the project's
/// design, which names the equations. What rests on reading between these lines:
/// - Steps: 32 a ray from within the air and 64 from above it ("32/64"); 64 for the table of transmittance.
/// - Eq. 4.6 as printed (literal): known only not to be Henyey-Greenstein; taken as its formula with the exponent 3/2
///   of the denominator lost.
/// - Eq. 5.8 as printed (literal): the last two terms, L_ms and the ground's, lack T sigma_s; taken so, per km of path.
/// Not the thesis's: wavelengths are the atmosphere's (the fit is interpolated), phase functions too; the ground at a
/// ray's end, which an engine lights from a captured sky, is lit by the sun and the model's own sky.
#include "linan23.h"

#include <math.h>
#include <stdlib.h>

#include "linan23_fit.h"
#include "march.h"
#include "texture.h"

struct linan23 {
    baseline_air air;
    baseline_wants wants;
    linan23_sizes sizes;
    int literal;
    texture transmittance, sky;
    double level[4];     ///< of the logistic, per band
    march_ground ground; ///< 0 where light is scattered once only
    baseline_view view;
};

// --- transmittance ---

/// Rays below the horizon go through the ground as through air at altitude 0, so that little is left of the sun, and
/// nothing else throws the planet's shadow.
static void transmittance_row(void *context, size_t row) {
    linan23 *const s = context;
    const int width = s->transmittance.width;
    const double top = s->air.top_km, h = top * (double)row / (s->transmittance.height - 1), r = s->air.radius_km + h;
    for (int i = 0; i < width; i++) {
        const double mu = 2.0 * i / (width - 1) - 1.0, b = r * mu;
        const double c = (top - h) * (2.0 * s->air.radius_km + top + h), root = sqrt(b * b + c);
        double t[4];
        march_transmittance(&s->air, h, mu, b > 0.0 ? c / (b + root) : root - b, s->sizes.transmittance_steps, 0.5, t);
        for (int k = 0; k < 4; k++)
            s->transmittance.texel[(int)row * width + i][k] = (float)t[k];
    }
}

static void transmittance_at(const linan23 *s, double h, double mu, double value[4]) {
    const texture *const t = &s->transmittance;
    texture_at(t, (0.5 + 0.5 * mu) * (t->width - 1), h / s->air.top_km * (t->height - 1), 0, value);
}

// --- light at a point ---

/// Level of the logistic at a wavelength: linear between the fitted ones in the logarithms, and beyond them.
static double level_at(double wavelength_nm) {
    int i = 0;
    while (i < LINAN23_FIT_BANDS - 2 && wavelength_nm > linan23_fit_nm[i + 1])
        i++;
    const double x0 = log(linan23_fit_nm[i]), x1 = log(linan23_fit_nm[i + 1]);
    const double y0 = log(linan23_fit_level[i]), y1 = log(linan23_fit_level[i + 1]);
    return exp(y0 + (y1 - y0) * (log(wavelength_nm) - x0) / (x1 - x0));
}

static double logistic(double mu_s) {
    return 1.0 / (1.0 + LINAN23_FIT_OFFSET * exp(-LINAN23_FIT_SLOPE * mu_s));
}

double linan23_logistic(double wavelength_nm, double mu_s) {
    return level_at(wavelength_nm) * logistic(mu_s);
}

/// Eq. 5.5: the ground as one isotropic source, lit where the point stands over it.
static void ground_bounce(const linan23 *s, double h, double mu_s, double light[4]) {
    const double radius = s->air.radius_km, r = radius + h;
    // 1 - sqrt(r^2 - R^2)/r without cancellation far away
    const double seen = radius * radius / (r * (r + sqrt(h * (2.0 * radius + h))));
    double lit[4], whole[4], above[4];
    transmittance_at(s, 0.0, mu_s, lit);
    transmittance_at(s, 0.0, 1.0, whole);
    transmittance_at(s, h, 1.0, above);
    for (int b = 0; b < s->air.bands; b++) {
        const double between = above[b] > 0.0 ? whole[b] / above[b] : 0.0;
        light[b] += 0.5 * seen * s->air.albedo[b] / BASELINE_PI * lit[b] * between * fmax(mu_s, 0.0);
    }
}

static void first_order(const void *model, double h, double mu_s, double sun[4], double diffuse[4]) {
    transmittance_at(model, h, mu_s, sun);
    for (int b = 0; b < 4; b++)
        diffuse[b] = 0.0;
}

static void all_orders(const void *model, double h, double mu_s, double sun[4], double diffuse[4]) {
    const linan23 *const s = model;
    const double light = logistic(mu_s);
    transmittance_at(s, h, mu_s, sun);
    for (int b = 0; b < 4; b++)
        diffuse[b] = s->level[b] * light;
    ground_bounce(s, h, mu_s, diffuse);
}

// --- the sky ---

/// Eq. 4.6 as printed, in the reading above.
static double printed_phase(double g, double c) {
    return (1.0 - g * g) / (4.0 * BASELINE_PI * (1.0 + g * g - 2.0 * g * c));
}

/// Adds what the ground at a ray's end sends: Lambert, lit by the sun and, where its light is known, the sky.
static void add_ground(const linan23 *s, march_result *r) {
    double sun[4], sky[4];
    transmittance_at(s, 0.0, r->mu_s, sun);
    march_ground_at(&s->ground, r->mu_s, sky);
    for (int b = 0; b < s->air.bands; b++)
        r->radiance[b] += r->transmittance[b] * s->air.albedo[b] / BASELINE_PI * (sun[b] * fmax(r->mu_s, 0.0) + sky[b]);
}

/// A ray that starts within the air, under a unit sun.
static void march_steps(const linan23 *s, const march_ray *ray, int steps, double radiance[4]) {
    const march_rule rule = {.steps = steps, .at = 0.5, .bare = s->literal};
    double phase[BASELINE_SCATTERERS];
    march_result r;
    for (int i = 0; i < BASELINE_SCATTERERS; i++)
        phase[i] = s->literal && i != GAS ? printed_phase(s->air.g[i], ray->nu) : baseline_phase(&s->air, i, ray->nu);
    march(&s->air, ray, &rule, phase, s->wants.all ? all_orders : first_order, s, &r);
    if (s->wants.lit_ground && r.ground)
        add_ground(s, &r);
    for (int b = 0; b < 4; b++)
        radiance[b] = r.radiance[b];
}

static void from_within(const void *model, const march_ray *ray, double radiance[4]) {
    const linan23 *const s = model;
    march_steps(s, ray, s->sizes.steps_inside, radiance);
}

static void sky_along(const linan23 *s, march_ray ray, double radiance[4]) {
    const int steps = ray.altitude_km > s->air.top_km ? s->sizes.steps_outside : s->sizes.steps_inside;
    for (int b = 0; b < 4; b++)
        radiance[b] = 0.0;
    if (!march_enter(&s->air, &ray))
        return;
    march_steps(s, &ray, steps, radiance);
    for (int b = 0; b < s->air.bands; b++)
        radiance[b] *= s->air.light[b];
}

/// Texels: azimuth from the sun, even over the circle; elevation, quadratic about the level.
static void sky_texel(linan23 *s, int i, int j) {
    const int width = s->sky.width;
    const double azimuth = 2.0 * BASELINE_PI * (i + 0.5) / width, l = 2.0 * (j + 0.5) / s->sky.height - 1.0;
    const double elevation = copysign(l * l, l) * 0.5 * BASELINE_PI, mu_s = s->view.sun_enu[2];
    const double nu = sin(elevation) * mu_s + cos(elevation) * sqrt(fmax(0.0, 1.0 - mu_s * mu_s)) * cos(azimuth);
    double radiance[4];
    sky_along(s, (march_ray){s->view.observer_km, sin(elevation), mu_s, fmin(1.0, fmax(-1.0, nu))}, radiance);
    for (int b = 0; b < 4; b++) // the other half is this one's mirror image
        s->sky.texel[j * width + i][b] = s->sky.texel[j * width + width - 1 - i][b] = (float)radiance[b];
}

void linan23_frame(linan23 *s, const baseline_view *view) {
    s->view = *view;
    for (int j = 0; j < s->sky.height; j++)
        for (int i = 0; i < (s->sky.width + 1) / 2; i++)
            sky_texel(s, i, j);
}

void linan23_direct(const linan23 *s, const baseline_view *view, const double direction_enu[3], double radiance[4]) {
    sky_along(s, march_ray_of(view, direction_enu), radiance);
}

void linan23_radiance(const linan23 *s, size_t n, const float (*direction_enu)[3], float (*radiance)[4]) {
    for (size_t i = 0; i < n; i++) {
        const double d[] = {(double)direction_enu[i][0], (double)direction_enu[i][1], (double)direction_enu[i][2]};
        const double elevation = asin(fmin(1.0, fmax(-1.0, d[2]))) / (0.5 * BASELINE_PI);
        const double azimuth = acos(march_azimuth_cosine(&s->view, d)) / (2.0 * BASELINE_PI);
        double value[4];
        texture_at(&s->sky, azimuth * s->sky.width - 0.5,
                   (0.5 + 0.5 * copysign(sqrt(fabs(elevation)), elevation)) * s->sky.height - 0.5, 1, value);
        for (int b = 0; b < 4; b++)
            radiance[i][b] = (float)value[b];
    }
}

// --- build ---

void linan23_release(linan23 *s) {
    texture_free(&s->transmittance);
    texture_free(&s->sky);
    baseline_air_free(&s->air);
    free(s);
}

int linan23_build(linan23 **state, const skv_atmosphere *air, const baseline_wants *wants, const linan23_sizes *sizes,
                  int literal, baseline_cost *cost) {
    const double start = baseline_cpu_s();
    linan23 *const s = calloc(1, sizeof *s);
    if (!s)
        return -1;
    if (baseline_air_copy(&s->air, air)) {
        free(s);
        return -1;
    }
    s->wants = *wants;
    s->sizes = *sizes;
    s->literal = literal;
    for (int b = 0; b < s->air.bands; b++)
        s->level[b] = level_at((double)air->wavelength_nm[b]);
    const int none = texture_make(&s->transmittance, sizes->transmittance_width, sizes->transmittance_height) |
                     texture_make(&s->sky, sizes->sky_width, sizes->sky_height);
    const int failed =
        none ? -1 : baseline_parallel(wants, 0.0, 1.0, (size_t)sizes->transmittance_height, transmittance_row, s);
    if (failed) {
        linan23_release(s);
        return failed;
    }
    if (wants->all && wants->lit_ground)
        march_ground_make(&s->ground, from_within, s);
    *cost =
        (baseline_cost){texture_bytes(&s->transmittance, 16) + texture_bytes(&s->sky, 16), 0, baseline_cpu_s() - start};
    *state = s;
    return 0;
}

// --- the baselines ---

static int start(void **state, const skv_atmosphere *air, const baseline_wants *wants, int literal,
                 baseline_cost *cost) {
    linan23 *s = NULL;
    const int status = linan23_build(&s, air, wants, &LINAN23_SIZES, literal, cost);
    *state = s;
    return status;
}

static int build(void **state, const skv_atmosphere *air, const baseline_wants *wants, baseline_cost *cost,
                 const char **why) {
    (void)why;
    return start(state, air, wants, 0, cost);
}

static int build_literal(void **state, const skv_atmosphere *air, const baseline_wants *wants, baseline_cost *cost,
                         const char **why) {
    (void)why;
    return start(state, air, wants, 1, cost);
}

static int frame(void *state, const baseline_view *view, const char **why) {
    (void)why;
    linan23_frame(state, view);
    return 0;
}

static void radiance(const void *state, size_t n, const float (*direction_enu)[3], float (*out)[4]) {
    linan23_radiance(state, n, direction_enu, out);
}

static void release(void *state) {
    linan23_release(state);
}

#define LINAN23_SOURCE                                                                                                 \
    "[Linan23] Garcia Linan: Physically-Based Sky and Atmosphere Rendering in Real-Time, Universidad de Zaragoza, "    \
    "TAZ-TFM-2023-053, https://zaguan.unizar.es/record/146054"
#define LINAN23_CAN (BASELINE_SINGLE | BASELINE_ALL | BASELINE_GROUND | BASELINE_SPACE | BASELINE_TWILIGHT)

extern const baseline linan23_baseline, linan23_literal;
const baseline linan23_baseline = {
    .name = "linan23",
    .title = "Garcia Linan 2023, transmittance 256x64, sky 256x256",
    .source = LINAN23_SOURCE,
    .slips = "Eq. 4.6 is Henyey-Greenstein; all terms of Eq. 5.8 have T sigma_s",
    .can = LINAN23_CAN,
    .cannot = "the light of higher orders is fitted to the clear Earth, whatever the air",
    .build = build,
    .frame = frame,
    .radiance = radiance,
    .release = release,
};
const baseline linan23_literal = {
    .name = "linan23-literal",
    .title = "Garcia Linan 2023, as printed",
    .source = LINAN23_SOURCE,
    .slips = "Eq. 4.6 without its exponent 3/2 (our reading); Eq. 5.8 without T sigma_s on its last two terms",
    .literal = 1,
    .can = LINAN23_CAN,
    .cannot = "as linan23",
    .build = build_literal,
    .frame = frame,
    .radiance = radiance,
    .release = release,
};
