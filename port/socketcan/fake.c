// A bus in this process: queues, a clock turned by the caller, and faults by a seeded generator.
#include "skv_can_fake.h"

#include <errno.h>
#include <linux/can/error.h>
#include <stdlib.h>
#include <string.h>
#include <sys/eventfd.h>
#include <unistd.h>

#define HANDLES 16
#define QUEUE   4096 // frames a handle holds before it drops
#define TASKS   64
#define DELAYED 1024

typedef struct handle handle;

typedef struct task {
    skv_can_cyclic cyclic;
    int64_t next_ns;
} task;

typedef struct watch {
    uint32_t id;
    int64_t timeout_ns, last_ns;
    uint8_t out, told; // timed out; and said so
} watch;

struct handle {
    skv_can_bus bus; // first
    skv_can_fake_net *net;
    skv_can_options options;
    skv_can_filter filter[SKV_CAN_MAX_FILTERS];
    skv_can_received queue[QUEUE];
    int first, waiting;
    task task[TASKS];
    int tasks;
    watch watched[TASKS];
    int watches;
    skv_can_received held; // comes behind the next frame
    int holds, frames_fd, event_fd, timeout_fd, events, went_down;
};

typedef struct delayed {
    handle *to;
    int64_t due_ns;
    skv_can_frame frame;
} delayed;

struct skv_can_fake_net {
    handle *handle[HANDLES];
    delayed later[DELAYED];
    int n_later;
    skv_can_faults faults;
    uint64_t random;
    int64_t now_ns, restart_ns; // restart_ns: when the controller comes back, 0 = never
    int up, bus_off;
    uint32_t restart_ms;
};

// splitmix64 [Steele14].
static double chance(skv_can_fake_net *net) {
    uint64_t z = net->random += 0x9E3779B97F4A7C15u;
    z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9u;
    z = (z ^ z >> 27) * 0x94D049BB133111EBu;
    return (double)((z ^ z >> 31) >> 11) * 0x1p-53;
}

static void signal_fd(int fd) {
    const uint64_t one = 1;
    (void)!write(fd, &one, sizeof one);
}

static void quiet_fd(int fd) {
    uint64_t count;
    (void)!read(fd, &count, sizeof count);
}

static handle *handle_of(skv_can_bus *bus) {
    return (handle *)(void *)bus;
}

// ---------------------------------------------------------------------------------------------------- delivering

static int passes(const handle *h, const skv_can_frame *frame) {
    if (frame->flags & SKV_CAN_ERROR)
        return h->options.receive_errors;
    if (h->options.receive_all)
        return 1;
    for (size_t i = 0; i < h->options.n_filters; i++) {
        const skv_can_filter *f = &h->filter[i];
        if (f->flags == frame->flags && ((f->id ^ frame->id) & f->mask) == 0)
            return 1;
    }
    return 0;
}

static void push(handle *h, const skv_can_received *frame) {
    if (h->waiting == QUEUE) {
        h->bus.counts.dropped++;
        return;
    }
    h->queue[(h->first + h->waiting++) % QUEUE] = *frame;
    signal_fd(h->frames_fd);
}

static void see(handle *h, const skv_can_frame *frame) {
    for (int i = 0; i < h->watches; i++)
        if (h->watched[i].id == frame->id && !frame->flags) {
            h->watched[i].last_ns = h->net->now_ns;
            h->watched[i].out = h->watched[i].told = 0;
        }
}

static void give(handle *h, const skv_can_frame *frame, int own) {
    const skv_can_received r = {.frame = *frame, .time_ns = h->net->now_ns, .own = (uint8_t)own};
    see(h, frame);
    if (passes(h, frame))
        push(h, &r);
}

static void release_held(handle *h) {
    if (h->holds)
        push(h, &h->held);
    h->holds = 0;
}

// One receiver's copy of a frame, faults and all.
static void deliver(handle *h, const skv_can_frame *frame, int own) {
    skv_can_fake_net *net = h->net;
    const skv_can_faults *f = &net->faults;
    skv_can_frame copy = *frame;
    if (chance(net) < f->drop)
        return;
    if (copy.length && chance(net) < f->corrupt) {
        const unsigned bit = (unsigned)(chance(net) * 8.0 * copy.length);
        copy.data[bit / 8] ^= (uint8_t)(1u << bit % 8);
    }
    if (chance(net) < f->delay && net->n_later < DELAYED) {
        net->later[net->n_later++] = (delayed){h, net->now_ns + f->delay_ns, copy};
        return;
    }
    if (chance(net) < f->reorder && !h->holds && passes(h, &copy)) {
        h->held = (skv_can_received){.frame = copy, .time_ns = net->now_ns, .own = (uint8_t)own};
        h->holds = 1;
        return;
    }
    give(h, &copy, own);
    if (chance(net) < f->duplicate)
        give(h, &copy, own);
    release_held(h);
}

