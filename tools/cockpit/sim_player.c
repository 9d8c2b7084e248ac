#include "sim_player.h"

#include <string.h>

#define MS ((int64_t)1000000)
/// Frames that are later than this move the whole rest: no burst to catch up.
#define LATE_NS (100 * MS)
/// How long the last frames may take to come back from the bus.
#define LAST_NS (200 * MS)

static int64_t due_ns(const sim_player *p) {
    const sim_record *r = p->recording->records;
    return p->start_ns + (int64_t)((double)(r[p->next].after_ns - r[p->first].after_ns) / p->options->speed);
}

void sim_player_begin(void *player, int64_t now_ns) {
    sim_player *const p = player;
    const sim_recording *r = p->recording;
    const int64_t from = (int64_t)(1e9 * p->options->start_s);
    const int64_t to = (int64_t)(1e9 * (p->options->start_s + p->options->duration_s));
    while (p->first + 1 < r->count && r->records[p->first].after_ns < from)
        p->first++;
    p->end = p->first + 1;
    while (p->end < r->count && r->records[p->end].after_ns <= to)
        p->end++;
    p->next = p->first;
    p->start_ns = now_ns;
}

/// The next lap begins as long after the last frame as the frames are apart on the whole, at least 1 ms.
static void next_lap(sim_player *p) {
    const sim_record *r = p->recording->records;
    const size_t n = p->end - p->first;
    const int64_t lap = r[p->end - 1].after_ns - r[p->first].after_ns;
    const int64_t gap = n > 1 ? lap / (int64_t)(n - 1) : 1000 * MS;
    p->start_ns += (int64_t)((double)(lap + (gap > MS ? gap : MS)) / p->options->speed);
    p->next = p->first;
    p->laps++;
}

static int64_t finished(const sim_player *p, int64_t now_ns) {
    return p->heard >= p->bus->frames || now_ns >= p->done_ns + LAST_NS ? 0 : now_ns + 10 * MS;
}

int64_t sim_player_tick(void *player, int64_t now_ns) {
    sim_player *const p = player;
    if (p->next == p->end)
        return finished(p, now_ns);
    while (due_ns(p) <= now_ns) {
        const skv_can_status status = sim_bus_send(p->bus, &p->recording->records[p->next].frame, now_ns);
        if (status != SKV_CAN_OK) // one frame takes .1 ms at 1 Mbit/s, 13 ms at 10 kbit/s
            return now_ns + (status == SKV_CAN_QUEUE_FULL || status == SKV_CAN_AGAIN ? MS : 50 * MS);
        if (now_ns - due_ns(p) > LATE_NS)
            p->start_ns += now_ns - due_ns(p);
        p->done_ns = now_ns;
        if (++p->next == p->end && p->options->loop)
            next_lap(p);
        if (p->next == p->end)
            return now_ns + 10 * MS;
    }
    return due_ns(p);
}

void sim_player_heard(void *player, const skv_can_received *frame, int64_t mono_ns, int64_t now_ns) {
    sim_player *const p = player;
    (void)mono_ns;
    (void)now_ns;
    p->heard += frame->own;
}

void sim_player_show(const void *player, char *text, size_t size) {
    const sim_player *const p = player;
    const size_t at = p->next < p->end ? p->next : p->end - 1;
    snprintf(text, size, "%.1f s of the log  %llu frames, %llu waits",
             1e-9 * (double)p->recording->records[at].after_ns, (unsigned long long)p->bus->frames,
             (unsigned long long)p->bus->waits);
}
