#define _POSIX_C_SOURCE 200809L
#include "cockpit_bus.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "cockpit_state.h"
#include "port/socketcan/skv_socketcan.h"

static const int64_t second = 1000000000;

static int64_t clock_ns(clockid_t id) {
    struct timespec t;
    clock_gettime(id, &t);
    return (int64_t)t.tv_sec * second + t.tv_nsec;
}

int64_t cockpit_mono_ns(void) {
    return clock_ns(CLOCK_MONOTONIC);
}

int64_t cockpit_bus_now(const cockpit_bus *b) {
    const int64_t now = cockpit_mono_ns();
    return b->source == COCKPIT_CAN ? now : (int64_t)((double)(now - b->start_ns) * b->speed);
}

static void make_filters(cockpit_bus *b) {
    uint32_t ids[64];
    b->filters = (size_t)cockpit_state_ids(ids, 64);
    for (size_t i = 0; i < b->filters; i++)
        b->filter[i] = (skv_can_filter){.id = ids[i], .mask = 0x7FF};
}

/// What may wait while a sky is evaluated: .1 s of a full bus of 1 Mbit/s and more (a frame takes about 800 bytes).
#define RECEIVE_BYTES 1000000

static skv_can_options listening(const cockpit_bus *b) {
    return (skv_can_options){
        .filters = b->filter, .n_filters = b->filters, .receive_errors = 1, .receive_bytes = RECEIVE_BYTES};
}

static int open_can(cockpit_bus *b) {
    int error = 0;
    const skv_can_options options = listening(b);
    const skv_can_status status = skv_socketcan_open(&b->bus, b->name, &options, &error);
    if (status == SKV_CAN_OK)
        return 0;
    const char *const text = skv_can_status_text(status);
    if (status == SKV_CAN_UNAVAILABLE) {
        (void)fail_job(COCKPIT ": %s", text);
        return EXIT_NO_CAN;
    }
    if (status == SKV_CAN_SYSTEM)
        return fail_job(COCKPIT ": --interface %s: %s", b->name, strerror(error));
    return (status == SKV_CAN_NO_INTERFACE ? fail_usage : fail_job)(COCKPIT ": --interface %s: %s", b->name, text);
}

static int open_net(cockpit_bus *b) {
    const skv_can_options options = listening(b);
    b->net = skv_can_fake_new();
    b->start_ns = cockpit_mono_ns();
    if (b->net && skv_can_fake_open(&b->bus, b->net, &options) == SKV_CAN_OK &&
        skv_can_fake_open(&b->sender, b->net, NULL) == SKV_CAN_OK)
        return 0;
    cockpit_bus_close(b);
    return fail_job(COCKPIT ": out of memory");
}

int cockpit_bus_open(cockpit_bus *b, const cockpit_options *options) {
    memset(b, 0, sizeof *b);
    b->source = options->replay ? COCKPIT_REPLAY : options->fake ? COCKPIT_FAKE : COCKPIT_CAN;
    b->speed = options->speed;
    b->talker.node = 1;
    make_filters(b);
    if (b->source == COCKPIT_CAN) {
        snprintf(b->name, sizeof b->name, "%s", options->interface);
        const int status = open_can(b);
        if (status == 0)
            (void)cockpit_bus_check(b);
        return status;
    }
    snprintf(b->name, sizeof b->name, "%s", options->replay ? "log" : "made-up flight");
    if (options->replay) {
        b->path = options->replay;
        b->log = fopen(options->replay, "r");
        if (!b->log)
            return fail_usage(COCKPIT ": --replay %.200s: %s", options->replay, strerror(errno));
    }
    const int status = open_net(b);
    if (status == 0)
        (void)cockpit_bus_check(b);
    return status;
}

void cockpit_bus_close(cockpit_bus *b) {
    skv_can_close(b->bus);
    skv_can_close(b->sender);
    if (b->net)
        skv_can_fake_free(b->net);
    if (b->log)
        fclose(b->log);
    free(b->line);
    b->bus = b->sender = NULL;
    b->net = NULL;
    b->log = NULL;
    b->line = NULL;
}

int cockpit_bus_fd(const cockpit_bus *b) {
    return b->bus ? skv_can_fd(b->bus) : -1;
}

int cockpit_bus_event_fd(const cockpit_bus *b) {
    return b->bus ? skv_can_event_fd(b->bus) : -1;
}

static void hear_error(cockpit_bus *b, const skv_can_frame *frame) {
    const unsigned says = skv_can_error_says(frame);
    if (says & SKV_CAN_SAYS_BUS_OFF) {
        b->bus_offs += !b->bus_off;
        b->bus_off = true;
        b->bus_off_ns = cockpit_mono_ns();
    } else if (says & (SKV_CAN_SAYS_RESTARTED | SKV_CAN_SAYS_ACTIVE)) {
        b->bus_off = false;
    }
}

/// Now by the frames' clock and by the one that the kernel stamps with, which may be set at any time: only ages are
/// taken from it. Read once for all frames of a call, which stay in order so.
typedef struct now_of {
    int64_t mono_ns, real_ns;
} now_of;

