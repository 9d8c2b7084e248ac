/// What the baselines share, against the reference in double and by its own properties: a slip here would be taken for
/// a slip of a published model.
#include <sys/stat.h>

#include "common.h"
#include "linan_sky.h"

/// One air with every kind of profile.
static skv_atmosphere air_of(int n) {
    static const float km[] = {0, 2.8f, 3, 4.5f, 5, 10}, density[] = {0.25f, 0.5f, 1, 1, 0.125f, 0};
    skv_atmosphere a = sky_clear();
    a.turbidity = 1.5f;
    fill(a.absorption_colour, 0.9, 0.8, 0.7, 0.6);
    fill(a.rayleigh_absorption_per_km, 0, 0.001, 0.003, 0.01);
    fill(a.dust_scattering_per_km, 0.03, 0.022, 0.016, 0.012);
    fill(a.dust_extinction_per_km, 0.034, 0.025, 0.018, 0.0135);
    a.dust_phase = SKV_PHASE_HG;
    a.dust_g = -0.4f;
    if (n == 1) {
        a.rayleigh = (skv_profile){.kind = SKV_PROFILE_US76, .us76_a = .07771971f, .us76_b = 1.16364243f};
        a.aerosol = (skv_profile){.kind = SKV_PROFILE_EXP_BACKGROUND, .scale_height_km = 1.2f, .background = 2e-3f};
        a.ozone = (skv_profile){.kind = SKV_PROFILE_LOGNORMAL, .lognormal_mu = 3.22261f, .lognormal_k = 5.55555555f};
        a.dust = (skv_profile){
            .kind = SKV_PROFILE_TABLE, .table_altitude_km = km, .table_density = density, .table_rows = 6};
    }
    return a;
}

static void the_air_is_the_reference_s(void **state) {
    (void)state;
    static ref_file truth;
    for (int n = 0; n < 2; n++) {
        const skv_atmosphere atmosphere = air_of(n);
        baseline_air air;
        ref_from_skyvert(&atmosphere, 0, &truth);
        const ref_atmosphere *const a = &truth.atmosphere;
        const ref_profile *const profile[] = {&a->rayleigh, &a->aerosol, &a->dust, &a->ozone};
        assert_int_equal(baseline_air_copy(&air, &atmosphere), 0);
        for (int i = 0; i <= 600; i++) {
            const double h = 0.1 * i;
            double want[4] = {0, 0, 0, 0}, got[4];
            for (int k = 0; k < BASELINE_SPECIES; k++) {
                const double density = profile[k]->kind == REF_NONE ? 0 : ref_density(profile[k], h);
                check_near("density", baseline_density(&air, k, h), density, 1e-12); // the same formula in double
                for (int b = 0; b < 4; b++)
                    want[b] += density * (k == GAS       ? a->rayleigh_scattering[b] + a->rayleigh_absorption[b]
                                          : k == AEROSOL ? a->aerosol_extinction[b]
                                          : k == DUST    ? a->dust_extinction[b]
                                                         : a->ozone_absorption[b]);
            }
            baseline_extinction(&air, h, got);
            for (int b = 0; b < 4; b++)
                check_near("extinction", got[b], want[b], 1e-12);
        }
        check_near("density above the top", baseline_density(&air, GAS, 60.001), 0, 0);
        for (int b = 0; b < 4; b++)
            check_near("light", air.light[b], a->irradiance[b], 1e-15);
        baseline_air_free(&air);
    }
}

static void phase_functions_are_the_reference_s(void **state) {
    (void)state;
    const skv_atmosphere atmosphere = air_of(0);
    static ref_file truth;
    baseline_air air;
    ref_from_skyvert(&atmosphere, 0, &truth);
    assert_int_equal(baseline_air_copy(&air, &atmosphere), 0);
    for (int i = 0; i <= 200; i++) {
        const double c = -1 + 0.01 * i;
        check_near("Rayleigh", baseline_phase(&air, GAS, c), ref_phase_rayleigh(c), 1e-15);
        // Relative: rounding of the two forms of the denominator.
        check_near("aerosol", baseline_phase(&air, AEROSOL, c) / ref_phase_aerosol(&truth.atmosphere, 1 - c, 1 + c), 1,
                   1e-12);
        check_near("dust", baseline_phase(&air, DUST, c) / ref_phase_dust(&truth.atmosphere, 1 - c, 1 + c), 1, 1e-12);
    }
    baseline_air_free(&air);
}

