/// skv_irradiance(): statuses, sums of skv_radiance() over the sphere, and the balance of energy.
#include <stdio.h>

#include "table_air.h"

static skv_frame frame;

static void statuses(void **state) {
    const skv_atmosphere air = air_br17o();
    const skv_table_spec s = spec_of(SKV_TABLE_SMALL);
    static skv_frame never;
    static const float good[2][3] = {{0, 0, 1}, {0, -1e30f, 0}};
    static const float bad[][3] = {{0, 0, 0},         {NAN, 0, 1},    {0, INFINITY, 0},
                                   {0, 0, -INFINITY}, {1e-39f, 0, 0}, {1, NAN, 1}};
    float out[16];
    (void)state;
    table_make(&air, &s);
    const skv_quality q = tier_of(SKV_TIER_STANDARD, SKV_WITH_ALL);
    begin(&frame, &table_model, &q, 1, 0, 60);
    memset(out, 0x5a, sizeof out);
    const uint32_t all = SKV_IRRADIANCE_ALL;
    check_status("no frame", skv_irradiance(NULL, all, 1, good[0], 0, out, 0), SKV_ERR_NULL);
    check_status("no normal", skv_irradiance(&frame, all, 1, NULL, 0, out, 0), SKV_ERR_NULL);
    check_status("no output", skv_irradiance(&frame, all, 1, good[0], 0, NULL, 0), SKV_ERR_NULL);
    check_status("frame not begun", skv_irradiance(&never, all, 1, good[0], 0, out, 0), SKV_ERR_LAYOUT);
    check_status("diffuse without a table", skv_irradiance(&frame, all, 1, good[0], 0, out, 0), SKV_ERR_LAYOUT);
    check_status("parts", skv_irradiance(&frame, 4, 1, good[0], 0, out, 0), SKV_ERR_RANGE);
    check_status("stride", skv_irradiance(&frame, 1, 1, good[0], 8, out, 0), SKV_ERR_SIZE);
    check_status("stride", skv_irradiance(&frame, 1, 1, good[0], 14, out, 0), SKV_ERR_SIZE);
    check_status("stride", skv_irradiance(&frame, 1, 1, good[0], 0, out, 12), SKV_ERR_SIZE);
    check_status("stride", skv_irradiance(&frame, 1, 1, good[0], 0, out, 18), SKV_ERR_SIZE);
    for (int i = 0; i < 16; i++)
        assert_int_equal(((const unsigned char *)&out[i])[1], 0x5a);
    check_status("direct alone", skv_irradiance(&frame, SKV_IRRADIANCE_DIRECT, 2, good[0], 12, out, 32), SKV_OK);
    assert_true(out[0] > 0 && out[8] > 0);
    assert_int_equal(((const unsigned char *)&out[4])[1], 0x5a); // between the fields
    check_status("no parts", skv_irradiance(&frame, 0, 1, good[0], 0, out, 0), SKV_OK);
    for (int b = 0; b < 4; b++)
        check_near("no parts", (double)out[b], 0, 0);
    check_status("frame_table", skv_frame_table(&frame, table_here), SKV_OK);
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        float normal[3][3] = {{0, 0, 1}, {0}, {0, 0, 1}};
        memcpy(normal[1], bad[i], sizeof bad[i]);
        check_status("a bad normal among good ones", skv_irradiance(&frame, all, 3, normal[0], 0, out, 0),
                     SKV_ERR_DIRECTION);
        for (int b = 0; b < 4; b++) {
            check_near("bad normal", (double)out[4 + b], 0, 0);
            check_near("beside it", (double)out[8 + b], (double)out[b], 0);
            assert_true(out[b] > 0);
        }
    }
}

