#define REAL  double
#define SQRT  sqrt
#define EXP   exp
#define POW   pow
#define NAIVE naive_double
#include "naive_model.h"
