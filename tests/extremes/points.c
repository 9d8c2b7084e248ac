/// Light scattered once at the ends of what the headers admit: a naive float program, the core (tier high) and the
/// double reference on the same floats. Then the same rays with subnormals flushed and in every rounding mode.
#include <fenv.h>
#if defined(__SSE__)
#include <xmmintrin.h>
#endif

#include "naive.h"
#include "table.h"

#define AIRS  96
#define SHOTS 4000
#define PI    3.14159265358979323846

typedef struct shot {
    int air;
    float observer_km, sun[3], view[3];
    float radiance[4], through[4];
    double least;
} shot;

/// One line of the table. `limit` is for ours, in percent; where it is not the design's 3 % the reason stands beside
/// it.
typedef struct row {
    int number;
    const char *name;
    double limit;
    const char *reason;     ///< for another limit than the design's 3 %; printed beside the value
    double naive, rounding; ///< the naive program's error, and how far it is from the same source in double
    double ours, truth;
    double shift; ///< >= 0: at the horizon, the largest turn that makes ours right, rad
    int naive_bad;
    char worst[240];
} row;

static air airs[AIRS];
static int air_count, shot_count;
static shot shots[SHOTS];
static skv_quality high;

static int new_air(const char *name, skv_atmosphere a, float ground_km) {
    assert_true(air_count < AIRS);
    air_make(&airs[air_count], name, a, ground_km);
    return air_count++;
}

static void evaluate(const skv_model *model, const shot *s, float radiance[4], float through[4]) {
    skv_frame frame;
    skv_light light;
    const skv_rays rays = {s->view, 0, NULL, 0};
    const skv_sky sky = {radiance, 0, through, 0};
    memset(radiance, 0xff, 4 * sizeof *radiance);
    memset(through, 0xff, 4 * sizeof *through);
    must(skv_light_sun(&light, model, s->sun), "skv_light_sun");
    must(skv_frame_begin(&frame, model, &high, s->observer_km, airs[s->air].ground_km, &light, 1), "skv_frame_begin");
    must(skv_radiance(&frame, 1, &rays, &sky), "skv_radiance");
}

/// The reference, and how far two quadratures of it are apart.
static void truth(const shot *s, ref_answer *answer, double *apart) {
    const air *a = &airs[s->air];
    const ref_options tight = {3e-10, 24};
    ref_answer other;
    double v[3], l[3], most = 0;
    for (int i = 0; i < 3; i++)
        v[i] = (double)s->view[i], l[i] = (double)s->sun[i];
    const ref_ray ray = ref_ray_from_vectors((double)s->observer_km - (double)a->ground_km, v, l);
    const int status = ref_single(&a->truth.atmosphere, &ray, 0, NULL, answer);
    if (apart == NULL) {
        if (status != 0 && answer->error > 1e-5)
            print_message("note: %s: the reference stopped at an error of %.1e\n", a->name, answer->error);
        return;
    }
    (void)ref_single(&a->truth.atmosphere, &ray, 0, &tight, &other);
    most = fmax(largest_of(other.radiance, 4), 1e-30);
    *apart = 0;
    for (int b = 0; b < a->atmosphere.bands; b++)
        *apart = fmax(*apart, fabs(answer->radiance[b] - other.radiance[b]) / most);
}

/// Largest channel error, %; infinite for what is not finite or negative.
static double error_of(const double got[4], const ref_answer *want, int bands, double least) {
    double error = 0;
    for (int b = 0; b < bands; b++) {
        if (!(got[b] >= 0 && got[b] < 1e38))
            return INFINITY;
        error = fmax(error, fabs(got[b] - want->radiance[b]));
    }
    return 100 * error / fmax(least, largest_of(want->radiance, bands));
}

