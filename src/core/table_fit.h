/// Of a finished work table: means moved so that straight lines between them fit best.
#ifndef SKV_CORE_TABLE_FIT_H
#define SKV_CORE_TABLE_FIT_H

#include "skyvert/table.h"

/// Along a row, and the ground's irradiance with row 0; along a column, once all rows are done, where the air has no
/// layers.
void skv_table_fit_row(skv_table *work, int row);
void skv_table_fit_column(skv_table *work, int column);

#endif
