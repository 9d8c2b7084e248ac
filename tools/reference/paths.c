/// Backward paths.
#include <math.h>
#include <string.h>

#include "paths.h"
#include "random.h"

#define PI 3.14159265358979323846

enum {
    FIRST_LIT = 48,
    FIRST_DARK = 24, // cells of the first ray
    LIT = 6,
    DARK = 3, // of later legs
    CELLS = 32,
    CANDIDATES = 8
};

int ref_tracer_make(ref_tracer *t, const ref_atmosphere *a, int threads) {
    if (ref_air_make(&t->air, a, 1024, 256, threads) != 0)
        return -1;
    if (ref_guide_make(&t->guide, &t->air, threads) == 0)
        return 0;
    ref_air_free(&t->air);
    return -1;
}

void ref_tracer_free(ref_tracer *t) {
    ref_air_free(&t->air);
    ref_guide_free(&t->guide);
}

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void along(const double from[3], const double direction[3], double s, double to[3]) {
    for (int i = 0; i < 3; i++)
        to[i] = from[i] + s * direction[i];
}

// A direction at cosine c and azimuth 2 pi u about a unit vector.
static void about(const double axis[3], double c, double u, double out[3]) {
    const double sign = copysign(1, axis[2]), a = -1 / (sign + axis[2]), b = axis[0] * axis[1] * a;
    const double x[3] = {1 + sign * axis[0] * axis[0] * a, sign * b, -sign * axis[0]};
    const double y[3] = {b, sign + axis[1] * axis[1] * a, -axis[1]};
    const double sine = sqrt(fmax(0, 1 - c * c)), p = sine * cos(2 * PI * u), q = sine * sin(2 * PI * u);
    for (int i = 0; i < 3; i++)
        out[i] = p * x[i] + q * y[i] + c * axis[i];
}

static double lobe_pdf(double g, double cosine) {
    const double d = fmax(1 + g * g - 2 * g * cosine, 1e-12);
    return (1 - g * g) / (4 * PI * d * sqrt(d));
}

static double lobe_cosine(double g, double u) {
    if (fabs(g) < 1e-3)
        return 2 * u - 1;
    const double x = (1 - g * g) / (1 - g + 2 * g * u);
    return fmax(-1, fmin(1, (1 + g * g - x * x) / (2 * g)));
}

static double fraction(double x) {
    return x - floor(x);
}

// A place from which a direction is to be chosen: scattering air, or ground.
typedef struct vertex {
    const double *direction; // of the leg that ends here
    double position[3], e, mu_s;
    int ground;
    const ref_point *point;
    double height01;
} vertex;

typedef struct chooser {
    const ref_view *view;
    const vertex *at;
    ref_outlook outlook;
    double up[3], toward[3]; // toward: the sun, or the horizon under which it has set
    double g, mean[REF_BANDS];
    int wide, ahead, sunward; // candidates of each kind
} chooser;

typedef struct candidate {
    double direction[3], weight[REF_BANDS], expected, pdf;
} candidate;

static void share_candidates(chooser *c, int n) {
    const ref_point *p = c->at->point;
    double aerosol = 0, all = 1e-300;
    if (p)
        for (int k = 0; k < REF_BANDS; k++) {
            aerosol += p->aerosol[k];
            all += p->aerosol[k] + p->rayleigh[k];
        }
    c->ahead = aerosol > 0.03 * all ? (n + 1) / 4 : 0;
    if (aerosol > 0.7 * all)
        c->ahead++;
    c->sunward = (n + 2) / 4;
    c->wide = n - c->ahead - c->sunward;
}

static void aim(chooser *c) {
    const double r = sqrt(dot(c->at->position, c->at->position));
    const ref_view *v = c->view;
    for (int i = 0; i < 3; i++)
        c->up[i] = c->at->position[i] / r;
    const double least = c->outlook.horizon + 0.08, mu_s = c->at->mu_s;
    memcpy(c->toward, v->sun, sizeof c->toward);
    if (mu_s >= least)
        return;
    double side[3];
    along(v->sun, c->up, -mu_s, side);
    const double size = sqrt(fmax(1e-30, dot(side, side))), flat = sqrt(1 - least * least);
    for (int i = 0; i < 3; i++)
        c->toward[i] = size > 1e-6 ? flat * side[i] / size + least * c->up[i] : c->up[i];
}

static double wide_pdf(const chooser *c, double mu) {
    return c->at->ground ? fmax(0, mu) / PI : 1 / (4 * PI);
}

