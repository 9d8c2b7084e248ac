/// Sliders: the air's parameters move in steps of .0001 of themselves. Nothing may pop. EXTREMES_FULL=1: finer, more
/// observers.
#include "steps.h"

static int full;
static air moving;

static void put_visibility(setting *s, double x) {
    for (int b = 0; b < 4; b++) {
        s->a->atmosphere.aerosol_extinction_per_km[b] = (float)(3.912 / exp(x) * (1 - 0.05 * b));
        s->a->atmosphere.aerosol_scattering_per_km[b] = 0.9f * s->a->atmosphere.aerosol_extinction_per_km[b];
    }
}
static void put_turbidity(setting *s, double x) {
    s->a->atmosphere.turbidity = (float)exp(x);
}
static void put_aerosol_scale(setting *s, double x) {
    s->a->atmosphere.aerosol.scale_height_km = (float)exp(x);
}
static void put_rayleigh_scale(setting *s, double x) {
    s->a->atmosphere.rayleigh.scale_height_km = (float)exp(x);
}
static void put_radius(setting *s, double x) {
    s->a->atmosphere.radius_km = (float)exp(x);
    s->a->atmosphere.top_km = fminf(60, s->a->atmosphere.radius_km);
}
static void put_top(setting *s, double x) {
    s->a->atmosphere.top_km = (float)exp(x);
}
static void put_forward(setting *s, double x) {
    s->a->atmosphere.aerosol_g = (float)(1 - exp(x));
}
static void put_backward(setting *s, double x) {
    s->a->atmosphere.aerosol_g = (float)(exp(x) - 1);
}
static void put_gas(setting *s, double x) {
    static const double one[4] = {0.0331, 0.017, 0.0096, 0.0058};
    for (int b = 0; b < 4; b++)
        s->a->atmosphere.rayleigh_scattering_per_km[b] = (float)(one[b] * exp(x));
}
static void put_background(setting *s, double x) {
    s->a->atmosphere.aerosol.kind = SKV_PROFILE_EXP_BACKGROUND;
    s->a->atmosphere.aerosol.background = (float)exp(x);
}
static void put_layer(setting *s, double x) {
    skv_atmosphere *a = &s->a->atmosphere;
    a->dust.kind = SKV_PROFILE_TENT;
    a->dust.peak_km = (float)exp(x);
    a->dust.half_width_km = 1.5f;
    a->dust_phase = SKV_PHASE_HG;
    a->dust_g = 0.66f;
    for (int b = 0; b < 4; b++)
        a->dust_scattering_per_km[b] = 0.1f, a->dust_extinction_per_km[b] = 0.11f;
}

typedef struct slider {
    int number;
    const char *name;
    void (*put)(setting *s, double x);
    double from, to;
} slider;

/// Sliders that share a number share a line of the table.
static const slider sliders[] = {
    {40, "visibility", put_visibility, 0.02, 3000},
    {40, "turbidity", put_turbidity, 1e-3, 1e3},
    {40, "scale height of the aerosol", put_aerosol_scale, 0.001, 1000},
    {40, "scale height of the gas", put_rayleigh_scale, 0.001, 1000},
    {40, "radius of the planet", put_radius, 1, 70000},
    {40, "top of the air", put_top, 0.1, 1000},
    {40, "1 - g", put_forward, 1e-4, 1},
    {40, "1 + g", put_backward, 1e-4, 1},
    {40, "amount of gas", put_gas, 1e-3, 30},
    {40, "background of the aerosol", put_background, 1e-6, 1},
    {41, "peak of a layer", put_layer, 0.01, 80},
};
#define SLIDERS (int)(sizeof sliders / sizeof *sliders)

/// %, .2 but for the reasons given.
static const double limits[] = {0.42, 0.85};
static const char *const reasons[] = {
    "where the closed form gives way to integration (H of 15 km), and in ten times the air",
    "as it leaves through the top of the air"};

static const char *const titles[] = {"steps: visibility, turbidity, gas, scale heights, g, radius, top (.0001 of it)",
                                     "steps: height of a layer (.0001 of it)"};

static void stay(setting *s, int set) {
    static const double fixed[2][STEP_RAYS][2] = {
        {{0, 0}, {40, 10}, {80, 0}, {89, 180}, {90.5, 0}, {92, 180}, {100, 90}, {180, 0}},
        {{60, 180}, {85, 90}, {90, 120}, {91, 0}, {91.5, 170}, {95, 0}, {130, 180}, {170, 180}}};
    for (int i = 0; i < STEP_RAYS; i++)
        direction_of(s->view[i], fixed[set][i][0], fixed[set][i][1]);
}

static void one(const slider *p, verdict *v) {
    static const double heights[] = {0, 0.3, 5, 40}, suns[] = {40, 85, 92};
    const int unit = full ? 2 : 16;
    const double from = log(p->from), to = log(p->to);
    for (int i = 0; i < 12; i++) {
        setting s;
        if (!full && i % 4 != (i / 4 + 1) % 3 + 1 && !(i == 0))
            continue;
        memset(&s, 0, sizeof s);
        skv_atmosphere gas = air_clear(4);
        gas.ozone.kind = SKV_PROFILE_NONE; // its table would be built at every step
        air_make(&moving, "clear without ozone", gas, 0);
        s.a = &moving;
        s.build = 1;
        s.observer_km = (float)heights[i % 4];
        (void)skv_quality_tier(&s.quality, SKV_TIER_STANDARD);
        direction_of(s.sun, suns[i / 4], 0);
        stay(&s, i % 2);
        sweep_run(&(sweep){p->name, p->put, from, unit * 1e-4, (int)((to - from) / (unit * 1e-4))}, &s, v, unit);
    }
}

static void all(void **state) {
    int bad = 0;
    (void)state;
    for (int number = 40; number <= 41; number++) {
        verdict v = {0};
        char ours[16], naive[16], text[140];
        for (int k = 0; k < SLIDERS; k++)
            if (sliders[k].number == number)
                one(&sliders[k], &v);
        const double worst = fmax(v.step, v.horizon);
        printf("figure: %s: %.3g %% per .0001, worst: %s\n", titles[number - 40], worst,
               v.horizon > v.step ? v.where_horizon : v.where);
        snprintf(text, sizeof text, worst > 0.2 ? "%s: %s" : "%s", figure_text(ours, worst), reasons[number - 40]);
        table_line(number, titles[number - 40], figure_text(naive, v.naive), text, "0");
        bad |= !(worst <= limits[number - 40]);
    }
    assert_false(bad);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(all)};
    full = getenv("EXTREMES_FULL") != NULL;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
