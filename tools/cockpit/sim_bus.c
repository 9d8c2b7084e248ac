#include "sim_bus.h"

#include <stdio.h>
#include <string.h>

#define MS     ((int64_t)1000000)
#define SECOND (1000 * MS)
#define BATCH  64

static void say(const sim_bus *b, const char *text) {
    if (!b->quiet)
        fprintf(stderr, "skyvert-sim: %s: %s\n", b->name, text);
}

// ---- state

static void enter(sim_bus *b, sim_bus_phase phase) {
    static const char *const text[] = {"works again", "is down: waiting for it", "bus-off", "is gone: waiting for it"};
    char line[120];
    if (phase == b->phase)
        return;
    b->recoveries += phase == SIM_BUS_WORKS;
    b->downs += phase == SIM_BUS_DOWN;
    b->bus_offs += phase == SIM_BUS_OFF;
    b->gone += phase == SIM_BUS_GONE;
    b->phase = phase;
    b->denied = b->refused = false;
    if (phase == SIM_BUS_OFF && b->state.restart_ms)
        snprintf(line, sizeof line, "bus-off: the kernel restarts it after %u ms", (unsigned)b->state.restart_ms);
    else
        snprintf(line, sizeof line, "%s", text[phase]);
    say(b, line);
}

static void lose(sim_bus *b, int64_t now_ns) {
    b->unread += skv_can_get_counts(b->bus).dropped;
    skv_can_close(b->bus);
    b->bus = NULL;
    b->look_ns = now_ns + SECOND / 2;
    enter(b, SIM_BUS_GONE);
}

/// Nobody else restarts it: try, and say so when that is not allowed or cannot be.
static void restart(sim_bus *b, int64_t now_ns) {
    const skv_can_status status = skv_can_restart(b->bus);
    b->restart_ns = now_ns + SECOND;
    if (status != SKV_CAN_OK && !b->denied)
        say(b, status == SKV_CAN_DENIED
                   ? "no right to restart it (CAP_NET_ADMIN): ip link set it up with restart-ms 100"
                   : "cannot be restarted: ip link set it down and up");
    b->denied = b->denied || status != SKV_CAN_OK;
}

void sim_bus_look(sim_bus *b, int64_t now_ns) {
    skv_can_state state;
    b->look_ns = now_ns + SECOND;
    if (!b->bus || skv_can_get_state(b->bus, &state) != SKV_CAN_OK)
        return;
    if (state.bitrate != b->state.bitrate && state.bitrate && state.bitrate < b->most_bits_s)
        say(b, "its bit rate is too low for what is sent");
    b->state = state;
    if (!state.present) {
        lose(b, now_ns);
        return;
    }
    enter(b, !state.up ? SIM_BUS_DOWN : state.controller == SKV_CAN_BUS_OFF ? SIM_BUS_OFF : SIM_BUS_WORKS);
    if (b->phase == SIM_BUS_OFF && state.restart_ms == 0 && now_ns >= b->restart_ns)
        restart(b, now_ns);
}

static skv_can_status open_bus(sim_bus *b, int64_t now_ns) {
    const skv_can_status status = b->open(b->context, &b->bus);
    if (status != SKV_CAN_OK) {
        b->bus = NULL;
        b->look_ns = now_ns + SECOND / 2;
        return status;
    }
    b->generation++;
    sim_bus_look(b, now_ns);
    return status;
}

skv_can_status sim_bus_begin(sim_bus *b, int64_t now_ns) {
    return open_bus(b, now_ns);
}

void sim_bus_end(sim_bus *b) {
    if (b->bus)
        b->unread += skv_can_get_counts(b->bus).dropped;
    skv_can_close(b->bus);
    b->bus = NULL;
}

// ---- frames

void sim_bus_say_why(sim_bus *b, skv_can_status status) {
    char line[160];
    if (b->refused || status == SKV_CAN_OK || (status <= SKV_CAN_QUEUE_FULL && status >= SKV_CAN_UNAVAILABLE))
        return;
    b->refused = true;
    snprintf(line, sizeof line, "cannot send: %s", // it is tried on
             status == SKV_CAN_SYSTEM ? strerror(skv_can_errno(b->bus)) : skv_can_status_text(status));
    say(b, line);
}

