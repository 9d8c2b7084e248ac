/// Instructions of the ablation's skies, by callgrind.
#ifndef TOOLS_TRADE_STUDY_COUNT_H
#define TOOLS_TRADE_STUDY_COUNT_H

#include "callgrind.h"
#include "studies.h"

enum { STUDY_COUNTS_MAX = 512, STUDY_LABEL = CALLGRIND_LABEL };

typedef struct study_counts {
    int n;
    char label[STUDY_COUNTS_MAX][STUDY_LABEL];
    double instructions[STUDY_COUNTS_MAX];
} study_counts;

/// Runs how->command under valgrind and gathers what it counts. Without a valgrind there are no counts.
/// @param expected  counts, for the progress.  @return DONE also without counts (a line on stderr says why); STOPPED.
int study_count_run(const trade_study *how, int expected, study_counts *counts);

/// -1: not counted.
double study_count_of(const study_counts *counts, const char *label);

#endif
