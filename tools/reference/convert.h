/// Between the library's atmosphere (floats) and the reference's (doubles).
#ifndef TOOLS_REFERENCE_CONVERT_H
#define TOOLS_REFERENCE_CONVERT_H

#include "read_ini.h"
#include "skyvert/atmosphere.h"

/// Room for the tables of an atmosphere.
typedef struct ref_float_tables {
    float km[4][REF_TABLE_ROWS], density[4][REF_TABLE_ROWS];
} ref_float_tables;

/// What a file says as the library takes it: rounded to float. The atmosphere points into `tables`.
void ref_to_skyvert(const ref_atmosphere *from, skv_atmosphere *to, ref_float_tables *tables);

/// The very floats that the library was given, so that both see the same air. Turbidity and absorption colour are
/// multiplied into the coefficients and the irradiance. The atmosphere points into `to`.
void ref_from_skyvert(const skv_atmosphere *from, double ground_km, ref_file *to);

#endif
