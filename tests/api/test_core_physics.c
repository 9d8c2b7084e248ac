/// What physics demands of the core, through its API alone: sums, shares, lengths of rays, grounds, the top of the air.
#include "core_air.h"

#define COUNT(a) ((int)(sizeof(a) / sizeof((a)[0])))
#define SKY_ONLY (SKV_WITH_ALL & ~(uint32_t)SKV_WITH_GROUND)

static skv_model clear, other, third;

static int build_clear(void **state) {
    (void)state;
    const skv_atmosphere a = air_br17o();
    build(&clear, &a);
    return 0;
}

/// Rules and depths, the first two in closed form.
static const skv_quality qualities[] = {
    {SKV_GAUSS_EXP, SKV_DEPTH_BY_CHAPMAN, 8, 1, SKV_WITH_ALL}, {SKV_KELLER, SKV_DEPTH_BY_CHAPMAN, 16, 1, SKV_WITH_ALL},
    {SKV_GAUSS_EXP, SKV_DEPTH_BY_INNER, 6, 8, SKV_WITH_ALL},   {SKV_KELLER, SKV_DEPTH_BY_INNER, 5, 5, SKV_WITH_ALL},
    {SKV_UNIFORM, SKV_DEPTH_BY_INNER, 5, 5, SKV_WITH_ALL},
};

/// Observers, suns and views that have all kinds of rays.
static const struct {
    double observer_km, sun_deg, view_deg, azimuth_deg;
} rays_of[] = {{0, 40, 30, 10},  {1, 88, 89, 137},  {0, 60, 90, 200},   {2, 93, 80, 130}, {5, 70, 100, 0},
               {12, 30, 92, 45}, {12, 95, 92, 137}, {30, 80, 180, 300}, {60, 50, 95, 20}, {400, 60, 109, 137}};

static void begin_ray(skv_frame *frame, const skv_model *model, const skv_quality *q, int i, float view[3]) {
    begin(frame, model, q, rays_of[i].observer_km, 0, rays_of[i].sun_deg);
    toward(view, rays_of[i].view_deg, rays_of[i].azimuth_deg);
}

/// Two lights give the sum of what each gives. Sums of at most eight floats in another order: 8 ulp.
static void two_lights_add(void **state) {
    (void)state;
    for (int k = 0; k < COUNT(qualities); k++)
        for (int i = 0; i < COUNT(rays_of); i++) {
            skv_light light[2];
            shone one[3];
            float view[3];
            toward(light[0].direction_enu, rays_of[i].sun_deg, SUN_AZIMUTH);
            toward(light[1].direction_enu, 50, 290);
            fill(light[0].irradiance, 1, 2, 3, 4);
            fill(light[1].irradiance, 2, 1, 0.5, 0);
            toward(view, rays_of[i].view_deg, rays_of[i].azimuth_deg);
            for (int n = 0; n < 3; n++) {
                skv_frame frame;
                check_status("skv_frame_begin",
                             skv_frame_begin(&frame, &clear, &qualities[k], (float)rays_of[i].observer_km, 0,
                                             n < 2 ? &light[n] : light, n < 2 ? 1 : 2),
                             SKV_OK);
                one[n] = shine(&frame, view, INFINITY);
            }
            for (int b = 0; b < 4; b++) {
                const double want = (double)one[0].radiance[b] + (double)one[1].radiance[b];
                check_near("two lights", (double)one[2].radiance[b], want, 8 * 0x1p-24 * want);
                assert_true(one[2].transmittance[b] == one[0].transmittance[b]);
            }
        }
}

/// Without a light there is no radiance, and the same transmittance.
static void no_light_no_radiance(void **state) {
    (void)state;
    for (int k = 0; k < COUNT(qualities); k++)
        for (int i = 0; i < COUNT(rays_of); i++) {
            skv_frame frame;
            float view[3];
            begin_ray(&frame, &clear, &qualities[k], i, view);
            shone want = shine(&frame, view, INFINITY);
            memset(want.radiance, 0, sizeof want.radiance);
            check_status("skv_frame_begin",
                         skv_frame_begin(&frame, &clear, &qualities[k], (float)rays_of[i].observer_km, 0, NULL, 0),
                         SKV_OK);
            const shone got = shine(&frame, view, INFINITY);
            check_same_bits("no light", &got, &want);
        }
}

