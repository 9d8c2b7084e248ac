/// Lines of the README's table, and how far an answer is from the truth.
#ifndef TESTS_EXTREMES_TABLE_H
#define TESTS_EXTREMES_TABLE_H

#include "air.h"

/// Luminance of a moonless night over that of sunlight on a plane, 2.2e-4 cd/m2 over 1.33e5 lx: 1/sr. What is darker is
/// not seen, and no error is relative to less.
#define NIGHT_PER_SR 1.7e-9

/// A number of the table: two digits, no zero before the point.
static inline const char *figure_text(char to[16], double x) {
    if (!(x == x) || x > 1e30)
        return "inf";
    snprintf(to, 16,
             x >= 9999.5     ? "%.0e"
             : x >= 99.5     ? "%.0f"
             : x >= 0.0995   ? "%.2g"
             : x >= 0.000995 ? "%.2g"
             : x > 0         ? "%.1e"
                             : "0",
             x);
    char *const zero = strncmp(to, "0.", 2) == 0 ? to : NULL;
    if (zero)
        memmove(zero, zero + 1, strlen(zero));
    return to;
}

/// Printed by `make extremes`, which puts the lines in order of their number.
static inline void table_line(int number, const char *what, const char *naive, const char *ours, const char *truth) {
    printf("row: %02d | %s | %s | %s | %s |\n", number, what, naive, ours, truth);
}

/// What errors of rays of this observer are relative to at least: 5 % of the mean of the dome, the night at least.
static inline double least_radiance(const air *a, const skv_quality *quality, float observer_km, const float sun[3]) {
    enum { DOME = 16 };
    skv_frame frame;
    float view[DOME][3], radiance[DOME][4] = {{0}};
    double mean = 0, night = 0;
    for (int i = 0; i < DOME; i++)
        direction_of(view[i], 180 * halton(i + 1, 2), 180 * halton(i + 1, 3));
    frame_of(&frame, a, quality, observer_km, sun);
    const skv_rays rays = {view[0], 0, NULL, 0};
    const skv_sky sky = {radiance[0], sizeof radiance[0], NULL, 0};
    must(skv_radiance(&frame, DOME, &rays, &sky), "skv_radiance");
    for (int i = 0; i < DOME; i++) {
        double most = 0;
        for (int b = 0; b < a->atmosphere.bands; b++)
            most = fmax(most, (double)radiance[i][b]);
        mean += most / DOME;
    }
    for (int b = 0; b < a->atmosphere.bands; b++)
        night = fmax(night, NIGHT_PER_SR * (double)a->atmosphere.solar_irradiance[b]);
    return fmax(0.05 * mean, night);
}

#endif