/// A ray within float's rounding of the horizon may meet the ground or miss it: ours must be right for one that is
/// hardly another. @return the error against the nearest such ray; `want` becomes its truth.
static double turned(row *r, const shot *s, ref_answer *want, const double got[4], double least) {
    const air *a = &airs[s->air];
    double best = INFINITY;
    for (int i = 2; i < 40; i++) {
        const double by = 2e-8 * (i / 2) * (i % 2 ? -1 : 1);
        const double flat = hypot((double)s->view[0], (double)s->view[1]), up = (double)s->view[2];
        const double v[3] = {(double)s->view[0] / flat * cos(atan2(up, flat) + by),
                             (double)s->view[1] / flat * cos(atan2(up, flat) + by), sin(atan2(up, flat) + by)};
        const double l[3] = {(double)s->sun[0], (double)s->sun[1], (double)s->sun[2]};
        const ref_ray ray = ref_ray_from_vectors((double)s->observer_km - (double)a->ground_km, v, l);
        ref_answer answer;
        (void)ref_single(&a->truth.atmosphere, &ray, 0, NULL, &answer);
        const double error = error_of(got, &answer, a->atmosphere.bands, least);
        if (error <= r->limit) {
            r->shift = fmax(r->shift, fabs(by));
            *want = answer;
            return error;
        }
        best = fmin(best, error);
    }
    return best;
}

static void look(row *r, int a, float observer_km, const float sun[3], const float view[3]) {
    assert_true(shot_count < SHOTS);
    shot *s = &shots[shot_count++];
    ref_answer want;
    double got[4], naive[4];
    const int bands = airs[a].atmosphere.bands;
    s->air = a;
    s->observer_km = observer_km;
    memcpy(s->sun, sun, sizeof s->sun);
    memcpy(s->view, view, sizeof s->view);
    evaluate(&airs[a].model, s, s->radiance, s->through);
    truth(s, &want, NULL);
    const double least = s->least = least_radiance(&airs[a], &high, observer_km, sun);
    for (int b = 0; b < 4; b++)
        got[b] = (double)s->radiance[b];
    double ours = error_of(got, &want, bands, least);
    if (r->shift >= 0 && ours > r->limit)
        ours = turned(r, s, &want, got, least);
    if (!(ours <= r->ours)) {
        r->ours = ours;
        truth(s, &want, &r->truth);
        snprintf(r->worst, sizeof r->worst,
                 "%s, ground %g, observer %.9g km, sun %.9g %.9g %.9g, view %.9g %.9g %.9g: %.6g, want %.6g",
                 airs[a].name, (double)airs[a].ground_km, (double)observer_km, (double)sun[0], (double)sun[1],
                 (double)sun[2], (double)view[0], (double)view[1], (double)view[2], got[0], want.radiance[0]);
    }
    naive_double(&airs[a].atmosphere, airs[a].ground_km, observer_km, view, sun, got);
    naive_float(&airs[a].atmosphere, airs[a].ground_km, observer_km, view, sun, naive);
    const double rough = error_of(naive, &want, bands, least);
    r->naive_bad += rough > 1e30;
    if (rough > 1e30)
        return;
    r->naive = fmax(r->naive, rough);
    for (int b = 0; b < 4; b++)
        want.radiance[b] = got[b];
    r->rounding = fmax(r->rounding, error_of(naive, &want, bands, least));
}

static void say(const row *r) {
    char rounding[16], all[16], ours[16], own[16], first[64], middle[160], last[32];
    snprintf(first, sizeof first, "%s, rounding %s%s", figure_text(all, r->naive), figure_text(rounding, r->rounding),
             r->naive_bad ? ", NaN" : "");
    snprintf(middle, sizeof middle, r->shift > 0 ? "%s, for a ray at most %.1e rad away" : "%s",
             figure_text(ours, r->ours), r->shift);
    if (r->reason)
        snprintf(middle, sizeof middle, "%s: %s", figure_text(ours, r->ours), r->reason);
    snprintf(last, sizeof last, "%s", r->truth < 1e-8 ? "<1e-6" : figure_text(own, 100 * r->truth));
    table_line(r->number, r->name, first, middle, last);
    printf("figure: %s: ours %.3g %% at %s\n", r->name, r->ours, r->worst);
    check_at_most(r->worst, r->ours, r->limit);
}