/// Lengths and altitudes by the textbook forms in long double.
static void rays_are_straight(void **state) {
    (void)state;
    static const double heights[] = {0, 1e-3, 1, 12, 59.9, 60}, angles[] = {0, 45, 89.9, 90, 90.5, 93, 97, 120, 180};
    const skv_atmosphere atmosphere = air_of(0);
    baseline_air air;
    assert_int_equal(baseline_air_copy(&air, &atmosphere), 0);
    for (int n = 0; n < 6 * 9; n++) {
        const double h = heights[n / 9],
                     mu = angles[n % 9] > 90 || angles[n % 9] < 90 ? cos(angles[n % 9] * DEGREE) : 0;
        const long double r = 6360.0L + (long double)h, b = r * (long double)mu;
        const long double ground = b * b - r * r + 6360.0L * 6360, top = b * b - r * r + 6420.0L * 6420;
        const int meets = mu < 0 && ground >= 0;
        const double want = (double)(meets ? -b - sqrtl(ground) : -b + sqrtl(top));
        double length;
        assert_int_equal(baseline_ray(&air, h, mu, &length), meets);
        check_near("length", length, want, 1e-8);
        for (int k = 0; k <= 4; k++) {
            const long double s = (long double)length * k / 4;
            check_near("altitude", baseline_altitude(&air, h, mu, (double)s),
                       (double)(sqrtl(r * r + s * s + 2 * b * s) - 6360), 1e-9);
        }
    }
    for (int i = 0; i <= 40; i++) { // from 400 km: the zenith angle of a ray that just meets the air is 108.24
        const double angle = 90 + i * 2.25;
        double h = 400, mu = cos(angle * DEGREE), s;
        const double impact = 6760 * sin(angle * DEGREE);
        const int meets = baseline_enter(&air, &h, &mu, &s);
        assert_int_equal(meets, impact < 6420 && angle > 90);
        if (meets) {
            check_near("enters at the top", h, 60, 0);
            check_near("keeps its impact parameter", 6420 * sqrt(1 - mu * mu), impact, 1e-6);
            check_near("way to the air", baseline_altitude(&air, 400, cos(angle * DEGREE), s), 60, 1e-8);
        } else {
            check_near("misses, nothing changed", h, 400, 0);
        }
    }
    check_near("horizon", baseline_horizon(&air, 12), -sqrt(1 - pow(6360.0 / 6372, 2)), 1e-12);
    baseline_air_free(&air);
}

/// Columns against the reference, to the top and along a length. The reference has no dust in ref_column().
static void columns_are_the_reference_s(void **state) {
    (void)state;
    static const double heights[] = {0, 0.5, 12, 40}, angles[] = {0, 60, 85, 89, 90, 91, 93};
    static const int to[] = {GAS, AEROSOL, OZONE};
    static ref_file truth;
    double worst = 0;
    for (int n = 0; n < 2 * 4 * 7; n++) {
        const skv_atmosphere atmosphere = air_of(n / 28);
        baseline_air air;
        ref_from_skyvert(&atmosphere, 0, &truth);
        assert_int_equal(baseline_air_copy(&air, &atmosphere), 0);
        const ref_ray ray = ref_ray_from_angles(heights[n / 7 % 4], 30, angles[n % 7], 0);
        double length = 0, column[BASELINE_SPECIES], steps[BASELINE_SPECIES], want[3];
        if (!baseline_ray(&air, ray.height_km, ray.mu, &length)) {
            ref_column(&truth.atmosphere, &ray, length, want);
            baseline_columns_to_top(&air, ray.height_km, ray.mu, column);
            baseline_columns(&air, ray.height_km, ray.mu, length, 4000, steps);
            for (int k = 0; k < 3; k++) {
                // Simpson over 128 intervals where a tent or a layer has corners: 1e-3; a tail that is left of it by
                // subtraction 1e-6 km. Trapezoids of 4000 steps: (15 m/1.2 km)^2/12 by the length of the ray.
                worst = fmax(worst, fabs(column[to[k]] - want[k]) / (want[k] + 1e-3));
                check_near("column to the top", column[to[k]], want[k], 2e-3 * want[k] + 1e-6);
                check_near("column of a length", steps[to[k]], want[k], 1e-3 * want[k] + 1e-6);
            }
        }
        baseline_air_free(&air);
    }
    printf("figure: baselines, columns to the top within %.1e of the reference\n", worst);
}

