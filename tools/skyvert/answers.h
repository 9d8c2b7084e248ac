/// The answers of `skyvert eval`.
#ifndef SKYVERT_ANSWERS_H
#define SKYVERT_ANSWERS_H

#include "ini.h"
#include "queries.h"
#include "skyvert/table.h"

/// Computes all answers, then writes them to the standard output.
/// @param table  of the model; NULL: light scattered once only.
/// @return the exit status
int answers_write(const query_list *queries, const skv_model *model, const skv_table *table, const skv_quality *quality,
                  const atmosphere_file *file);

/// Sine and cosine of an angle in degrees: exact at multiples of 90 (view zenith 90 is a cosine of exactly 0).
void sin_cos_deg(double degrees, double *sine, double *cosine);

#endif
