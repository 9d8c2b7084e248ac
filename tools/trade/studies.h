/// The three studies of `skyvert trade --study NAME`: what each term is worth, how a dome interpolates, and how a day
/// runs.
///
/// Each prints text of at most 120 columns and a CSV with one header line, and takes some seconds to a minute (`quick`:
/// a second or two, coarser, for tests). A study that is stopped keeps the rows that it finished.
#ifndef TOOLS_TRADE_STUDIES_H
#define TOOLS_TRADE_STUDIES_H

#include <stdio.h>

#include "truth.h"

typedef struct trade_study_air {
    const char *name; ///< of its rows: "br16"
    const skv_atmosphere *atmosphere;
    const trade_scene *scene; ///< [TRADE_SCENES] of trade_truth; NULL: the finest settings stand in for the truth
} trade_study_air;

typedef struct trade_study {
    const trade_study_air *air; ///< [airs]
    int airs;                   ///< [1, 8]
    const char *spectra;        ///< folder of the measured spectra (tools/fit/spectra); NULL: no rows about bands
    int quick;
    /// Called often with what is done, 0 to 1. Another result than 0 stops the study. NULL: not wanted.
    int (*progress)(void *context, double done);
    void *context;
    /// Of the ablation, [.., NULL]: a program and its options that end in trade_ablation_count() on the same airs. It
    /// is run under valgrind, its dumps go to `folder`, which is made and removed. NULL: nothing is counted.
    char *const *command;
    const char *folder;
} trade_study;

enum { TRADE_STUDY_DONE = 0, TRADE_STUDY_STOPPED = 1, TRADE_STUDY_FAILED = 2 }; ///< FAILED: a line is on stderr

/// What leaving a term out does to the error of all light, scene by scene, and what it saves.
/// @return TRADE_STUDY_*
int trade_ablation(FILE *text, FILE *csv, const trade_study *how);

/// What the command of trade_study does: evaluates what is counted, between callgrind's marks. Some 20 s under it.
int trade_ablation_count(const trade_study *how);

/// Error of domes that are interpolated between their vertices, against the number of vertices.
int trade_dome(FILE *text, FILE *csv, const trade_study *how);

/// Error and steps over a whole day in steps of a minute. CSV rows `minute` and `day`.
int trade_day(FILE *text, FILE *csv, const trade_study *how);

/// A gnuplot program that draws "dome" or "day" in one air from its CSV. @param terminal "svg" or "pngcairo"
/// @return 0; 1: this study has no picture.
int trade_study_plot(FILE *program, const char *study, const char *air, const char *csv, const char *terminal,
                     const char *picture);

#endif