/// A term that is switched off is as one that the atmosphere does not have.
static void terms_off_are_species_absent(void **state) {
    (void)state;
    static const char *const name[5] = {"no Rayleigh", "no aerosol", "no dust", "no ozone", "no ground"};
    static const uint32_t bit[5] = {SKV_WITH_RAYLEIGH, SKV_WITH_AEROSOL, SKV_WITH_DUST, SKV_WITH_OZONE,
                                    SKV_WITH_GROUND};
    const skv_atmosphere all = air_smoky();
    build(&third, &all);
    for (int term = 0; term < 5; term++) {
        skv_atmosphere a = all;
        skv_profile *const profile[4] = {&a.rayleigh, &a.aerosol, &a.dust, &a.ozone};
        if (term < 4)
            profile[term]->kind = SKV_PROFILE_NONE;
        else
            fill(a.albedo, 0, 0, 0, 0);
        build(&other, &a);
        for (int k = 0; k < COUNT(qualities); k++)
            for (int i = 0; i < COUNT(rays_of); i++) {
                skv_frame frame;
                float view[3];
                skv_quality q = qualities[k];
                begin_ray(&frame, &other, &q, i, view);
                const shone want = shine(&frame, view, INFINITY);
                q.terms &= ~bit[term];
                begin_ray(&frame, &third, &q, i, view);
                const shone got = shine(&frame, view, INFINITY);
                check_same_bits(name[term], &got, &want);
            }
    }
}

/// Both models for all rules and rays: the same bits, or alike to a share.
static void compare_models(const char *what, const skv_model *got_of, const skv_model *want_of, double share) {
    for (int k = 0; k < COUNT(qualities); k++)
        for (int i = 0; i < COUNT(rays_of); i++) {
            skv_frame frame;
            float view[3];
            begin_ray(&frame, want_of, &qualities[k], i, view);
            const shone want = shine(&frame, view, INFINITY);
            begin_ray(&frame, got_of, &qualities[k], i, view);
            const shone got = shine(&frame, view, INFINITY);
            if (share > 0)
                check_alike(what, &got, &want, share, share);
            else
                check_same_bits(what, &got, &want);
        }
}

/// What is called aerosol may as well be called dust, whatever its profile and phase function.
static void dust_is_as_aerosol(void **state) {
    (void)state;
    static const float km[4] = {0, 2, 3, 6}, density[4] = {0, 1, 0.8f, 0};
    static const skv_profile profiles[] = {
        {.kind = SKV_PROFILE_EXPONENTIAL, .scale_height_km = 1.2f},
        {.kind = SKV_PROFILE_EXP_BACKGROUND, .scale_height_km = 1.2f, .background = 2e-3f},
        {.kind = SKV_PROFILE_TENT, .peak_km = 3, .half_width_km = 2},
        {.kind = SKV_PROFILE_LOGNORMAL, .lognormal_mu = 1, .lognormal_k = 4},
        {.kind = SKV_PROFILE_TABLE, .table_altitude_km = km, .table_density = density, .table_rows = 4}};
    for (int i = 0; i < COUNT(profiles); i++) {
        skv_atmosphere a = air_br16();
        a.aerosol = profiles[i];
        a.aerosol_phase = i % 2 == 0 ? SKV_PHASE_CS : SKV_PHASE_HG;
        a.aerosol_g = i == 2 ? -0.3f : 0.7f;
        build(&other, &a);
        a.dust = a.aerosol;
        a.dust_phase = a.aerosol_phase;
        a.dust_g = a.aerosol_g;
        memcpy(a.dust_scattering_per_km, a.aerosol_scattering_per_km, sizeof a.dust_scattering_per_km);
        memcpy(a.dust_extinction_per_km, a.aerosol_extinction_per_km, sizeof a.dust_extinction_per_km);
        a.aerosol.kind = SKV_PROFILE_NONE;
        build(&third, &a);
        compare_models("dust for aerosol", &third, &other, 0);
    }
}

