#include "picture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "command.h"

/// Weights of ITU-R BT.709 luminance.
static double luminance_of(const float *rgb) {
    return 0.2126 * (double)rgb[0] + 0.7152 * (double)rgb[1] + 0.0722 * (double)rgb[2];
}

// ---- rendering: a row of pixels is one batch of rays

typedef struct row {
    float *direction, *radiance, *rgb; // [width * n * n][3 or 4]
    float *cover;                      // [width * n * n]
    size_t rays;
} row;

static bool row_begin(row *line, const projection *map, int n) {
    const size_t rays = (size_t)map->width * (size_t)(n * n);
    line->direction = malloc(rays * 3 * sizeof(float));
    line->radiance = malloc(rays * 4 * sizeof(float));
    line->rgb = malloc(rays * 3 * sizeof(float));
    line->cover = malloc(rays * sizeof(float));
    return line->direction && line->radiance && line->rgb && line->cover;
}

static void row_end(row *line) {
    free(line->direction);
    free(line->radiance);
    free(line->rgb);
    free(line->cover);
}

/// Rays of row y, only those the picture covers, pixel after pixel.
static void row_aim(row *line, const projection *map, int n, int y) {
    line->rays = 0;
    size_t i = 0;
    for (int x = 0; x < map->width; x++)
        for (int k = 0; k < n * n; k++) {
            const double dx = (k % n + 0.5) / n - 0.5, dy = (k / n + 0.5) / n - 0.5;
            const double cover = projection_direction(map, x + dx, y + dy, line->direction + 3 * line->rays);
            line->cover[i++] = (float)cover;
            line->rays += cover > 0.0;
        }
}

/// Averages the rays of each pixel, premultiplied by how much of it is covered.
static void row_resolve(const row *line, const picture *image, int n, float *out) {
    const float *rgb = line->rgb, *cover = line->cover;
    const float share = 1.0f / (float)(n * n);
    for (int x = 0; x < image->map.width; x++, out += image->channels) {
        float sum[4] = {0.0f, 0.0f, 0.0f, 0.0f};
        for (int k = 0; k < n * n; k++, cover++) {
            if (!(*cover > 0.0f))
                continue;
            for (int c = 0; c < 3; c++)
                sum[c] += *cover * rgb[c];
            sum[3] += *cover;
            rgb += 3;
        }
        for (int c = 0; c < image->channels; c++)
            out[c] = sum[c] * share;
    }
}

static bool render_rows(picture *image, scene *view, int n, row *line, bool progress) {
    const size_t stride = (size_t)image->map.width * (size_t)image->channels;
    for (int y = 0; y < image->map.height; y++) {
        row_aim(line, &image->map, n, y);
        if (line->rays > 0 && !scene_colours(view, line->rays, line->direction, line->radiance, line->rgb, NULL))
            return false;
        row_resolve(line, image, n, image->pixels + (size_t)y * stride);
        if (progress)
            progress_update((size_t)y + 1);
    }
    return true;
}

scene_plan picture_plan(const picture_options *options) {
    const size_t pixels = (size_t)options->map.width * (size_t)options->map.height;
    const int n = options->supersample;
    const double spacing = projection_spacing(&options->map) / n;
    return (scene_plan){.rays = pixels * (size_t)(n * n),
                        .sample_rad = (float)fmin(spacing, (double)SKV_DISC_SAMPLE_MAX)};
}

int picture_render(picture *image, const picture_options *options, scene *view, const moment *now, bool progress) {
    row line = {0};
    *image = (picture){.map = options->map, .channels = options->map.kind == PROJECTION_FISHEYE ? 4 : 3};
    if (!options->has_azimuth)
        image->map.azimuth_deg = now->sun_azimuth_deg;
    projection_prepare(&image->map);
    image->horizon_deg = scene_horizon_deg(view);
    const size_t pixels = (size_t)image->map.width * (size_t)image->map.height;
    image->pixels = malloc(pixels * (size_t)image->channels * sizeof(float));
    int status = 0;
    if (!image->pixels || !row_begin(&line, &image->map, options->supersample))
        status = fail_job("skyvert %s: no memory for a picture of %dx%d", options->command, image->map.width,
                          image->map.height);
    if (progress)
        progress_begin("render", (size_t)image->map.height);
    if (status == 0 && !render_rows(image, view, options->supersample, &line, progress))
        status = fail_job("skyvert %s: the core refused a row of rays", options->command);
    if (progress)
        progress_end();
    row_end(&line);
    if (status != 0)
        picture_free(image);
    return status;
}

void picture_free(picture *image) {
    free(image->pixels);
    image->pixels = NULL;
}

// ---- exposure

/// How much of a picture has which luminance: steps of 1/16 of a power of two from 2^-64 to 2^64.
enum { STEPS = 16, LOWEST = -64, STOPS = 128 };
typedef struct histogram {
    double weight[STEPS * STOPS];
    double all;
} histogram;

static void histogram_add(histogram *h, double luminance, double weight) {
    if (!(luminance > 0.0 && weight > 0.0))
        return;
    const double step = (log2(luminance) - LOWEST) * STEPS;
    h->weight[step < 0.0 ? 0 : step < STEPS * STOPS ? (int)step : STEPS * STOPS - 1] += weight;
    h->all += weight;
}

