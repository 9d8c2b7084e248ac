/// picture-views FOLDER: sheets of perspective views by the library, in the manner of published figures.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sheet.h"

#define WIDE 192
#define HIGH 128
#define FINE 2 ///< rays a pixel, each way

typedef struct view {
    int column, row;
    skv_preset preset;
    int all;
    double height_km, sun_zenith_deg;
    double turn_deg, elevation_deg, fov_deg; ///< of the camera; turn from the sun
    int same;                                ///< exposed like the panel before
} view;

typedef struct figure {
    const char *name;
    int columns, rows, views;
    view view[16];
} figure;

static const figure figures[] = {
    // Single scattering above, all light below; noon, afternoon, sunset, dusk [Elek09, Fig. 4].
    {"single-and-all",
     4,
     2,
     8,
     {{0, 1, SKV_PRESET_EARTH_CLEAR, 1, 1, 30, 120, 8, 90, 0},
      {0, 0, SKV_PRESET_EARTH_CLEAR, 0, 1, 30, 120, 8, 90, 1},
      {1, 1, SKV_PRESET_EARTH_CLEAR, 1, 1, 75, 60, 8, 90, 0},
      {1, 0, SKV_PRESET_EARTH_CLEAR, 0, 1, 75, 60, 8, 90, 1},
      {2, 1, SKV_PRESET_EARTH_CLEAR, 1, 1, 89, 0, 14, 90, 0},
      {2, 0, SKV_PRESET_EARTH_CLEAR, 0, 1, 89, 0, 14, 90, 1},
      {3, 1, SKV_PRESET_EARTH_CLEAR, 1, 1, 94, 0, 14, 90, 0},
      {3, 0, SKV_PRESET_EARTH_CLEAR, 0, 1, 94, 0, 14, 90, 1}}},
    // A fifth of the Earth's air, the Earth's, five times it: from space, 20 km, and 1 km at sunset [Elek09, Fig. 6].
    {"thin-and-dense",
     3,
     3,
     9,
     {{0, 0, SKV_PRESET_EARTH_THIN, 1, 1000, 60, 90, -30, 60, 0},
      {1, 0, SKV_PRESET_EARTH_THIN, 1, 20, 70, 70, -2, 80, 0},
      {2, 0, SKV_PRESET_EARTH_THIN, 1, 1, 89, 0, 14, 80, 0},
      {0, 1, SKV_PRESET_EARTH_CLEAR, 1, 1000, 60, 90, -30, 60, 0},
      {1, 1, SKV_PRESET_EARTH_CLEAR, 1, 20, 70, 70, -2, 80, 0},
      {2, 1, SKV_PRESET_EARTH_CLEAR, 1, 1, 89, 0, 14, 80, 0},
      {0, 2, SKV_PRESET_EARTH_DENSE, 1, 1000, 60, 90, -30, 60, 0},
      {1, 2, SKV_PRESET_EARTH_DENSE, 1, 20, 70, 70, -2, 80, 0},
      {2, 2, SKV_PRESET_EARTH_DENSE, 1, 1, 89, 0, 14, 80, 0}}},
    // From 80 km: day, low sun, sunset, the sun below the horizon.
    {"80km",
     4,
     1,
     4,
     {{0, 0, SKV_PRESET_EARTH_CLEAR, 1, 80, 45, 60, -10, 60, 0},
      {1, 0, SKV_PRESET_EARTH_CLEAR, 1, 80, 85, 30, -10, 60, 0},
      {2, 0, SKV_PRESET_EARTH_CLEAR, 1, 80, 95, 0, -8, 60, 0},
      {3, 0, SKV_PRESET_EARTH_CLEAR, 1, 80, 100, 0, -8, 60, 0}}},
    // Ground: day, afternoon, sunset, dusk; 10 km, 30 km, the limb by day and at the edge of night [Keller08, Fig.
    // 9-12].
    {"ground-to-space",
     4,
     2,
     8,
     {{0, 0, SKV_PRESET_EARTH_HAZY, 1, 0.1, 40, 60, 20, 90, 0},
      {1, 0, SKV_PRESET_EARTH_HAZY, 1, 0.1, 80, 0, 20, 90, 0},
      {2, 0, SKV_PRESET_EARTH_HAZY, 1, 0.1, 89, 0, 20, 90, 0},
      {3, 0, SKV_PRESET_EARTH_HAZY, 1, 0.1, 94, 0, 20, 90, 0},
      {0, 1, SKV_PRESET_EARTH_HAZY, 1, 10, 60, 60, 0, 90, 0},
      {1, 1, SKV_PRESET_EARTH_HAZY, 1, 30, 60, 60, 0, 90, 0},
      {2, 1, SKV_PRESET_EARTH_HAZY, 1, 400, 70, 60, -19, 50, 0},
      {3, 1, SKV_PRESET_EARTH_HAZY, 1, 400, 105, 0, -19, 50, 0}}},
    // Other air: Mars by day and at sunset, Titan by day and low sun, smoke, 25 times the Earth's air.
    {"planets",
     3,
     2,
     6,
     {{0, 0, SKV_PRESET_MARS, 1, 0.1, 50, 60, 14, 90, 0},
      {1, 0, SKV_PRESET_MARS, 1, 0.1, 87, 0, 14, 90, 0},
      {2, 0, SKV_PRESET_TITAN, 1, 0.1, 40, 60, 14, 90, 0},
      {0, 1, SKV_PRESET_TITAN, 1, 2000, 60, 60, -35, 60, 0},
      {1, 1, SKV_PRESET_EARTH_SMOKE, 1, 1, 70, 0, 14, 90, 0},
      {2, 1, SKV_PRESET_EARTH_X25, 1, 1, 60, 0, 14, 90, 0}}},
};

