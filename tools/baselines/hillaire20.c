/// [Hillaire20]; sizes and step numbers are the paper's, but for the picture of the sky, 192x108 as in the author's
/// public example (the paper has 200x100). Steps fill the whole ray. Maps of the tables as in the author's public
/// example (MIT licence), written anew: transmittance over distances to the top and to the horizon [Bruneton17]; the
/// sky over the square root of the elevation from the geometric horizon and over the square root of the azimuth's
/// haversine. Not the paper's: the ground at a ray's end, which an engine lights from a captured sky, is lit by the sun
/// and the model's own sky.
#include "hillaire20.h"

#include <math.h>
#include <stdlib.h>

#include "march.h"
#include "texture.h"

struct hillaire20 {
    baseline_air air;
    baseline_wants wants;
    hillaire20_sizes sizes;
    texture transmittance, multiple, sky;
    march_ground ground; ///< 0 where light is scattered once only
    baseline_view view;
};

/// The point of a step at 0.3 of its length, the author's choice.
#define POINT 0.3

// --- transmittance ---

/// Distances that the map is made of: to the horizon from the top, and of this altitude.
static double horizon_km(const baseline_air *air, double altitude_km) {
    return sqrt(altitude_km * (2.0 * air->radius_km + altitude_km));
}

static void transmittance_row(void *context, size_t row) {
    hillaire20 *const s = context;
    const baseline_air *const air = &s->air;
    const int width = s->transmittance.width, height = s->transmittance.height;
    const double whole = horizon_km(air, air->top_km), rho = whole * (double)row / (height - 1);
    const double h = row + 1 == (size_t)height
                         ? air->top_km
                         : rho * rho / (air->radius_km + sqrt(air->radius_km * air->radius_km + rho * rho));
    const double least = air->top_km - h, most = rho + whole;
    for (int i = 0; i < width; i++) {
        const double d = least + (most - least) * i / (width - 1);
        const double c = (whole - rho) * (whole + rho);
        const double mu = d > 0.0 ? fmin(1.0, fmax(-1.0, (c - d * d) / (2.0 * (air->radius_km + h) * d))) : 1.0;
        double t[4];
        march_transmittance(air, h, mu, d, s->sizes.transmittance_steps, 0.5, t);
        for (int b = 0; b < 4; b++)
            s->transmittance.texel[(int)row * width + i][b] = (float)t[b];
    }
}

/// Toward the top along a ray that does not meet the ground.
static void transmittance_at(const hillaire20 *s, double h, double mu, double value[4]) {
    const baseline_air *const air = &s->air;
    const double whole = horizon_km(air, air->top_km), rho = horizon_km(air, h);
    double d;
    baseline_ray(air, h, mu, &d);
    const double least = air->top_km - h, most = rho + whole;
    const double x = most > least ? (d - least) / (most - least) : 0.0;
    texture_at(&s->transmittance, x * (s->transmittance.width - 1), rho / whole * (s->transmittance.height - 1), 0,
               value);
}

// --- light at a point ---

static void sun_at(const hillaire20 *s, double h, double mu_s, double sun[4]) {
    if (!baseline_ray(&s->air, h, mu_s, NULL))
        transmittance_at(s, h, mu_s, sun);
    else
        for (int b = 0; b < 4; b++)
            sun[b] = 0.0;
}

static void none(double value[4], double x) {
    for (int b = 0; b < 4; b++)
        value[b] = x;
}

static void first_order(const void *model, double h, double mu_s, double sun[4], double diffuse[4]) {
    sun_at(model, h, mu_s, sun);
    none(diffuse, 0.0);
}

static void unit_everywhere(const void *model, double h, double mu_s, double sun[4], double diffuse[4]) {
    (void)model, (void)h, (void)mu_s;
    none(sun, 0.0);
    none(diffuse, 1.0);
}

void hillaire20_multiple(const hillaire20 *s, double altitude_km, double mu_s, double radiance[4]) {
    const texture *const t = &s->multiple;
    texture_at(t, (0.5 + 0.5 * mu_s) * (t->width - 1), altitude_km / s->air.top_km * (t->height - 1), 0, radiance);
}

static void all_orders(const void *model, double h, double mu_s, double sun[4], double diffuse[4]) {
    sun_at(model, h, mu_s, sun);
    hillaire20_multiple(model, h, mu_s, diffuse);
}

/// Adds what the ground at a ray's end sends: Lambert, lit by the sun and, where its light is known, the sky.
static void add_ground(const hillaire20 *s, march_result *r) {
    double sun[4], sky[4];
    if (!r->ground)
        return;
    sun_at(s, 0.0, r->mu_s, sun);
    march_ground_at(&s->ground, r->mu_s, sky);
    for (int b = 0; b < s->air.bands; b++)
        r->radiance[b] += r->transmittance[b] * s->air.albedo[b] / BASELINE_PI * (sun[b] * fmax(r->mu_s, 0.0) + sky[b]);
}

