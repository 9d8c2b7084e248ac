/// Instructions of rows, counted by callgrind: the program runs itself once more under valgrind.
#ifndef TOOLS_TRADE_COUNT_H
#define TOOLS_TRADE_COUNT_H

#include "measure.h"

/// 1 iff this program was built with valgrind's header and valgrind can be found.
int trade_count_possible(void);

/// Within the run under valgrind: counts the rows named, e.g. "3,17s", dump by dump; s: in the first scene only.
/// @return 0, or 1 after a line on stderr.
int trade_count_rows(trade_rows *rows, const char *numbers, const trade_making *making);

typedef struct trade_counting {
    char *const *command; ///< [..., NULL] program and options that call trade_count_rows(), the numbers its last
    const char *folder;   ///< for the dumps; made and removed
    int (*progress)(void *context, double done);
    void *context;
} trade_counting;

/// Counts the rows that lack counts, as far as it gets.
/// @return 0; TRADE_STOPPED by progress (what was counted is in the rows); -1 after a line on stderr: not counted.
int trade_count(trade_rows *rows, const trade_counting *how);

#endif