/// A normal's length does not matter.
static void any_length_of_a_normal(void **state) {
    static const float normal[4][3] = {
        {0.3f, -0.4f, 0.5f}, {3e37f, -4e37f, 5e37f}, {3e-37f, -4e-37f, 5e-37f}, {30, -40, 50}};
    float out[4][4];
    const skv_atmosphere air = air_br17o();
    const skv_table_spec s = spec_of(SKV_TABLE_SMALL);
    (void)state;
    table_make(&air, &s);
    table_frame(&frame, 2, 0, 70);
    check_status("skv_irradiance", skv_irradiance(&frame, SKV_IRRADIANCE_ALL, 4, normal[0], 0, out[0], 0), SKV_OK);
    for (int i = 1; i < 4; i++)
        for (int b = 0; b < 4; b++)
            check_near("length of a normal", (double)out[i][b], (double)out[0][b], 1e-6 * (double)out[0][b]);
}

enum { POLAR = SMALL_TARGET ? 10 : 40, AZIMUTHS = SMALL_TARGET ? 12 : 72, NORMALS = 6 };

/// Sums of radiance over the sphere, midpoints that crowd at the edges: up, down, towards the sun and away from it on
/// the level, and two tilted.
static void by_quadrature(double horizon, double top, const float normal[NORMALS][3], double sum[NORMALS][4]) {
    static float view[AZIMUTHS][3], radiance[AZIMUTHS][4];
    const skv_rays rays = {view[0], 0, NULL, 0};
    const skv_sky sky = {radiance[0], sizeof radiance[0], NULL, 0};
    memset(sum, 0, NORMALS * sizeof sum[0]);
    for (int i = 0; i < 2 * POLAR; i++) {
        // mu = horizon +- range t^2, dmu = 2 range t dt; from below the top of the air where the observer is above it.
        const int up = i < POLAR;
        const double t = (i % POLAR + 0.5) / POLAR, range = up ? top - horizon : -1 - horizon;
        const double mu = horizon + range * t * t, s = sqrt(1 - mu * mu);
        const double weight = 2 * fabs(range) * t / POLAR * 2 * 3.14159265358979 / AZIMUTHS;
        for (int k = 0; k < AZIMUTHS; k++) {
            const double phi = (SUN_AZIMUTH + 360 * (k + 0.5) / AZIMUTHS) * DEGREE;
            view[k][0] = (float)(s * sin(phi));
            view[k][1] = (float)(s * cos(phi));
            view[k][2] = (float)mu;
        }
        check_status("skv_radiance", skv_radiance(&frame, AZIMUTHS, &rays, &sky), SKV_OK);
        for (int k = 0; k < AZIMUTHS; k++)
            for (int n = 0; n < NORMALS; n++) {
                double c = 0;
                for (int j = 0; j < 3; j++)
                    c += (double)normal[n][j] * (double)view[k][j];
                for (int b = 0; b < 4 && c > 0; b++)
                    sum[n][b] += weight * c * (double)radiance[k][b];
            }
    }
}

static const char *const normal_names[NORMALS] = {"up",           "down",      "to the sun",
                                                  "from the sun", "tilted to", "tilted from"};

typedef struct tally {
    double sum, worst;
    int n;
    char where[96];
} tally;

/// One observer: all normals against the quadrature, relative to the largest of the sphere (a panel in the dark side is
/// judged by what shines on the bright one).
static void sphere(tally t[NORMALS], const char *air, double height, double sun) {
    float normal[NORMALS][3], got[NORMALS][4];
    double want[NORMALS][4], most = 0;
    const double r = 6360, horizon = -sqrt(height * (2 * r + height)) / (r + height);
    const double top = height > 60 ? -sqrt((height - 60) * (2 * r + 60 + height)) / (r + height) : 1;
    table_frame(&frame, height, 0, sun);
    for (int i = 0; i < NORMALS; i++) {
        static const double zenith[NORMALS] = {0, 180, 90, 90, 50, 130};
        toward(normal[i], zenith[i], SUN_AZIMUTH + (i % 2 ? 180 : 0));
    }
    by_quadrature(horizon, top, (const float(*)[3])normal, want);
    check_status("skv_irradiance", skv_irradiance(&frame, SKV_IRRADIANCE_DIFFUSE, NORMALS, normal[0], 0, got[0], 0),
                 SKV_OK);
    for (int n = 0; n < NORMALS; n++)
        for (int b = 0; b < 4; b++)
            most = fmax(most, want[n][b]);
    for (int n = 0; n < NORMALS; n++) {
        double error = 0;
        for (int b = 0; b < 4; b++)
            error = fmax(error, fabs((double)got[n][b] - want[n][b]) / most);
        t[n].sum += error;
        t[n].n++;
        if (error > t[n].worst) {
            t[n].worst = error;
            snprintf(t[n].where, sizeof t[n].where, "%s, %g km, sun %g: got %.4g, want %.4g", air, height, sun,
                     (double)got[n][1], want[n][1]);
        }
    }
}

