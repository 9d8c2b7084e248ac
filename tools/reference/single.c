/// The view integral of the reference.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "inner.h"

#define PI         3.14159265358979323846
#define PANELS_MAX 3000

// Gauss-Kronrod (10, 21): abscissae, Kronrod weights, Gauss weights of the odd abscissae; values of [QUADPACK] qk21.
static const double kx[11] = {0.995657163025808080735527280689003,
                              0.973906528517171720077964012084452,
                              0.930157491355708226001207180059508,
                              0.865063366688984510732096688423493,
                              0.780817726586416897063717578345042,
                              0.679409568299024406234327365114874,
                              0.562757134668604683339000099272694,
                              0.433395394129247190799265943165784,
                              0.294392862701460198131126603103866,
                              0.148874338981631210884826001129720,
                              0};
static const double kw[11] = {
    0.011694638867371874278064396062192, 0.032558162307964727478818972459390, 0.054755896574351996031381300244580,
    0.075039674810919952767043140916190, 0.093125454583697605535065465083366, 0.109387158802297641899210590325805,
    0.123491976262065851077958585166000, 0.134709217311473325928054001771707, 0.142775938577060080797094273138717,
    0.147739104901338491374841515972068, 0.149445554002916905664936468389821};
static const double gw[5] = {0.066671344308688137593568809893332, 0.149451349150580593145863396957658,
                             0.219086362515982043995534934228163, 0.269266719309996355091226921569469,
                             0.295524224714752870173815619188769};

// Everything constant along one ray, rebased to where it enters the air.
typedef struct path {
    const ref_world *world;
    double e, b;      // of the start: E and r mu
    double b_sun, nu; // r mu_s at the start
    double sin2;      // 1 - nu^2
    double length;    // to the end of the integral
    double phase[3];  // Rayleigh, aerosol, dust
} path;

typedef struct panel {
    double from, to;           // the whole panel, along the ray
    double u0, u1;             // the part of it
    double depth[REF_SPECIES]; // columns from the observer to `from`
    double value[REF_BANDS], error[REF_BANDS];
} panel;

double ref_phase_rayleigh(double nu) {
    return 3 / (16 * PI) * (1 + nu * nu);
}

static double phase_of(ref_phase kind, double g, double nu_minus, double nu_plus) {
    const double nu = nu_minus < nu_plus ? 1 - nu_minus : nu_plus - 1;
    const double d = g >= 0 ? (1 - g) * (1 - g) + 2 * g * nu_minus : (1 + g) * (1 + g) - 2 * g * nu_plus;
    const double hg = (1 - g) * (1 + g) / (4 * PI * d * sqrt(d));
    return kind == REF_HENYEY_GREENSTEIN ? hg : hg * 1.5 * (1 + nu * nu) / (2 + g * g);
}

double ref_phase_aerosol(const ref_atmosphere *a, double nu_minus, double nu_plus) {
    return phase_of(a->phase, a->g, nu_minus, nu_plus);
}

double ref_phase_dust(const ref_atmosphere *a, double nu_minus, double nu_plus) {
    return phase_of(a->dust_phase, a->dust_g, nu_minus, nu_plus);
}

// Sine and cosine in degrees, exact at the multiples of 90.
void ref_sincos_deg(double deg, double *sine, double *cosine) {
    const double turn = fmod(deg, 360);
    const double quarter = floor(turn / 90 + 0.5);
    const double r = (turn - 90 * quarter) * (PI / 180);
    const double s = sin(r), c = cos(r);
    const double sines[4] = {s, c, -s, -c}, cosines[4] = {c, -s, -c, s};
    const int q = (int)fmod(quarter + 8, 4);
    *sine = sines[q];
    *cosine = cosines[q];
}

ref_ray ref_ray_from_angles(double height_km, double sun_deg, double view_deg, double azimuth_deg) {
    ref_ray ray = {.height_km = height_km, .length_km = INFINITY};
    double sin_s, sin_v, half_sin, half_cos, apart, unused, sum_cos;
    ref_sincos_deg(sun_deg, &sin_s, &ray.mu_s);
    ref_sincos_deg(view_deg, &sin_v, &ray.mu);
    ref_sincos_deg(0.5 * azimuth_deg, &half_sin, &half_cos);
    ref_sincos_deg(0.5 * (view_deg - sun_deg), &apart, &unused);
    ref_sincos_deg(0.5 * (view_deg + sun_deg), &unused, &sum_cos);
    (void)unused;
    // 1 - nu = 2 sin^2((v-s)/2) + 2 sin v sin s sin^2(az/2), and 1 + nu likewise: no cancellation.
    ray.nu_minus = 2 * apart * apart + 2 * sin_v * sin_s * half_sin * half_sin;
    ray.nu_plus = 2 * sum_cos * sum_cos + 2 * sin_v * sin_s * half_cos * half_cos;
    ray.nu = ray.nu_minus < ray.nu_plus ? 1 - ray.nu_minus : ray.nu_plus - 1;
    return ray;
}

