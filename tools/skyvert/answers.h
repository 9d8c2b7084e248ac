/// The answers of `skyvert eval`.
#ifndef SKYVERT_ANSWERS_H
#define SKYVERT_ANSWERS_H

#include <stdbool.h>

#include "ini.h"
#include "queries.h"
#include "skyvert/table.h"
#include "tools/baselines/baseline.h"

/// Who answers.
typedef struct answers_source {
    const skv_model *model;
    const skv_quality *quality;
    const skv_table *table; ///< of the model; NULL: light scattered once only
    bool grid;              ///< the table's light through a grid, where there can be one
    const baseline *other;  ///< a published model instead of the core; NULL: the core
    void *other_state;      ///< built
} answers_source;

/// Computes all answers, then writes them to the standard output.
/// @return the exit status
int answers_write(const query_list *queries, const answers_source *source, const atmosphere_file *file);

/// Sine and cosine of an angle in degrees: exact at multiples of 90 (view zenith 90 is a cosine of exactly 0).
void sin_cos_deg(double degrees, double *sine, double *cosine);

#endif