/// The table's cell has the radiance up to degree 2, the clamped cosine's next term is 1/24 of degree 4: some percent.
/// At the top of the air all light comes from one half: there and just below it the cell is worst.
static void against_sums_of_radiance(void **state) {
    static const struct {
        const char *name;
        double height[3], mean, max; // percent
    } places[] = {{"0-10 km", {0, 3, 10}, 6, 12}, {"25-60 km", {25, 45, 60}, 4, 15}, {"space", {61, 400, 36000}, 1, 4}};
    static const double suns[] = {20, 60, 85, 90, 94};
    const skv_atmosphere airs[] = {air_br16(), air_br17o()};
    int failed = 0;
    tally t[3][NORMALS] = {{{0, 0, 0, ""}}};
    (void)state;
    for (int k = 0; k < (SMALL_TARGET ? 1 : 2); k++) {
        const skv_table_spec s = spec_of(SKV_TABLE_ACCURATE);
        table_make(&airs[k], &s);
        for (int p = 0; p < 3; p++)
            for (int h = 0; h < (SMALL_TARGET ? 1 : 3); h++)
                for (int i = 0; i < 5; i += SMALL_TARGET ? 3 : 1)
                    sphere(t[p], k ? "br17o" : "br16", places[p].height[h], suns[i]);
    }
    for (int p = 0; p < 3; p++)
        for (int n = 0; n < NORMALS; n++) {
            const tally *const a = &t[p][n];
            print_message("figure: diffuse irradiance, %s, %s: mean %.2f max %.1f %% of the brightest side (%s)\n",
                          places[p].name, normal_names[n], 100 * a->sum / a->n, 100 * a->worst, a->where);
            failed |= 100 * a->sum / a->n > places[p].mean || 100 * a->worst > places[p].max;
        }
    if (failed && !SMALL_TARGET) // with so few directions and cells only that it works is of interest
        fail_msg("irradiance is outside its limits (above)");
}

/// The beam: the light's irradiance, dimmed as a ray towards it is, times the cosine.
static void direct_irradiance_is_the_beam(void **state) {
    const skv_atmosphere air = air_br17o();
    (void)state;
    random_state = 31;
    build(&table_model, &air);
    for (int i = 0; i < CASES(400); i++) {
        const skv_quality q = tier_of(SKV_TIER_STANDARD, SKV_WITH_ALL);
        const double h = i % 7 ? random_in(0, 80) : 3000, sun = random_in(0, 110);
        const double dip = 90 + acos(6360 / (6360 + h)) / DEGREE;
        float to_sun[3], got[2][4];
        double n[3];
        begin(&frame, &table_model, &q, h, 0, sun);
        toward(to_sun, sun, SUN_AZIMUTH);
        random_direction(n);
        const float normal[2][3] = {{(float)n[0], (float)n[1], (float)n[2]},
                                    {(float)-n[0], (float)-n[1], (float)-n[2]}};
        double c = 0;
        for (int k = 0; k < 3; k++)
            c += n[k] * (double)to_sun[k];
        check_status("skv_irradiance", skv_irradiance(&frame, SKV_IRRADIANCE_DIRECT, 2, normal[0], 0, got[0], 0),
                     SKV_OK);
        const shone beam = shine(&frame, to_sun, INFINITY);
        for (int b = 0; b < 4; b++) {
            const double want = sun < dip ? fabs(c) * (double)beam.transmittance[b] : 0;
            check_near("lit side", (double)got[c < 0][b], want, 1e-6 + 1e-5 * want);
            check_near("far side", (double)got[c >= 0][b], 0, 1e-6);
        }
    }
}

