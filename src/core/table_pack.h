/// From the float table that a build works on to the table that frames read.
#ifndef SKV_CORE_TABLE_PACK_H
#define SKV_CORE_TABLE_PACK_H

#include "skyvert/table.h"

/// Packs one row; row 0 also writes the header and the ground's irradiance.
/// @param largest  of each ratio over all cells, absolute.
void skv_table_pack_row(const skv_table *work, skv_table *table, int row, const float largest[SKV_TABLE_TERMS - 1],
                        int format);

/// Writes the checksum.
void skv_table_seal(skv_table *table);

#endif