ref_ray ref_ray_from_vectors(double height_km, const double view[3], const double sun[3]) {
    double v[3], s[3], minus = 0, plus = 0;
    const double nv = sqrt(view[0] * view[0] + view[1] * view[1] + view[2] * view[2]);
    const double ns = sqrt(sun[0] * sun[0] + sun[1] * sun[1] + sun[2] * sun[2]);
    for (int i = 0; i < 3; i++) {
        v[i] = view[i] / nv;
        s[i] = sun[i] / ns;
        minus += 0.5 * (v[i] - s[i]) * (v[i] - s[i]);
        plus += 0.5 * (v[i] + s[i]) * (v[i] + s[i]);
    }
    const double nu = minus < plus ? 1 - minus : plus - 1;
    return (ref_ray){height_km, v[2], s[2], nu, minus, plus, INFINITY};
}

// The integrand of all bands at distance s, the columns of the observer's side being known up to `from`.
static void integrand(const path *p, const panel *q, double s, double weight, double sum[REF_BANDS]) {
    const ref_world *w = p->world;
    const ref_atmosphere *a = w->atmosphere;
    double column[REF_SPECIES];
    memcpy(column, q->depth, sizeof column);
    const double e0 = p->e + q->from * (2 * p->b + q->from);
    ref_stretch(w, e0, p->b + q->from, s - q->from, column);
    const double e = p->e + s * (2 * p->b + s), b = p->b_sun + s * p->nu;
    if (b >= 0) {
        ref_stretch(w, e, b, ref_to_top(w, e, b), column);
    } else {
        double half[REF_SPECIES] = {0};
        const double tangent = fmax(0, e - b * b);
        ref_stretch(w, tangent, 0, -b, half);
        for (int i = 0; i < REF_SPECIES; i++)
            column[i] += 2 * half[i];
        ref_stretch(w, e, -b, ref_to_top(w, e, -b), column);
    }
    const double h = ref_height(w, e) + a->ground_km;
    const double rayleigh = p->phase[0] * ref_density(&a->rayleigh, h);
    const double aerosol = p->phase[1] * ref_density(&a->aerosol, h);
    const double dust = p->phase[2] * ref_density(&a->dust, h);
    for (int i = 0; i < a->bands; i++)
        sum[i] +=
            weight * exp(-ref_depth(a, column, i)) *
            (a->rayleigh_scattering[i] * rayleigh + a->aerosol_scattering[i] * aerosol + a->dust_scattering[i] * dust);
}

static void integrate(const path *p, panel *q) {
    double kronrod[REF_BANDS] = {0}, gauss[REF_BANDS] = {0};
    const double middle = 0.5 * (q->u0 + q->u1), radius = 0.5 * (q->u1 - q->u0), length = q->to - q->from;
    for (int i = 0; i < 21; i++) {
        const int j = i <= 10 ? i : 20 - i;
        const double u = middle + (i <= 10 ? -radius : radius) * kx[j];
        const double s = q->from + length * u * u * (3 - 2 * u);
        double f[REF_BANDS] = {0};
        integrand(p, q, s, radius * length * 6 * u * (1 - u), f);
        for (int k = 0; k < REF_BANDS; k++) {
            kronrod[k] += kw[j] * f[k];
            gauss[k] += j % 2 == 1 ? gw[j / 2] * f[k] : 0;
        }
    }
    for (int k = 0; k < REF_BANDS; k++) {
        q->value[k] = kronrod[k];
        q->error[k] = fabs(kronrod[k] - gauss[k]);
    }
}

static void cut(double *cuts, int *n, double s, double length) {
    if (s > 0 && s < length && *n < 2 * REF_KNOTS_MAX)
        cuts[(*n)++] = s;
}