static void date(const cockpit_bus *b, const now_of *clocks, const skv_can_received *r, cockpit_received *out) {
    const int64_t now = clocks->mono_ns;
    if (b->source != COCKPIT_CAN) {
        out->time_ns = r->time_ns; // arrived when a bus would have brought it
        out->arrived_ns = b->start_ns + (int64_t)((double)r->time_ns / b->speed);
        out->arrived_ns = out->arrived_ns > now ? now : out->arrived_ns;
        return;
    }
    const int64_t age = r->time_ns == 0 ? 0 : clocks->real_ns - r->time_ns;
    out->time_ns = out->arrived_ns = age > 0 && age < second ? now - age : now;
}

static void lose_interface(cockpit_bus *b) {
    b->before = cockpit_bus_counts(b);
    skv_can_close(b->bus);
    b->bus = NULL;
    b->gone = true;
    b->denied = false;
    memset(&b->state, 0, sizeof b->state);
}

int cockpit_bus_receive(cockpit_bus *b, cockpit_received *frames, int n) {
    skv_can_received got[32];
    int taken = 0;
    while (b->bus && taken == 0) {
        const int count = skv_can_receive(b->bus, got, n < 32 ? n : 32);
        if (count == SKV_CAN_GONE)
            lose_interface(b);
        else if (count == SKV_CAN_DOWN)
            b->state.up = 0;
        if (count <= 0)
            break;
        const now_of clocks = {cockpit_mono_ns(), clock_ns(CLOCK_REALTIME)};
        for (int i = 0; i < count; i++) {
            if (got[i].frame.flags & SKV_CAN_ERROR) {
                hear_error(b, &got[i].frame);
                continue;
            }
            frames[taken].frame = got[i].frame;
            date(b, &clocks, &got[i], &frames[taken++]);
        }
    }
    // A bus that carries data is on again.
    if (taken > 0 && b->bus_off && cockpit_mono_ns() - b->bus_off_ns > second)
        b->bus_off = false;
    return taken;
}

bool cockpit_bus_send(cockpit_bus *b, const skv_can_frame *frame) {
    return b->bus && skv_can_send(b->bus, frame) == SKV_CAN_OK;
}

/// The old state stays where the kernel does not answer.
bool cockpit_bus_check(cockpit_bus *b) {
    if (!b->bus) {
        int error = 0;
        const skv_can_options options = listening(b);
        if (!b->gone || skv_socketcan_open(&b->bus, b->name, &options, &error) != SKV_CAN_OK) {
            b->bus = NULL;
            return false;
        }
        b->gone = false;
        (void)skv_can_get_state(b->bus, &b->state);
        return true;
    }
    (void)skv_can_events(b->bus);
    (void)skv_can_get_state(b->bus, &b->state);
    if (b->source == COCKPIT_CAN && !b->state.present) {
        lose_interface(b);
        return true;
    }
    // A controller knows best whether it is on again; virtual ones do not say.
    if (b->state.controller != SKV_CAN_UNKNOWN && b->state.controller != SKV_CAN_BUS_OFF &&
        cockpit_mono_ns() - b->bus_off_ns > second)
        b->bus_off = false;
    if (b->state.controller == SKV_CAN_BUS_OFF && b->state.restart_ms == 0 && !b->denied)
        b->denied = skv_can_restart(b->bus) == SKV_CAN_DENIED;
    return false;
}

bool cockpit_bus_fault(const cockpit_bus *b) {
    return b->gone || !b->state.up || b->bus_off || b->state.controller == SKV_CAN_BUS_OFF ||
           b->state.controller == SKV_CAN_PASSIVE || (b->bus_offs > 0 && cockpit_mono_ns() - b->bus_off_ns < second);
}

const char *cockpit_bus_words(const cockpit_bus *b, char *text, size_t size) {
    static const char *const controller[] = {"",          "",          ", error warning", ", error passive",
                                             ", bus-off", ", stopped", ", sleeping"};
    if (b->gone)
        return "the interface is gone";
    if (b->source == COCKPIT_REPLAY && b->ended)
        return "the log is at its end";
    if (b->source != COCKPIT_CAN)
        return "no bus";
    if (!b->state.up)
        return "down";
    const unsigned c = b->bus_off ? SKV_CAN_BUS_OFF : b->state.controller;
    const char *const doing = c == SKV_CAN_BUS_OFF && b->denied ? ", bus-off: no right to restart it"
                              : c < 7                           ? controller[c]
                                                                : "";
    if (b->state.bitrate > 0)
        snprintf(text, size, "up, %g kbit/s%s", b->state.bitrate / 1000.0, doing);
    else
        snprintf(text, size, "up%s", doing);
    return text;
}

skv_can_counts cockpit_bus_counts(const cockpit_bus *b) {
    skv_can_counts sum = b->before;
    if (!b->bus)
        return sum;
    const skv_can_counts now = skv_can_get_counts(b->bus);
    sum.received += now.received;
    sum.sent += now.sent;
    sum.dropped += now.dropped;
    sum.error_frames += now.error_frames;
    return sum;
}
