/// A candump log in memory.
#ifndef SIM_REPLAY_H
#define SIM_REPLAY_H

#include "sim.h"

typedef struct sim_record {
    int64_t after_ns; ///< after the first frame; never falls
    skv_can_frame frame;
} sim_record;

typedef struct sim_recording {
    sim_record *records;
    size_t count, capacity;
    int64_t first_ns;        ///< time of the first frame in the log
    uint64_t skipped;        ///< CAN FD frames and error frames, which cannot be sent
    uint64_t backwards;      ///< frames before the one before them: their time is its
    bool gap;                ///< more than an hour without a frame: said once
    double most_bits_second; ///< within any second, stuff bits at their worst
} sim_recording;

/// @return 0; 2 after an error line `file:line: column: what`; 1 iff memory ran out. On error nothing has to be freed.
int sim_recording_read(sim_recording *r, const char *path);
void sim_recording_free(sim_recording *r);

/// The same frames as a log, at their own times. @return the exit status
int sim_log_recording(const sim_options *options, const sim_recording *r);

#endif