static void toward(float to[3], double zenith_rad, double azimuth_deg) {
    direction_of(to, zenith_rad / DEGREE, azimuth_deg);
}

/// Angle from the zenith at which the ground's horizon lies.
static double horizon_of(int a, double observer_km) {
    const double r = (double)airs[a].atmosphere.radius_km + (double)airs[a].ground_km;
    const double y = observer_km - (double)airs[a].ground_km;
    return y > 0 ? acos(-1.0) / 2 + acos(r / (r + y)) : acos(-1.0) / 2;
}

/// A fan over the zenith angles that meet air.
static void fan(row *r, int a, float observer_km, const float sun[3], int n) {
    const double radius = (double)airs[a].atmosphere.radius_km, top = radius + (double)airs[a].atmosphere.top_km;
    const double r0 = radius + (double)observer_km, from = r0 > top ? PI - asin(top / r0) : 0;
    for (int i = 0; i < n; i++) {
        float view[3];
        toward(view, from + (PI - from) * (i + 0.5) / n, 180.0 * (i % 5) / 4);
        look(r, a, observer_km, sun, view);
    }
}

static void heights(void **state) {
    (void)state;
    row r = {.number = 1, .name = "height -430 m to 36,000 km, exactly at ground and top", .limit = 3, .shift = -1};
    const int sea = new_air("clear", air_clear(4), 0), low = new_air("clear", air_clear(4), -0.43f);
    const int hazy = new_air("hazy", air_hazy(4), 0);
    static const double suns[] = {30, 88, 93};
    for (int i = 0; i < 3; i++) {
        static const float at[] = {-0.43f, 0.001f, 8.848f, 35, 59.9f, 60.1f, 400, 36000};
        static const float edge[] = {0, 1.4e-45f, 1e-6f, 59.9999962f, 60, 60.0000038f};
        float sun[3];
        direction_of(sun, suns[i], 0);
        for (int k = 0; k < 8; k++)
            fan(&r, k == 0 ? low : k % 2 ? sea : hazy, at[k], sun, 12);
        for (int k = 0; k < 6; k++)
            fan(&r, sea, edge[k], sun, 9);
        fan(&r, low, -0.43f, sun, 9);
        fan(&r, low, -0.42999998f, sun, 9);
    }
    say(&r);
}

static void views(void **state) {
    (void)state;
    // Within 1e-7 rad of tangency floats do not say whether a ray meets the ground: see below.
    row r = {.number = 3, .name = "view 1e-7 rad around zenith and nadir", .limit = 3, .shift = -1};
    row at_horizon = {.number = 4, .name = "view 1e-7 to 1e-5 rad around the horizon", .limit = 3};
    static const double off[] = {-1e-5, -1e-6, -3e-7, -1e-7, 0, 1e-7, 3e-7, 1e-6, 1e-5};
    static const float at[] = {0, 0.002f, 1, 11, 59, 400};
    for (int i = 0; i < 6; i++)
        for (int k = 0; k < 9; k++)
            for (int s = 0; s < 2; s++) {
                float sun[3], view[3];
                direction_of(sun, s ? 85 : 50, 0);
                toward(view, fabs(off[k]), 40 + 30 * k);
                look(&r, 0, at[i], sun, view);
                view[2] = -view[2];
                look(&r, 0, at[i], sun, view);
                toward(view, horizon_of(0, (double)at[i]) + off[k], 60 * s);
                look(&at_horizon, 0, at[i], sun, view);
            }
    say(&r);
    say(&at_horizon);
}

