/// Elek 2009: precomputed multiple scattering in a table of altitude, view and sun, without azimuth [Elek09].
#include <stdlib.h>

#include "elek09.h"

#define CITATION                                                                                                       \
    "Elek, O.: Rendering Parametrizable Planetary Atmospheres with Multiple Scattering in Real-Time. CESCG 2009, "     \
    "old.cescg.org/CESCG-2009/papers/PragueCUNI-Elek-Oskar09.pdf"
#define CANNOT                                                                                                         \
    "dust dims but does not scatter; gas and aerosol do not scatter each other's light, nor the ground's; no azimuth " \
    "but in the phase functions of the sun"

typedef struct state {
    baseline_air air;
    int literal, lit_ground;
    double observer_km, sun[3];
    elek_store store;
} state;

// ---- build

/// Part of the key: what is stored and how it is computed.
enum { VERSION = 2 };

static uint64_t key_of(const state *self, const baseline_wants *wants) {
    const int what[] = {VERSION, self->literal, wants->all != 0, (int)sizeof(elek_store)};
    return baseline_hash(baseline_air_hash(&self->air), what, sizeof what);
}

static int fill(state *self, const baseline_wants *wants, baseline_cost *cost) {
    const uint64_t key = key_of(self, wants);
    cost->table_bytes = elek_table_bytes(self->air.bands);
    cost->work_bytes = elek_work_bytes();
    if (baseline_cache_load(wants->cache, "elek09", key, &self->store, sizeof self->store, &cost->build_s))
        return 0;
    const double start_s = baseline_cpu_s();
    const int status = elek_make(&self->store, &self->air, self->literal, wants);
    cost->build_s = baseline_cpu_s() - start_s;
    if (status == 0)
        (void)baseline_cache_save(wants->cache, "elek09", key, &self->store, sizeof self->store, cost->build_s);
    return status;
}

static void release(void *context) {
    state *const self = context;
    baseline_air_free(&self->air);
    free(self);
}

static int build(int literal, void **out, const skv_atmosphere *air, const baseline_wants *wants, baseline_cost *cost,
                 const char **why) {
    state *const self = calloc(1, sizeof *self);
    if (!self || baseline_air_copy(&self->air, air) != 0) {
        free(self);
        return -1;
    }
    self->literal = literal;
    self->lit_ground = wants->lit_ground;
    if (literal)
        self->air.g[AEROSOL] = -self->air.g[AEROSOL];
    const int status = fill(self, wants, cost);
    if (status == -2)
        *why = "the aerosol's phase function is too sharp for 30 x 30 samples, which would make light out of nothing";
    if (status != 0)
        release(self);
    else
        *out = self;
    return status;
}

static int build_corrected(void **out, const skv_atmosphere *air, const baseline_wants *wants, baseline_cost *cost,
                           const char **why) {
    return build(0, out, air, wants, cost, why);
}

static int build_literal(void **out, const skv_atmosphere *air, const baseline_wants *wants, baseline_cost *cost,
                         const char **why) {
    return build(1, out, air, wants, cost, why);
}

static int frame(void *context, const baseline_view *view, const char **why) {
    state *const self = context;
    (void)why;
    self->observer_km = fmax(view->observer_km, 0.0);
    memcpy(self->sun, view->sun_enu, sizeof self->sun);
    return 0;
}

// ---- lookups

static void add_half(float out[4], const uint16_t half[4], float share) {
    for (int b = 0; b < 4; b++)
        out[b] += share * baseline_from_half(half[b]);
}

static void read_scattering(const state *self, double h, double mu, double mu_s, elek_light *out) {
    elek_corners at;
    elek_corners_of(&self->air, self->literal, h, mu, mu_s, &at);
    memset(out, 0, sizeof *out);
    for (int c = 0; c < 8; c++)
        for (int kind = 0; kind < ELEK_KINDS; kind++)
            add_half(out->of[kind], self->store.scattering[at.cell[c]][kind],
                     at.share[c] * self->store.scattering_unit);
}

static void read_transmittance(const state *self, double h, double mu, float out[4]) {
    const double u = elek_u(&self->air, h) * (ELEK_T - 1), v = elek_v(mu) * (ELEK_T - 1);
    const size_t i = u < ELEK_T - 2 ? (size_t)u : ELEK_T - 2, j = v < ELEK_T - 2 ? (size_t)v : ELEK_T - 2;
    const float tu = (float)(u - (double)i), tv = (float)(v - (double)j);
    const size_t at = i * ELEK_T + j;
    memset(out, 0, 4 * sizeof out[0]);
    add_half(out, self->store.transmittance[at], (1.0f - tu) * (1.0f - tv));
    add_half(out, self->store.transmittance[at + 1], (1.0f - tu) * tv);
    add_half(out, self->store.transmittance[at + ELEK_T], tu * (1.0f - tv));
    add_half(out, self->store.transmittance[at + ELEK_T + 1], tu * tv);
}

