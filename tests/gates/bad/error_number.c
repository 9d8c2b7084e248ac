// Must be refused: errno.
// Says: needs (__errno_location|__errno)
#include <errno.h>
int sample(void);
int sample(void) { return errno; }