/// Half of the aerosol in each slot is the whole of it. Sums of twice as many floats; the grazing rays of 60 km and
/// more have optical depths of some 10 whose roundings show in the radiance: 5e-5.
static void halves_of_an_aerosol_add(void **state) {
    (void)state;
    skv_atmosphere a = air_br16();
    build(&other, &a);
    a.dust = a.aerosol;
    a.dust_phase = a.aerosol_phase;
    a.dust_g = a.aerosol_g;
    for (int b = 0; b < 4; b++) {
        a.dust_scattering_per_km[b] = 0.25f * a.aerosol_scattering_per_km[b];
        a.dust_extinction_per_km[b] = 0.25f * a.aerosol_extinction_per_km[b];
        a.aerosol_scattering_per_km[b] *= 0.75f;
        a.aerosol_extinction_per_km[b] *= 0.75f;
    }
    build(&third, &a);
    compare_models("halves", &third, &other, 5e-5);
}

/// Absorption of the gas is the same as a layer of its scale height that only absorbs; tolerance as above.
static void a_gas_that_absorbs(void **state) {
    (void)state;
    skv_atmosphere a = air_br17o();
    fill(a.rayleigh_absorption_per_km, 0.001, 0.01, 0.03, 0);
    build(&third, &a);
    memcpy(a.dust_extinction_per_km, a.rayleigh_absorption_per_km, sizeof a.dust_extinction_per_km);
    fill(a.rayleigh_absorption_per_km, 0, 0, 0, 0);
    a.dust = a.rayleigh;
    build(&other, &a);
    compare_models("an absorbing gas", &third, &other, 5e-5);
}

/// The fast tier takes N = 6 by itself, so it is the standard one, above 20 km and for a light below 2 deg; not else.
static void fast_is_standard_where_it_has_to_be(void **state) {
    (void)state;
    static const struct {
        double observer_km, sun_deg;
        int same;
    } cases[] = {{20.01, 30, 1}, {400, 30, 1}, {0, 88.1, 1}, {1, 95, 1}, {19.99, 30, 0}, {0, 87.9, 0}};
    const skv_quality fast = tier_of(SKV_TIER_FAST, SKY_ONLY), standard = tier_of(SKV_TIER_STANDARD, SKY_ONLY);
    for (int i = 0; i < COUNT(cases); i++) {
        skv_frame frame;
        float view[3];
        toward(view, cases[i].observer_km > 60 ? 120 : 85, 20);
        begin(&frame, &clear, &fast, cases[i].observer_km, 0, cases[i].sun_deg);
        const shone got = shine(&frame, view, INFINITY);
        begin(&frame, &clear, &standard, cases[i].observer_km, 0, cases[i].sun_deg);
        const shone want = shine(&frame, view, INFINITY);
        if (cases[i].same)
            check_same_bits("fast is standard", &got, &want);
        else
            assert_true(memcmp(got.radiance, want.radiance, sizeof got.radiance) != 0);
    }
}

/// All off: black and clear.
static void no_term_at_all(void **state) {
    (void)state;
    for (int k = 0; k < COUNT(qualities); k++)
        for (int i = 0; i < COUNT(rays_of); i++) {
            skv_frame frame;
            float view[3];
            skv_quality q = qualities[k];
            const shone want = {{0, 0, 0, 0}, {1, 1, 1, 1}};
            q.terms = 0;
            begin_ray(&frame, &clear, &q, i, view);
            const shone got = shine(&frame, view, INFINITY);
            check_same_bits("no term", &got, &want);
        }
}

static void a_ray_of_no_length(void **state) {
    (void)state;
    const shone want = {{0, 0, 0, 0}, {1, 1, 1, 1}};
    for (int k = 0; k < COUNT(qualities); k++)
        for (int i = 0; i < COUNT(rays_of); i++) {
            skv_frame frame;
            float view[3];
            begin_ray(&frame, &clear, &qualities[k], i, view);
            const shone got = shine(&frame, view, 0.0f), minus = shine(&frame, view, -0.0f);
            check_same_bits("length 0", &got, &want);
            check_same_bits("length -0", &minus, &want);
        }
}

