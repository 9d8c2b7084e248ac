/// Sheets of pictures: the README's comparisons with published figures.
#ifndef TOOLS_PICTURES_SHEET_H
#define TOOLS_PICTURES_SHEET_H

#include <stdint.h>

#include "skyvert/skyvert.h"

#define SHEET_GAP 4

typedef struct sheet {
    int columns, rows, tile_width, tile_height, width, height;
    uint8_t *rgb; ///< [height][width][3], sRGB
} sheet;

/// Air, its table and what turns its bands into colour.
typedef struct sheet_air {
    skv_atmosphere atmosphere;
    skv_model model;
    skv_colour_matrix matrix;
    skv_table *table;
} sheet_air;

/// Ends the program with a message where the status is not SKV_OK.
void sheet_check(skv_status status, const char *what);

void sheet_begin(sheet *s, int columns, int rows, int tile_width, int tile_height);
/// Linear colour of a pixel, k its exposure.
void sheet_put(sheet *s, int column, int row, int x, int y, const float rgb[3], float k);
/// A number of a map: black, red, yellow, white at 0, 1/3, 2/3, 1.
void sheet_map(sheet *s, int column, int row, int x, int y, double t);
/// Writes the file and frees the sheet. @return 0, or 1 after a line on stderr.
int sheet_end(sheet *s, const char *name);

/// From an atmosphere that is filled in.
void sheet_air_begin(sheet_air *air);
void sheet_air_end(sheet_air *air);

/// A frame with the sun in the south, the ground lit; all: with all orders.
void sheet_frame(skv_frame *frame, const sheet_air *air, double height_km, double sun_zenith_deg, int all);

/// Exposure of n pixels that brings the mean of log luminance of what is not black to 0.32 of white, but no more than
/// takes one pixel in a hundred over 0.92.
float sheet_exposure(const float *rgb, int n);

#endif
