#include "core/table_fit.h"

#include "core/cells.h"

#if SKV_TERM_DIFFUSE

/// Where a function breaks off it is no smooth one: a mean moves by at most so much of its log2.
#define SKV_TABLE_FIT_MOST 0.2f

/// n values `step` apart; the ends stay.
///
/// Straight lines between exact values of a curved function lie all on one side of it, by up to D/8, D the second
/// difference. Moved by -D/12 they are the nearest in the mean square: the error is of both signs, and 2.4 times less.
/// (For ratios that gains nothing: their error is another one.)
static void skv_table_fit_line(float *v, size_t step, int n) {
    float before = v[0];
    for (int i = 1; i < n - 1; i++) {
        float *const at = v + (size_t)i * step;
        const float here = *at, move = (before - 2.0f * here + at[step]) * (-1.0f / 12.0f);
        *at = here + skv_clampf(move, -SKV_TABLE_FIT_MOST, SKV_TABLE_FIT_MOST);
        before = here;
    }
}

/// log2 of the ground's irradiance, then of the mean radiance of the rows (skv_cells_bytes()).
static float *skv_table_logs(skv_table *work) {
    return (float *)(void *)(work + 1);
}

void skv_table_fit_row(skv_table *work, int row) {
    const size_t bands = work->bands, line = work->suns * bands;
    for (size_t b = 0; b < bands; b++) {
        skv_table_fit_line(skv_table_logs(work) + (size_t)(row + 1) * line + b, bands, work->suns);
        if (row == 0)
            skv_table_fit_line(skv_table_logs(work) + b, bands, work->suns);
    }
}

void skv_table_fit_column(skv_table *work, int column) {
    const size_t bands = work->bands, line = work->suns * bands;
    for (size_t b = 0; b < bands; b++)
        skv_table_fit_line(skv_table_logs(work) + line + (size_t)column * bands + b, line, work->altitudes);
}

#endif