/// Light of the sky only grows and transmittance only falls with the length. Each length has its own samples: growth is
/// seen up to their error, .3 % of the ray's largest band (`high` by day; the closed form's columns); transmittance up
/// to the rounding of columns of up to 1000 km, 1e-7 of an optical depth of 40, and of T itself.
static void longer_rays_are_brighter_and_dimmer(void **state) {
    (void)state;
    const skv_quality q = tier_of(SKV_TIER_HIGH, SKY_ONLY);
    for (int i = 0; i < COUNT(rays_of); i++) {
        skv_frame frame;
        float view[3];
        begin_ray(&frame, &clear, &q, i, view);
        const shone whole = shine(&frame, view, INFINITY);
        shone before = {{0, 0, 0, 0}, {1, 1, 1, 1}};
        for (double d = 0.001; d < 4000; d *= 1.3) {
            const shone now = shine(&frame, view, (float)d);
            for (int b = 0; b < 4; b++) {
                check_at_most("a shorter ray's radiance", (double)before.radiance[b],
                              (double)now.radiance[b] + 3e-3 * largest4(now.radiance));
                check_at_most("a longer ray's transmittance", (double)now.transmittance[b],
                              (double)before.transmittance[b] + 4e-6);
            }
            before = now;
        }
        // 4000 km is past the air, and beyond it nothing changes.
        check_same_bits("past the air", &before, &whole);
    }
}

/// Uphill and down: a vertical ray is its first part and, dimmed by that, the rest seen from where the first ends.
/// The two integrals have their own samples: the quadrature's .3 %; transmittances multiply to float rounding and the
/// closed form's 3e-4 of a column, .37 of it.
static void a_ray_cut_in_two(void **state) {
    (void)state;
    static const struct {
        double from, cut, view_deg, sun_deg;
    } cuts[] = {{0, 2, 0, 30}, {0, 8, 0, 85}, {1, 20, 0, 92}, {10, 4, 180, 50}, {60, 15, 180, 75}, {30, 29.9, 180, 88}};
    const skv_quality q = tier_of(SKV_TIER_HIGH, SKV_WITH_ALL);
    for (int i = 0; i < COUNT(cuts); i++) {
        skv_frame frame;
        float view[3];
        toward(view, cuts[i].view_deg, 0);
        const double to = cuts[i].view_deg > 0 ? cuts[i].from - cuts[i].cut : cuts[i].from + cuts[i].cut;
        begin(&frame, &clear, &q, cuts[i].from, 0, cuts[i].sun_deg);
        const shone whole = shine(&frame, view, INFINITY), near = shine(&frame, view, (float)cuts[i].cut);
        begin(&frame, &clear, &q, to, 0, cuts[i].sun_deg);
        const shone far = shine(&frame, view, INFINITY);
        shone sum;
        for (int b = 0; b < 4; b++) {
            sum.radiance[b] = near.radiance[b] + near.transmittance[b] * far.radiance[b];
            sum.transmittance[b] = near.transmittance[b] * far.transmittance[b];
        }
        check_alike("first part and rest", &sum, &whole, 3e-3, 2e-4);
    }
}

/// Distance to the ground in double.
static double ground_distance(double height_km, double view_deg) {
    const double r = 6360 + height_km, mu = cos(view_deg * DEGREE);
    return (r * r - 6360.0 * 6360.0) / (-r * mu + sqrt(r * r * mu * mu - (r * r - 6360.0 * 6360.0)));
}

