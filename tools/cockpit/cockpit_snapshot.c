#define _XOPEN_SOURCE 700
#include "cockpit_snapshot.h"

#include <errno.h>
#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#ifdef SKV_HAVE_EXR
#include "port/openexr/skv_exr.h"
#endif
#ifdef SKV_HAVE_PNG
#include "port/png/skv_png.h"
#endif

enum { WIDTH = 720, HEIGHT = 361 };
static const double pi = 3.14159265358979323846;

/// As OpenEXR's latitude-longitude map: column 0 and the last one are south, north is the centre, east right of it.
static void direction(int x, int y, float enu[3]) {
    const double azimuth = 2 * pi * x / (WIDTH - 1) - pi, elevation = pi / 2 - pi * y / (HEIGHT - 1);
    enu[0] = (float)(cos(elevation) * sin(azimuth));
    enu[1] = (float)(cos(elevation) * cos(azimuth));
    enu[2] = (float)sin(elevation);
}

static float *render(const cockpit_sky *sky) {
    float *const rgb = malloc(sizeof(float) * 3 * WIDTH * HEIGHT), *const row = malloc(sizeof(float) * 3 * WIDTH);
    float *const work = malloc(sizeof(float) * 8 * WIDTH);
    bool ok = rgb && row && work;
    for (int y = 0; y < HEIGHT && ok; y++) {
        for (int x = 0; x < WIDTH; x++)
            direction(x, y, row + 3 * x);
        ok = cockpit_sky_look(sky, WIDTH, row, work, rgb + (size_t)3 * WIDTH * (size_t)y, (float)(pi / (HEIGHT - 1)));
    }
    free(row);
    free(work);
    if (ok)
        return rgb;
    free(rgb);
    return NULL;
}

#ifdef SKV_HAVE_EXR
static int write_exr(const float *rgb, const cockpit_sky *sky, const char *path) {
    char message[200], date[32] = "";
    output out;
    skv_calendar c = {0};
    const skv_utc utc = {sky->at.utc_day, (float)sky->at.utc_seconds};
    const bool dated = skv_utc_to_calendar(&c, &utc) == SKV_OK;
    snprintf(date, sizeof date, "%04d:%02d:%02d %02d:%02d:%02d", (int)c.year, (int)c.month, (int)c.day, (int)c.hour,
             (int)c.minute, (int)c.second);
    const skv_exr_image image = {.width = WIDTH,
                                 .height = HEIGHT,
                                 .channels = 3,
                                 .pixels = rgb,
                                 .white_luminance = SKV_WHITE_LUMINANCE,
                                 .latlong = true,
                                 .screen_window_width = 1.0f,
                                 .has_position = true,
                                 .latitude_deg = (float)sky->at.latitude_deg,
                                 .longitude_deg = (float)sky->at.longitude_deg,
                                 .altitude_m = sky->at.height_m,
                                 .cap_date = dated ? date : NULL,
                                 .software = COCKPIT " " SKV_VERSION};
    const int opened = output_open(&out, path);
    if (opened != 0)
        return opened;
    if (skv_exr_write(fileno(out.stream), &image, message, sizeof message) == SKV_EXR_OK)
        return output_commit(&out);
    output_discard(&out);
    return fail_job(COCKPIT ": --exr %.200s: %s", path, message);
}
#else
static int write_exr(const float *rgb, const cockpit_sky *sky, const char *path) {
    (void)rgb;
    (void)sky;
    return fail_job(COCKPIT ": --exr %.200s: built without OpenEXR (package libopenexr-dev)", path);
}
#endif

#ifdef SKV_HAVE_PNG
static int write_png(float *rgb, const cockpit_sky *sky, const char *path) {
    char message[200];
    output out;
    const size_t n = (size_t)WIDTH * HEIGHT;
    uint8_t *const bytes = malloc(3 * n);
    if (!bytes || skv_expose(sky->at.exposure, n, rgb, 0, rgb, 0) != SKV_OK ||
        skv_pack(SKV_FORMAT_SRGB8, n, rgb, 0, bytes, 0) != SKV_OK) {
        free(bytes);
        return fail_job(COCKPIT ": --png %.200s: out of memory", path);
    }
    const skv_png_image image = {.width = WIDTH, .height = HEIGHT, .channels = 3, .bits = 8, .pixels = bytes};
    int status = output_open(&out, path);
    if (status == 0 && skv_png_write(fileno(out.stream), &image, message, sizeof message) == SKV_PNG_OK) {
        status = output_commit(&out);
    } else if (status == 0) {
        output_discard(&out);
        status = fail_job(COCKPIT ": --png %.200s: %s", path, message);
    }
    free(bytes);
    return status;
}
#else
static int write_png(float *rgb, const cockpit_sky *sky, const char *path) {
    (void)rgb;
    (void)sky;
    return fail_job(COCKPIT ": --png %.200s: built without libpng (package libpng-dev)", path);
}
#endif

int cockpit_snapshot_write(const cockpit_options *options, const cockpit_sky *sky) {
    float *const rgb = render(sky);
    if (!rgb)
        return fail_job(COCKPIT ": snapshot: out of memory");
    int status = options->exr ? write_exr(rgb, sky, options->exr) : 0;
    if (options->png) { // last: it exposes in place
        const int png = write_png(rgb, sky, options->png);
        status = status ? status : png;
    }
    free(rgb);
    return status;
}

pid_t cockpit_snapshot_begin(const cockpit_options *options, const cockpit_sky *sky) {
    fflush(NULL);
    const pid_t child = fork();
    if (child != 0)
        return child;
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, NULL); // a signal ends it, and what it was writing is removed
    errno = 0;
    (void)nice(10);
    _exit(cockpit_snapshot_write(options, sky));
}
