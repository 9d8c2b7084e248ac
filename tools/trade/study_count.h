/// Instructions of the ablation's skies, counted by callgrind: the program runs itself once more under valgrind.
#ifndef TOOLS_TRADE_STUDY_COUNT_H
#define TOOLS_TRADE_STUDY_COUNT_H

#include "studies.h"

enum { STUDY_COUNTS_MAX = 512, STUDY_LABEL = 64 };

typedef struct study_counts {
    int n;
    char label[STUDY_COUNTS_MAX][STUDY_LABEL];
    double instructions[STUDY_COUNTS_MAX];
} study_counts;

// --- within the run under valgrind ---

/// Instructions are looked at from here on; what lies outside runs at valgrind's full speed.
void study_count_on(void);
void study_count_off(void);
/// Between these two they are counted, as the label's.
void study_count_begin(void);
void study_count_end(const char *label);

// --- outside ---

/// Runs how->command under valgrind and gathers what it counts. Without a valgrind there are no counts.
/// @param expected  counts, for the progress.  @return DONE also without counts (a line on stderr says why); STOPPED.
int study_count_run(const trade_study *how, int expected, study_counts *counts);

/// -1: not counted.
double study_count_of(const study_counts *counts, const char *label);

#endif
