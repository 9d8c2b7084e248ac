/// Density tables named by an atmosphere file.
#ifndef SKYVERT_TABLE_FILE_H
#define SKYVERT_TABLE_FILE_H

#include <stdint.h>

typedef struct density_table {
    float *altitude_km, *density; ///< [rows], owned
    uint32_t rows;
} density_table;

/// Reads two columns altitude_km,relative_density; the header line may be left out (then in this order), lines that
/// start with # or ; are comments.
/// @return 0; 2 after one error line `file:line: ...`; 1 iff memory ran out. On error nothing has to be freed.
int table_read(density_table *table, const char *path);
void table_free(density_table *table);

#endif
