#include "metric.h"

#include <math.h>
#include <stdlib.h>

static double largest(const double truth[TRADE_BANDS], int bands) {
    double most = 0;
    for (int b = 0; b < bands; b++)
        most = fmax(most, truth[b]);
    return most;
}

static int ascending(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

void trade_measure(size_t n, int bands, const float (*got)[TRADE_BANDS], const double (*truth)[TRADE_BANDS],
                   double *scratch, trade_error *error) {
    double mean = 0, sum = 0;
    for (size_t i = 0; i < n; i++)
        mean += largest(truth[i], bands) / (double)n;
    *error = (trade_error){.max = -1};
    for (size_t i = 0; i < n; i++) {
        double off = 0;
        for (int b = 0; b < bands; b++)
            off = fmax(off, fabs((double)got[i][b] - truth[i][b]));
        const double floor = fmax(largest(truth[i], bands), 0.05 * mean);
        scratch[i] = off == 0 ? 0 : off / floor;
        if (scratch[i] > error->max)
            error->max = scratch[i], error->worst = i;
        sum += scratch[i];
    }
    qsort(scratch, n, sizeof *scratch, ascending);
    error->mean = sum / (double)n;
    error->p95 = scratch[(size_t)(0.95 * (double)n)];
}