static void aim(const view *v, int x, int y, float direction[3]) {
    const double degree = 3.14159265358979323846 / 180, e = v->elevation_deg * degree, t = v->turn_deg * degree;
    const double half = tan(0.5 * v->fov_deg * degree), scale = 2 * half / (WIDE * FINE);
    const double right = (x + 0.5 - 0.5 * WIDE * FINE) * scale, up = (0.5 * HIGH * FINE - y - 0.5) * scale;
    // The sun is in the south; a camera turned by t looks t to the right of it.
    const double flat = cos(e) - up * sin(e);
    direction[0] = (float)(-flat * sin(t) - right * cos(t));
    direction[1] = (float)(-flat * cos(t) + right * sin(t));
    direction[2] = (float)(sin(e) + up * cos(e));
}

static void draw(sheet *s, const view *v, const sheet_air *air, float *k) {
    static float direction[WIDE * FINE][3], radiance[WIDE * FINE][4], fine[WIDE * FINE][3], rgb[HIGH * WIDE][3];
    skv_frame frame;
    sheet_frame(&frame, air, v->height_km, v->sun_zenith_deg, v->all);
    memset(rgb, 0, sizeof rgb);
    for (int y = 0; y < HIGH * FINE; y++) {
        for (int x = 0; x < WIDE * FINE; x++)
            aim(v, x, y, direction[x]);
        const skv_rays rays = {direction[0], 0, NULL, 0};
        const skv_sky sky = {radiance[0], sizeof radiance[0], NULL, 0};
        sheet_check(skv_radiance(&frame, WIDE * FINE, &rays, &sky), "skv_radiance");
        sheet_check(skv_colour(&air->matrix, air->atmosphere.bands, WIDE * FINE, radiance[0], sizeof radiance[0],
                               fine[0], 0, NULL, 0),
                    "skv_colour");
        for (int x = 0; x < WIDE * FINE; x++)
            for (int c = 0; c < 3; c++)
                rgb[y / FINE * WIDE + x / FINE][c] += fine[x][c] / (FINE * FINE);
    }
    *k = v->same ? *k : sheet_exposure(rgb[0], HIGH * WIDE);
    for (int i = 0; i < HIGH * WIDE; i++)
        sheet_put(s, v->column, v->row, i % WIDE, i / WIDE, rgb[i], *k);
}

static int make(const figure *f, const char *folder) {
    static sheet_air air;
    char name[512];
    sheet s;
    float k = 1;
    int have = -1;
    sheet_begin(&s, f->columns, f->rows, WIDE, HIGH);
    for (int i = 0; i < f->views; i++) {
        const int preset = (int)f->view[i].preset;
        if (preset != have) {
            sheet_air_end(&air);
            sheet_check(skv_atmosphere_preset(&air.atmosphere, f->view[i].preset, 4), "skv_atmosphere_preset");
            sheet_air_begin(&air);
            have = preset;
        }
        draw(&s, &f->view[i], &air, &k);
    }
    sheet_air_end(&air);
    if (snprintf(name, sizeof name, "%s/%s.png", folder, f->name) >= (int)sizeof name)
        return 1;
    printf("  %s\n", name);
    return sheet_end(&s, name);
}

int main(int argc, char **argv) {
    int status = 0;
    if (argc != 2) {
        fprintf(stderr, "usage: picture-views FOLDER\n");
        return 2;
    }
    for (size_t i = 0; i < sizeof figures / sizeof *figures; i++)
        status |= make(&figures[i], argv[1]);
    return status;
}