static void read_ambient(const state *self, double mu_s, float out[4]) {
    const double w = fmin(fmax(elek_w(mu_s), 0.0), 1.0) * (ELEK_AMBIENT - 1);
    const size_t i = w < ELEK_AMBIENT - 2 ? (size_t)w : ELEK_AMBIENT - 2;
    const float t = (float)(w - (double)i);
    memset(out, 0, 4 * sizeof out[0]);
    add_half(out, self->store.ambient[i], (1.0f - t) * self->store.ambient_unit);
    add_half(out, self->store.ambient[i + 1], t * self->store.ambient_unit);
}

static float read_phase(const state *self, double cosine) {
    const double x = 0.5 * (1.0 + cosine) * (ELEK_ANGLES - 1);
    const size_t i = x < ELEK_ANGLES - 2 ? (size_t)x : ELEK_ANGLES - 2;
    const uint16_t *const row = self->store.phase[ELEK_SHAPES - 1] + i;
    const float t = (float)(x - (double)i);
    return (1.0f - t) * baseline_from_half(row[0]) + t * baseline_from_half(row[1]);
}

// ---- a ray

/// Ground at the end of a ray: direct and ambient light, dimmed on the way back. Both transmittances of the way are
/// looked up upwards, from the ground and from the observer: their ratio is the way between.
static void add_ground(const state *self, double h, double mu, double mu_s, double nu, float out[4]) {
    const double r = self->air.radius_km + h, ground = self->air.radius_km;
    double length;
    if (!baseline_ray(&self->air, h, mu, &length))
        return;
    const double sun = fmin(fmax((r * mu_s + length * nu) / ground, -1.0), 1.0);
    float direct[4], sky[4], whole[4], rest[4];
    read_transmittance(self, 0.0, sun, direct);
    read_ambient(self, sun, sky);
    read_transmittance(self, 0.0, fmax(-(r * mu + length) / ground, 0.0), whole);
    read_transmittance(self, h, -mu, rest);
    for (int b = 0; b < self->air.bands; b++) {
        const float way = rest[b] > 0.0f ? fminf(whole[b] / rest[b], 1.0f) : 0.0f;
        out[b] += (float)(self->air.albedo[b] / BASELINE_PI) * way * (direct[b] * (float)fmax(sun, 0.0) + sky[b]);
    }
}

static void one(const state *self, const float direction[3], float out[4]) {
    const double d[3] = {(double)direction[0], (double)direction[1], (double)direction[2]};
    const double nu = fmin(fmax(d[0] * self->sun[0] + d[1] * self->sun[1] + d[2] * self->sun[2], -1.0), 1.0);
    double h = self->observer_km, mu = fmin(fmax(d[2], -1.0), 1.0), mu_s = self->sun[2], s;
    memset(out, 0, 4 * sizeof out[0]);
    if (!baseline_enter(&self->air, &h, &mu, &s))
        return;
    if (s > 0.0)
        mu_s = ((self->air.radius_km + self->observer_km) * mu_s + s * nu) / (self->air.radius_km + h);
    mu_s = fmin(fmax(mu_s, -1.0), 1.0);
    elek_light light;
    read_scattering(self, h, mu, mu_s, &light);
    const float gas = (float)elek_phase_gas(nu), aerosol = read_phase(self, nu);
    for (int b = 0; b < self->air.bands; b++)
        out[b] = gas * light.of[GAS][b] + aerosol * light.of[AEROSOL][b];
    if (self->lit_ground)
        add_ground(self, h, mu, mu_s, nu, out);
    for (int b = 0; b < 4; b++)
        out[b] *= (float)self->air.light[b];
}

static void radiance(const void *context, size_t n, const float (*direction_enu)[3], float (*out)[4]) {
    for (size_t i = 0; i < n; i++)
        one(context, direction_enu[i], out[i]);
}

enum { CAN = BASELINE_SINGLE | BASELINE_ALL | BASELINE_GROUND | BASELINE_SPACE | BASELINE_TWILIGHT };

extern const baseline elek09, elek09_literal;

const baseline elek09 = {
    .name = "elek09",
    .title = "Elek 2009, 32x256x32, six orders",
    .source = CITATION,
    .slips = "U of radii, W kept above 0, a positive g is forward",
    .literal = 0,
    .can = CAN,
    .cannot = CANNOT,
    .build = build_corrected,
    .frame = frame,
    .radiance = radiance,
    .release = release,
};

const baseline elek09_literal = {
    .name = "elek09-literal",
    .title = "Elek 2009 as printed",
    .source = CITATION,
    .slips =
        "as printed: U of an altitude is a root of a negative number (read as 0), W below 0 repeats the table, g of "
        "the sign of Figure 3",
    .literal = 1,
    .can = CAN,
    .cannot = CANNOT,
    .build = build_literal,
    .frame = frame,
    .radiance = radiance,
    .release = release,
};