/// A length at or past the ground changes nothing; one that ends short of it loses the ground's light and no more than
/// that: the last metres hold 1e-4 of the rest at most.
static void the_ground_ends_a_ray(void **state) {
    (void)state;
    static const double heights[] = {0.1, 2, 10, 30}, views[] = {96, 110, 150, 180};
    for (int i = 0; i < 16; i++) {
        skv_frame lit, unlit;
        float view[3];
        const double h = heights[i / 4], d = ground_distance(h, views[i % 4]);
        const skv_quality with = tier_of(SKV_TIER_HIGH, SKV_WITH_ALL), without = tier_of(SKV_TIER_HIGH, SKY_ONLY);
        begin(&lit, &clear, &with, h, 0, 40);
        begin(&unlit, &clear, &without, h, 0, 40);
        toward(view, views[i % 4], 77);
        const shone own = shine(&lit, view, INFINITY), sky = shine(&unlit, view, INFINITY);
        const shone past = shine(&lit, view, (float)(d * 1.001)), far = shine(&lit, view, 1e6f);
        const shone at = shine(&unlit, view, (float)d), shortened = shine(&lit, view, (float)(d * 0.9999));
        check_same_bits("past the ground", &past, &own);
        check_same_bits("far past the ground", &far, &own);
        // The distance in float: 1e-6 of the path length, and of what is in it.
        check_alike("at the ground", &at, &sky, 3e-6, 3e-6);
        check_alike("just before the ground", &shortened, &sky, 3e-4, 3e-4);
        for (int b = 0; b < 4; b++)
            assert_true(own.radiance[b] > sky.radiance[b]);
    }
}

/// Lambert's ground from a metre above it: albedo/pi E mu_s T, with the T that the ground has towards the sun. The
/// metre of air between takes 4e-5; T by the other leg of the same closed form: 3e-4.
static void the_ground_is_lambert(void **state) {
    (void)state;
    static const double suns[] = {0, 45, 70, 85};
    const float down[3] = {0, 0, -1};
    skv_atmosphere a = air_br17o();
    fill(a.albedo, 0.05, 0.2, 0.6, 1);
    build(&other, &a);
    for (int i = 0; i < 4; i++) {
        skv_frame frame;
        float sun[3];
        const skv_quality q = tier_of(SKV_TIER_HIGH, SKV_WITH_ALL), sky_only = tier_of(SKV_TIER_HIGH, SKY_ONLY);
        toward(sun, suns[i], SUN_AZIMUTH);
        begin(&frame, &other, &sky_only, 0.001, 0, suns[i]);
        const shone between = shine(&frame, down, INFINITY);
        begin(&frame, &other, &q, 0.001, 0, suns[i]);
        const shone ground = shine(&frame, down, INFINITY);
        begin(&frame, &other, &q, 0, 0, suns[i]);
        const shone to_sun = shine(&frame, sun, INFINITY);
        for (int b = 0; b < 4; b++) {
            const double want =
                (double)a.albedo[b] / 3.14159265358979323846 * (double)sun[2] * (double)to_sun.transmittance[b];
            check_near("ground", (double)ground.radiance[b] - (double)between.radiance[b], want, 4e-4 * want);
        }
    }
}

/// Below the ground counts as on it.
static void observers_below_the_ground(void **state) {
    (void)state;
    static const double grounds[] = {0, -0.43, 2.4}, below[] = {0.001, 1, 12, 9e5};
    for (int k = 0; k < COUNT(qualities); k++)
        for (int i = 0; i < 3 * COUNT(rays_of); i++) {
            const double ground = grounds[i % 3];
            skv_frame frame;
            float view[3];
            toward(view, rays_of[i / 3].view_deg, rays_of[i / 3].azimuth_deg);
            begin(&frame, &clear, &qualities[k], ground, ground, rays_of[i / 3].sun_deg);
            const shone want = shine(&frame, view, INFINITY);
            for (int n = 0; n < COUNT(below); n++) {
                begin(&frame, &clear, &qualities[k], ground - below[n], ground, rays_of[i / 3].sun_deg);
                const shone got = shine(&frame, view, INFINITY);
                check_same_bits("below the ground", &got, &want);
            }
        }
}

