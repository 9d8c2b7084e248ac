#include "study_count.h"

#include <string.h>

static void take(void *taker, const char *label, double instructions) {
    study_counts *const counts = taker;
    if (counts->n == STUDY_COUNTS_MAX)
        return;
    snprintf(counts->label[counts->n], STUDY_LABEL, "%s", label);
    counts->instructions[counts->n++] = instructions;
}

int study_count_run(const trade_study *how, int expected, study_counts *counts) {
    counts->n = 0;
    if (how->command == NULL)
        return TRADE_STUDY_DONE;
    if (!callgrind_built()) {
        fprintf(stderr, "trade: built without valgrind's header: instructions are not counted\n");
        return TRADE_STUDY_DONE;
    }
    const callgrind_run run = {.command = how->command,
                               .folder = how->folder,
                               .expected = expected,
                               .take = take,
                               .taker = counts,
                               .progress = how->progress,
                               .context = how->context};
    const int status = callgrind_count(&run);
    if (status == CALLGRIND_FAILED) {
        counts->n = 0;
        fprintf(stderr,
                "trade: valgrind is missing or failed (its log, if it ran: %s/log): instructions are not counted\n",
                how->folder);
    }
    return status == CALLGRIND_STOPPED ? TRADE_STUDY_STOPPED : TRADE_STUDY_DONE;
}

double study_count_of(const study_counts *counts, const char *label) {
    for (int i = 0; i < counts->n; i++)
        if (strcmp(counts->label[i], label) == 0)
            return counts->instructions[i];
    return -1;
}
