/// Constants of the logistic of [Linan23], Eq. 5.7: radiance level/(1 + offset exp(-slope mu_s)) for a unit sun, 1/sr.
/// Made by tools/fit/linan23.py from tools/fit/linan23_truth.csv (our path tracer, clear Earth); do not edit.
/// What the fit leaves of all light in a band: 6.3 % (root mean square).
#ifndef TOOLS_BASELINES_LINAN23_FIT_H
#define TOOLS_BASELINES_LINAN23_FIT_H

#define LINAN23_FIT_BANDS  4
#define LINAN23_FIT_OFFSET 7.157
#define LINAN23_FIT_SLOPE  29.62
static const double linan23_fit_nm[LINAN23_FIT_BANDS] = {440, 520, 600, 680};
static const double linan23_fit_level[LINAN23_FIT_BANDS] = {0.02218, 0.01733, 0.0114, 0.01207};

#endif