static int works(const skv_can_fake_net *net) {
    return net->up && !net->bus_off;
}

static void spread(skv_can_fake_net *net, const handle *from, const skv_can_frame *frame) {
    for (int i = 0; i < HANDLES; i++) {
        handle *h = net->handle[i];
        if (h && (h != from || h->options.receive_own))
            deliver(h, frame, h == from);
    }
}

// -------------------------------------------------------------------------------------------------- one handle

static int fake_fd(const skv_can_bus *bus) {
    return ((const handle *)(const void *)bus)->frames_fd;
}

static int fake_receive(skv_can_bus *bus, skv_can_received *frames, int n) {
    handle *h = handle_of(bus);
    int got = 0;
    while (got < n && h->waiting) {
        frames[got++] = h->queue[h->first];
        h->first = (h->first + 1) % QUEUE;
        h->waiting--;
    }
    if (got == 0 && h->went_down) {
        h->went_down = 0;
        bus->last_errno = ENETDOWN;
        return SKV_CAN_DOWN;
    }
    if (!h->waiting && !h->went_down)
        quiet_fd(h->frames_fd);
    return got;
}

static skv_can_status fake_send(skv_can_bus *bus, const skv_can_frame *frame) {
    handle *h = handle_of(bus);
    skv_can_fake_net *net = h->net;
    const skv_can_status status = !net->up                               ? SKV_CAN_DOWN
                                  : net->bus_off                         ? SKV_CAN_QUEUE_FULL
                                  : chance(net) < net->faults.queue_full ? SKV_CAN_QUEUE_FULL
                                  : chance(net) < net->faults.again      ? SKV_CAN_AGAIN
                                                                         : SKV_CAN_OK;
    if (status == SKV_CAN_OK)
        spread(net, h, frame);
    else
        bus->last_errno = status == SKV_CAN_DOWN ? ENETDOWN : status == SKV_CAN_AGAIN ? EAGAIN : ENOBUFS;
    return status;
}

static task *find_task(handle *h, uint32_t id, uint8_t flags) {
    for (int i = 0; i < h->tasks; i++)
        if (h->task[i].cyclic.frame.id == id && h->task[i].cyclic.frame.flags == flags)
            return &h->task[i];
    return NULL;
}

// As the kernel: the count goes on even where the frame cannot.
static void run_task(handle *h, task *t) {
    const skv_can_frame frame = t->cyclic.frame;
    const int counter = t->cyclic.counter_byte;
    if (counter >= 0)
        t->cyclic.frame.data[counter] = (uint8_t)(frame.data[counter] + 1);
    t->next_ns += (int64_t)t->cyclic.period_us * 1000;
    if (!works(h->net))
        return;
    for (int i = 0; i < HANDLES; i++) // its sender is another socket, so its own handle hears it too
        if (h->net->handle[i])
            deliver(h->net->handle[i], &frame, 0);
}

static skv_can_status fake_cyclic_start(skv_can_bus *bus, const skv_can_cyclic *cyclic) {
    handle *h = handle_of(bus);
    task *t = find_task(h, cyclic->frame.id, cyclic->frame.flags);
    if (!t && h->tasks == TASKS)
        return SKV_CAN_BAD_ARGUMENT;
    if (!t)
        t = &h->task[h->tasks++];
    *t = (task){*cyclic, h->net->now_ns};
    run_task(h, t);
    return SKV_CAN_OK;
}

static skv_can_status fake_cyclic_update(skv_can_bus *bus, const skv_can_frame *frame) {
    task *t = find_task(handle_of(bus), frame->id, frame->flags);
    if (!t || t->cyclic.frame.length != frame->length)
        return SKV_CAN_BAD_ARGUMENT;
    const int counter = t->cyclic.counter_byte;
    const uint8_t count = counter >= 0 ? t->cyclic.frame.data[counter] : 0;
    t->cyclic.frame = *frame;
    if (counter >= 0)
        t->cyclic.frame.data[counter] = count;
    return SKV_CAN_OK;
}

