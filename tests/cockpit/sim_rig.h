/// skyvert-sim on a fake bus, time turned by hand: for its tests.
#ifndef SIM_RIG_H
#define SIM_RIG_H

#include "check.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "port/socketcan/skv_can_fake.h"
#include "tools/cockpit/sim_player.h"
#include "tools/cockpit/sim_stream.h"

#define MS     ((int64_t)1000000)
#define SECOND (1000 * MS)

// ---- a flight due north along a meridian: the latitude is a straight line in time

#define LAT0_DEG     47.0
#define LAT_DEG_S    0.002 // 222 m/s
#define HEIGHT_M_S   10.0
#define FLIGHT_S     600.0
#define LONGITUDE    8.5
#define START_HEIGHT 1000.0

static inline void write_flight(char *path) {
    strcpy(path, "/tmp/skyvert-sim-test-XXXXXX");
    const int fd = mkstemp(path);
    FILE *const file = fd >= 0 ? fdopen(fd, "w") : NULL;
    assert_true(file != NULL);
    fputs("utc,lat_deg,lon_deg,height_m\n", file);
    for (int t = 0; t <= (int)FLIGHT_S; t += 10)
        fprintf(file, "2024-03-20T16:%02d:%02dZ,%.9f,%.1f,%.1f\n", t / 60, t % 60, LAT0_DEG + LAT_DEG_S * t, LONGITUDE,
                START_HEIGHT + HEIGHT_M_S * t);
    fclose(file);
}

// ---- the rig: a sender on a fake net, and a receiver that keeps what it hears

#define KEPT 40000

typedef struct rig {
    skv_can_fake_net *net;
    skv_can_bus *listener;
    sim_options options;
    sim_flight flight;
    sim_bus bus;
    sim_stream stream;
    sim_player player;
    bool plays;
    int64_t now_ns, wake_ns, jump_ns; // jump_ns: how far the clock that can be set is off
    int opens_fail;                   // so many more
    skv_can_received kept[KEPT];
    int n_kept;
} rig;

static inline skv_can_status open_fake(void *context, skv_can_bus **bus) {
    rig *const r = context;
    if (r->opens_fail > 0) {
        r->opens_fail--;
        return SKV_CAN_NO_INTERFACE;
    }
    const skv_can_options all = {.receive_all = 1, .receive_errors = 1, .receive_own = r->plays};
    return skv_can_fake_open(bus, r->net, &all);
}

static inline rig *new_rig(double speed) {
    rig *const r = calloc(1, sizeof *r);
    const skv_can_options all = {.receive_all = 1};
    char path[64];
    assert_true(r != NULL);
    write_flight(path);
    r->options = (sim_options){.speed = speed, .duration_s = FLIGHT_S, .node = 7, .flight = {.visibility_m = 12000}};
    assert_int_equal(sim_flight_open(&r->flight, path, &r->options.flight), 0);
    unlink(path);
    r->net = skv_can_fake_new();
    assert_int_equal(skv_can_fake_open(&r->listener, r->net, &all), SKV_CAN_OK);
    r->bus = (sim_bus){.open = open_fake, .context = r, .name = "fake", .quiet = true, .self = {7, 1, 2}};
    return r;
}

static inline void begin_stream(rig *r) {
    assert_int_equal(sim_bus_begin(&r->bus, r->now_ns), SKV_CAN_OK);
    r->stream = (sim_stream){.options = &r->options, .flight = &r->flight, .bus = &r->bus, .sender = {.node = 7}};
    sim_stream_begin(&r->stream, r->now_ns);
}

static inline void free_rig(rig *r) {
    sim_bus_end(&r->bus);
    skv_can_close(r->listener);
    skv_can_fake_free(r->net);
    sim_flight_close(&r->flight);
    free(r);
}

/// One millisecond. The fake net's stamps are its own clock; jump_ns makes ours differ from it as a clock that was set.
static inline bool step(rig *r) {
    r->now_ns += MS;
    skv_can_fake_advance(r->net, r->now_ns);
    const sim_now now = {r->now_ns, r->now_ns + r->jump_ns};
    sim_bus_receive(&r->bus, now, r->plays ? sim_player_heard : sim_stream_heard,
                    r->plays ? (void *)&r->player : (void *)&r->stream);
    const int64_t bus_ns = sim_bus_tick(&r->bus, r->now_ns);
    if (r->now_ns >= r->wake_ns)
        r->wake_ns = r->plays ? sim_player_tick(&r->player, r->now_ns) : sim_stream_tick(&r->stream, r->now_ns);
    (void)bus_ns;
    while (r->n_kept < KEPT && skv_can_receive(r->listener, &r->kept[r->n_kept], 1) == 1)
        r->n_kept++;
    return r->wake_ns != 0;
}

static inline void run_for(rig *r, double seconds) {
    const int64_t end = r->now_ns + (int64_t)(seconds * 1e9);
    while (r->now_ns < end && step(r))
        ;
}

static inline int32_t long_of(const skv_can_frame *f) {
    return (int32_t)((uint32_t)f->data[4] << 24 | (uint32_t)f->data[5] << 16 | (uint32_t)f->data[6] << 8 | f->data[7]);
}

static inline float float_of(const skv_can_frame *f) {
    const int32_t bits = long_of(f);
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

/// Latitudes from frame `from` on are those of the moments they arrived; codes go up by one unless `gaps`.
static inline int check_latitudes(const rig *r, int from, bool gaps) {
    int n = 0, last = -1;
    for (int i = from; i < r->n_kept; i++) {
        const skv_can_frame *f = &r->kept[i].frame;
        if (f->id != 1036)
            continue;
        const double at_s = 1e-9 * (double)(r->kept[i].time_ns - r->stream.start_ns) * r->options.speed;
        // A step of this test is 1 ms of the bus; a count is 1e-7 deg.
        check_near("latitude", long_of(f) * 1e-7, LAT0_DEG + LAT_DEG_S * at_s,
                   1e-7 + LAT_DEG_S * 0.0011 * r->options.speed);
        if (!gaps && last >= 0 && f->data[3] != (uint8_t)(last + 1))
            fail_msg("message code: got %d after %d at %.3f s", f->data[3], last, at_s);
        last = f->data[3];
        n++;
    }
    return n;
}

#endif
