/// The loop of a job on a bus: frames, changes of the interface, a timer, signals.
#ifndef SIM_RUN_H
#define SIM_RUN_H

#include "sim_bus.h"

/// What is done on the bus: a stream or a player.
typedef struct sim_task {
    void *self;
    void (*begin)(void *self, int64_t now_ns);
    int64_t (*tick)(void *self, int64_t now_ns); ///< when to call again; 0 = done
    void (*heard)(void *self, const skv_can_received *frame, int64_t mono_ns, int64_t now_ns);
    void (*show)(const void *self, char *text, size_t size);
} sim_task;

/// Until the task is done or a signal comes. @return 0; 1 after an error line
int sim_run(sim_bus *bus, const sim_task *task);

#endif