/// At the top and above it: nothing upward; straight down the same light from any height.
static void the_top_of_the_air(void **state) {
    (void)state;
    static const double heights[] = {60, 60.001, 61, 400, 36000, 1e6};
    const skv_quality q = tier_of(SKV_TIER_HIGH, SKV_WITH_ALL);
    const shone nothing = {{0, 0, 0, 0}, {1, 1, 1, 1}};
    shone at_top = nothing;
    for (int i = 0; i < COUNT(heights); i++) {
        static const double views[] = {0, 30, 60, 89, 90};
        const float down[3] = {0, 0, -1};
        skv_frame frame;
        begin(&frame, &clear, &q, heights[i], 0, 50);
        for (int n = 0; n < COUNT(views); n++) {
            float view[3];
            toward(view, views[n], 33);
            const shone got = shine(&frame, view, INFINITY);
            check_same_bits("upward from the top", &got, &nothing);
        }
        const shone got = shine(&frame, down, INFINITY);
        if (i == 0)
            at_top = got;
        // A ray's entry is known to 1e-7 of the distance to it, in air of 1e-3 of the density of the ground.
        check_alike("straight down", &got, &at_top, 1e-5, 1e-5);
        const shone short_of_air = shine(&frame, down, (float)((heights[i] - 60) * 0.999));
        check_same_bits("a ray that ends above the air", &short_of_air, &nothing);
    }
}

/// A ground at another altitude is another planet: radius and top shifted, coefficients those of its altitude. Rounding
/// of the coefficients and radii only: 2e-5. Ozone's column table has its rows elsewhere: 1 % at the horizon at worst,
/// of an optical depth of which .5 is ozone's there.
static void ground_at_another_altitude(void **state) {
    (void)state;
    static const double grounds[] = {-0.43, 2.4};
    for (int g = 0; g < 2; g++)
        for (int ozone = 0; ozone < 2; ozone++) {
            skv_atmosphere a = air_br17o(), shifted;
            if (!ozone)
                a.ozone.kind = SKV_PROFILE_NONE;
            shifted = a;
            shifted.radius_km = (float)(6360 + grounds[g]);
            shifted.top_km = (float)(60 - grounds[g]);
            shifted.ozone.peak_km = (float)(25 - grounds[g]);
            for (int b = 0; b < 4; b++) {
                const double rayleigh = exp(-grounds[g] / 8), aerosol = exp(-grounds[g] / (double)1.2f);
                shifted.rayleigh_scattering_per_km[b] = (float)((double)a.rayleigh_scattering_per_km[b] * rayleigh);
                shifted.aerosol_scattering_per_km[b] = (float)((double)a.aerosol_scattering_per_km[b] * aerosol);
                shifted.aerosol_extinction_per_km[b] = (float)((double)a.aerosol_extinction_per_km[b] * aerosol);
            }
            build(&third, &a);
            build(&other, &shifted);
            for (int k = 0; k < COUNT(qualities); k++)
                for (int i = 0; i < COUNT(rays_of); i++) {
                    skv_frame frame;
                    float view[3];
                    begin(&frame, &third, &qualities[k], rays_of[i].observer_km + grounds[g], grounds[g],
                          rays_of[i].sun_deg);
                    toward(view, rays_of[i].view_deg, rays_of[i].azimuth_deg);
                    const shone got = shine(&frame, view, INFINITY);
                    begin(&frame, &other, &qualities[k], rays_of[i].observer_km, 0, rays_of[i].sun_deg);
                    const shone want = shine(&frame, view, INFINITY);
                    check_alike("shifted ground", &got, &want, ozone ? 5e-3 : 2e-5, ozone ? 5e-3 : 2e-5);
                }
        }
}

/// Radiance scales with irradiance and absorption colour; transmittance does not know them. Powers of two: in all bits.
static void irradiance_and_absorption_colour_scale(void **state) {
    (void)state;
    skv_atmosphere a = air_br17o();
    fill(a.solar_irradiance, 2, 0.25, 0, 1.7);
    fill(a.absorption_colour, 0.5, 1, 0.25, 0.3);
    const double factor[4] = {1, 0.25, 0, 0.51};
    build(&other, &a);
    for (int k = 0; k < COUNT(qualities); k++)
        for (int i = 0; i < COUNT(rays_of); i++) {
            skv_frame frame;
            float view[3];
            begin_ray(&frame, &clear, &qualities[k], i, view);
            shone want = shine(&frame, view, INFINITY);
            begin_ray(&frame, &other, &qualities[k], i, view);
            const shone got = shine(&frame, view, INFINITY);
            // Band 3: five roundings; a ground's light is a sum.
            const double last = (double)want.radiance[3] * factor[3];
            check_near("scaled by .51", (double)got.radiance[3], last, 1e-6 * last);
            for (int b = 0; b < 4; b++)
                want.radiance[b] = b == 3 ? got.radiance[3] : want.radiance[b] * (float)factor[b];
            check_same_bits("scaled", &got, &want);
        }
}

