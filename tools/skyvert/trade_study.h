/// `skyvert trade --study NAME`: what terms are worth, how domes interpolate, how a day runs (tools/trade/studies.h).
#ifndef TOOLS_SKYVERT_TRADE_STUDY_H
#define TOOLS_SKYVERT_TRADE_STUDY_H

#include <stdbool.h>

typedef struct study_settings {
    const char *study; ///< ablation, dome or day
    const char *root;  ///< folder of the project
    const char *out;   ///< folder of the results, which is there
    bool quick;        ///< coarser
    bool instructions; ///< count them, where there is a valgrind
    bool only_count;   ///< this is the run under valgrind
} study_settings;

extern const char *const study_names[]; ///< NULL at the end

/// Writes OUT/NAME.txt and OUT/NAME.csv, of dome and day pictures too; the text goes to the standard output as well. A
/// study that is stopped keeps what it finished. @return the exit status
int run_study(const study_settings *settings);

#endif
