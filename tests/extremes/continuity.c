/// No pops: an input that moves finely moves the sky as the reference moves. EXTREMES_FULL=1: all sweeps instead of a
/// seeded choice of them.
#include "steps.h"

#define RADIAN 1e-4

static uint64_t state_of_random = 0x9E3779B97F4A7C15ULL;
static int full;

/// Sweeps that are not full step three times as far and look closer where something is seen.
static void watch(const char *name, void (*put)(setting *, double), double from, double step, int n, setting *s,
                  verdict *v) {
    const int unit = full ? 1 : 3;
    sweep_run(&(sweep){name, put, from, step * unit, n / unit}, s, v, unit);
}

/// A seeded choice: one of n on average, all of them in the long run.
static int chosen(int n) {
    const int yes = random_unit(&state_of_random) * n < 1;
    return full || yes;
}

static const double azimuths[STEP_RAYS] = {0, 1, 20, 45, 90, 135, 179, 180};
/// Zenith angle and azimuth of views that stay: sky, horizon, ground.
static const double fixed[2][STEP_RAYS][2] = {
    {{0, 0}, {40, 10}, {80, 0}, {89, 180}, {90.5, 0}, {92, 180}, {100, 90}, {180, 0}},
    {{60, 180}, {85, 90}, {90, 120}, {91, 0}, {91.5, 170}, {95, 0}, {130, 180}, {170, 180}}};

static void stay(setting *s, int set) {
    for (int i = 0; i < STEP_RAYS; i++)
        direction_of(s->view[i], fixed[set][i][0], fixed[set][i][1]);
}

static void put_view(setting *s, double x) {
    for (int i = 0; i < STEP_RAYS; i++)
        direction_of(s->view[i], x / DEGREE, azimuths[i]);
}

static void put_azimuth(setting *s, double x) {
    static const double zenith[STEP_RAYS] = {20, 60, 85, 89.9, 90, 91, 95, 120};
    for (int i = 0; i < STEP_RAYS; i++)
        direction_of(s->view[i], zenith[i], x / DEGREE);
}

static void put_sun(setting *s, double x) {
    direction_of(s->sun, x / DEGREE, 0);
}

static void put_height(setting *s, double x) {
    s->observer_km = (float)x;
}

static void put_length(setting *s, double x) {
    for (int i = 0; i < STEP_RAYS; i++)
        s->length_km[i] = (float)x;
}

/// What is allowed, %, and for what is beyond .2 % per .0001 rad or 1 m and 1 % across the geometric horizon, why.
typedef struct limits {
    double step, horizon;
    const char *reason;
} limits;

static const limits plain = {0.2, 1, NULL};
/// Where the planet's shadow is about to touch the middle of a ray its light passes low air there, which few nodes see.
static const limits of_sun = {2.6, 1, "just before the shadow touches a ray across the sun"};
static const limits of_views = {1.3, 2, "Mars' limb over the terminator"};
/// Limbs seen from 60 km with the sun 20 deg down: 1e-9 of the sun's light.
static const limits layered = {25, 1, "a limb by night"};

static void say(int number, const char *name, const verdict *v, limits most) {
    char ours[16], naive[16], text[120];
    printf("figure: %s: %d steps put before the reference (%d undecided), worst: %s\n", name, v->looked, v->undecided,
           v->where);
    if (v->where_horizon[0])
        printf("figure: %s: across the horizon %.3g %%: %s\n", name, v->horizon, v->where_horizon);
    snprintf(text, sizeof text, most.reason && v->step > plain.step ? "%s: %s" : "%s", figure_text(ours, v->step),
             most.reason);
    table_line(number, name, figure_text(naive, v->naive), text, "0");
    check_at_most(v->where, v->step, most.step);
    check_at_most(v->where_horizon, v->horizon, most.horizon);
}

static air airs[6];
static const char *const names[6] = {"clear", "hazy", "smoky", "layered", "shaped", "mars"};
static const double suns[] = {0, 40, 80, 88, 90, 91, 94, 97, 110};

static double height_of(const air *a, int i) {
    static const double share[8] = {0, 1.7e-5, 0.017, 0.17, 0.5, 0.9998, 1.008, 7};
    return share[i] * (double)a->atmosphere.top_km;
}

static void begin(setting *s, int a, int tier) {
    memset(s, 0, sizeof *s);
    s->a = &airs[a];
    (void)skv_quality_tier(&s->quality, (skv_tier)tier);
}

static verdict directions, layers;

/// Air with thin layers has a line of its own.
static verdict *of(int a, verdict *v) {
    return strcmp(names[a], "layered") == 0 ? &layers : v;
}