// --- multiple scattering ---

/// L2 and f of one texel, means over side^2 directions of equal solid angle.
static void second_order(const hillaire20 *s, double h, double mu_s, double l2[4], double f[4]) {
    const march_rule rule = {.steps = s->sizes.multiple_steps, .at = POINT};
    const double even = 0.25 / BASELINE_PI, phase[] = {even, even, even};
    const int side = s->sizes.multiple_side;
    none(l2, 0.0);
    none(f, 0.0);
    for (int i = 0; i < side * side; i++) {
        const double mu = 1.0 - 2.0 * (i / side + 0.5) / side, turn = 2.0 * BASELINE_PI * (i % side + 0.5) / side;
        const double nu = mu * mu_s + sqrt((1.0 - mu * mu) * (1.0 - mu_s * mu_s)) * sin(turn);
        const march_ray ray = {h, mu, mu_s, nu};
        march_result light, back;
        march(&s->air, &ray, &rule, phase, first_order, s, &light);
        add_ground(s, &light);
        march(&s->air, &ray, &rule, phase, unit_everywhere, s, &back);
        for (int b = 0; b < s->air.bands; b++) {
            l2[b] += light.radiance[b] / (side * side);
            f[b] += back.radiance[b] / (side * side);
        }
    }
}

static void multiple_texel(void *context, size_t i) {
    hillaire20 *const s = context;
    const int width = s->multiple.width;
    const double mu_s = 2.0 * (double)((int)i % width) / (width - 1) - 1.0;
    const double h = s->air.top_km * (double)((int)i / width) / (s->multiple.height - 1);
    double l2[4], f[4];
    second_order(s, h, mu_s, l2, f);
    for (int b = 0; b < 4; b++)
        s->multiple.texel[i][b] = (float)(l2[b] / (1.0 - fmin(f[b], 0.999)));
}

// --- the sky ---

/// A ray that starts within the air, under a unit sun.
static void unit_sky(const void *model, const march_ray *ray, double radiance[4]) {
    const hillaire20 *const s = model;
    const march_rule rule = {.steps = s->sizes.sky_steps, .squared = 1, .at = POINT};
    double phase[BASELINE_SCATTERERS];
    march_result r;
    for (int i = 0; i < BASELINE_SCATTERERS; i++)
        phase[i] = baseline_phase(&s->air, i, ray->nu);
    march(&s->air, ray, &rule, phase, s->wants.all ? all_orders : first_order, s, &r);
    if (s->wants.lit_ground)
        add_ground(s, &r);
    for (int b = 0; b < 4; b++)
        radiance[b] = r.radiance[b];
}

static void sky_along(const hillaire20 *s, march_ray ray, double radiance[4]) {
    none(radiance, 0.0);
    if (!march_enter(&s->air, &ray))
        return;
    unit_sky(s, &ray, radiance);
    for (int b = 0; b < s->air.bands; b++)
        radiance[b] *= s->air.light[b];
}

/// Zenith angle of the geometric horizon.
static double horizon_angle(const hillaire20 *s) {
    return acos(baseline_horizon(&s->air, s->view.observer_km));
}

static void sky_texel(hillaire20 *s, int i, int j) {
    const double x = (double)i / (s->sky.width - 1), y = (double)j / (s->sky.height - 1), horizon = horizon_angle(s);
    const double away = 2.0 * y - 1.0;
    const double zenith = away < 0.0 ? horizon * (1.0 - away * away) : horizon + (BASELINE_PI - horizon) * away * away;
    const double turn = 1.0 - 2.0 * x * x; // cosine of the azimuth from the sun
    const double mu = cos(zenith), mu_s = s->view.sun_enu[2];
    const double nu = mu * mu_s + sin(zenith) * sqrt(fmax(0.0, 1.0 - mu_s * mu_s)) * turn;
    double radiance[4];
    sky_along(s, (march_ray){s->view.observer_km, mu, mu_s, fmin(1.0, fmax(-1.0, nu))}, radiance);
    for (int b = 0; b < 4; b++)
        s->sky.texel[j * s->sky.width + i][b] = (float)radiance[b];
}

int hillaire20_frame(hillaire20 *s, const baseline_view *view) {
    s->view = *view;
    if (view->observer_km > s->air.top_km)
        return 0; // from space every ray is marched
    for (int j = 0; j < s->sky.height; j++)
        for (int i = 0; i < s->sky.width; i++)
            sky_texel(s, i, j);
    return 0;
}