skv_can_status sim_bus_send(sim_bus *b, const skv_can_frame *frame, int64_t now_ns) {
    if (!b->bus || b->phase != SIM_BUS_WORKS)
        return SKV_CAN_DOWN;
    const skv_can_status status = skv_can_send(b->bus, frame);
    b->frames += status == SKV_CAN_OK;
    b->waits += status == SKV_CAN_QUEUE_FULL || status == SKV_CAN_AGAIN;
    sim_bus_say_why(b, status);
    if (status == SKV_CAN_GONE || status == SKV_CAN_DOWN)
        sim_bus_look(b, now_ns);
    return status;
}

/// Replies in order. @return whether all are gone
static bool send_replies(sim_bus *b, int64_t now_ns) {
    int sent = 0;
    while (sent < b->replies && sim_bus_send(b, &b->reply[sent], now_ns) == SKV_CAN_OK) {
        const int64_t took = now_ns - b->asked_ns[sent];
        b->longest_answer_ns = took > b->longest_answer_ns ? took : b->longest_answer_ns;
        b->answers++;
        sent++;
    }
    b->replies -= sent;
    memmove(b->reply, b->reply + sent, (size_t)b->replies * sizeof b->reply[0]);
    memmove(b->asked_ns, b->asked_ns + sent, (size_t)b->replies * sizeof b->asked_ns[0]);
    return b->replies == 0;
}

static void answer(sim_bus *b, const skv_can_frame *frame, int64_t asked_ns, int64_t now_ns) {
    skv_can_frame reply;
    if (!skv_cas_identify(frame, &b->self, &reply))
        return;
    b->requests++;
    if (b->replies == SIM_REPLIES) // somebody asks on and on while nothing can be sent
        return;
    b->reply[b->replies] = reply;
    b->asked_ns[b->replies++] = asked_ns;
    (void)send_replies(b, now_ns);
}

/// Stamps are of the clock that can be set: only how long ago counts, and only when that can be.
static int64_t mono_of(int64_t stamp_ns, sim_now now) {
    const int64_t ago = now.real_ns - stamp_ns;
    return stamp_ns && ago >= 0 && ago < 10 * SECOND ? now.mono_ns - ago : now.mono_ns;
}

void sim_bus_receive(sim_bus *b, sim_now now,
                     void (*heard)(void *self, const skv_can_received *frame, int64_t mono_ns, int64_t now_ns),
                     void *self) {
    skv_can_received frames[BATCH];
    int n = b->bus ? BATCH : 0;
    while (n == BATCH) {
        n = skv_can_receive(b->bus, frames, BATCH);
        bool look = n < 0;
        for (int i = 0; i < n; i++) {
            const int64_t mono_ns = mono_of(frames[i].time_ns, now);
            if (frames[i].frame.flags & SKV_CAN_ERROR) {
                look = look || skv_can_error_says(&frames[i].frame) & (SKV_CAN_SAYS_BUS_OFF | SKV_CAN_SAYS_RESTARTED);
                continue;
            }
            answer(b, &frames[i].frame, mono_ns, now.mono_ns);
            heard(self, &frames[i], mono_ns, now.mono_ns);
        }
        if (look)
            sim_bus_look(b, now.mono_ns);
        if (n == SKV_CAN_GONE && b->bus)
            lose(b, now.mono_ns);
    }
}

int64_t sim_bus_tick(sim_bus *b, int64_t now_ns) {
    if (!b->bus && now_ns >= b->look_ns)
        (void)open_bus(b, now_ns);
    else if (now_ns >= b->look_ns)
        sim_bus_look(b, now_ns);
    if (b->replies && !send_replies(b, now_ns) && b->phase == SIM_BUS_WORKS)
        return now_ns + MS;
    return b->look_ns;
}
