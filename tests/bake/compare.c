/// compare PRESET TURBIDITY FILE.raw16f [LABEL MEAN P95 MAX]...: the C sampler on a baked table against skv_radiance()
/// with all orders, at random places and directions between the texels. Prints one figure a label; each must be within
/// its limits.
#include "sky.h"

enum { DIRECTIONS = 96, FRAMES = 60, LABELS = 12 };

typedef struct results {
    const char *label[LABELS];
    errors of[LABELS];
    int n;
} results;

static errors *results_of(results *r, const char *label) {
    for (int i = 0; i < r->n; i++)
        if (strcmp(r->label[i], label) == 0)
            return &r->of[i];
    if (r->n == LABELS)
        stop("too many labels");
    r->label[r->n] = label;
    return &r->of[r->n++];
}

static double dip_of(const skv_bake_table *t, double h) {
    return acos((double)t->radius_km / ((double)t->radius_km + h));
}

static double dome_mean(const float radiance[][4], int n) {
    double sum = 0.0;
    for (int i = 0; i < n; i++)
        sum += most4(radiance[i]) / n;
    return sum;
}

/// Whether a direction is of sky; -1: too near the horizon to say.
static int is_sky(const float d[3], double dip) {
    const double above = asin(fmin(fmax((double)d[2], -1.0), 1.0)) + dip;
    return fabs(above) < 1e-5 ? -1 : above > 0.0;
}

// ---- the four kinds

static void compare_sky_view(const skv_bake_table *t, const bake_sky *sky, results *r) {
    static float direction[40 * DIRECTIONS][3], want[40 * DIRECTIONS][4], through[40 * DIRECTIONS][4];
    const int n = 40 * DIRECTIONS;
    const double dip = dip_of(t, (double)t->height_km), zenith = acos((double)t->mu_s), azimuth = 2.1;
    uint64_t state = 88172645463325252u;
    float sun[3], got[4], transmittance[4];
    toward(sun, zenith, azimuth);
    for (int i = 0; i < n; i++)
        random_direction(&state, dip, zenith, azimuth, direction[i]);
    sky_light(sky, 1, t->height_km, sun, (size_t)n, direction[0], want[0], through[0]);
    const double mean = dome_mean((const float(*)[4])want, n);
    for (int i = 0; i < n; i++) {
        const int up = is_sky(direction[i], dip);
        if (up < 0)
            continue;
        skv_bake_sky_view(t, direction[i], sun, got, transmittance);
        errors_add(results_of(r, up ? "sky" : "ground"), error_of(got, want[i], mean));
        errors_add(results_of(r, "transmittance"), error_of(transmittance, through[i], 20.0));
    }
}

static void compare_transmittance(const skv_bake_table *t, const bake_sky *sky, results *r) {
    uint64_t state = 362436069362436069u;
    const float sun[3] = {0.0f, 0.0f, 1.0f};
    for (int i = 0; i < 8000; i++) {
        const double h = (double)t->top_km * pow(uniform(&state), 3.0), dip = dip_of(t, h);
        float direction[3], want[4], through[4], got[4];
        random_direction(&state, dip, 1.0, 0.0, direction);
        const int up = is_sky(direction, dip);
        if (up < 0)
            continue;
        sky_light(sky, 0, (float)h, sun, 1, direction, want, through);
        skv_bake_transmittance(t, (float)h, direction[2], got);
        errors_add(results_of(r, up ? "to the top" : "to the ground"), error_of(got, through, 20.0)); // % of 1
    }
}

typedef struct sun_class {
    const char *sky, *ground;
    double from_deg, to_deg;
} sun_class;