/// Turbidity multiplies the aerosol's coefficients.
static void turbidity_scales_the_aerosol(void **state) {
    (void)state;
    skv_atmosphere a = air_br17o();
    for (int n = 0; n < 2; n++) {
        shone got[COUNT(rays_of)];
        static shone want[COUNT(rays_of)];
        for (int b = 0; b < 4; b++) {
            a.aerosol_scattering_per_km[b] *= n == 0 ? 4.0f : 0.25f;
            a.aerosol_extinction_per_km[b] *= n == 0 ? 4.0f : 0.25f;
        }
        a.turbidity = n == 0 ? 1.0f : 4.0f;
        build(&other, &a);
        for (int i = 0; i < COUNT(rays_of); i++) {
            skv_frame frame;
            float view[3];
            begin_ray(&frame, &other, &qualities[0], i, view);
            got[i] = shine(&frame, view, INFINITY);
            if (n == 1)
                check_same_bits("turbidity", &got[i], &want[i]);
            want[i] = got[i];
        }
    }
}

/// Only angles between view, light and up count: a turn of the whole scene about up, and its mirror image, change
/// rounding only: 1e-5, where the phase function is steep (g = .8, near the sun) 1e-4.
static void a_turned_scene_is_the_same(void **state) {
    (void)state;
    for (int i = 0; i < COUNT(rays_of); i++) {
        shone first = {{0, 0, 0, 0}, {1, 1, 1, 1}};
        for (int turn = 0; turn < 8; turn++) {
            const double mirror = turn % 2 ? -1 : 1, by = 41.0 * turn;
            skv_frame frame;
            skv_light sun;
            float view[3];
            toward(sun.direction_enu, rays_of[i].sun_deg, mirror * SUN_AZIMUTH + by);
            toward(view, rays_of[i].view_deg, mirror * rays_of[i].azimuth_deg + by);
            fill(sun.irradiance, 1, 1, 1, 1);
            check_status("skv_frame_begin",
                         skv_frame_begin(&frame, &clear, &qualities[0], (float)rays_of[i].observer_km, 0, &sun, 1),
                         SKV_OK);
            const shone got = shine(&frame, view, INFINITY);
            if (turn == 0)
                first = got;
            // Lengths and transmittances: a float's rounding of the level part.
            check_alike("turned", &got, &first, 1e-4, 1e-5);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(two_lights_add),
        cmocka_unit_test(no_light_no_radiance),
        cmocka_unit_test(terms_off_are_species_absent),
        cmocka_unit_test(dust_is_as_aerosol),
        cmocka_unit_test(halves_of_an_aerosol_add),
        cmocka_unit_test(a_gas_that_absorbs),
        cmocka_unit_test(fast_is_standard_where_it_has_to_be),
        cmocka_unit_test(no_term_at_all),
        cmocka_unit_test(a_ray_of_no_length),
        cmocka_unit_test(longer_rays_are_brighter_and_dimmer),
        cmocka_unit_test(a_ray_cut_in_two),
        cmocka_unit_test(the_ground_ends_a_ray),
        cmocka_unit_test(the_ground_is_lambert),
        cmocka_unit_test(observers_below_the_ground),
        cmocka_unit_test(the_top_of_the_air),
        cmocka_unit_test(ground_at_another_altitude),
        cmocka_unit_test(irradiance_and_absorption_colour_scale),
        cmocka_unit_test(turbidity_scales_the_aerosol),
        cmocka_unit_test(a_turned_scene_is_the_same),
    };
    return cmocka_run_group_tests(tests, build_clear, NULL);
}
