// Shared by the sources of the kernel's bus.
#ifndef SKV_SOCKETCAN_PRIVATE_H
#define SKV_SOCKETCAN_PRIVATE_H

#include <linux/can.h>

#include "skv_can_bus.h"

// At most so many ids are sent cyclically by one handle.
#define SKV_SOCKETCAN_MAX_CYCLIC 64

// What is being sent.
typedef struct skv_socketcan_task {
    canid_t id;
    uint8_t length, first; // the counter's first value
    int8_t counter_byte;
} skv_socketcan_task;

typedef struct skv_socketcan {
    skv_can_bus bus; // first
    char name[16];
    int index;                    // of the interface
    int raw, cyclic, watch, link; // sockets, -1 = not open
    uint32_t overflow;            // the kernel's last count of drops
    skv_socketcan_task task[SKV_SOCKETCAN_MAX_CYCLIC];
    int tasks;
} skv_socketcan;

// The status of an errno, kept in bus.last_errno.
skv_can_status skv_socketcan_failed(skv_socketcan *s, int error);
void skv_socketcan_to_kernel(struct can_frame *to, const skv_can_frame *from);
void skv_socketcan_from_kernel(skv_can_frame *to, const struct can_frame *from);

// cyclic.c
skv_can_status skv_socketcan_cyclic_start(skv_can_bus *bus, const skv_can_cyclic *cyclic);
skv_can_status skv_socketcan_cyclic_update(skv_can_bus *bus, const skv_can_frame *frame);
skv_can_status skv_socketcan_cyclic_stop(skv_can_bus *bus, uint32_t id, uint8_t flags);
skv_can_status skv_socketcan_watch(skv_can_bus *bus, uint32_t id, uint32_t timeout_ms);
int skv_socketcan_timeouts(skv_can_bus *bus, uint32_t *ids, int n);
int skv_socketcan_timeout_fd(const skv_can_bus *bus);

// link.c
int skv_socketcan_link_open(void);
skv_can_status skv_socketcan_state(skv_can_bus *bus, skv_can_state *state);
skv_can_status skv_socketcan_restart(skv_can_bus *bus);
int skv_socketcan_event_fd(const skv_can_bus *bus);
int skv_socketcan_events(skv_can_bus *bus);

#endif
