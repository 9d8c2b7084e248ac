/// One cockpit: everything it has, and its loop.
#ifndef COCKPIT_LOOP_H
#define COCKPIT_LOOP_H

#include <sys/types.h>

#include "cockpit_bus.h"
#include "cockpit_panel.h"
#include "cockpit_share.h"
#include "cockpit_sky.h"
#include "cockpit_stats.h"
#include "cockpit_view.h"

typedef struct cockpit {
    cockpit_options options;
    cockpit_state state;
    cockpit_now now;
    cockpit_bus bus;
    cockpit_sky sky;
    cockpit_share share;
    cockpit_panel panel;
    cockpit_stats stats;
    skv_cas_sender speaker;
    skv_can_frame reply;      ///< to an identification request, that the bus has not taken yet
    int64_t reply_until_ns;   ///< and how long it is wanted, 0: there is none
    int poll, timer, signals; ///< descriptors, -1: none
    int64_t tick, shown_ns, second_ns, level_ns;
    int64_t calm_ns; ///< so long it must be cheap before a dearer way is tried again
    bool tried;      ///< the last change of it was to a dearer way
    bool running, quit, seen;
    pid_t snapshot; ///< the process that makes one, 0: none
    int status;
    uint32_t flags;
    char *text; ///< [COCKPIT_TEXT]
} cockpit;

/// Opens everything. @return 0, or the exit status after an error line; close it in any case.
int cockpit_open(cockpit *c);
/// Runs until it is told to end. @return the exit status
int cockpit_run(cockpit *c);
void cockpit_close(cockpit *c);

/// One frame of the sky from what has come; and what becomes of it. For the loop, and for tests.
void cockpit_frame(cockpit *c);
/// Takes what the bus has.
void cockpit_receive(cockpit *c);

/// Figures of the run: lines `name value unit`. @return 0, or a status after an error line
int cockpit_stats_write(const cockpit *c, const char *path);

#endif