static void suns(void **state) {
    (void)state;
    row r = {
        .number = 5, .name = "sun at 0, 180 deg, 1e-6 rad around horizon and antisolar axis", .limit = 3, .shift = -1};
    static const double off[] = {-1e-6, 0, 1e-6};
    static const float at[] = {0, 0.3f, 10, 59, 400};
    for (int i = 0; i < 5; i++) {
        for (int k = 0; k < 8; k++) {
            float sun[3];
            toward(sun,
                   k < 3    ? PI / 2 + off[k]
                   : k < 6  ? horizon_of(0, (double)at[i]) + off[k - 3]
                   : k == 6 ? 0
                            : PI,
                   0);
            fan(&r, 0, at[i], sun, 7);
        }
        for (int k = 0; k < 9; k++) {
            const double zenith = (k / 3 == 0 ? 20 : k / 3 == 1 ? 80 : 91) * DEGREE;
            float sun[3], view[3];
            toward(sun, zenith, 0);
            toward(view, zenith + off[k % 3], 0);
            look(&r, 0, at[i], sun, view);
            toward(view, PI - zenith + off[k % 3], 180);
            look(&r, 0, at[i], sun, view);
        }
    }
    say(&r);
}

static void asymmetry(void **state) {
    (void)state;
    row r = {.number = 7, .name = "g from -.9999 to .9999", .limit = 3, .shift = -1};
    static const float g[] = {0.9999f, 0.999f, 0.99f, 0.9f, 0.3f, 0};
    static const double off[] = {0, 1e-5, 1e-4, 1e-3, 0.01, 0.1, 1, 3};
    for (int i = 0; i < 24; i++) {
        skv_atmosphere gas = air_hazy(3);
        gas.aerosol_g = g[i / 4] * (i % 2 ? 1.0f : -1.0f);
        gas.aerosol_phase = i % 4 < 2 ? SKV_PHASE_HG : SKV_PHASE_CS;
        const int a = new_air("hazy, g", gas, 0);
        for (int k = 0; k < 8; k++) {
            float sun[3], view[3];
            direction_of(sun, 60, 0);
            toward(view, 60 * DEGREE + off[k] * (k % 2 && k < 7 ? -1 : 1) * (k < 6 ? 1 : 0.1), off[k] > 1 ? 180 : 0);
            look(&r, a, 0.5f, sun, view);
            toward(view, 120 * DEGREE - off[k] * 0.1, 180);
            look(&r, a, 5, sun, view);
        }
        static skv_model model;
        gas.aerosol_g = i % 2 ? 0.99991f : -0.99991f;
        assert_int_equal(skv_model_build(&model, &gas), SKV_ERR_RANGE);
    }
    say(&r);
}

/// Aerosol of a meteorological range: 3.912/V.
static skv_atmosphere fog(double visibility_km, float scale_km) {
    skv_atmosphere gas = air_clear(3);
    for (int b = 0; b < 3; b++) {
        gas.aerosol_extinction_per_km[b] = (float)(3.912 / visibility_km * (1 - 0.05 * b));
        gas.aerosol_scattering_per_km[b] = 0.95f * gas.aerosol_extinction_per_km[b];
    }
    gas.aerosol.scale_height_km = scale_km;
    return gas;
}

static void visibility(void **state) {
    (void)state;
    row r = {.number = 8,
             .name = "visibility 20 m to none",
             .limit = 18,
             .reason = "dark rays inside fog under a low sun",
             .shift = -1};
    static const double range[] = {0.02, 0.1, 0.5, 2, 10, 50, 300};
    static const double suns_deg[] = {30, 85, 92};
    for (int i = 0; i <= 7; i++) {
        skv_atmosphere clean = air_clear(3);
        clean.aerosol.kind = SKV_PROFILE_NONE;
        const int a = new_air("fog", i < 7 ? fog(range[i], i < 2 ? 0.05f : 1.2f) : clean, 0);
        for (int s = 0; s < 3; s++) {
            static const float at[] = {0, 0.03f, 1, 6};
            float sun[3];
            direction_of(sun, suns_deg[s], 0);
            for (int k = 0; k < 4; k++)
                fan(&r, a, at[k], sun, 8);
        }
    }
    say(&r);
}

