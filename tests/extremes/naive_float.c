#define REAL  float
#define SQRT  sqrtf
#define EXP   expf
#define POW   powf
#define NAIVE naive_float
#include "naive_model.h"
