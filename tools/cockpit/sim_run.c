#include "sim_run.h"

#include <errno.h>
#include <poll.h>
#include <string.h>
#include <sys/timerfd.h>
#include <time.h>
#include <unistd.h>

#include "sim.h"

#define SECOND ((int64_t)1000000000)

typedef struct loop {
    sim_bus *bus;
    const sim_task *task;
    int timer, signals;
    bool terminal;
    int64_t show_ns;
} loop;

static sim_now now_of(void) {
    struct timespec t;
    clock_gettime(CLOCK_REALTIME, &t);
    return (sim_now){sim_mono_ns(), (int64_t)t.tv_sec * SECOND + t.tv_nsec};
}

static void wipe(const loop *l) {
    if (l->terminal)
        fputs("\r\033[K", stderr);
}

static void show(loop *l, int64_t now_ns) {
    char text[160];
    if (!l->terminal || now_ns < l->show_ns)
        return;
    l->show_ns = now_ns + SECOND;
    l->task->show(l->task->self, text, sizeof text);
    fprintf(stderr, "\r\033[K%.78s", text);
}

/// One round. @return false iff the task is done
static bool work(loop *l) {
    const sim_now now = now_of();
    sim_bus_receive(l->bus, now, l->task->heard, l->task->self);
    const int64_t bus_ns = sim_bus_tick(l->bus, now.mono_ns);
    const int64_t task_ns = l->task->tick(l->task->self, now.mono_ns);
    show(l, now.mono_ns);
    if (task_ns == 0)
        return false;
    const int64_t next = task_ns < bus_ns ? task_ns : bus_ns;
    const int64_t at = next > now.mono_ns ? next : now.mono_ns + 1;
    const struct itimerspec when = {.it_value = {(time_t)(at / SECOND), (long)(at % SECOND)}};
    timerfd_settime(l->timer, TFD_TIMER_ABSTIME, &when, NULL);
    return true;
}

/// @return false iff a signal came or waiting failed
static bool wait_for_events(const loop *l) {
    struct pollfd fds[] = {{.fd = l->signals, .events = POLLIN},
                           {.fd = l->timer, .events = POLLIN},
                           {.fd = skv_can_fd(l->bus->bus), .events = POLLIN},
                           {.fd = skv_can_event_fd(l->bus->bus), .events = POLLIN}};
    uint64_t expired;
    if (poll(fds, 4, -1) < 0)
        return errno == EINTR;
    if (fds[1].revents)
        (void)!read(l->timer, &expired, sizeof expired);
    if (fds[3].revents && skv_can_events(l->bus->bus) > 0)
        sim_bus_look(l->bus, sim_mono_ns());
    return !fds[0].revents;
}

int sim_run(sim_bus *bus, const sim_task *task) {
    loop l = {.bus = bus, .task = task, .terminal = isatty(STDERR_FILENO) == 1};
    sim_hold_signals();
    l.signals = sim_signal_fd();
    l.timer = timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK | TFD_CLOEXEC);
    int status = 0;
    if (l.signals < 0 || l.timer < 0)
        status = fail_job(SIM ": no timer or signal descriptor: %s", strerror(errno));
    else
        task->begin(task->self, sim_mono_ns());
    while (status == 0 && work(&l) && wait_for_events(&l))
        ;
    wipe(&l);
    if (l.signals >= 0)
        close(l.signals);
    if (l.timer >= 0)
        close(l.timer);
    return status;
}