static void propose(const chooser *c, int i, double u, double w, double out[3]) {
    if (i < c->ahead)
        about(c->at->direction, lobe_cosine(c->g, u), w, out);
    else if (i < c->ahead + c->sunward)
        about(c->toward, lobe_cosine(c->g, u), w, out);
    else if (c->at->ground)
        about(c->up, sqrt(u), w, out);
    else
        about(c->up, 2 * u - 1, w, out);
}

// Weight and expectation of a direction.
static void weigh(const chooser *c, const double throughput[REF_BANDS], candidate *q) {
    const ref_view *v = c->view;
    const ref_air *air = &v->tracer->air;
    const ref_atmosphere *a = air->world.atmosphere;
    const int n = c->ahead + c->sunward + c->wide;
    const double mu = dot(q->direction, c->up), nu = dot(q->direction, v->sun);
    const double turn = c->at->ground ? 0 : dot(q->direction, c->at->direction);
    q->expected = 0;
    q->pdf = c->wide * wide_pdf(c, mu) + c->sunward * lobe_pdf(c->g, dot(q->direction, c->toward));
    if (c->ahead)
        q->pdf += c->ahead * lobe_pdf(c->g, turn);
    q->pdf /= n;
    if (c->at->ground && mu <= 0)
        return;
    const ref_glow *glow = ref_guide_glow(&c->outlook, mu, nu);
    const double rayleigh = ref_phase_rayleigh(turn),
                 aerosol = c->at->ground ? 0 : ref_phase_aerosol(a, 1 - turn, 1 + turn);
    const double sunward = ref_phase_aerosol(a, 1 - nu, 1 + nu);
    for (int k = 0; k < REF_BANDS; k++) {
        const double weight = c->at->ground ? air->albedo[k] / PI * mu
                                            : c->at->point->rayleigh[k] * rayleigh + c->at->point->aerosol[k] * aerosol;
        const double light = (double)glow->smooth[k] + sunward * (double)glow->aerosol[k] + 0.05 * c->mean[k];
        q->weight[k] = throughput[k] * weight;
        q->expected += q->weight[k] * v->scale[k] * light;
    }
}

// Chooses the next direction and multiplies the throughput. Returns 0 when nothing can come.
static int turn(const ref_view *v, const vertex *at, int n, double u, double w, double pick,
                double throughput[REF_BANDS], double direction[3]) {
    chooser c = {.view = v, .at = at};
    candidate q[CANDIDATES];
    double sum = 0;
    c.g = fmax(-0.98, fmin(0.98, v->tracer->air.world.atmosphere->g));
    c.outlook = ref_guide_outlook(&v->tracer->guide, &v->tracer->air, at->e, at->mu_s);
    ref_guide_mean(&v->tracer->guide, at->height01, at->mu_s, c.mean);
    share_candidates(&c, n);
    aim(&c);
    // A lattice turned at random: the candidates spread, each uniform by itself.
    for (int i = 0; i < n; i++) {
        propose(&c, i, fraction(u + i * 0.61803398874989485), fraction(w + (double)i / n), q[i].direction);
        weigh(&c, throughput, &q[i]);
        sum += q[i].expected / q[i].pdf;
    }
    if (!(sum > 0))
        return 0;
    double rest = pick * sum;
    int i = 0;
    while (i + 1 < n && (rest -= q[i].expected / q[i].pdf) >= 0)
        i++;
    while (i > 0 && !(q[i].expected > 0))
        i--;
    if (!(q[i].expected > 0))
        return 0;
    for (int k = 0; k < REF_BANDS; k++)
        throughput[k] = q[i].weight[k] * sum / (n * q[i].expected);
    memcpy(direction, q[i].direction, sizeof q[i].direction);
    return 1;
}

static double depth_to_ground(const ref_view *v, const ref_line *l, double transmittance[REF_BANDS],
                              double sun[REF_BANDS]) {
    const ref_air *air = &v->tracer->air;
    double depth[REF_BANDS];
    const double mu_s = (l->b_sun + l->length * l->nu) / air->ground;
    ref_line_end(air, l, depth);
    for (int k = 0; k < REF_BANDS; k++)
        transmittance[k] = exp(-depth[k]);
    ref_air_sun(air, mu_s, depth);
    for (int k = 0; k < REF_BANDS; k++)
        sun[k] = mu_s > 0 ? air->albedo[k] / PI * mu_s * exp(-depth[k]) : 0;
    return mu_s;
}

// Expected light that a cell's point sends on: all bands relative to the totals.
static double promise(const ref_view *v, const ref_point *q, const double throughput[REF_BANDS]) {
    double mean[REF_BANDS], sum = 0;
    ref_guide_mean(&v->tracer->guide, q->height01, q->mu_s, mean);
    for (int k = 0; k < REF_BANDS; k++)
        sum += throughput[k] * v->scale[k] * (q->rayleigh[k] + q->aerosol[k]) * mean[k];
    return sum;
}

