/// picture-fisheyes OUT.png FILE.ini PIXELS TRUTH.csv...: half fisheyes of the path tracer (queries.awk) against the
/// library's. A column per file; rows: path tracer, ours, error (black 0, red 5 %, yellow 10 %),
/// luminance of ours (black 1, red 32, yellow 1000, white 32,000 cd/m2).
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "convert.h"
#include "sheet.h"

#define SIDE_MAX 64
#define SCALE    2

typedef struct pixel {
    int x, y; ///< right half
    float direction[3], truth[4];
} pixel;

static pixel pixels[SIDE_MAX * SIDE_MAX];
static double height_km, sun_zenith_deg;

static int load(const char *name, int side, int bands) {
    char text[1024];
    FILE *in = fopen(name, "r");
    int n = 0;
    if (!in || !fgets(text, sizeof text, in)) {
        fprintf(stderr, "picture-fisheyes: %s: cannot be read\n", name);
        exit(2);
    }
    while (n < SIDE_MAX * SIDE_MAX && fgets(text, sizeof text, in)) {
        double v[8] = {0};
        const char *at = text;
        for (int i = 0; i < 4 + bands; i++) {
            char *end;
            v[i] = strtod(at, &end);
            if (end == at || !isfinite(v[i])) {
                fprintf(stderr, "picture-fisheyes: %s:%d: a number is missing\n", name, n + 2);
                exit(2);
            }
            at = end + 1;
        }
        const double view = v[2] * 3.14159265358979323846 / 180, turn = v[3] * 3.14159265358979323846 / 180;
        pixel *const p = &pixels[n++];
        height_km = v[0];
        sun_zenith_deg = v[1];
        p->x = (int)floor(side / 2.0 * (1 + v[2] / 90 * sin(turn)));
        p->y = (int)floor(side / 2.0 * (1 - v[2] / 90 * cos(turn)));
        p->direction[0] = (float)(sin(view) * sin(turn));
        p->direction[1] = (float)(-sin(view) * cos(turn));
        p->direction[2] = (float)cos(view);
        for (int b = 0; b < bands; b++)
            p->truth[b] = (float)v[4 + b];
    }
    fclose(in);
    return n;
}

/// The pixel and its mirror image, SCALE times as large; a number where rgb is NULL.
static void put(sheet *s, int column, int row, const pixel *p, int side, const float *rgb, double k) {
    for (int i = 0; i < 2 * SCALE * SCALE; i++) {
        const int y = p->y * SCALE + i / 2 / SCALE, right = p->x * SCALE + i / 2 % SCALE;
        const int x = i % 2 == 0 ? right : side * SCALE - 1 - right;
        if (rgb)
            sheet_put(s, column, row, x, y, rgb, (float)k);
        else
            sheet_map(s, column, row, x, y, k);
    }
}

static void draw(sheet *s, int column, const sheet_air *air, int n, int side) {
    static float ours[SIDE_MAX * SIDE_MAX][4], rgb[SIDE_MAX * SIDE_MAX][3], light[SIDE_MAX * SIDE_MAX];
    static float true_rgb[SIDE_MAX * SIDE_MAX][3];
    const int bands = air->atmosphere.bands;
    double mean = 0, sum = 0, worst = 0;
    skv_frame frame;
    sheet_frame(&frame, air, height_km, sun_zenith_deg, 1);
    const skv_rays rays = {pixels[0].direction, sizeof pixels[0], NULL, 0};
    const skv_sky sky = {ours[0], sizeof ours[0], NULL, 0};
    sheet_check(skv_radiance(&frame, (size_t)n, &rays, &sky), "skv_radiance");
    sheet_check(skv_colour(&air->matrix, bands, (size_t)n, ours[0], sizeof ours[0], rgb[0], 0, light, 0), "skv_colour");
    sheet_check(skv_colour(&air->matrix, bands, (size_t)n, pixels[0].truth, sizeof pixels[0], true_rgb[0], 0, NULL, 0),
                "skv_colour");
    for (int i = 0; i < n; i++) {
        float largest = 0;
        for (int b = 0; b < bands; b++)
            largest = fmaxf(largest, pixels[i].truth[b]);
        mean += (double)largest / n;
    }
    const float k = sheet_exposure(true_rgb[0], n);
    for (int i = 0; i < n; i++) {
        float largest = 0, error = 0;
        for (int b = 0; b < bands; b++) {
            largest = fmaxf(largest, pixels[i].truth[b]);
            error = fmaxf(error, fabsf(ours[i][b] - pixels[i].truth[b]));
        }
        const double e = (double)error / fmax((double)largest, 0.05 * mean);
        sum += e / n;
        worst = fmax(worst, e);
        put(s, column, 0, &pixels[i], side, true_rgb[i], (double)k);
        put(s, column, 1, &pixels[i], side, rgb[i], (double)k);
        put(s, column, 2, &pixels[i], side, NULL, e / 0.15);
        put(s, column, 3, &pixels[i], side, NULL, log10(fmax((double)light[i], 1)) / 4.5);
    }
    printf("  sun %g deg from the zenith, %g km: mean error %.2f %%, largest %.1f %% (with the truth's noise)\n",
           sun_zenith_deg, height_km, 100 * sum, 100 * worst);
}

int main(int argc, char **argv) {
    static ref_file file;
    static ref_float_tables tables;
    static sheet_air air;
    sheet s;
    const int side = argc > 4 ? atoi(argv[3]) : 0;
    if (side < 4 || side > SIDE_MAX) {
        fprintf(stderr, "usage: picture-fisheyes OUT.png FILE.ini PIXELS(4-%d) TRUTH.csv...\n", SIDE_MAX);
        return 2;
    }
    if (ref_read_ini(&file, argv[2]) != 0)
        return 2;
    ref_to_skyvert(&file.atmosphere, &air.atmosphere, &tables);
    sheet_air_begin(&air);
    sheet_begin(&s, argc - 4, 4, side * SCALE, side * SCALE);
    for (int i = 4; i < argc; i++) {
        const int n = load(argv[i], side, air.atmosphere.bands);
        draw(&s, i - 4, &air, n, side);
    }
    sheet_air_end(&air);
    return sheet_end(&s, argv[1]);
}
