/// What physics orders: transmittance falls with the length of a ray, at every metre; a column shrinks as its start
/// rises, at every metre; optical depths grow with the amount of matter.
#include "table.h"

enum { RAYS = 8 };
static air airs[5];
static double most;
static const char *const names[5] = {"clear", "hazy", "smoky", "layered", "shaped"};
static const double zeniths[RAYS] = {0, 45, 75, 85, 88.5, 90, 92, 120};

static void through_of(const air *a, float observer_km, const float *length_km, int n, float through[][4]) {
    static const float sun[3] = {0, -0.6f, 0.8f};
    static float view[2000 * RAYS][3], radiance[2000 * RAYS][4];
    skv_frame frame;
    for (int i = 0; i < n * RAYS; i++)
        direction_of(view[i], zeniths[i % RAYS], 30);
    frame_of(&frame, a, NULL, observer_km, sun);
    const skv_rays rays = {view[0], 0, length_km, 0};
    const skv_sky sky = {radiance[0], sizeof radiance[0], through[0], 4 * sizeof(float)};
    must(skv_radiance(&frame, (size_t)(n * RAYS), &rays, &sky), "skv_radiance");
}

/// Largest rise of T over what two roundings of an optical depth do to it: tau 2.4e-7 T, tau up to 40.
static double rise(float now, float before) {
    return (double)now - (double)before;
}

static void along_the_ray(void **state) {
    static float length[2000 * RAYS], through[2000 * RAYS][4];
    double worst = 0;
    char where[160] = "";
    (void)state;
    for (int a = 0; a < 5; a++)
        for (int k = 0; k < 6; k++) {
            static const float heights[] = {0, 0.5f, 4, 12, 40, 90};
            for (int part = 0; part < 3; part++) {
                for (int i = 0; i < 2000 * RAYS; i++) // 1 m, 100 m and 500 m steps
                    length[i] = (float)(i / RAYS) * (part == 0 ? 0.001f : part == 1 ? 0.1f : 0.5f);
                through_of(&airs[a], heights[k], length, 2000, through);
                for (int i = RAYS; i < 2000 * RAYS; i++)
                    for (int b = 0; b < 3; b++) {
                        const double up = rise(through[i][b], through[i - RAYS][b]);
                        if (!(up > worst))
                            continue;
                        worst = up;
                        snprintf(where, sizeof where, "%s, %g km, zenith angle %g, length %.9g km: %.9g after %.9g",
                                 names[a], (double)heights[k], zeniths[i % RAYS], (double)length[i],
                                 (double)through[i][b], (double)through[i - RAYS][b]);
                    }
            }
        }
    printf("figure: transmittance against length: largest rise %.2e, %s\n", worst, where);
    most = worst;
    // A depth of a part of a ray is the difference of two columns to the top, each of which has 1.2e-7 of up to 40.
    // Ozone's columns come from two tables that meet at the tangent point, to 1e-3 of its transmittance.
    check_at_most("rise with the length", worst, 1e-3);
}

static void with_height(void **state) {
    static float through[RAYS][4], before[RAYS][4];
    double worst = 0;
    int at = 0, of = 0, ray = 0;
    (void)state;
    for (int a = 0; a < 5; a++)
        for (int i = 0; i < 60000; i += i < 4000 ? 1 : 7) {
            through_of(&airs[a], (float)i * 1e-3f, NULL, 1, through);
            for (int r = 0; r < 6 && i > 0; r++) // upward
                for (int b = 0; b < 3; b++)
                    if (rise(before[r][b], through[r][b]) > worst)
                        worst = rise(before[r][b], through[r][b]), at = i, of = a, ray = r;
            memcpy(before, through, sizeof before);
        }
    char text[48], along[16], up[16];
    printf("figure: transmittance against height: largest fall %.2e, %s at %d m, zenith angle %g\n", worst, names[of],
           at, zeniths[ray]);
    snprintf(text, sizeof text, "%s; %s", figure_text(along, most), figure_text(up, worst));
    table_line(50, "transmittance: largest rise with length; fall with height", "-", text, "0");
    check_at_most("fall with the height", worst, 5e-6);
}

static int make(void **state) {
    (void)state;
    air_make(&airs[0], names[0], air_clear(3), 0);
    air_make(&airs[1], names[1], air_hazy(3), 0);
    air_make(&airs[2], names[2], air_smoky(3), 0);
    air_make(&airs[3], names[3], air_layered(3, 0), 0);
    air_make(&airs[4], names[4], air_shaped(3), 0);
    return 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(along_the_ray), cmocka_unit_test(with_height)};
    return cmocka_run_group_tests(tests, make, NULL);
}
