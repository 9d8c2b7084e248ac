/// What a cockpit does with frames of the bus and at each tick: state, sky, shared memory, lamps.
#include <math.h>
#include <time.h>

#include "cockpit_loop.h"

static void answer(cockpit *c, const skv_can_frame *request) {
    const skv_cas_identity self = {.node = (uint8_t)c->options.node, .hardware_revision = 1, .software_revision = 1};
    skv_can_frame reply;
    if (skv_cas_identify(request, &self, &reply) != 1 || cockpit_bus_send(&c->bus, &reply))
        return;
    c->reply = reply;
    c->reply_until_ns = cockpit_mono_ns() + 100000000; // by the specification
}

/// The queue was full: once more at each tick.
static void answer_late(cockpit *c) {
    if (c->reply_until_ns > 0 && (cockpit_mono_ns() > c->reply_until_ns || cockpit_bus_send(&c->bus, &c->reply)))
        c->reply_until_ns = 0;
}

void cockpit_receive(cockpit *c) {
    cockpit_received got[32];
    for (int round = 0; round < 64; round++) { // not for ever: a bus at full load must not stop the sky
        const int n = cockpit_bus_receive(&c->bus, got, 32);
        for (int i = 0; i < n; i++) {
            const skv_cas_count became = cockpit_state_frame(&c->state, &got[i].frame, got[i].time_ns);
            if (became == SKV_CAS_ACCEPTED)
                cockpit_stats_arrived(&c->stats, got[i].arrived_ns);
            else if (became == SKV_CAS_SERVICE)
                answer(c, &got[i].frame);
        }
        if (n == 0)
            return;
    }
}

static bool fault(const cockpit *c) {
    const cockpit_now *const now = &c->now;
    const bool silent = c->state.accepted == 0 && cockpit_mono_ns() - c->stats.start_ns > 3000000000;
    return silent || cockpit_bus_fault(&c->bus) || now->position_stale || now->height_stale || now->time_stale;
}

static uint32_t flags_of(const cockpit *c) {
    const cockpit_now *const now = &c->now;
    return (now->position_stale ? SKV_VERTICES_POSITION_STALE : 0u) |
           (now->height_stale ? SKV_VERTICES_HEIGHT_STALE : 0u) | (now->time_stale ? SKV_VERTICES_TIME_STALE : 0u) |
           (now->held ? SKV_VERTICES_HELD : 0u) | (c->panel.bus ? SKV_VERTICES_BUS_FAULT : 0u) |
           (c->panel.night ? SKV_VERTICES_NIGHT_LAMP : 0u) | (now->sun_by_bus ? SKV_VERTICES_SUN_BY_BUS : 0u) |
           (c->sky.building ? SKV_VERTICES_BUILDING : 0u);
}

static int64_t thread_ns(void) {
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (int64_t)t.tv_sec * 1000000000 + t.tv_nsec;
}

/// The cheapest way that holds the rate: the fast tier first, then every second, fourth, eighth tick.
static int stride(const cockpit *c) {
    return c->sky.level > 1 ? 1 << (c->sky.level - 1) : 1;
}

static void choose_level(cockpit *c, int64_t now_ns) {
    const double share = c->stats.evaluate_ms * c->options.rate / 1000.0 / stride(c);
    const int64_t since = now_ns - c->level_ns;
    const int change = share > 0.7 && since > 500000000 ? 1 : share < 0.2 && since > c->calm_ns ? -1 : 0;
    const int level = c->sky.level + change;
    if (change == 0 || level < 0 || level > 4)
        return;
    if (change > 0 && c->tried && c->calm_ns < 600000000000) // it was too much: not to and fro every ten seconds
        c->calm_ns *= 2;
    c->tried = change < 0;
    c->sky.level = level;
    c->level_ns = now_ns;
    c->stats.evaluate_ms = 0.0;
}

static void publish(cockpit *c, int64_t until_ns, double seconds) {
    const int64_t before = thread_ns();
    if (!cockpit_sky_frame(&c->sky, &c->now, seconds)) {
        c->stats.refused++;
        return;
    }
    cockpit_stats_evaluated(&c->stats, thread_ns() - before);
    skv_vertices_moment moment = c->sky.at;
    moment.flags = c->flags;
    moment.input_ns = c->stats.newest_ns;
    moment.published_ns = cockpit_mono_ns();
    cockpit_share_publish(&c->share, &c->sky, &moment);
    cockpit_stats_published(&c->stats, until_ns, cockpit_mono_ns());
    c->running = true;
}

void cockpit_frame(cockpit *c) {
    const int64_t until_ns = cockpit_mono_ns();
    const double period_s = 1.0 / c->options.rate;
    answer_late(c);
    cockpit_state_now(&c->state, cockpit_bus_now(&c->bus), &c->now);
    if (c->options.exposure > 0)
        c->now.exposure = c->options.exposure / (double)SKV_WHITE_LUMINANCE;
    const double spare_s = fmax(0.1 * period_s, 0.6 * period_s - 1e-3 * c->stats.evaluate_ms);
    cockpit_sky_build(&c->sky, c->now.visibility_km, (int64_t)(1e9 * spare_s));
    cockpit_panel_lamps(&c->panel, &c->options, c->now.has_sun ? (double)c->now.sun.elevation_deg : (double)NAN,
                        fault(c));
    c->flags = flags_of(c);
    c->seen = false;
    if (c->now.has_sun && c->tick % stride(c) == 0) {
        publish(c, until_ns, period_s * stride(c));
        c->seen = true;
        choose_level(c, until_ns);
    } else if (c->now.has_sun) {
        c->stats.skipped++;
    }
    cockpit_share_beat(&c->share);
    c->tick++;
}