// Where the ray meets the height of E = e.
static void cut_height(const path *p, double e, double *cuts, int *n) {
    const double c = p->e - e, root = p->b * p->b - c;
    if (!(root >= 0))
        return;
    const double q = -(p->b + copysign(sqrt(root), p->b));
    cut(cuts, n, q, p->length);
    cut(cuts, n, c / q, p->length);
}

// Where the sun ray is tangent to the height of E = e: sin2 s^2 + 2 (b - b_sun nu) s + (E - b_sun^2 - e) = 0.
static void cut_tangent(const path *p, double e, double *cuts, int *n) {
    const double half = p->b - p->b_sun * p->nu, c = p->e - p->b_sun * p->b_sun - e;
    const double root = half * half - p->sin2 * c;
    if (!(root >= 0))
        return;
    const double q = -(half + copysign(sqrt(root), half));
    const double at[2] = {q / p->sin2, c / q};
    for (int i = 0; i < 2; i++)
        if (p->b_sun + at[i] * p->nu <= 0)
            cut(cuts, n, at[i], p->length);
}

static int ascending(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static int cuts_of(const path *p, double *cuts) {
    const ref_world *w = p->world;
    const ref_atmosphere *a = w->atmosphere;
    int n = 0;
    cuts[n++] = 0;
    cut(cuts, &n, -p->b, p->length);
    cut_tangent(p, 0, cuts, &n);
    for (int i = 0; i < w->kinks; i++) {
        cut_height(p, w->kink[i], cuts, &n);
        cut_tangent(p, w->kink[i], cuts, &n);
    }
    // Dense air: the light comes from the first few mean free paths.
    const double h = ref_height(w, p->e) + a->ground_km;
    double extinction = 0;
    for (int i = 0; i < a->bands; i++)
        extinction =
            fmax(extinction, (a->rayleigh_scattering[i] + a->rayleigh_absorption[i]) * ref_density(&a->rayleigh, h) +
                                 a->aerosol_extinction[i] * ref_density(&a->aerosol, h) +
                                 a->dust_extinction[i] * ref_density(&a->dust, h));
    if (extinction * p->length > 8)
        for (double t = 2; t < 200; t *= 8)
            cut(cuts, &n, t / extinction, p->length);
    cuts[n++] = p->length;
    qsort(cuts, (size_t)n, sizeof *cuts, ascending);
    return n;
}

static int is_lit(const path *p, double s) {
    const double e = p->e + s * (2 * p->b + s), b = p->b_sun + s * p->nu;
    return b >= 0 || e - b * b >= 0;
}

// First panels; columns of the observer's side at the start of each. Returns their number.
static int lay_panels(const path *p, panel *panels, double depth[REF_SPECIES]) {
    double cuts[2 * REF_KNOTS_MAX + 2];
    const int n = cuts_of(p, cuts);
    int count = 0;
    for (int i = 0; i + 1 < n; i++) {
        panel q = {.from = cuts[i], .to = cuts[i + 1], .u1 = 1};
        if (!(q.to > q.from))
            continue;
        memcpy(q.depth, depth, sizeof q.depth);
        if (is_lit(p, 0.5 * (q.from + q.to)) && count < PANELS_MAX / 2) {
            integrate(p, &q);
            panels[count++] = q;
        }
        ref_stretch(p->world, p->e + q.from * (2 * p->b + q.from), p->b + q.from, q.to - q.from, depth);
    }
    return count;
}

// Halves the worst panel until the sum of the error estimates is within the tolerance.
static int refine(const path *p, panel *panels, int *count, double tolerance, ref_answer *answer) {
    for (;;) {
        double sum[REF_BANDS] = {0}, error[REF_BANDS] = {0}, worst_error = -1, ratio = 0;
        int worst = 0, band = 0;
        for (int i = 0; i < *count; i++)
            for (int k = 0; k < REF_BANDS; k++) {
                sum[k] += panels[i].value[k];
                error[k] += panels[i].error[k];
            }
        for (int k = 0; k < REF_BANDS; k++)
            if (sum[k] > 0 && error[k] / sum[k] > ratio)
                ratio = error[k] / sum[k], band = k;
        memcpy(answer->radiance, sum, sizeof sum);
        answer->error = ratio;
        answer->panels = *count;
        if (ratio <= tolerance)
            return 0;
        if (*count >= PANELS_MAX)
            return -1;
        for (int i = 0; i < *count; i++)
            if (panels[i].error[band] > worst_error)
                worst_error = panels[i].error[band], worst = i;
        panel right = panels[worst];
        right.u0 = panels[worst].u1 = 0.5 * (right.u0 + right.u1);
        integrate(p, &panels[worst]);
        integrate(p, &right);
        panels[(*count)++] = right;
    }
}

// Moves the start of a ray from above the top to where it enters; 0 when it does not.
static int enter(const ref_world *w, path *p, double *skipped) {
    *skipped = 0;
    if (p->e <= w->top)
        return 1;
    const double c = p->e - w->top, root = p->b * p->b - c;
    if (p->b >= 0 || root <= 0)
        return 0;
    const double s = c / (sqrt(root) - p->b); // -b - sqrt(root)
    p->e = w->top;
    p->b = -sqrt(root);
    p->b_sun += s * p->nu;
    *skipped = s;
    return 1;
}

static void light_ground(const path *p, ref_answer *answer) {
    const ref_world *w = p->world;
    const ref_atmosphere *a = w->atmosphere;
    const double b = p->b_sun + p->length * p->nu;
    if (!(b > 0))
        return;
    double column[REF_SPECIES] = {0};
    ref_stretch(w, 0, b, ref_to_top(w, 0, b), column);
    for (int i = 0; i < a->bands; i++)
        answer->radiance[i] += a->albedo[i] / PI * a->irradiance[i] * (b / w->ground) * exp(-ref_depth(a, column, i)) *
                               answer->transmittance[i];
}

static path make_path(const ref_world *w, const ref_ray *ray) {
    const double y = fmax(0, ray->height_km), r = w->ground + y;
    path p = {.world = w, .e = y * (2 * w->ground + y), .b = r * ray->mu, .b_sun = r * ray->mu_s, .nu = ray->nu};
    p.sin2 = ray->nu_minus * ray->nu_plus;
    p.phase[0] = ref_phase_rayleigh(ray->nu);
    p.phase[1] = ref_phase_aerosol(w->atmosphere, ray->nu_minus, ray->nu_plus);
    p.phase[2] = ref_phase_dust(w->atmosphere, ray->nu_minus, ray->nu_plus);
    return p;
}

// The ray's end: the ground, the top, or the given length. Returns 1 when it is the ground.
static int end_path(path *p, double length) {
    const int down = p->b < 0 && p->b * p->b > p->e;
    const double end = down ? p->e / (sqrt(p->b * p->b - p->e) - p->b) : ref_to_top(p->world, p->e, p->b);
    p->length = fmin(end, fmax(0, length));
    return down && end <= length;
}

int ref_single(const ref_atmosphere *a, const ref_ray *ray, int lit_ground, const ref_options *options,
               ref_answer *answer) {
    const ref_options standard = {3e-8, 16};
    const ref_options *o = options ? options : &standard;
    ref_world world;
    ref_world_make(&world, a, o->nodes);
    path p = make_path(&world, ray);
    double skipped, depth[REF_SPECIES] = {0};
    *answer = (ref_answer){{0}, {1, 1, 1, 1}, 0, 0, 0};
    if (!enter(&world, &p, &skipped) || ray->length_km <= skipped)
        return 0;
    answer->meets_ground = end_path(&p, ray->length_km - skipped);
    panel *panels = malloc(PANELS_MAX * sizeof *panels);
    if (!panels)
        return -1;
    int count = lay_panels(&p, panels, depth);
    const int status = refine(&p, panels, &count, o->tolerance, answer);
    free(panels);
    for (int i = 0; i < REF_BANDS; i++) {
        answer->transmittance[i] = i < a->bands ? exp(-ref_depth(a, depth, i)) : 1;
        answer->radiance[i] *= i < a->bands ? a->irradiance[i] : 0;
    }
    if (lit_ground && answer->meets_ground)
        light_ground(&p, answer);
    return status;
}

void ref_column(const ref_atmosphere *a, const ref_ray *ray, double length_km, double column[3]) {
    ref_world world;
    ref_world_make(&world, a, 24);
    path p = make_path(&world, ray);
    double skipped, all[REF_SPECIES] = {0};
    column[0] = column[1] = column[2] = 0;
    if (!enter(&world, &p, &skipped) || length_km <= skipped)
        return;
    end_path(&p, length_km - skipped);
    ref_stretch(&world, p.e, p.b, p.length, all);
    for (int i = 0; i < 3; i++)
        column[i] = all[i];
}
