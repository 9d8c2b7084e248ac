/// Reads the ini form of an atmosphere for the reference, by itself.
#ifndef TOOLS_REFERENCE_READ_INI_H
#define TOOLS_REFERENCE_READ_INI_H

#include "single.h"

typedef struct ref_file {
    ref_atmosphere atmosphere;
    double table_km[4][REF_TABLE_ROWS], table_density[4][REF_TABLE_ROWS]; ///< the atmosphere points in here
} ref_file;

/// @return 0; else a line `file:line: what` was written to stderr.
int ref_read_ini(ref_file *file, const char *name);

#endif