/// Air that absorbs nothing over a ground that absorbs nothing, so large that it is flat: what comes in leaves again.
/// At the ground and at the top down is up; at the top down is the sun's cosine.
static void energy_is_kept(void **state) {
    double worst_ground = 0, worst_top = 0, thick_top = 0; // thick: optical depth 1.7
    (void)state;
    for (int k = 0; k < 4; k++) {
        skv_atmosphere air = air_br17o();
        const skv_table_spec s = spec_of(SKV_TABLE_ACCURATE);
        air.radius_km = 1e5f;
        air.ozone.kind = SKV_PROFILE_NONE;
        fill(air.albedo, 1, 1, 1, 1);
        fill(air.aerosol_scattering_per_km, 0.1, 0.05, 0.02, 0.005);
        memcpy(air.aerosol_extinction_per_km, air.aerosol_scattering_per_km, sizeof air.aerosol_scattering_per_km);
        if (k == 0)
            air.aerosol.kind = SKV_PROFILE_NONE;
        if (k == 2)
            fill(air.rayleigh_scattering_per_km, 0.2, 0.1, 0.05, 0.02);
        if (k == 3) { // dust alone
            air.dust = air.aerosol;
            air.dust.scale_height_km = 11;
            fill(air.dust_scattering_per_km, 0.04, 0.02, 0.01, 0.002);
            memcpy(air.dust_extinction_per_km, air.dust_scattering_per_km, sizeof air.dust_scattering_per_km);
            air.dust_g = 0.69f;
            air.rayleigh.kind = air.aerosol.kind = SKV_PROFILE_NONE;
        }
        table_make(&air, &s);
        for (int i = 0; i < 5; i++) {
            static const double sun[] = {0, 30, 60, 75, 85};
            static const float normal[NORMALS][3] = {{0, 0, 1}, {0, 0, -1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
            double top[NORMALS][4];
            float ground[2][4];
            const double in = cos(sun[i] * DEGREE), horizon = -sqrt(60 * (2e5 + 60)) / (1e5 + 60);
            table_frame(&frame, 0, 0, sun[i]);
            check_status("skv_irradiance", skv_irradiance(&frame, SKV_IRRADIANCE_ALL, 2, normal[0], 0, ground[0], 0),
                         SKV_OK);
            table_frame(&frame, 60, 0, sun[i]);
            by_quadrature(horizon, 1, normal, top);
            for (int b = 0; b < 4; b++) {
                const double net = ((double)ground[0][b] - (double)ground[1][b]) / in;
                const double left = (in + top[0][b] - top[1][b]) / in;
                if (fabs(net) > 0.025 || fabs(left) > 0.025)
                    print_message("# air %d sun %g band %d: ground down %.4f up %.4f, top up %.4f in %.4f\n", k, sun[i],
                                  b, (double)ground[0][b], (double)ground[1][b], top[1][b], in);
                worst_ground = fmax(worst_ground, fabs(net));
                if (k == 2 && b == 0)
                    thick_top = fmax(thick_top, fabs(left));
                else
                    worst_top = fmax(worst_top, fabs(left));
            }
        }
    }
    print_message(
        "figure: energy that is lost or won, white ground: at the ground %.2f, at the top %.2f, thick air %.1f %%\n",
        100 * worst_ground, 100 * worst_top, 100 * thick_top);
    if (!SMALL_TARGET) {
        // 2 % of the flux is the table's own error in haze; a white ground sends it to and fro.
        check_at_most("net flux at the ground, %", 100 * worst_ground, 4);
        check_at_most("net flux at the top, %", 100 * worst_top, 4);
        // Four nodes along a gathered ray are few for an optical depth of 1.7: light is lost at each scattering.
        check_at_most("net flux at the top of thick air, %", 100 * thick_top, 15);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(statuses),
        cmocka_unit_test(any_length_of_a_normal),
        cmocka_unit_test(against_sums_of_radiance),
        cmocka_unit_test(direct_irradiance_is_the_beam),
        cmocka_unit_test(energy_is_kept),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