static void scale_heights(void **state) {
    (void)state;
    row r = {.number = 10,
             .name = "scale height 1 m to 1000 km",
             .limit = 3.5,
             .reason = "H of 70 km and more in twilight",
             .shift = -1};
    static const float scale[] = {0.001f, 0.03f, 0.7f, 5, 14, 70, 1000};
    static const double suns_deg[] = {20, 80, 91};
    for (int i = 0; i < 14; i++) {
        skv_atmosphere gas = air_clear(3);
        (i % 2 ? &gas.rayleigh : &gas.aerosol)->scale_height_km = scale[i / 2];
        const int a = new_air(i % 2 ? "Rayleigh's scale height" : "aerosol's scale height", gas, 0);
        for (int s = 0; s < 3; s++) {
            float sun[3];
            direction_of(sun, suns_deg[s], 0);
            fan(&r, a, i < 4 && s != 1 ? 0.0005f : 2, sun, 9);
            fan(&r, a, 70, sun, 4);
        }
    }
    say(&r);
}

static void planets(void **state) {
    (void)state;
    row r = {.number = 11,
             .name = "planets of 1 km to 70,000 km",
             .limit = 18,
             .reason = "80 scale heights of air over 1 km, twilight",
             .shift = -1};
    static const float radius[] = {1, 5, 30, 200, 1737, 20000, 70000};
    static const double suns_deg[] = {20, 85, 95};
    for (int i = 0; i < 14; i++) {
        const double size = (double)radius[i / 2] / 6360;
        skv_atmosphere gas = air_clear(3);
        gas.radius_km = radius[i / 2];
        gas.top_km = fminf(60, gas.radius_km);
        if (i % 2) { // the same picture on a smaller or larger scale
            gas.top_km = (float)fmin(1000, fmax(0.1, 60 * size));
            gas.rayleigh.scale_height_km = (float)(8 * size);
            gas.aerosol.scale_height_km = (float)fmax(0.001, 1.2 * size);
            gas.ozone.peak_km = (float)(25 * size);
            gas.ozone.half_width_km = (float)fmax(0.01, 15 * size);
            for (int b = 0; b < 3; b++) {
                gas.rayleigh_scattering_per_km[b] /= (float)size;
                gas.aerosol_scattering_per_km[b] /= (float)size;
                gas.aerosol_extinction_per_km[b] /= (float)size;
                gas.ozone_absorption_per_km[b] /= (float)size;
            }
        }
        const int a = new_air(i % 2 ? "planet, scaled" : "planet", gas, 0);
        for (int s = 0; s < 3; s++) {
            float sun[3];
            direction_of(sun, suns_deg[s], 0);
            fan(&r, a, 0.03f * gas.top_km, sun, 9);
            fan(&r, a, 1.5f * gas.top_km, sun, 4);
        }
    }
    say(&r);
}