static void half_floats_are_whole(void **state) {
    (void)state;
    for (uint32_t i = 0; i < 65536; i++) {
        const uint16_t half = (uint16_t)i;
        const float value = baseline_from_half(half);
        const int exponent = half >> 10 & 31, fraction = half & 1023;
        if (exponent == 31 && fraction) {
            assert_true(isnan(value));
            continue;
        }
        const double size =
            exponent == 31 ? INFINITY : ldexp(exponent ? 1024 + fraction : fraction, (exponent ? exponent : 1) - 25);
        assert_true((double)fabsf(value) >= size && (double)fabsf(value) <= size);
        assert_int_equal(baseline_to_half(value), half);
        // Half-way to the next one goes to the even one, a little further to the next.
        const double step = exponent ? ldexp(1, exponent - 25) : ldexp(1, -24);
        if (exponent < 31 && half < 0x7bff) {
            assert_int_equal(baseline_to_half((float)(size + 0.5 * step)), fraction % 2 ? half + 1 : half);
            assert_int_equal(baseline_to_half((float)(size + 0.501 * step)), half + 1);
        }
    }
    assert_int_equal(baseline_to_half(65519.9f), 0x7bff);
    assert_int_equal(baseline_to_half(65520.0f), 0x7c00);
    assert_int_equal(baseline_to_half(-1e-9f), 0x8000);
    assert_int_equal(baseline_to_half(NAN) & 0x7c00, 0x7c00);
}

// ---- threads

typedef struct work {
    unsigned char done[1000];
    double told, wrong;
    int stop;
} work;

static void mark(void *context, size_t i) {
    ((work *)context)->done[i]++;
}

static int hear(void *context, double done) {
    work *const w = context;
    if (!(done >= w->told && done <= 0.75))
        w->wrong = 1;
    w->told = done;
    return w->stop && done > 0.4;
}

static void every_item_is_done_once(void **state) {
    (void)state;
    for (int threads = 1; threads <= 4; threads += 3)
        for (int stop = 0; stop < 2; stop++) {
            work w = {.told = 0.25, .stop = stop};
            const baseline_wants wants = {.threads = threads, .progress = hear, .context = &w};
            size_t done = 0;
            const int stopped = baseline_parallel(&wants, 0.25, 0.75, 1000, mark, &w);
            for (int i = 0; i < 1000; i++) {
                assert_true(w.done[i] <= 1);
                done += w.done[i];
            }
            // Progress is told between the caller's own items: helpers may be through before.
            assert_true(stopped == stop || (stop && threads > 1 && done == 1000));
            assert_true(stopped ? threads > 1 || done < 1000 : done == 1000);
            assert_true(w.wrong <= 0);
        }
}

// ---- cache

static int load(const char *folder, uint64_t key) {
    char got[64];
    double build_s = 0;
    const int there = baseline_cache_load(folder, "thing", key, got, sizeof got, &build_s);
    if (there) {
        for (int i = 0; i < 64; i++)
            assert_int_equal(got[i], i);
        check_near("seconds", build_s, 12.5, 0);
    }
    return there;
}

/// Changes the file by a shell line with $f in it. @return whether it is still taken
static int after(const char *folder, const char *line) {
    char command[400], data[64];
    for (int i = 0; i < 64; i++)
        data[i] = (char)i;
    assert_int_equal(baseline_cache_save(folder, "thing", 7, data, sizeof data, 12.5), 1);
    assert_int_equal(load(folder, 7), 1);
    snprintf(command, sizeof command, "f=%s/thing-0000000000000007.bin; %s", folder, line);
    assert_int_equal(system(command), 0);
    return load(folder, 7);
}

