/// Descriptors, signals and time: the loop.
#define _DEFAULT_SOURCE
#include "cockpit_loop.h"

#include <errno.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/epoll.h>
#include <sys/signalfd.h>
#include <sys/timerfd.h>
#include <sys/wait.h>
#include <unistd.h>

#include "cockpit_snapshot.h"

enum { FROM_BUS = 1, FROM_EVENTS, FROM_TIMER, FROM_SIGNALS, FROM_PANEL };
static const int64_t second = 1000000000;

static void listen_to(const cockpit *c, int fd, uint32_t from) {
    struct epoll_event event = {.events = EPOLLIN, .data = {.u32 = from}};
    if (fd >= 0)
        (void)epoll_ctl(c->poll, EPOLL_CTL_ADD, fd, &event);
}

static int open_signals(void) {
    static const int held[] = {SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGWINCH, SIGCHLD};
    sigset_t set;
    sigemptyset(&set);
    for (size_t i = 0; i < sizeof held / sizeof held[0]; i++)
        sigaddset(&set, held[i]);
    signal(SIGPIPE, SIG_IGN);
    sigprocmask(SIG_BLOCK, &set, NULL);
    return signalfd(-1, &set, SFD_NONBLOCK | SFD_CLOEXEC);
}

static int open_timer(double rate) {
    const int fd = timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK | TFD_CLOEXEC);
    const long ns = (long)(1e9 / rate);
    const struct timespec period = {ns / 1000000000, ns % 1000000000};
    const struct itimerspec spec = {period, period};
    if (fd >= 0)
        (void)timerfd_settime(fd, 0, &spec, NULL);
    return fd;
}

static int open_descriptors(cockpit *c) {
    c->timer = open_timer(c->options.rate);
    c->poll = epoll_create1(EPOLL_CLOEXEC);
    if (c->signals < 0 || c->timer < 0 || c->poll < 0)
        return fail_job(COCKPIT ": %s", strerror(errno));
    listen_to(c, c->signals, FROM_SIGNALS);
    listen_to(c, c->timer, FROM_TIMER);
    listen_to(c, cockpit_panel_fd(&c->panel), FROM_PANEL);
    listen_to(c, cockpit_bus_fd(&c->bus), FROM_BUS);
    listen_to(c, cockpit_bus_event_fd(&c->bus), FROM_EVENTS);
    return 0;
}

int cockpit_open(cockpit *c) {
    const cockpit_options *const o = &c->options;
    c->poll = c->timer = -1;
    c->signals = open_signals(); // first: an early one must not leave anything behind
    c->speaker.node = (uint8_t)o->node;
    c->calm_ns = 10 * second;
    cockpit_stats_begin(&c->stats);
    cockpit_state_begin(&c->state, o->visibility_km);
    c->state.geoid_m = o->geoid_m;
    int status = cockpit_bus_open(&c->bus, o);
    if (status != 0)
        return status;
    const cockpit_sky_options sky = {(skv_preset)o->preset, o->bands, (skv_tier)o->tier, (uint32_t)o->vertices,
                                     o->visibility_km};
    c->text = malloc(COCKPIT_TEXT);
    if (!c->text || cockpit_sky_begin(&c->sky, &sky) != 0)
        return fail_job(COCKPIT ": out of memory");
    status = o->shm ? cockpit_share_open(&c->share, o->shm, &c->sky) : 0;
    if (status != 0)
        return status;
    cockpit_panel_open(&c->panel, o);
    return open_descriptors(c);
}

void cockpit_close(cockpit *c) {
    cockpit_panel_close(&c->panel);
    cockpit_share_close(&c->share);
    cockpit_sky_end(&c->sky);
    cockpit_bus_close(&c->bus);
    free(c->text);
    const int fds[] = {c->poll, c->timer, c->signals};
    for (int i = 0; i < 3; i++)
        if (fds[i] >= 0)
            close(fds[i]);
}

static cockpit_shown shown(const cockpit *c) {
    return (cockpit_shown){&c->options, &c->state, &c->now,    &c->bus, &c->sky,
                           &c->panel,   &c->stats, c->running, c->flags};
}

static void show_picture(cockpit *c) {
    int columns, rows;
    const cockpit_shown all = shown(c);
    cockpit_view_size(&columns, &rows);
    const size_t n = cockpit_view_picture(&all, columns, rows, c->text, COCKPIT_TEXT);
    fwrite(c->text, 1, n, stdout);
    fflush(stdout);
}

static void show_line(cockpit *c) {
    const cockpit_shown all = shown(c);
    cockpit_view_line(&all, c->text, COCKPIT_TEXT);
    puts(c->text);
    if (fflush(stdout) != 0) { // the reader has gone
        c->quit = true;
        c->status = fail_job(COCKPIT ": standard output: %s", strerror(errno));
    }
}

static void send_number(cockpit *c, skv_cas_index index, double value) {
    skv_can_frame frames[2];
    const double low = (double)skv_cas_table[index].low, high = (double)skv_cas_table[index].high;
    const int n = skv_cas_encode(&c->speaker, index, 0, value < low ? low : value > high ? high : value, frames);
    for (int i = 0; i < n; i++)
        (void)cockpit_bus_send(&c->bus, &frames[i]);
}

