// The small interface: hands every call to the implementation behind it.
#include "skv_can_bus.h"

#include <linux/can/error.h>

int skv_can_fd(const skv_can_bus *bus) {
    return bus ? bus->ops->fd(bus) : -1;
}

int skv_can_receive(skv_can_bus *bus, skv_can_received *frames, int n) {
    if (!bus || !frames || n < 1)
        return SKV_CAN_BAD_ARGUMENT;
    const int got = bus->ops->receive(bus, frames, n);
    for (int i = 0; i < got; i++) {
        bus->counts.received++;
        bus->counts.error_frames += (frames[i].frame.flags & SKV_CAN_ERROR) != 0;
    }
    bus->counts.down += got == SKV_CAN_DOWN;
    return got;
}

// A frame that may be sent.
static int sendable(const skv_can_frame *frame) {
    return frame && frame->length <= 8 && !(frame->flags & ~(SKV_CAN_EXTENDED | SKV_CAN_RTR)) &&
           frame->id <= (frame->flags & SKV_CAN_EXTENDED ? 0x1FFFFFFFu : 0x7FFu);
}

skv_can_status skv_can_send(skv_can_bus *bus, const skv_can_frame *frame) {
    if (!bus || !sendable(frame))
        return SKV_CAN_BAD_ARGUMENT;
    const skv_can_status status = bus->ops->send(bus, frame);
    bus->counts.sent += status == SKV_CAN_OK;
    bus->counts.queue_full += status == SKV_CAN_QUEUE_FULL;
    bus->counts.again += status == SKV_CAN_AGAIN;
    bus->counts.down += status == SKV_CAN_DOWN;
    return status;
}

skv_can_status skv_can_cyclic_start(skv_can_bus *bus, const skv_can_cyclic *cyclic) {
    if (!bus || !cyclic || !sendable(&cyclic->frame) || cyclic->frame.flags & SKV_CAN_RTR || cyclic->period_us < 1000 ||
        cyclic->period_us > 3600000000u || cyclic->counter_byte < -1 || cyclic->counter_byte >= cyclic->frame.length)
        return SKV_CAN_BAD_ARGUMENT;
    return bus->ops->cyclic_start(bus, cyclic);
}

skv_can_status skv_can_cyclic_update(skv_can_bus *bus, const skv_can_frame *frame) {
    return bus && sendable(frame) ? bus->ops->cyclic_update(bus, frame) : SKV_CAN_BAD_ARGUMENT;
}

skv_can_status skv_can_cyclic_stop(skv_can_bus *bus, uint32_t id, uint8_t flags) {
    return bus ? bus->ops->cyclic_stop(bus, id, flags) : SKV_CAN_BAD_ARGUMENT;
}

skv_can_status skv_can_get_state(skv_can_bus *bus, skv_can_state *state) {
    return bus && state ? bus->ops->state(bus, state) : SKV_CAN_BAD_ARGUMENT;
}

skv_can_status skv_can_restart(skv_can_bus *bus) {
    return bus ? bus->ops->restart(bus) : SKV_CAN_BAD_ARGUMENT;
}

skv_can_status skv_can_watch(skv_can_bus *bus, uint32_t id, uint32_t timeout_ms) {
    return bus && id <= 0x7FFu && timeout_ms ? bus->ops->watch(bus, id, timeout_ms) : SKV_CAN_BAD_ARGUMENT;
}

int skv_can_timeouts(skv_can_bus *bus, uint32_t *ids, int n) {
    return bus && ids && n > 0 ? bus->ops->timeouts(bus, ids, n) : SKV_CAN_BAD_ARGUMENT;
}

int skv_can_timeout_fd(const skv_can_bus *bus) {
    return bus ? bus->ops->timeout_fd(bus) : -1;
}

int skv_can_event_fd(const skv_can_bus *bus) {
    return bus ? bus->ops->event_fd(bus) : -1;
}

int skv_can_events(skv_can_bus *bus) {
    return bus ? bus->ops->events(bus) : SKV_CAN_BAD_ARGUMENT;
}

skv_can_counts skv_can_get_counts(const skv_can_bus *bus) {
    return bus ? bus->counts : (skv_can_counts){0};
}

int skv_can_errno(const skv_can_bus *bus) {
    return bus ? bus->last_errno : 0;
}

void skv_can_close(skv_can_bus *bus) {
    if (bus)
        bus->ops->close(bus);
}

const char *skv_can_status_text(skv_can_status status) {
    static const char *const text[] = {
        "all well",
        "the interface's queue is full (ENOBUFS)",
        "the socket's buffer is full (EAGAIN)",
        "the interface is down",
        "the interface was removed",
        "this kernel has no CAN (AF_CAN): load the modules can, can-raw and can-bcm, or use another kernel",
        "there is no CAN interface of that name",
        "not permitted",
        "an argument is out of range",
        "no memory",
        "a system call failed",
    };
    return status <= 0 && status >= SKV_CAN_SYSTEM ? text[-(int)status] : "?";
}

static unsigned controller_says(uint8_t what) {
    unsigned says = 0;
    if (what & (CAN_ERR_CRTL_RX_OVERFLOW | CAN_ERR_CRTL_TX_OVERFLOW))
        says |= SKV_CAN_SAYS_OVERFLOW;
    if (what & (CAN_ERR_CRTL_RX_WARNING | CAN_ERR_CRTL_TX_WARNING))
        says |= SKV_CAN_SAYS_WARNING;
    if (what & (CAN_ERR_CRTL_RX_PASSIVE | CAN_ERR_CRTL_TX_PASSIVE))
        says |= SKV_CAN_SAYS_PASSIVE;
    if (what & CAN_ERR_CRTL_ACTIVE)
        says |= SKV_CAN_SAYS_ACTIVE;
    return says;
}

unsigned skv_can_error_says(const skv_can_frame *frame) {
    static const struct {
        uint32_t bits;
        unsigned says;
    } classes[] = {
        {CAN_ERR_BUSOFF, SKV_CAN_SAYS_BUS_OFF},      {CAN_ERR_RESTARTED, SKV_CAN_SAYS_RESTARTED},
        {CAN_ERR_ACK, SKV_CAN_SAYS_NO_ACK},          {CAN_ERR_PROT | CAN_ERR_BUSERROR, SKV_CAN_SAYS_BUS_ERROR},
        {CAN_ERR_LOSTARB, SKV_CAN_SAYS_ARBITRATION}, {CAN_ERR_TX_TIMEOUT, SKV_CAN_SAYS_TX_TIMEOUT},
    };
    unsigned says = 0;
    if (!frame || !(frame->flags & SKV_CAN_ERROR))
        return 0;
    for (size_t i = 0; i < sizeof classes / sizeof classes[0]; i++)
        says |= frame->id & classes[i].bits ? classes[i].says : 0;
    return frame->id & CAN_ERR_CRTL ? says | controller_says(frame->data[1]) : says;
}