static skv_can_status fake_cyclic_stop(skv_can_bus *bus, uint32_t id, uint8_t flags) {
    handle *h = handle_of(bus);
    task *t = find_task(h, id, flags);
    if (!t)
        return SKV_CAN_BAD_ARGUMENT;
    *t = h->task[--h->tasks];
    return SKV_CAN_OK;
}

static skv_can_status fake_state(skv_can_bus *bus, skv_can_state *state) {
    const skv_can_fake_net *net = handle_of(bus)->net;
    *state = (skv_can_state){.present = 1,
                             .up = (uint8_t)net->up,
                             .controller = net->bus_off ? SKV_CAN_BUS_OFF
                                           : net->up    ? SKV_CAN_ACTIVE
                                                        : SKV_CAN_STOPPED,
                             .tx_errors = net->bus_off ? 256 : 0,
                             .restart_ms = net->restart_ms,
                             .bitrate = 500000};
    return SKV_CAN_OK;
}

static void changed(skv_can_fake_net *net) {
    for (int i = 0; i < HANDLES; i++)
        if (net->handle[i]) {
            net->handle[i]->events++;
            signal_fd(net->handle[i]->event_fd);
        }
}

static void come_back(skv_can_fake_net *net) {
    const skv_can_frame restarted = {.id = CAN_ERR_RESTARTED, .length = 8, .flags = SKV_CAN_ERROR};
    net->bus_off = 0;
    net->restart_ns = 0;
    skv_can_fake_inject(net, &restarted);
    changed(net);
}

static skv_can_status fake_restart(skv_can_bus *bus) {
    skv_can_fake_net *net = handle_of(bus)->net;
    if (!net->bus_off || net->restart_ms)
        return SKV_CAN_BAD_ARGUMENT;
    come_back(net);
    return SKV_CAN_OK;
}

static skv_can_status fake_watch(skv_can_bus *bus, uint32_t id, uint32_t timeout_ms) {
    handle *h = handle_of(bus);
    if (h->watches == TASKS)
        return SKV_CAN_BAD_ARGUMENT;
    h->watched[h->watches++] =
        (watch){.id = id, .timeout_ns = (int64_t)timeout_ms * 1000000, .last_ns = h->net->now_ns};
    return SKV_CAN_OK;
}

static int fake_timeouts(skv_can_bus *bus, uint32_t *ids, int n) {
    handle *h = handle_of(bus);
    int found = 0;
    for (int i = 0; i < h->watches && found < n; i++)
        if (h->watched[i].out && !h->watched[i].told) {
            h->watched[i].told = 1;
            ids[found++] = h->watched[i].id;
        }
    if (found < n)
        quiet_fd(h->timeout_fd);
    return found;
}

static int fake_event_fd(const skv_can_bus *bus) {
    return ((const handle *)(const void *)bus)->event_fd;
}

static int fake_timeout_fd(const skv_can_bus *bus) {
    const handle *h = (const handle *)(const void *)bus;
    return h->watches ? h->timeout_fd : -1;
}

static int fake_events(skv_can_bus *bus) {
    handle *h = handle_of(bus);
    const int events = h->events;
    h->events = 0;
    quiet_fd(h->event_fd);
    return events;
}

static void fake_close(skv_can_bus *bus) {
    handle *h = handle_of(bus);
    skv_can_fake_net *net = h->net;
    for (int i = 0; i < HANDLES; i++)
        if (net->handle[i] == h)
            net->handle[i] = NULL;
    for (int i = 0; i < net->n_later; i++)
        if (net->later[i].to == h)
            net->later[i--] = net->later[--net->n_later];
    close(h->frames_fd);
    close(h->event_fd);
    close(h->timeout_fd);
    free(h);
}

static const skv_can_ops ops = {
    fake_fd,      fake_receive, fake_send,     fake_cyclic_start, fake_cyclic_update, fake_cyclic_stop, fake_state,
    fake_restart, fake_watch,   fake_timeouts, fake_event_fd,     fake_timeout_fd,    fake_events,      fake_close,
};

// ------------------------------------------------------------------------------------------------------- the net

skv_can_fake_net *skv_can_fake_new(void) {
    skv_can_fake_net *net = calloc(1, sizeof *net);
    if (net)
        net->up = 1;
    return net;
}

void skv_can_fake_free(skv_can_fake_net *net) {
    free(net);
}

