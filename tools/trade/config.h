/// The configurations that are compared: rule, samples, depth backend, tier, terms, table, grid, degree of the
/// exponential; and the baselines.
#ifndef TOOLS_TRADE_CONFIG_H
#define TOOLS_TRADE_CONFIG_H

#include <stddef.h>

#include "skyvert/table.h"
#include "tools/baselines/baseline.h"

/// What of the air is kept; the truth always has all of it.
enum { TRADE_ALL_TERMS, TRADE_NO_OZONE, TRADE_GAS_ONLY, TRADE_TERM_SETS };
/// Name of the atmosphere file that leaves the terms out: AIR + this + ".ini".
extern const char *const trade_terms_suffix[TRADE_TERM_SETS];

/// Degree of the polynomial of 2^x in the core's inner loops when nothing is said.
#define TRADE_EXP_DEGREE 4

typedef struct trade_config {
    char name[48];                 ///< of its rows; unique within `light`
    const baseline *baseline;      ///< NULL: ours
    int light;                     ///< the truth that it is measured against: TRADE_SINGLE, TRADE_FULL
    int quick;                     ///< 1: also in the small subset
    int terms;                     ///< TRADE_ALL_TERMS ...
    skv_quality quality;           ///< ours; with the light of the ground
    int table;                     ///< ours: skv_table_kind, -1 none: light scattered once
    int altitudes, detailed, suns; ///< of the table; 0: the kind's
    int format;                    ///< skv_table_format
    int grid;                      ///< 1: through a grid, where there can be one
    int exp_degree;
    char eval[160]; ///< options of `skyvert eval` that give the same answers, without --atmosphere
} trade_config;

/// All configurations, or the quick ones. @return their number; *list is to be freed; 0 out of memory.
size_t trade_configs(trade_config **list, int quick);

/// What decides about a configuration's results, in one line: for digests. @return text
char *trade_config_text(const trade_config *config, char text[400]);

#endif
