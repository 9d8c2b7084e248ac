// CAN_BCM: the kernel's own clockwork for frames that are sent, or awaited, again and again.
#include <errno.h>
#include <linux/can/bcm.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

#include "private.h"

#define RING 256 // frames of a counter: all values of a byte

typedef struct bcm_msg_head message; // frames follow it

#define BYTES(frames) (sizeof(message) + (frames) * sizeof(struct can_frame))

// Room for a message with one frame.
typedef union small {
    uint64_t aligned;
    char bytes[BYTES(1)];
} small;

// A socket of the broadcast manager, opened when first needed.
static skv_can_status bcm_open(skv_socketcan *s, int *fd) {
    if (*fd >= 0)
        return SKV_CAN_OK;
    struct sockaddr_can address = {.can_family = AF_CAN, .can_ifindex = s->index};
    const int opened = socket(PF_CAN, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_BCM);
    if (opened < 0)
        return skv_socketcan_failed(s, errno);
    if (connect(opened, (struct sockaddr *)&address, sizeof address)) {
        const int error = errno;
        close(opened);
        return skv_socketcan_failed(s, error);
    }
    *fd = opened;
    return SKV_CAN_OK;
}

static skv_can_status bcm_write(skv_socketcan *s, int fd, const message *m) {
    const size_t size = BYTES(m->nframes);
    // A socket that learned of an interface going down says so once, then works again.
    for (int tries = 0; tries < 2; tries++) {
        if (send(fd, m, size, MSG_DONTWAIT) == (ssize_t)size)
            return SKV_CAN_OK;
        if (errno != ENETDOWN)
            break;
    }
    return skv_socketcan_failed(s, errno);
}

static canid_t kernel_id(uint32_t id, uint8_t flags) {
    return id | (flags & SKV_CAN_EXTENDED ? CAN_EFF_FLAG : 0);
}

static skv_socketcan_task *find_task(skv_socketcan *s, canid_t id) {
    for (int i = 0; i < s->tasks; i++)
        if (s->task[i].id == id)
            return &s->task[i];
    return NULL;
}

// The message that sets up a task: one frame, or a ring whose counter byte runs once around from its first value. To be
// freed; NULL iff there is no memory.
static message *message_of(const skv_socketcan_task *task, const skv_can_frame *frame) {
    const unsigned n = task->counter_byte < 0 ? 1 : RING;
    message *m = calloc(1, BYTES(n));
    if (!m)
        return NULL;
    m->can_id = task->id;
    m->opcode = TX_SETUP;
    m->nframes = n;
    for (unsigned i = 0; i < n; i++) {
        skv_socketcan_to_kernel(&m->frames[i], frame);
        if (task->counter_byte >= 0)
            m->frames[i].data[task->counter_byte] = (uint8_t)(task->first + i);
    }
    return m;
}

static struct bcm_timeval interval(uint32_t us) {
    return (struct bcm_timeval){.tv_sec = (long)(us / 1000000u), .tv_usec = (long)(us % 1000000u)};
}

skv_can_status skv_socketcan_cyclic_start(skv_can_bus *bus, const skv_can_cyclic *cyclic) {
    skv_socketcan *s = (skv_socketcan *)(void *)bus;
    const canid_t id = kernel_id(cyclic->frame.id, cyclic->frame.flags);
    skv_can_status status = bcm_open(s, &s->cyclic);
    if (status != SKV_CAN_OK)
        return status;
    (void)skv_socketcan_cyclic_stop(bus, cyclic->frame.id, cyclic->frame.flags);
    if (s->tasks == SKV_SOCKETCAN_MAX_CYCLIC)
        return SKV_CAN_BAD_ARGUMENT;
    const int8_t counter = cyclic->counter_byte;
    const skv_socketcan_task task = {.id = id,
                                     .length = cyclic->frame.length,
                                     .first = counter < 0 ? 0 : cyclic->frame.data[counter],
                                     .counter_byte = counter};
    message *m = message_of(&task, &cyclic->frame);
    if (!m)
        return SKV_CAN_NO_MEMORY;
    m->flags = SETTIMER | STARTTIMER; // the first frame goes out at once
    m->ival2 = interval(cyclic->period_us);
    status = bcm_write(s, s->cyclic, m);
    free(m);
    if (status == SKV_CAN_OK)
        s->task[s->tasks++] = task;
    return status;
}

// Without SETTIMER and STARTTIMER, and with as many frames as before, the kernel changes the contents and nothing else.
skv_can_status skv_socketcan_cyclic_update(skv_can_bus *bus, const skv_can_frame *frame) {
    skv_socketcan *s = (skv_socketcan *)(void *)bus;
    const skv_socketcan_task *task = find_task(s, kernel_id(frame->id, frame->flags));
    if (!task || task->length != frame->length)
        return SKV_CAN_BAD_ARGUMENT;
    message *m = message_of(task, frame);
    if (!m)
        return SKV_CAN_NO_MEMORY;
    const skv_can_status status = bcm_write(s, s->cyclic, m);
    free(m);
    return status;
}

skv_can_status skv_socketcan_cyclic_stop(skv_can_bus *bus, uint32_t id, uint8_t flags) {
    skv_socketcan *s = (skv_socketcan *)(void *)bus;
    skv_socketcan_task *task = find_task(s, kernel_id(id, flags));
    if (!task)
        return SKV_CAN_BAD_ARGUMENT;
    const message head = {.opcode = TX_DELETE, .can_id = task->id};
    *task = s->task[--s->tasks];
    return bcm_write(s, s->cyclic, &head);
}

// One frame with an empty mask: contents never count as a change, so the kernel speaks up at a timeout, and when the id
// comes back.
skv_can_status skv_socketcan_watch(skv_can_bus *bus, uint32_t id, uint32_t timeout_ms) {
    skv_socketcan *s = (skv_socketcan *)(void *)bus;
    const skv_can_status status = bcm_open(s, &s->watch);
    if (status != SKV_CAN_OK)
        return status;
    small room;
    memset(&room, 0, sizeof room);
    message *m = (message *)(void *)room.bytes;
    m->opcode = RX_SETUP;
    m->flags = SETTIMER | STARTTIMER | RX_ANNOUNCE_RESUME;
    m->can_id = id;
    m->nframes = 1;
    m->ival1 =
        (struct bcm_timeval){.tv_sec = (long)(timeout_ms / 1000u), .tv_usec = (long)(timeout_ms % 1000u * 1000u)};
    return bcm_write(s, s->watch, m);
}

int skv_socketcan_timeouts(skv_can_bus *bus, uint32_t *ids, int n) {
    skv_socketcan *s = (skv_socketcan *)(void *)bus;
    int found = 0;
    while (s->watch >= 0 && found < n) {
        small room;
        const message *m = (const message *)(const void *)room.bytes;
        const ssize_t size = recv(s->watch, room.bytes, sizeof room.bytes, MSG_DONTWAIT);
        if (size < 0)
            return found || errno == EAGAIN || errno == EINTR ? found : (int)skv_socketcan_failed(s, errno);
        if (size >= (ssize_t)sizeof *m && m->opcode == RX_TIMEOUT)
            ids[found++] = m->can_id & CAN_SFF_MASK;
    }
    return found;
}

int skv_socketcan_timeout_fd(const skv_can_bus *bus) {
    return ((const skv_socketcan *)(const void *)bus)->watch;
}
