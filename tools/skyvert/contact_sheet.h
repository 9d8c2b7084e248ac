/// A sheet of small pictures with captions, for a look over a whole flight.
#ifndef SKYVERT_CONTACT_SHEET_H
#define SKYVERT_CONTACT_SHEET_H

#include <stdint.h>

#include "picture.h"

/// Most pictures on a sheet; of a longer track evenly chosen ones.
#define CONTACT_TILES_MAX 240
/// Longer side of a small picture.
#define CONTACT_TILE_SIDE 160

typedef struct contact_sheet {
    size_t steps, tiles; ///< pictures of the track, and those shown
    size_t next;         ///< tiles filled
    int tile_width, tile_height, columns, width, height;
    uint8_t *rgb; ///< [height][width][3], sRGB
} contact_sheet;

/// @return false iff memory ran out
bool contact_sheet_begin(contact_sheet *sheet, const projection *map, size_t steps);
/// Adds picture number `step` if it is among those shown. The captions are two lines of at most 26 characters out of
/// digits, capital letters, space and :-+.
void contact_sheet_add(contact_sheet *sheet, size_t step, const picture *image, double exposure, const char *line1,
                       const char *line2);
void contact_sheet_end(contact_sheet *sheet);

#endif
