/// Marks the instructions to count: callgrind on the host, the QEMU plugin of port/cortexm on a board.
#ifndef TESTS_GATES_WINDOW_H
#define TESTS_GATES_WINDOW_H

#if defined(__x86_64__)
#include <valgrind/callgrind.h>
#define WINDOW_BEGIN()   CALLGRIND_ZERO_STATS
#define WINDOW_END(name) CALLGRIND_DUMP_STATS_AT(name)
#else
/// The plugin counts from the first instruction of the one to the first of the other.
void window_begin(void);
void window_end(void);
#define WINDOW_BEGIN()   window_begin()
#define WINDOW_END(name) window_end()
#endif

#endif