static void views(void **state) {
    char name[64];
    setting s;
    (void)state;
    for (int a = 0; a < 6; a++)
        for (int i = 0; i < 8; i++)
            for (int k = 0; k < 9; k++) {
                const int first = (a == 0 && i == 2 && (k == 2 || k == 4)) || (a == 3 && i == 5 && k == 8);
                if (!first && !chosen(40))
                    continue;
                begin(&s, a, k % 3 == 0 ? 2 : 1);
                s.observer_km = (float)height_of(&airs[a], i);
                direction_of(s.sun, suns[k], 0);
                snprintf(name, sizeof name, "zenith angle of the view, %s", names[a]);
                watch(name, put_view, 0, RADIAN, 31416, &s, of(a, &directions));
                if (!chosen(3))
                    continue;
                snprintf(name, sizeof name, "azimuth of the view, %s", names[a]);
                watch(name, put_azimuth, -0.001, RADIAN, 31440, &s, of(a, &directions));
            }
}

static void lights(void **state) {
    verdict v = {0};
    char name[64];
    setting s;
    (void)state;
    for (int a = 0; a < 6; a++)
        for (int i = 0; i < 8; i++)
            for (int set = 0; set < 2; set++) {
                if (!(a < 2 && i == 2) && !(set && i == 3 && (a == 1 || a == 3)) && !chosen(16))
                    continue;
                begin(&s, a, set ? 1 : 2);
                s.observer_km = (float)height_of(&airs[a], i);
                stay(&s, set);
                snprintf(name, sizeof name, "zenith angle of the sun, %s", names[a]);
                watch(name, put_sun, 0, RADIAN, 31416, &s, of(a, &v));
            }
    say(22, "steps: sun (.0001 rad)", &v, of_sun);
}

static void heights(void **state) {
    char name[64];
    setting s;
    (void)state;
    for (int a = 0; a < 6; a++)
        for (int k = 0; k < 9; k++)
            for (int set = 0; set < 2; set++) {
                const double top = (double)airs[a].atmosphere.top_km;
                if (!(a == 0 && k == 2) && !chosen(36))
                    continue;
                begin(&s, a, 1);
                direction_of(s.sun, suns[k], 0);
                stay(&s, set);
                snprintf(name, sizeof name, "observer's height, %s", names[a]);
                watch(name, put_height, -0.01, 1e-3, (int)(1.2 * top * 1000), &s, of(a, &directions));
            }
}

/// The fast tier takes six nodes by itself where four are too few.
static void tiers(void **state) {
    verdict v = {0};
    setting s;
    (void)state;
    for (int a = 0; a < 2; a++)
        for (int set = 0; set < 2; set++) {
            begin(&s, a, 0);
            stay(&s, set);
            s.observer_km = a ? 0.3f : 2;
            watch("fast tier, zenith angle of the sun", put_sun, 70 * DEGREE, RADIAN, 3800, &s, &v);
            direction_of(s.sun, set ? 80 : 50, 0);
            watch("fast tier, observer's height", put_height, 10, 1e-3, 14000, &s, &v);
        }
    say(24, "steps: fast tier changing its nodes", &v, plain);
}

static void lengths(void **state) {
    setting s;
    (void)state;
    for (int a = 0; a < 4; a++)
        for (int i = 0; i < 6; i++)
            for (int k = 0; k < 4; k++) {
                const double until = 60 + 400 * random_unit(&state_of_random);
                if (!(a == 1 && i == 3 && k == 2) && !chosen(8))
                    continue;
                begin(&s, a, 1);
                s.lengths = 1;
                s.observer_km = (float)height_of(&airs[a], i);
                direction_of(s.sun, suns[2 * k], 0);
                stay(&s, k % 2);
                watch("length, near", put_length, 0, 1e-3, 15000, &s, of(a, &directions));
                watch("length, far", put_length, until, 1e-3, 15000, &s, of(a, &directions));
            }
    say(20, "steps: view (.0001 rad), height, length of a ray (1 m)", &directions, of_views);
}

static int make_airs(void **state) {
    skv_atmosphere mars;
    (void)state;
    air_make(&airs[0], names[0], air_clear(4), 0);
    air_make(&airs[1], names[1], air_hazy(4), 0);
    air_make(&airs[2], names[2], air_smoky(3), 0);
    air_make(&airs[3], names[3], air_layered(3, 0), 0);
    air_make(&airs[4], names[4], air_shaped(3), 0);
    must(skv_atmosphere_preset(&mars, SKV_PRESET_MARS, 4), names[5]);
    air_make(&airs[5], names[5], mars, 0);
    full = getenv("EXTREMES_FULL") != NULL;
    return 0;
}

static void horizon(void **state) {
    char ours[16];
    (void)state;
    table_line(21, "steps: view across the geometric horizon", "-",
               figure_text(ours, fmax(directions.horizon, layers.horizon)), "0");
}

static void thin_layers(void **state) {
    (void)state;
    say(25, "steps: view, sun, height in a smoke layer 2-5 km up", &layers, layered);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(views), cmocka_unit_test(horizon), cmocka_unit_test(lights),      cmocka_unit_test(heights),
        cmocka_unit_test(tiers), cmocka_unit_test(lengths), cmocka_unit_test(thin_layers),
    };
    return cmocka_run_group_tests(tests, make_airs, NULL);
}