static void compare_scattering(const skv_bake_table *t, const bake_sky *sky, results *r) {
    static const sun_class classes[] = {{"sky, sun zenith 0-75", "ground, 0-75", 0.0, 75.0},
                                        {"sky, 75-88", "ground, 75-88", 75.0, 88.0},
                                        {"sky, 88-92", "ground, 88-92", 88.0, 92.0},
                                        {"sky, 92-96", "ground, 92-96", 92.0, 96.0},
                                        {"sky, 96-101", "ground, 96-101", 96.0, 101.0}};
    uint64_t state = 521288629546311u;
    for (int c = 0; c < 5; c++)
        for (int f = 0; f < FRAMES; f++) {
            static float direction[DIRECTIONS][3], want[DIRECTIONS][4];
            const double h = (double)t->top_km * pow(uniform(&state), 3.0), dip = dip_of(t, h);
            const double zenith =
                DEGREE * (classes[c].from_deg + (classes[c].to_deg - classes[c].from_deg) * uniform(&state));
            float sun[3], got[4];
            toward(sun, zenith, 0.7);
            for (int i = 0; i < DIRECTIONS; i++)
                random_direction(&state, dip, zenith, 0.7, direction[i]);
            sky_light(sky, 0, (float)h, sun, DIRECTIONS, direction[0], want[0], NULL);
            const double mean = dome_mean((const float(*)[4])want, DIRECTIONS);
            for (int i = 0; i < DIRECTIONS; i++) {
                const int up = is_sky(direction[i], dip);
                if (up < 0)
                    continue;
                skv_bake_scattering(t, (float)h, direction[i], sun, got);
                errors_add(results_of(r, up ? classes[c].sky : classes[c].ground), error_of(got, want[i], mean));
            }
        }
}

/// Irradiance by the midpoint rule over mu and azimuth: another rule than the command's, and thirty times as many rays.
/// In three pieces from the zenith over the horizontal and the horizon to the nadir, dense at the horizon.
static void irradiance(const bake_sky *sky, double h, const float sun[3], double sums[2][4]) {
    enum { POLAR = 60, ROUND = 80, RAYS = 3 * POLAR * ROUND };
    static float direction[RAYS][3], radiance[RAYS][4];
    static double weight[RAYS];
    const double pi = 3.14159265358979323846, r = (double)sky->model.radius_km;
    const double horizon = -sqrt(h * (2.0 * r + h)) / (r + h), from[3] = {0.0, horizon, horizon},
                 to[3] = {1.0, 0.0, -1.0};
    for (int i = 0; i < RAYS; i++) {
        const int piece = i / (POLAR * ROUND);
        const double k = (i / ROUND % POLAR + 0.5) / POLAR, j = 2.0 * pi * (i % ROUND + 0.5) / ROUND;
        const double mu = from[piece] + (to[piece] - from[piece]) * k * k, level = sqrt(1.0 - mu * mu);
        direction[i][0] = (float)(level * cos(j));
        direction[i][1] = (float)(level * sin(j));
        direction[i][2] = (float)mu;
        weight[i] = fabs(mu * (to[piece] - from[piece])) * 2.0 * k / POLAR * 2.0 * pi / ROUND;
    }
    sky_light(sky, 1, (float)h, sun, RAYS, direction[0], radiance[0], NULL);
    memset(sums, 0, 2 * sizeof sums[0]);
    for (int i = 0; i < RAYS; i++)
        for (int b = 0; b < 4; b++)
            sums[i >= POLAR * ROUND][b] += weight[i] * (double)radiance[i][b];
}