static void sky_at(const hillaire20 *s, const double direction[3], double radiance[4]) {
    const double zenith = acos(fmin(1.0, fmax(-1.0, direction[2]))), horizon = horizon_angle(s);
    const double turn = march_azimuth_cosine(&s->view, direction);
    const double away =
        zenith < horizon ? -sqrt((horizon - zenith) / horizon) : sqrt((zenith - horizon) / (BASELINE_PI - horizon));
    texture_at(&s->sky, sqrt(0.5 * (1.0 - turn)) * (s->sky.width - 1), (0.5 + 0.5 * away) * (s->sky.height - 1), 0,
               radiance);
}

void hillaire20_direct(const hillaire20 *s, const baseline_view *view, const double direction_enu[3],
                       double radiance[4]) {
    sky_along(s, march_ray_of(view, direction_enu), radiance);
}

void hillaire20_radiance(const hillaire20 *s, size_t n, const float (*direction_enu)[3], float (*radiance)[4]) {
    for (size_t i = 0; i < n; i++) {
        const double d[] = {(double)direction_enu[i][0], (double)direction_enu[i][1], (double)direction_enu[i][2]};
        double value[4];
        if (s->view.observer_km > s->air.top_km)
            hillaire20_direct(s, &s->view, d, value);
        else
            sky_at(s, d, value);
        for (int b = 0; b < 4; b++)
            radiance[i][b] = (float)value[b];
    }
}

// --- build ---

void hillaire20_release(hillaire20 *s) {
    texture_free(&s->transmittance);
    texture_free(&s->multiple);
    texture_free(&s->sky);
    baseline_air_free(&s->air);
    free(s);
}

static int make_textures(hillaire20 *s) {
    const hillaire20_sizes *const z = &s->sizes;
    const int a = texture_make(&s->transmittance, z->transmittance_width, z->transmittance_height);
    const int b = texture_make(&s->multiple, z->multiple_width, z->multiple_height);
    const int c = texture_make(&s->sky, z->sky_width, z->sky_height);
    return a | b | c;
}

/// The tables of an atmosphere. @return 0; 1 stopped.
static int fill(hillaire20 *s) {
    if (baseline_parallel(&s->wants, 0.0, 0.1, (size_t)s->transmittance.height, transmittance_row, s))
        return 1;
    if (!s->wants.all)
        return 0;
    const size_t texels = (size_t)s->multiple.width * (size_t)s->multiple.height;
    if (baseline_parallel(&s->wants, 0.1, 1.0, texels, multiple_texel, s))
        return 1;
    if (s->wants.lit_ground)
        march_ground_make(&s->ground, unit_sky, s);
    return 0;
}

int hillaire20_build(hillaire20 **state, const skv_atmosphere *air, const baseline_wants *wants,
                     const hillaire20_sizes *sizes, baseline_cost *cost, const char **why) {
    const double start = baseline_cpu_s();
    hillaire20 *const s = calloc(1, sizeof *s);
    (void)why;
    if (!s)
        return -1;
    if (baseline_air_copy(&s->air, air)) {
        free(s);
        return -1;
    }
    s->wants = *wants;
    s->sizes = *sizes;
    const int failed = make_textures(s) ? -1 : fill(s);
    if (failed) {
        hillaire20_release(s);
        return failed;
    }
    // Half floats of four bands, as the author's tables are; kept here as floats, so that rounding adds no error.
    const size_t texel = 8;
    *cost = (baseline_cost){texture_bytes(&s->transmittance, texel) + texture_bytes(&s->multiple, texel) +
                                texture_bytes(&s->sky, texel),
                            0, baseline_cpu_s() - start};
    *state = s;
    return 0;
}

// --- the baseline ---

static int build(void **state, const skv_atmosphere *air, const baseline_wants *wants, baseline_cost *cost,
                 const char **why) {
    hillaire20 *s = NULL;
    const int status = hillaire20_build(&s, air, wants, &HILLAIRE20_SIZES, cost, why);
    *state = s;
    return status;
}

static int frame(void *state, const baseline_view *view, const char **why) {
    (void)why;
    return hillaire20_frame(state, view);
}

static void radiance(const void *state, size_t n, const float (*direction_enu)[3], float (*out)[4]) {
    hillaire20_radiance(state, n, direction_enu, out);
}

static void release(void *state) {
    hillaire20_release(state);
}

extern const baseline hillaire20_baseline;
const baseline hillaire20_baseline = {
    .name = "hillaire20",
    .title = "Hillaire 2020, transmittance 256x64, multiple scattering 32x32, sky 192x108",
    .source = "[Hillaire20] 10.1111/cgf.14050",
    .slips = "",
    .can = BASELINE_SINGLE | BASELINE_ALL | BASELINE_GROUND | BASELINE_SPACE | BASELINE_TWILIGHT,
    .cannot = "",
    .build = build,
    .frame = frame,
    .radiance = radiance,
    .release = release,
};