static double ground_promise(const ref_view *v, double mu_s, const double throughput[REF_BANDS]) {
    double mean[REF_BANDS], sum = 0;
    ref_guide_mean(&v->tracer->guide, 0, mu_s, mean);
    for (int k = 0; k < REF_BANDS; k++)
        sum += throughput[k] * v->scale[k] * v->tracer->air.albedo[k] * mean[k];
    return sum;
}

typedef struct leg {
    ref_line line;
    int cells;
    ref_point point[CELLS];
    double at[CELLS], carried[CELLS + 1][REF_BANDS], promise[CELLS + 1];
    double ground_mu_s;
} leg;

// Adds the sun's light scattered along a leg; leaves the candidates for its end. Returns the sum of their promises.
static double walk(const ref_view *v, const double from[3], const double direction[3],
                   const double throughput[REF_BANDS], ref_random *random, leg *g, double out[REF_BANDS]) {
    const ref_air *air = &v->tracer->air;
    double edges[REF_CELLS_MAX + 1], sum = 0;
    ref_line *l = &g->line;
    ref_line_begin(air, l, fmax(0, dot(from, from) - air->ground * air->ground), dot(from, direction),
                   dot(from, v->sun), dot(direction, v->sun));
    g->cells = ref_line_cells(air, l, LIT, DARK, edges);
    const double rayleigh = ref_phase_rayleigh(l->nu),
                 aerosol = ref_phase_aerosol(air->world.atmosphere, 1 - l->nu, 1 + l->nu);
    for (int i = 0; i < g->cells; i++) {
        ref_point *q = &g->point[i];
        const double size = edges[i + 1] - edges[i];
        g->at[i] = edges[i] + size * ref_uniform(random);
        ref_line_at(air, l, g->at[i], q);
        for (int k = 0; k < REF_BANDS; k++) {
            g->carried[i][k] = throughput[k] * size * exp(-q->depth[k]);
            if (q->lit)
                out[k] += g->carried[i][k] * exp(-q->sun[k]) * (q->rayleigh[k] * rayleigh + q->aerosol[k] * aerosol);
        }
        sum += g->promise[i] = promise(v, q, g->carried[i]);
    }
    g->promise[g->cells] = 0;
    if (l->ground) {
        double transmittance[REF_BANDS], sun[REF_BANDS];
        g->ground_mu_s = depth_to_ground(v, l, transmittance, sun);
        for (int k = 0; k < REF_BANDS; k++) {
            g->carried[g->cells][k] = throughput[k] * transmittance[k];
            out[k] += g->carried[g->cells][k] * sun[k];
        }
        sum += g->promise[g->cells] = ground_promise(v, g->ground_mu_s, g->carried[g->cells]);
    }
    return sum;
}

static int choose(const leg *g, double u, double sum) {
    int i = 0;
    double rest = u * sum;
    while (i < g->cells && (rest -= g->promise[i]) >= 0)
        i++;
    while (i > 0 && !(g->promise[i] > 0))
        i--;
    return i;
}

static vertex air_vertex(const double direction[3], const double position[3], const ref_point *q) {
    vertex at = {.direction = direction, .e = q->e, .mu_s = q->mu_s, .point = q, .height01 = q->height01};
    memcpy(at.position, position, sizeof at.position);
    return at;
}

static vertex ground_vertex(const ref_view *v, const double direction[3], const double position[3], double mu_s) {
    vertex at = {.direction = direction, .mu_s = mu_s, .ground = 1};
    const double f = v->tracer->air.ground / sqrt(dot(position, position));
    for (int i = 0; i < 3; i++)
        at.position[i] = f * position[i];
    return at;
}

// The legs after the first vertex.
static void follow(const ref_view *v, const double start[3], const double first[3], double throughput[REF_BANDS],
                   ref_random *random, double out[REF_BANDS]) {
    double from[3], direction[3], next[3];
    memcpy(from, start, sizeof from);
    memcpy(direction, first, sizeof direction);
    for (;;) {
        leg g;
        const double sum = walk(v, from, direction, throughput, random, &g, out);
        const double survive = fmin(1, sum / (0.5 * v->expected));
        if (!(ref_uniform(random) < survive))
            return;
        const int i = choose(&g, ref_uniform(random), sum);
        for (int k = 0; k < REF_BANDS; k++)
            throughput[k] = g.carried[i][k] * sum / (g.promise[i] * survive);
        const int ground = i == g.cells;
        along(from, direction, ground ? g.line.length : g.at[i], next);
        const vertex at =
            ground ? ground_vertex(v, direction, next, g.ground_mu_s) : air_vertex(direction, next, &g.point[i]);
        memcpy(from, at.position, sizeof from);
        const double u = ref_uniform(random), w = ref_uniform(random);
        double turned[3];
        if (!turn(v, &at, 4, u, w, ref_uniform(random), throughput, turned))
            return;
        memcpy(direction, turned, sizeof direction);
    }
}

