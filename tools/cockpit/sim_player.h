/// A candump log on a bus, at its own pace. No frame is left out: where the bus cannot take it, all wait.
#ifndef SIM_PLAYER_H
#define SIM_PLAYER_H

#include "sim_bus.h"
#include "sim_replay.h"

typedef struct sim_player {
    const sim_options *options;
    const sim_recording *recording;
    sim_bus *bus;
    size_t next, first, end; ///< records [first, end)
    int64_t start_ns;        ///< when the log's first frame would have been due
    uint64_t heard;          ///< frames of ours, back from the bus, replies too
    uint64_t laps;
    int64_t done_ns; ///< when the last one was sent
    bool full;       ///< the last send met a full queue
} sim_player;

/// options, recording and bus are set, all else 0.
void sim_player_begin(void *player, int64_t now_ns);
/// What is due. @return when to call again; 0 = all is sent
int64_t sim_player_tick(void *player, int64_t now_ns);
void sim_player_heard(void *player, const skv_can_received *frame, int64_t mono_ns, int64_t now_ns);
void sim_player_show(const void *player, char *text, size_t size);

#endif
