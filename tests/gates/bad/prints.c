// Must be refused: output.
// Says: needs (printf|iprintf)
#include <stdio.h>
void sample(int n);
void sample(int n) { printf("%d\n", n); }