static void trace(const ref_view *v, const double u[4], ref_random *random, double out[REF_BANDS]) {
    const double target = u[0] * v->reach[v->cells + 1];
    double throughput[REF_BANDS], position[3], direction[3];
    int low = 0, high = v->cells + 1;
    while (high - low > 1) {
        const int middle = (low + high) / 2;
        if (v->reach[middle] <= target)
            low = middle;
        else
            high = middle;
    }
    const double share = v->reach[low + 1] - v->reach[low], all = v->reach[v->cells + 1];
    ref_point point;
    vertex at;
    if (low == v->cells) {
        double sun[REF_BANDS];
        const double mu_s = depth_to_ground(v, &v->line, throughput, sun);
        for (int k = 0; k < REF_BANDS; k++)
            throughput[k] *= all / share;
        along(v->from, v->view, v->line.length, position);
        at = ground_vertex(v, v->view, position, mu_s);
    } else {
        const double size = v->edges[low + 1] - v->edges[low];
        const double s = v->edges[low] + size * (target - v->reach[low]) / share;
        ref_line_at(&v->tracer->air, &v->line, s, &point);
        for (int k = 0; k < REF_BANDS; k++)
            throughput[k] = exp(-point.depth[k]) * size * all / share;
        along(v->from, v->view, s, position);
        at = air_vertex(v->view, position, &point);
    }
    if (turn(v, &at, CANDIDATES, u[1], u[2], u[3], throughput, direction))
        follow(v, at.position, direction, throughput, random, out);
}

void ref_view_batch(const ref_view *v, ref_tally *t) {
    double sum[REF_BANDS] = {0};
    const uint64_t batch = t->batches;
    if (!v->empty) {
        ref_random dice = ref_random_start(v->key, batch << 32 | 0xFFFFFFFFu);
        uint32_t seed[4];
        for (int i = 0; i < 4; i++)
            seed[i] = (uint32_t)(ref_uniform(&dice) * 0x1p32);
        for (uint32_t i = 0; i < REF_BATCH; i++) {
            ref_random random = ref_random_start(v->key, batch << 32 | i);
            double u[4];
            for (int d = 0; d < 4; d++)
                u[d] = ref_sobol(i, d, seed[d]);
            trace(v, u, &random, sum);
        }
    }
    for (int k = 0; k < REF_BANDS; k++) {
        const double mean = sum[k] / REF_BATCH;
        t->sum[k] += mean;
        t->squares[k] += mean * mean;
    }
    t->batches++;
}

void ref_view_result(const ref_view *v, const ref_tally *t, double radiance[REF_BANDS], double error[REF_BANDS]) {
    const double n = (double)t->batches;
    for (int k = 0; k < REF_BANDS; k++) {
        const double sun = v->tracer->air.world.atmosphere->irradiance[k], mean = n > 0 ? t->sum[k] / n : 0;
        const double spread = n > 1 ? fmax(0, t->squares[k] / n - mean * mean) / (n - 1) : 0;
        radiance[k] = sun * (v->single[k] + mean);
        error[k] = sun * sqrt(spread);
    }
}

double ref_view_error(const ref_view *v, const ref_tally *t) {
    double radiance[REF_BANDS], error[REF_BANDS], worst = 0;
    if (v->empty)
        return 0;
    if (t->batches < 2)
        return INFINITY;
    ref_view_result(v, t, radiance, error);
    for (int k = 0; k < REF_BANDS; k++)
        worst = radiance[k] > 0 ? fmax(worst, error[k] / radiance[k]) : worst;
    return worst;
}

// Moves the start of a ray from above the top to where it enters; 0 when it does not.
static int enter(ref_view *v) {
    const ref_air *air = &v->tracer->air;
    const double e = dot(v->from, v->from) - air->ground * air->ground, b = dot(v->from, v->view);
    if (e <= air->top)
        return 1;
    const double c = e - air->top, root = b * b - c;
    if (b >= 0 || root <= 0)
        return 0;
    const double start[3] = {v->from[0], v->from[1], v->from[2]};
    along(start, v->view, c / (sqrt(root) - b), v->from);
    return 1;
}