static void bands(void **state) {
    (void)state;
    row r = {.number = 12, .name = "single bands at 0, subnormal coefficients", .limit = 3, .shift = -1};
    float sun[3];
    direction_of(sun, 60, 0);
    for (int b = 0; b < 4; b++) {
        skv_atmosphere gas = air_clear(4);
        gas.rayleigh_scattering_per_km[b] = gas.aerosol_scattering_per_km[b] = 0;
        fan(&r, new_air("no scattering in a band", gas, 0), 1, sun, 8);
        gas.aerosol_extinction_per_km[b] = gas.ozone_absorption_per_km[b] = 0;
        fan(&r, new_air("nothing in a band", gas, 0), 1, sun, 8);
        gas = air_clear(4);
        gas.solar_irradiance[b] = 0;
        fan(&r, new_air("no sun in a band", gas, 0), 1, sun, 8);
        gas = air_clear(4);
        gas.rayleigh_scattering_per_km[b] = 1e-40f;
        gas.aerosol_scattering_per_km[b] = 1.4e-45f;
        gas.aerosol_extinction_per_km[b] = 1e-39f;
        gas.ozone_absorption_per_km[b] = 1e-41f;
        gas.solar_irradiance[3 - b] = 1e-40f;
        fan(&r, new_air("subnormal coefficients", gas, 0), 1, sun, 8);
        gas.ozone.kind = SKV_PROFILE_EXPONENTIAL;
        gas.ozone.scale_height_km = 5;
        gas.aerosol_g = 1e-40f;
        fan(&r, new_air("subnormal coefficients and g", gas, 0), 1, sun, 8);
    }
    say(&r);
}

/// Every ray so far once more in another mode; the model is built in it too.
static double again(const char *mode, int *where) {
    static skv_model model;
    double worst = 0;
    int built = -1;
    for (int i = 0; i < shot_count; i++) {
        const shot *s = &shots[i];
        float radiance[4], through[4];
        if (built != s->air)
            must(skv_model_build(&model, &airs[s->air].atmosphere), mode);
        built = s->air;
        evaluate(&model, s, radiance, through);
        double most = s->least;
        for (int b = 0; b < model.bands; b++)
            most = fmax(most, (double)s->radiance[b]);
        for (int b = 0; b < model.bands; b++) {
            if (!(radiance[b] >= 0 && radiance[b] < 1e38f && through[b] >= 0 && through[b] <= 1))
                fail_msg("%s, %s: observer %.9g, view %.9g %.9g %.9g: radiance %g, transmittance %g", mode,
                         airs[s->air].name, (double)s->observer_km, (double)s->view[0], (double)s->view[1],
                         (double)s->view[2], (double)radiance[b], (double)through[b]);
            const double change = 100 * fabs((double)radiance[b] - (double)s->radiance[b]) / most;
            if (change > worst)
                worst = change, *where = i;
        }
    }
    return worst;
}

static void modes(void **state) {
    static const struct {
        const char *name;
        int mode;
    } of[] = {{"upward", FE_UPWARD}, {"downward", FE_DOWNWARD}, {"toward zero", FE_TOWARDZERO}};
    char text[96], flushed[16] = "0";
    int at = 0;
    (void)state;
#if defined(__SSE__)
    const unsigned before = _mm_getcsr();
    _mm_setcsr(before | 0x8040); // FTZ, DAZ
    figure_text(flushed, again("subnormals flushed", &at));
    _mm_setcsr(before);
#endif
    for (int i = 0; i < 3; i++) {
        fesetround(of[i].mode);
        const double d = again(of[i].name, &at);
        fesetround(FE_TONEAREST);
        printf("figure: rounding %s: largest change %.3g %%, %s, observer %g km, radiance %.3g to nearest\n",
               of[i].name, d, airs[shots[at].air].name, (double)shots[at].observer_km, (double)shots[at].radiance[0]);
    }
    snprintf(text, sizeof text, "finite, >= 0; flushed: the same within %s", flushed);
    table_line(14, "all of these, subnormals flushed; all rounding modes", "-", text, "-");
}

static int restore(void **state) {
    (void)state;
    fesetround(FE_TONEAREST);
#if defined(__SSE__)
    _mm_setcsr(0x1f80);
#endif
    return 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(heights),   cmocka_unit_test(views),      cmocka_unit_test(suns),
        cmocka_unit_test(asymmetry), cmocka_unit_test(visibility), cmocka_unit_test(scale_heights),
        cmocka_unit_test(planets),   cmocka_unit_test(bands),      cmocka_unit_test_teardown(modes, restore),
    };
    (void)skv_quality_tier(&high, SKV_TIER_HIGH);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