static void compare_irradiance(const skv_bake_table *t, const bake_sky *sky, results *r) {
    uint64_t state = 1181783497276652981u;
    for (int i = 0; i < 40; i++) {
        const double h = (double)t->top_km * pow(uniform(&state), 3.0), zenith = DEGREE * 101.0 * uniform(&state);
        float sun[3], got[4], want[4], none[4], through[4];
        double sums[2][4], at_ground[2][4];
        toward(sun, zenith, 0.0);
        irradiance(sky, h, sun, sums);
        irradiance(sky, 0.0, sun, at_ground); // the floor: 5 % of the brightest on the ground at that time
        for (int layer = 0; layer < 2; layer++) {
            for (int b = 0; b < 4; b++)
                want[b] = (float)sums[layer][b];
            skv_bake_irradiance(t, layer, (float)h, sun[2], got);
            errors_add(results_of(r, layer == 0 ? zenith < 88.0 * DEGREE ? "down, sun above 2 deg" : "down, below"
                                     : zenith < 88.0 * DEGREE ? "up, sun above 2 deg"
                                                              : "up, below"),
                       error_of(got, want, fmax(at_ground[0][0], at_ground[0][3])));
        }
        sky_light(sky, 0, (float)h, sun, 1, sun, none, through);
        for (int b = 0; b < 4; b++)
            want[b] = is_sky(sun, dip_of(t, h)) ? through[b] * sky->model.solar_irradiance[b] : 0.0f;
        skv_bake_irradiance(t, SKV_BAKE_BEAM, (float)h, sun[2], got);
        errors_add(results_of(r, "beam, % of the sun"), error_of(got, want, 20.0 * most4(sky->model.solar_irradiance)));
    }
}

// ---- limits

static int check(results *r, const char *file, int argc, char **argv) {
    int bad = 0;
    for (int i = 0; i < r->n; i++) {
        const size_t n = r->of[i].n;
        const error_summary s = errors_sum(&r->of[i]);
        printf("figure: %s, %s: %.2g/%.2g/%.2g %% (mean/95 %%/largest of %zu)\n", file, r->label[i], s.mean, s.p95,
               s.most, n);
        for (int a = 0; a + 3 < argc; a += 4) {
            const double limit[3] = {atof(argv[a + 1]), atof(argv[a + 2]), atof(argv[a + 3])};
            if (strcmp(argv[a], r->label[i]) == 0 && !(s.mean <= limit[0] && s.p95 <= limit[1] && s.most <= limit[2])) {
                printf("FAILED: %s, %s: allowed is %g/%g/%g %%\n", file, argv[a], limit[0], limit[1], limit[2]);
                bad = 1;
            }
        }
    }
    return bad;
}

/// The deferred phase functions by the formulas of the papers [Henyey41], [Cornette92], in double.
static void check_phase(const skv_bake_table *t) {
    const double pi = 3.14159265358979323846;
    const float sun[3] = {0.0f, 0.0f, 1.0f};
    for (int k = 0; k < t->deferred; k++)
        for (int i = 0; i <= 180; i += 3) {
            float view[3];
            toward(view, DEGREE * i, 0.3);
            const double g = (double)t->g[k], nu = cos(DEGREE * i), d = pow(1.0 + g * g - 2.0 * g * nu, 1.5);
            const double hg = (1.0 - g * g) / (4.0 * pi * d);
            const double cs = 3.0 / (8.0 * pi) * (1.0 - g * g) * (1.0 + nu * nu) / ((2.0 + g * g) * d);
            const double want = t->phase[k] == SKV_BAKE_HG ? hg : cs, got = (double)skv_bake_phase(t, k + 1, view, sun);
            if (!(fabs(got - want) <= 2e-5 * want)) // floats; the sine of a small angle from a difference
                stop("skv_bake_phase()");
        }
}

int main(int argc, char **argv) {
    static void (*const kinds[])(const skv_bake_table *, const bake_sky *, results *) = {
        compare_sky_view, compare_transmittance, compare_scattering, compare_irradiance};
    static bake_sky sky;
    static results r;
    skv_bake_table table;
    if (argc < 4)
        stop("usage: compare PRESET TURBIDITY FILE.raw16f [LABEL MEAN P95 MAX]...");
    sky_begin(&sky, argv[1], (float)atof(argv[2]));
    table_read(argv[3], &table);
    check_phase(&table);
    kinds[table.what](&table, &sky, &r);
    const char *const slash = strrchr(argv[3], '/');
    return check(&r, slash ? slash + 1 : argv[3], argc - 4, argv + 4);
}
