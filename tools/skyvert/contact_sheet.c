#include "contact_sheet.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define GAP          8
#define LINE_HEIGHT  10 // of a caption: seven rows of a letter and three between
#define CAPTION      (2 * LINE_HEIGHT + 2)
#define PAPER        26  // sRGB grey of the sheet
#define INK          190 // and of the captions
#define PAPER_LINEAR 0.0103

/// Letters five wide, seven high: one byte a row, bit 4 is the left column.
typedef struct glyph {
    char letter;
    uint8_t row[7];
} glyph;

static const glyph font[] = {
    {'0', {14, 17, 19, 21, 25, 17, 14}}, {'1', {4, 12, 4, 4, 4, 4, 14}},      {'2', {14, 17, 1, 2, 4, 8, 31}},
    {'3', {31, 2, 4, 2, 1, 17, 14}},     {'4', {2, 6, 10, 18, 31, 2, 2}},     {'5', {31, 16, 30, 1, 1, 17, 14}},
    {'6', {6, 8, 16, 30, 17, 17, 14}},   {'7', {31, 1, 2, 4, 8, 8, 8}},       {'8', {14, 17, 17, 14, 17, 17, 14}},
    {'9', {14, 17, 17, 15, 1, 2, 12}},   {':', {0, 4, 4, 0, 4, 4, 0}},        {'-', {0, 0, 0, 31, 0, 0, 0}},
    {'+', {0, 4, 4, 31, 4, 4, 0}},       {'.', {0, 0, 0, 0, 0, 12, 12}},      {'S', {15, 16, 16, 14, 1, 1, 30}},
    {'U', {17, 17, 17, 17, 17, 17, 14}}, {'N', {17, 17, 25, 21, 19, 17, 17}}, {'K', {17, 18, 20, 24, 20, 18, 17}},
    {'M', {17, 27, 21, 21, 17, 17, 17}}, {'Z', {31, 1, 2, 4, 8, 16, 31}},
};

static const uint8_t *glyph_rows(char letter) {
    for (size_t i = 0; i < sizeof font / sizeof font[0]; i++)
        if (font[i].letter == letter)
            return font[i].row;
    return NULL;
}

static void put(contact_sheet *sheet, int x, int y, uint8_t grey) {
    if (x >= 0 && x < sheet->width && y >= 0 && y < sheet->height)
        memset(sheet->rgb + 3 * ((size_t)y * (size_t)sheet->width + (size_t)x), grey, 3);
}

static void write_text(contact_sheet *sheet, int x, int y, const char *text) {
    for (; *text; text++, x += 6) {
        const uint8_t *rows = glyph_rows(*text);
        for (int i = 0; rows && i < 35; i++)
            if (rows[i / 5] >> (4 - i % 5) & 1)
                put(sheet, x + i % 5, y + i / 5, INK);
    }
}

bool contact_sheet_begin(contact_sheet *sheet, const projection *map, size_t steps) {
    memset(sheet, 0, sizeof *sheet);
    const int longer = map->width > map->height ? map->width : map->height;
    const double scale = longer > CONTACT_TILE_SIDE ? (double)CONTACT_TILE_SIDE / longer : 1.0;
    sheet->steps = steps;
    sheet->tiles = steps < CONTACT_TILES_MAX ? steps : CONTACT_TILES_MAX;
    sheet->tile_width = (int)fmax(2.0, floor(map->width * scale));
    sheet->tile_height = (int)fmax(2.0, floor(map->height * scale));
    const int cell = (sheet->tile_width > 100 ? sheet->tile_width : 100) + GAP; // a caption's width at least
    const int high = sheet->tile_height + CAPTION + GAP;
    const double across = ceil(sqrt(1.5 * (double)sheet->tiles * high / cell)); // a sheet of about 3:2
    sheet->columns = across < (double)sheet->tiles ? (int)across : (int)sheet->tiles;
    const int rows = ((int)sheet->tiles + sheet->columns - 1) / sheet->columns;
    sheet->width = GAP + sheet->columns * cell;
    sheet->height = GAP + rows * high;
    sheet->rgb = malloc((size_t)sheet->width * (size_t)sheet->height * 3);
    if (sheet->rgb)
        memset(sheet->rgb, PAPER, (size_t)sheet->width * (size_t)sheet->height * 3);
    return sheet->rgb != NULL;
}

/// Mean of the picture's pixels under pixel (x, y) of the tile: linear light, premultiplied alpha last.
static void shrink(const contact_sheet *sheet, const picture *image, int x, int y, double mean[4]) {
    const int w = image->map.width, h = image->map.height, channels = image->channels;
    const int x0 = (int)((long long)x * w / sheet->tile_width), x1 = (int)((long long)(x + 1) * w / sheet->tile_width);
    const int y0 = (int)((long long)y * h / sheet->tile_height),
              y1 = (int)((long long)(y + 1) * h / sheet->tile_height);
    const int right = x1 > x0 ? x1 : x0 + 1, bottom = y1 > y0 ? y1 : y0 + 1;
    memset(mean, 0, 4 * sizeof *mean);
    for (int j = y0; j < bottom; j++)
        for (int i = x0; i < right; i++) {
            const float *pixel = image->pixels + ((size_t)j * (size_t)w + (size_t)i) * (size_t)channels;
            for (int c = 0; c < 3; c++)
                mean[c] += (double)pixel[c];
            mean[3] += channels == 4 ? (double)pixel[3] : 1.0;
        }
    for (int c = 0; c < 4; c++)
        mean[c] /= (double)((right - x0) * (bottom - y0));
}

static void draw_tile(contact_sheet *sheet, const picture *image, double exposure, int left, int top) {
    for (int y = 0; y < sheet->tile_height; y++)
        for (int x = 0; x < sheet->tile_width; x++) {
            double mean[4];
            shrink(sheet, image, x, y, mean);
            uint8_t *out = sheet->rgb + 3 * ((size_t)(top + y) * (size_t)sheet->width + (size_t)(left + x));
            for (int c = 0; c < 3; c++) {
                const double light = mean[3] > 0.0 ? 1.0 - exp(-exposure * fmax(0.0, mean[c]) / mean[3]) : 0.0;
                const double over = mean[3] * light + (1.0 - mean[3]) * PAPER_LINEAR;
                out[c] = (uint8_t)(255.0 * srgb_from_linear(over) + 0.5);
            }
        }
}

void contact_sheet_add(contact_sheet *sheet, size_t step, const picture *image, double exposure, const char *line1,
                       const char *line2) {
    if (sheet->next >= sheet->tiles || step * sheet->tiles < sheet->next * sheet->steps)
        return;
    const int cell = (sheet->width - GAP) / sheet->columns, high = sheet->tile_height + CAPTION + GAP;
    const int left = GAP + (int)(sheet->next % (size_t)sheet->columns) * cell;
    const int top = GAP + (int)(sheet->next / (size_t)sheet->columns) * high;
    draw_tile(sheet, image, exposure, left, top);
    write_text(sheet, left, top + sheet->tile_height + 3, line1);
    write_text(sheet, left, top + sheet->tile_height + 3 + LINE_HEIGHT, line2);
    sheet->next++;
}

void contact_sheet_end(contact_sheet *sheet) {
    free(sheet->rgb);
    sheet->rgb = NULL;
}
