/// Processor time: other programs on the machine do not count.
#ifndef TOOLS_TRADE_CLOCK_H
#define TOOLS_TRADE_CLOCK_H

#include <time.h>

/// Of this process, all threads, s.
static inline double trade_processor_s(void) {
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/// Of this thread, ns.
static inline double trade_thread_ns(void) {
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return 1e9 * (double)t.tv_sec + (double)t.tv_nsec;
}

#endif
