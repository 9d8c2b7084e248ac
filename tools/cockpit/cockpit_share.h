/// The shared memory of vertices.h, from the writer's side.
#ifndef COCKPIT_SHARE_H
#define COCKPIT_SHARE_H

#include "cockpit_sky.h"

typedef struct cockpit_share {
    char name[64]; ///< with its slash
    unsigned char *map;
    size_t bytes;
    uint32_t next, frame;
} cockpit_share;

/// Makes the memory `name` ("skyvert" or "/skyvert").
/// @return 0; 2 after an error line iff the name cannot be one; 1 iff another writer that lives has it, or the system
///         refuses.
int cockpit_share_open(cockpit_share *share, const char *name, const cockpit_sky *sky);

/// Publishes sky->vertex with a moment. @return its frame number
uint32_t cockpit_share_publish(cockpit_share *share, const cockpit_sky *sky, const skv_vertices_moment *moment);

/// A sign of life.
void cockpit_share_beat(cockpit_share *share);

/// Says that the writer is gone, and removes the name. Does nothing where it was not opened.
void cockpit_share_close(cockpit_share *share);

#endif
