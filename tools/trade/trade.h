/// The trade: error against the reference and cost of every configuration, kept row by row.
///
/// Cost of a vertex is that of a vertex in a dome of 2048 (TRADE_DOME_VERTICES): a frame's work before its first vertex
/// (grid, sky texture) is spread over them.
#ifndef TOOLS_TRADE_TRADE_H
#define TOOLS_TRADE_TRADE_H

#include <stdio.h>

#include "count.h"

typedef struct trade_options {
    const char *root;  ///< the project's folder
    const char *out;   ///< folder of the results; there already
    const char *cache; ///< for baselines' tables that take minutes
    int quick;
    int threads;          ///< of baselines' builds
    char *const *command; ///< [..., NULL] this program and options that call trade_count_only(), numbers last; NULL: no
                          ///< counting
    /// What is being done and how much of it, 0 to 1. Not 0: stop. NULL: not wanted.
    int (*progress)(void *context, const char *what, double done);
    void *context;
} trade_options;

typedef struct trade {
    trade_options options;
    trade_config *configs;
    size_t n_configs, n_truths;
    trade_truth *truths;
    trade_rows rows;
    int counted;     ///< 1: there are instruction counts
    int repeats;     ///< rounds of timing
    size_t kept;     ///< rows that an earlier run had finished
    double checksum; ///< of all radiances that were timed in this run
    const char *step;
} trade;

/// Reads the truth and what an earlier run left.
/// @return 0; 1 or 2 (bad files) after a line on stderr. trade_end() in any case.
int trade_begin(trade *t, const trade_options *options);
/// Measures all that is missing. @return 0; TRADE_STOPPED; -1 after a line on stderr.
int trade_run(trade *t);
/// The run under valgrind: counts rows "1,5,7". @return exit status
int trade_count_only(trade *t, const char *numbers);
void trade_end(trade *t);

/// The whole cost of a vertex in a scene: instructions where they are counted, else ns; negative where not measured.
double trade_cost_ns(const trade_row *row, int scene);
double trade_cost_instructions(const trade_row *row, int scene);

/// Error and cost over the three heights and both airs: means of the scenes' means, the largest of the largest. Sees
/// rows of other airs beside `row`.
typedef struct trade_pooled {
    double mean, p95, max, ns, ns_low, ns_high, instructions;
    int scenes; ///< pooled; 0: the configuration cannot do any of them
    const trade_row *worst;
    int worst_scene;
} trade_pooled;

/// @param config  index; @param sun, height, air  -1: all.
trade_pooled trade_pool(const trade *t, size_t config, int sun, int height, int air);

/// What the frontier is drawn with: instructions where all was counted, else ns.
double trade_pooled_cost(const trade *t, const trade_pooled *p);

/// Marks the configurations of a light that no other beats in both cost and mean error.
/// @param[in,out] on_frontier  [t->n_configs].
void trade_frontier(const trade *t, int light, int sun, int height, int *on_frontier);

// --- reports ---

/// The metric in one sentence.
extern const char trade_metric_sentence[];

void trade_report_text(FILE *out, const trade *t);
/// A line about processor, compiler and flags.
void trade_report_machine(FILE *out);
/// Every number, a line per configuration, air and scene.
void trade_report_csv(FILE *out, const trade *t);
/// Pooled costs and errors with the frontier, a line per configuration, light, sun and height ("all" too).
void trade_report_frontier(FILE *out, const trade *t);
/// What the papers claim beside what was measured here.
void trade_report_claims(FILE *out, const trade *t);
/// Worst inputs of the rows: a line each, for `skyvert eval`.
void trade_report_worst(FILE *out, const trade *t);
/// Atmosphere files of rows that leave terms out, into the folder of results. @return 0; 1 after a line on stderr
int trade_write_airs(const trade *t);
/// A gnuplot program of one picture. @param light  -1: both, heights pooled; else that light, height by height.
void trade_plot(FILE *out, const trade *t, int light, const char *terminal, const char *picture);

#endif
