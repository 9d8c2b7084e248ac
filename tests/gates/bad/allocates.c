// Must be refused: memory from the heap.
// Says: needs malloc
#include <stdlib.h>
float *sample(unsigned n);
float *sample(unsigned n) { return malloc(n * sizeof(float)); }
