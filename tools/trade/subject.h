/// A configuration or a baseline at work on an air.
#ifndef TOOLS_TRADE_SUBJECT_H
#define TOOLS_TRADE_SUBJECT_H

#include "config.h"
#include "core.h"
#include "truth.h"

typedef struct trade_subject {
    const trade_config *config;
    const trade_core *core;
    skv_atmosphere air; ///< the truth's without the terms that are left out
    skv_model model;
    skv_table *table; ///< NULL: none
    float *grid;      ///< NULL: none
    size_t grid_bytes;
    skv_frame frame;
    void *state; ///< of a baseline
    size_t table_bytes, work_bytes;
    double build_s; ///< processor time of model and table
} trade_subject;

typedef struct trade_making {
    int threads;                                 ///< of a baseline's build
    const char *cache;                           ///< folder for tables that take minutes to build; NULL: none
    int (*progress)(void *context, double done); ///< NULL: not wanted. Not 0: stop
    void *context;
} trade_making;

enum { TRADE_OK, TRADE_STOPPED, TRADE_NO_MEMORY, TRADE_BEYOND, TRADE_CORE };

/// Builds model, tables and all that does not depend on observer and sun.
/// @param[out] why  of TRADE_BEYOND, constant text.
/// @return TRADE_OK; TRADE_STOPPED by progress; TRADE_NO_MEMORY; TRADE_BEYOND: a baseline cannot do this air;
///         TRADE_CORE: the core refuses (this build lacks something). Nothing is to be closed after an error.
int trade_subject_open(trade_subject *subject, const trade_config *config, const trade_truth *truth,
                       const trade_making *making, const char **why);
void trade_subject_close(trade_subject *subject);

/// Work of a frame: 1 iff it can do this scene (twilight may be beyond a baseline).
int trade_subject_frame(trade_subject *subject, const trade_scene *scene);
/// After trade_subject_frame(): n directions, 1/sr.
void trade_subject_radiance(const trade_subject *subject, size_t n, const float (*direction)[3],
                            float (*radiance)[TRADE_BANDS]);

/// Whether rays that end on the ground are answered with its light.
int trade_subject_sees_ground(const trade_config *config);

#endif
