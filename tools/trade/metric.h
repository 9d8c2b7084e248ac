/// How errors are measured, in one sentence: the error of a ray is the largest absolute error of a band over the
/// largest band of the truth, which counts as at least 5 % of the mean (of the largest bands) of its scene.
#ifndef TOOLS_TRADE_METRIC_H
#define TOOLS_TRADE_METRIC_H

#include <stddef.h>

#define TRADE_BANDS 4

typedef struct trade_error {
    double mean, p95, max; ///< 1 = 100 %
    size_t worst;          ///< index of the ray with the largest
} trade_error;

/// @param[in] got, truth  [n][TRADE_BANDS], the first `bands` count; n >= 1.
/// @param[in] scratch     [n], overwritten.
void trade_measure(size_t n, int bands, const float (*got)[TRADE_BANDS], const double (*truth)[TRADE_BANDS],
                   double *scratch, trade_error *error);

#endif
