// Must be refused: a function of libm.
// Says: needs expf
#include <math.h>
float sample(float x);
float sample(float x) { return expf(x); }