/// What others on the bus may want to know.
static void transmit(cockpit *c) {
    static const float below[] = {-0.833f, -6.0f, -12.0f, -18.0f};
    uint8_t state[4] = {
        SKV_CAS_DAY, (uint8_t)((c->panel.night ? SKV_CAS_LAMP_NIGHT : 0) | (c->panel.bus ? SKV_CAS_LAMP_BUS_FAULT : 0)),
        (uint8_t)c->now.stale, 0};
    skv_can_frame frame;
    // A bus that does not take them gets the next ones a second later.
    while (state[0] < SKV_CAS_NIGHT && c->now.sun.elevation_deg < below[state[0]])
        state[0]++;
    if (skv_cas_encode_bytes(&c->speaker, SKV_CAS_SKY_STATE, state, &frame) == 1)
        (void)cockpit_bus_send(&c->bus, &frame);
    send_number(c, SKV_CAS_ZENITH_LUMINANCE, c->sky.zenith_cd_m2);
    send_number(c, SKV_CAS_TIME_OFFSET, c->state.time_offset_s);
    if (c->state.visibility_km > 0)
        send_number(c, SKV_CAS_VISIBILITY_SETTING, 1000.0 * c->state.visibility_km);
}

static void each_second(cockpit *c) {
    if (cockpit_bus_check(&c->bus)) {
        listen_to(c, cockpit_bus_fd(&c->bus), FROM_BUS);
        listen_to(c, cockpit_bus_event_fd(&c->bus), FROM_EVENTS);
    }
    if (c->options.transmit && c->running)
        transmit(c);
    if (!c->options.terminal)
        show_line(c);
}

static void take_snapshot(cockpit *c) {
    if (!c->options.png && !c->options.exr)
        (void)fail_job(COCKPIT ": SIGUSR1: --png or --exr says where a snapshot goes");
    else if (!c->running)
        (void)fail_job(COCKPIT ": SIGUSR1: there is no sky yet");
    else if (c->snapshot == 0)
        c->snapshot = cockpit_snapshot_begin(&c->options, &c->sky);
    if (c->snapshot < 0)
        (void)fail_job(COCKPIT ": SIGUSR1: %s", strerror(errno));
    c->snapshot = c->snapshot < 0 ? 0 : c->snapshot;
}

static void tick(cockpit *c) {
    uint64_t times = 0;
    if (read(c->timer, &times, sizeof times) != (ssize_t)sizeof times)
        return;
    c->stats.late += times - 1;
    while (cockpit_bus_play(&c->bus))
        cockpit_receive(c);
    cockpit_receive(c);
    cockpit_frame(c);
    const int64_t now = cockpit_mono_ns();
    if (now - c->second_ns >= second) {
        c->second_ns = now - c->second_ns > 2 * second ? now : c->second_ns + second;
        each_second(c);
    }
    if (c->options.terminal && now - c->shown_ns >= second / 5 && (c->seen || !c->running)) {
        c->shown_ns = now;
        show_picture(c);
    }
    const bool over = c->options.duration_s > 0 && 1e-9 * (double)(now - c->stats.start_ns) >= c->options.duration_s;
    const bool played = c->bus.ended && c->options.duration_s <= 0;
    c->quit = c->quit || over || played;
}

static void reap(cockpit *c) {
    int status = 0;
    if (c->snapshot > 0 && waitpid(c->snapshot, &status, WNOHANG) == c->snapshot)
        c->snapshot = 0;
}

static void hear_signals(cockpit *c) {
    struct signalfd_siginfo info;
    while (read(c->signals, &info, sizeof info) == (ssize_t)sizeof info) {
        if (info.ssi_signo == SIGUSR1)
            take_snapshot(c);
        else if (info.ssi_signo == SIGCHLD)
            reap(c);
        else if (info.ssi_signo == SIGWINCH)
            c->shown_ns = 0;
        else
            c->quit = true;
    }
}

static void hear(cockpit *c, uint32_t from) {
    switch (from) {
    case FROM_BUS:
        if (c->bus.source == COCKPIT_CAN)
            cockpit_receive(c);
        break;
    case FROM_EVENTS:
        if (cockpit_bus_check(&c->bus))
            listen_to(c, cockpit_bus_fd(&c->bus), FROM_BUS);
        break;
    case FROM_TIMER:
        tick(c);
        break;
    case FROM_SIGNALS:
        hear_signals(c);
        break;
    default:
        cockpit_panel_read(&c->panel, &c->options, &c->state);
        break;
    }
}

int cockpit_run(cockpit *c) {
    struct epoll_event events[8];
    c->second_ns = c->stats.start_ns;
    if (c->options.terminal)
        cockpit_view_begin();
    while (!c->quit) {
        const int n = epoll_wait(c->poll, events, 8, 1000);
        for (int i = 0; i < n && !c->quit; i++)
            hear(c, events[i].data.u32);
        if (n < 0 && errno != EINTR) {
            c->status = fail_job(COCKPIT ": %s", strerror(errno));
            break;
        }
    }
    if (c->options.terminal)
        cockpit_view_end();
    if (c->snapshot > 0)
        waitpid(c->snapshot, NULL, 0);
    return c->status ? c->status : c->bus.status;
}