skv_can_status skv_can_fake_open(skv_can_bus **bus, skv_can_fake_net *net, const skv_can_options *options) {
    int place = 0;
    if (!bus || !net ||
        (options && (options->n_filters > SKV_CAN_MAX_FILTERS || (options->n_filters && !options->filters))))
        return SKV_CAN_BAD_ARGUMENT;
    *bus = NULL;
    while (place < HANDLES && net->handle[place])
        place++;
    handle *h = place < HANDLES ? calloc(1, sizeof *h) : NULL;
    if (!h)
        return SKV_CAN_NO_MEMORY;
    h->bus.ops = &ops;
    h->net = net;
    if (options) {
        h->options = *options;
        for (size_t i = 0; i < options->n_filters; i++)
            h->filter[i] = options->filters[i];
    }
    h->frames_fd = eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
    h->event_fd = eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
    h->timeout_fd = eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
    net->handle[place] = h;
    *bus = &h->bus;
    return SKV_CAN_OK;
}

void skv_can_fake_set_faults(skv_can_fake_net *net, const skv_can_faults *faults) {
    net->faults = faults ? *faults : (skv_can_faults){0};
    net->random = net->faults.seed;
}

// What happens next, by the time `until`: the earliest of all that is due. NULL task and index -1 = nothing.
typedef struct due {
    int64_t at_ns;
    handle *sender; // of the task
    task *task;
    int later; // index of a delayed frame
    int restart;
} due;

static due next_due(skv_can_fake_net *net, int64_t until_ns) {
    due d = {until_ns + 1, NULL, NULL, -1, 0};
    if (net->restart_ns && net->restart_ns < d.at_ns)
        d = (due){net->restart_ns, NULL, NULL, -1, 1};
    for (int i = 0; i < net->n_later; i++)
        if (net->later[i].due_ns < d.at_ns)
            d = (due){net->later[i].due_ns, NULL, NULL, i, 0};
    for (int i = 0; i < HANDLES; i++)
        for (int j = 0; net->handle[i] && j < net->handle[i]->tasks; j++)
            if (net->handle[i]->task[j].next_ns < d.at_ns)
                d = (due){net->handle[i]->task[j].next_ns, net->handle[i], &net->handle[i]->task[j], -1, 0};
    return d;
}

static void happen(skv_can_fake_net *net, const due *d) {
    net->now_ns = d->at_ns > net->now_ns ? d->at_ns : net->now_ns;
    if (d->restart) {
        come_back(net);
    } else if (d->task) {
        run_task(d->sender, d->task);
    } else {
        const delayed late = net->later[d->later];
        net->later[d->later] = net->later[--net->n_later];
        give(late.to, &late.frame, 0);
    }
}

static void find_timeouts(skv_can_fake_net *net) {
    for (int i = 0; i < HANDLES; i++) {
        handle *h = net->handle[i];
        for (int j = 0; h && j < h->watches; j++)
            if (!h->watched[j].out && net->now_ns - h->watched[j].last_ns >= h->watched[j].timeout_ns) {
                h->watched[j].out = 1;
                signal_fd(h->timeout_fd);
            }
    }
}

void skv_can_fake_advance(skv_can_fake_net *net, int64_t now_ns) {
    for (due d = next_due(net, now_ns); d.at_ns <= now_ns; d = next_due(net, now_ns))
        happen(net, &d);
    if (now_ns > net->now_ns)
        net->now_ns = now_ns;
    find_timeouts(net);
    for (int i = 0; i < HANDLES; i++) // a frame that waits for a next one that does not come
        if (net->handle[i] && net->handle[i]->holds && now_ns - net->handle[i]->held.time_ns > 1000000000)
            release_held(net->handle[i]);
}

void skv_can_fake_set_up(skv_can_fake_net *net, int up) {
    if (net->up == (up != 0))
        return;
    net->up = up != 0;
    if (up)
        net->bus_off = 0;
    for (int i = 0; i < HANDLES && !up; i++)
        if (net->handle[i]) {
            net->handle[i]->went_down = 1;
            signal_fd(net->handle[i]->frames_fd);
        }
    changed(net);
}

void skv_can_fake_bus_off(skv_can_fake_net *net, uint32_t restart_ms) {
    const skv_can_frame off = {.id = CAN_ERR_BUSOFF, .length = 8, .flags = SKV_CAN_ERROR};
    net->bus_off = 1;
    net->restart_ms = restart_ms;
    net->restart_ns = restart_ms ? net->now_ns + (int64_t)restart_ms * 1000000 : 0;
    skv_can_fake_inject(net, &off);
    changed(net);
}

void skv_can_fake_inject(skv_can_fake_net *net, const skv_can_frame *frame) {
    for (int i = 0; i < HANDLES; i++)
        if (net->handle[i])
            give(net->handle[i], frame, 0);
}
