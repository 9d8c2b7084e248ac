/// Light scattered more than once: the table of a model, for eval, render, track and dome.
#ifndef SKYVERT_ALL_ORDERS_H
#define SKYVERT_ALL_ORDERS_H

#include <stdbool.h>

#include "skyvert/skyvert.h"

extern const char *const order_names[]; ///< for option_choice(): single, all
extern const char *const table_names[]; ///< accurate, small, large: as skv_table_kind

/// A table that was built. Zero it before the first use; then sizes and floats may be set.
typedef struct all_orders {
    int sizes[3];     ///< altitudes, detailed ones and suns of the table, ranges in skyvert/table.h; 0: the kind's
    bool floats;      ///< whether its numbers are floats and not packed
    skv_table *table; ///< NULL: none yet
    float ground_km;
    double build_s; ///< processor time of all builds so far
} all_orders;

/// The table of `model`; the one that is there stays where it fits.
/// @param progress  whether to show a bar where it takes long.
/// @return 0, or a status after an error line.
int all_orders_build(all_orders *out, const char *command, const skv_model *model, skv_table_kind kind, float ground_km,
                     bool progress);
void all_orders_free(all_orders *out);

/// Processor time of this program, seconds: other programs on the machine do not count.
double processor_s(void);

#endif
