/// Sheets of pictures: what their makers share.
#include "sheet.h"

#include <fcntl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "port/png/skv_png.h"

#define PAPER 26

void sheet_check(skv_status status, const char *what) {
    if (status == SKV_OK)
        return;
    fprintf(stderr, "pictures: %s: status %d\n", what, (int)status);
    exit(1);
}

static void *get(size_t n) {
    void *const p = malloc(n);
    if (!p) {
        fprintf(stderr, "pictures: no memory\n");
        exit(1);
    }
    return p;
}

void sheet_begin(sheet *s, int columns, int rows, int tile_width, int tile_height) {
    s->columns = columns;
    s->rows = rows;
    s->tile_width = tile_width;
    s->tile_height = tile_height;
    s->width = columns * (tile_width + SHEET_GAP) + SHEET_GAP;
    s->height = rows * (tile_height + SHEET_GAP) + SHEET_GAP;
    s->rgb = get((size_t)s->width * (size_t)s->height * 3);
    memset(s->rgb, PAPER, (size_t)s->width * (size_t)s->height * 3);
}

void sheet_put(sheet *s, int column, int row, int x, int y, const float rgb[3], float k) {
    const int left = SHEET_GAP + column * (s->tile_width + SHEET_GAP),
              top = SHEET_GAP + row * (s->tile_height + SHEET_GAP);
    float exposed[3];
    sheet_check(skv_expose(k, 1, rgb, 0, exposed, 0), "skv_expose");
    sheet_check(skv_pack(SKV_FORMAT_SRGB8, 1, exposed, 0,
                         s->rgb + 3 * ((size_t)(top + y) * (size_t)s->width + (size_t)(left + x)), 0),
                "skv_pack");
}

void sheet_map(sheet *s, int column, int row, int x, int y, double t) {
    const int left = SHEET_GAP + column * (s->tile_width + SHEET_GAP),
              top = SHEET_GAP + row * (s->tile_height + SHEET_GAP);
    uint8_t *const out = s->rgb + 3 * ((size_t)(top + y) * (size_t)s->width + (size_t)(left + x));
    for (int c = 0; c < 3; c++)
        out[c] = (uint8_t)(255.0 * fmin(fmax(3 * t - c, 0), 1) + 0.5);
}

int sheet_end(sheet *s, const char *name) {
    char message[256] = "cannot be opened";
    const int fd = open(name, O_WRONLY | O_CREAT | O_TRUNC, 0644);
    const skv_png_image image = {.width = s->width, .height = s->height, .channels = 3, .bits = 8, .pixels = s->rgb};
    int status = fd < 0 ? -1 : skv_png_write(fd, &image, message, sizeof message);
    if (fd >= 0 && close(fd) != 0 && status == 0) {
        snprintf(message, sizeof message, "closing failed");
        status = -1;
    }
    if (status != 0)
        fprintf(stderr, "pictures: %s: %s\n", name, message);
    free(s->rgb);
    s->rgb = NULL;
    return status != 0;
}

void sheet_air_begin(sheet_air *air) {
    const skv_atmosphere *const a = &air->atmosphere;
    skv_table_spec spec;
    sheet_check(skv_model_build(&air->model, a), "skv_model_build");
    sheet_check(skv_colour_matrix_for(&air->matrix, a->bands, a->wavelength_nm, a->solar_irradiance),
                "skv_colour_matrix_for");
    sheet_check(skv_table_spec_for(&spec, &air->model, SKV_TABLE_ACCURATE), "skv_table_spec_for");
    const size_t size = skv_table_size(&spec, a->bands), work_size = skv_table_work_size(&spec, a->bands);
    void *const work = get(work_size);
    air->table = get(size);
    sheet_check(skv_table_build(air->table, size, work, work_size, &air->model, &spec), "skv_table_build");
    free(work);
}

void sheet_air_end(sheet_air *air) {
    free(air->table);
    air->table = NULL;
}

void sheet_frame(skv_frame *frame, const sheet_air *air, double height_km, double sun_zenith_deg, int all) {
    const double z = sun_zenith_deg * 3.14159265358979323846 / 180;
    const float sun[3] = {0, (float)-sin(z), (float)cos(z)};
    skv_quality quality;
    skv_light light;
    sheet_check(skv_quality_tier(&quality, SKV_TIER_HIGH), "skv_quality_tier");
    quality.terms |= SKV_WITH_GROUND;
    sheet_check(skv_light_sun(&light, &air->model, sun), "skv_light_sun");
    sheet_check(skv_frame_begin(frame, &air->model, &quality, (float)height_km, 0, &light, 1), "skv_frame_begin");
    if (all)
        sheet_check(skv_frame_table(frame, air->table), "skv_frame_table");
}

static int ascending(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

float sheet_exposure(const float *rgb, int n) {
    double *const y = get((size_t)n * sizeof *y), sum = 0;
    int counted = 0;
    for (int i = 0; i < n; i++)
        y[i] = 0.2126 * (double)rgb[3 * i] + 0.7152 * (double)rgb[3 * i + 1] + 0.0722 * (double)rgb[3 * i + 2];
    qsort(y, (size_t)n, sizeof *y, ascending);
    const double bright = y[(int)(0.99 * n)], floor = 0.003 * y[n - 1];
    for (int i = 0; i < n; i++)
        if (y[i] > floor) {
            sum += log(y[i]);
            counted++;
        }
    free(y);
    if (counted == 0)
        return 1.0f;
    return (float)fmin(-log(1 - 0.32) / exp(sum / counted), -log(1 - 0.92) / fmax(bright, 1e-30));
}