static void a_damaged_cache_is_not_taken(void **state) {
    (void)state;
    char folder[] = "/tmp/baseline-cache-XXXXXX", inner[60], command[100];
    double build_s;
    assert_true(mkdtemp(folder) != NULL);
    snprintf(inner, sizeof inner, "%s/new", folder); // is made
    assert_int_equal(after(inner, ":"), 1);
    assert_int_equal(load(inner, 8), 0);
    assert_int_equal(after(inner, "cp $f ${f%7.bin}8.bin") && load(inner, 8), 0);
    assert_int_equal(after(inner, "printf x | dd of=$f bs=1 seek=40 conv=notrunc 2>/dev/null"), 0);
    assert_int_equal(after(inner, "printf x | dd of=$f bs=1 seek=26 conv=notrunc 2>/dev/null"), 0); // the seconds
    assert_int_equal(after(inner, "head -c 90 $f > $f.x && mv $f.x $f"), 0);
    assert_int_equal(after(inner, "echo >> $f"), 0);
    assert_int_equal(after(inner, ": > $f"), 0);
    assert_int_equal(after(inner, "rm $f"), 0);
    assert_int_equal(baseline_cache_load(NULL, "thing", 7, inner, sizeof inner, &build_s), 0);
    assert_int_equal(baseline_cache_save("/proc/none/such", "thing", 7, inner, sizeof inner, 1), 0);
    snprintf(command, sizeof command, "test -z \"$(find %s -name '*.part')\" && rm -r %s", folder, folder);
    assert_int_equal(system(command), 0);
}

static uint64_t hash_of(const skv_atmosphere *atmosphere) {
    baseline_air air;
    assert_int_equal(baseline_air_copy(&air, atmosphere), 0);
    const uint64_t hash = baseline_air_hash(&air);
    baseline_air_free(&air);
    return hash;
}

static void the_hash_knows_the_air(void **state) {
    (void)state;
    float density[6] = {0.25f, 0.5f, 1, 1, 0.125f, 0};
    skv_atmosphere a = air_of(1), b = a;
    b.dust.table_density = density; // the same rows elsewhere
    assert_true(hash_of(&a) == hash_of(&b));
    density[3] = 0.9f;
    assert_true(hash_of(&a) != hash_of(&b));
    b = a;
    b.solar_irradiance[1] = 2;
    b.albedo[1] = 0.5f;
    assert_true(hash_of(&a) == hash_of(&b));
    float *const fields[] = {&b.radius_km,
                             &b.top_km,
                             &b.turbidity,
                             &b.aerosol_g,
                             &b.dust_g,
                             &b.aerosol.background,
                             &b.ozone.lognormal_mu,
                             &b.rayleigh_absorption_per_km[3]};
    for (size_t i = 0; i < sizeof fields / sizeof fields[0]; i++) {
        b = a;
        *fields[i] += 0.25f;
        if (hash_of(&a) == hash_of(&b))
            fail_msg("field %zu changes nothing", i);
    }
    b = a;
    b.aerosol_phase = SKV_PHASE_HG;
    assert_true(hash_of(&a) != hash_of(&b));
}

static void the_list_is_whole(void **state) {
    (void)state;
    for (const baseline *const *b = baselines; *b; b++) {
        assert_true((*b)->name && (*b)->title && (*b)->source && (*b)->slips && (*b)->cannot);
        assert_true((*b)->build && (*b)->frame && (*b)->radiance && (*b)->release);
        assert_true(((*b)->can & BASELINE_SINGLE) && (*b)->source[0]);
        assert_true(!strchr((*b)->slips, '\n') && !strchr((*b)->cannot, '\n') && !strchr((*b)->title, '\n'));
        assert_true(baseline_find((*b)->name) == *b); // no name twice
        assert_int_equal((*b)->literal, strstr((*b)->name, "-literal") != NULL);
    }
    assert_true(baseline_find("skyvert") == NULL && baseline_find("") == NULL);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_air_is_the_reference_s),
        cmocka_unit_test(phase_functions_are_the_reference_s),
        cmocka_unit_test(rays_are_straight),
        cmocka_unit_test(columns_are_the_reference_s),
        cmocka_unit_test(half_floats_are_whole),
        cmocka_unit_test(every_item_is_done_once),
        cmocka_unit_test(a_damaged_cache_is_not_taken),
        cmocka_unit_test(the_hash_knows_the_air),
        cmocka_unit_test(the_list_is_whole),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