/// Luminance that all but the brightest hundredth stays below.
static int brightest(const histogram *h) {
    double above = 0.0;
    int i = STEPS * STOPS - 1;
    while (i > 0 && above + h->weight[i] <= 0.01 * h->all)
        above += h->weight[i--];
    return i;
}

/// exp of the mean of log luminance from 1/1000 of the brightest on; the brightest hundredth counts as no brighter
/// than the rest.
static double log_mean(const histogram *h) {
    const int top = brightest(h), floor_step = top - 10 * STEPS;
    double sum = 0.0, weight = 0.0;
    for (int i = floor_step > 0 ? floor_step : 0; i < STEPS * STOPS; i++) {
        sum += h->weight[i] * ((i < top ? i : top) + 0.5);
        weight += h->weight[i];
    }
    return weight > 0.0 ? exp2(sum / weight / STEPS + LOWEST) : 0.0;
}

/// k with 1 - exp(-k L) = EXPOSURE_KEY at the brightness of sky and ground, each weighed by its light; 1 where all is
/// black.
static double exposure_of(const histogram part[2]) {
    double sum = 0.0, light = 0.0;
    for (int i = 0; i < 2; i++) {
        const double mean = log_mean(&part[i]);
        light += part[i].all * mean;
        sum += part[i].all * mean * mean;
    }
    return sum > 0.0 ? -log(1.0 - EXPOSURE_KEY) * light / sum : 1.0;
}

double colours_auto_exposure(const float *rgb, size_t n, size_t channels, const float *weight) {
    histogram part[2] = {{{0.0}, 0.0}, {{0.0}, 0.0}};
    for (size_t i = 0; i < n; i++)
        histogram_add(&part[0], luminance_of(rgb + i * channels), weight ? (double)weight[i] : 1.0);
    return exposure_of(part);
}

double picture_auto_exposure(const picture *image) {
    const double lowest = sin(image->horizon_deg * (3.14159265358979323846 / 180.0));
    histogram part[2] = {{{0.0}, 0.0}, {{0.0}, 0.0}};
    for (int y = 0; y < image->map.height; y++)
        for (int x = 0; x < image->map.width; x++) {
            const size_t i = (size_t)y * (size_t)image->map.width + (size_t)x;
            float d[3];
            if (projection_direction(&image->map, x, y, d) < 1.0)
                continue; // not wholly covered
            histogram_add(&part[(double)d[2] < lowest], luminance_of(image->pixels + i * (size_t)image->channels),
                          projection_weight(&image->map, x, y));
        }
    return exposure_of(part);
}

// ---- for the eye

double srgb_from_linear(double linear) {
    if (!(linear > 0.0))
        return 0.0;
    return linear >= 1.0 ? 1.0 : linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1.0 / 2.4) - 0.055;
}

/// Ordered noise in [0, 1) without visible structure: interleaved gradient noise [Jimenez14].
static double noise_at(size_t x, size_t y, int channel) {
    const double u = (double)x + 17.0 * channel, v = (double)y + 31.0 * channel;
    const double inner = 0.06711056 * u + 0.00583715 * v;
    const double outer = 52.9829189 * (inner - floor(inner));
    return outer - floor(outer);
}

/// One pixel, exposed: colour with alpha taken out, then sRGB, in [0, 1].
static void pixel_to_srgb(const float *pixel, int channels, double exposure, double out[4]) {
    const float alpha = channels == 4 ? pixel[3] : 1.0f;
    const float scale = alpha > 0.0f ? 1.0f / alpha : 0.0f;
    const float straight[3] = {pixel[0] * scale, pixel[1] * scale, pixel[2] * scale};
    float exposed[3] = {0.0f, 0.0f, 0.0f};
    (void)skv_expose((float)exposure, 1, straight, 0, exposed, 0);
    for (int c = 0; c < 3; c++)
        out[c] = srgb_from_linear((double)exposed[c]);
    out[3] = (double)alpha;
}

uint8_t *picture_to_srgb8(const picture *image, double exposure, bool dither) {
    const size_t width = (size_t)image->map.width, pixels = width * (size_t)image->map.height;
    const int channels = image->channels;
    uint8_t *bytes = malloc(pixels * (size_t)channels);
    for (size_t i = 0; bytes && i < pixels; i++) {
        double value[4];
        pixel_to_srgb(image->pixels + i * (size_t)channels, channels, exposure, value);
        for (int c = 0; c < channels; c++) {
            // Black and white stay exact; alpha is not dithered.
            const bool smooth = dither && c < 3 && value[c] > 0.0 && value[c] < 1.0;
            const double step = smooth ? noise_at(i % width, i / width, c) : 0.5;
            bytes[i * (size_t)channels + (size_t)c] = (uint8_t)fmin(255.0, 255.0 * value[c] + step);
        }
    }
    return bytes;
}

uint16_t *picture_to_srgb16(const picture *image, double exposure) {
    const size_t pixels = (size_t)image->map.width * (size_t)image->map.height;
    const size_t channels = (size_t)image->channels;
    uint16_t *words = malloc(pixels * channels * sizeof *words);
    for (size_t i = 0; words && i < pixels; i++) {
        double value[4];
        pixel_to_srgb(image->pixels + i * channels, image->channels, exposure, value);
        for (size_t c = 0; c < channels; c++)
            words[i * channels + c] = (uint16_t)(65535.0 * value[c] + 0.5);
    }
    return words;
}