// What the map expects of later orders along the first ray, band by band.
static void expect_later(const ref_view *v, double later[REF_BANDS]) {
    double mean[REF_BANDS], transmittance[REF_BANDS], sun[REF_BANDS];
    memset(later, 0, REF_BANDS * sizeof *later);
    for (int i = 0; i < v->cells; i++) {
        ref_point q;
        const double size = v->edges[i + 1] - v->edges[i];
        ref_line_at(&v->tracer->air, &v->line, v->edges[i] + 0.5 * size, &q);
        ref_guide_mean(&v->tracer->guide, q.height01, q.mu_s, mean);
        for (int k = 0; k < REF_BANDS; k++)
            later[k] += size * exp(-q.depth[k]) * (q.rayleigh[k] + q.aerosol[k]) * mean[k];
    }
    if (!v->lit_ground)
        return;
    ref_guide_mean(&v->tracer->guide, 0, depth_to_ground(v, &v->line, transmittance, sun), mean);
    for (int k = 0; k < REF_BANDS; k++)
        later[k] += transmittance[k] * v->tracer->air.albedo[k] * mean[k];
}

// How the bands are weighed, and the chances of the cells of the first ray.
static void expect(ref_view *v) {
    double later[REF_BANDS], carried[REF_BANDS], sun[REF_BANDS], all = 0;
    expect_later(v, later);
    for (int k = 0; k < REF_BANDS; k++) {
        v->scale[k] = later[k] + v->single[k] > 0 ? 1 / (later[k] + v->single[k]) : 0;
        all += v->scale[k] * later[k];
    }
    for (int i = 0; i < v->cells; i++) {
        ref_point q;
        const double size = v->edges[i + 1] - v->edges[i];
        ref_line_at(&v->tracer->air, &v->line, v->edges[i] + 0.5 * size, &q);
        for (int k = 0; k < REF_BANDS; k++)
            carried[k] = size * exp(-q.depth[k]);
        // The floor keeps every cell possible where the middle sees nothing.
        v->reach[i + 1] = v->reach[i] + promise(v, &q, carried) + 1e-3 * all * size / v->line.length;
    }
    v->reach[v->cells + 1] = v->reach[v->cells];
    if (v->lit_ground)
        v->reach[v->cells + 1] += ground_promise(v, depth_to_ground(v, &v->line, carried, sun), carried);
    v->expected = v->reach[v->cells + 1];
    v->empty = !(v->expected > 0);
}

static uint64_t mix(uint64_t h, double value) {
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    h = (h ^ bits) + 0x9E3779B97F4A7C15u; // [Steele14] splitmix64
    h = (h ^ h >> 30) * 0xBF58476D1CE4E5B9u;
    h = (h ^ h >> 27) * 0x94D049BB133111EBu;
    return h ^ h >> 31;
}

int ref_view_make(ref_view *v, const ref_tracer *t, double height_km, double sun_deg, double view_deg,
                  double azimuth_deg, int lit_ground, uint64_t seed) {
    const ref_air *air = &t->air;
    const ref_options options = {1e-6, 16};
    const ref_ray ray = ref_ray_from_angles(height_km, sun_deg, view_deg, azimuth_deg);
    ref_answer answer;
    *v = (ref_view){.tracer = t, .key = mix(mix(mix(mix(seed, height_km), sun_deg), view_deg), azimuth_deg)};
    const int status = ref_single(air->world.atmosphere, &ray, lit_ground, &options, &answer);
    double sine, cosine;
    for (int k = 0; k < air->world.atmosphere->bands; k++) {
        const double sun = air->world.atmosphere->irradiance[k];
        v->single[k] = sun > 0 ? answer.radiance[k] / sun : 0;
    }
    v->from[2] = air->ground + fmax(0, height_km);
    double flat;
    ref_sincos_deg(sun_deg, &v->sun[0], &v->sun[2]);
    ref_sincos_deg(view_deg, &flat, &v->view[2]);
    ref_sincos_deg(azimuth_deg, &sine, &cosine);
    v->view[0] = flat * cosine;
    v->view[1] = flat * sine;
    if (!enter(v)) {
        v->empty = 1;
        return status;
    }
    ref_line_begin(air, &v->line, fmax(0, dot(v->from, v->from) - air->ground * air->ground), dot(v->from, v->view),
                   dot(v->from, v->sun), ray.nu);
    v->lit_ground = lit_ground && v->line.ground;
    v->cells = ref_line_cells(air, &v->line, FIRST_LIT, FIRST_DARK, v->edges);
    expect(v);
    return status;
}
