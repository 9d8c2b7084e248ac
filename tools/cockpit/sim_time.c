/// The clock that nobody sets, and signals that wait until they are asked for.
#include <errno.h>
#include <signal.h>
#include <sys/signalfd.h>
#include <time.h>

#include "sim.h"

int64_t sim_mono_ns(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (int64_t)t.tv_sec * 1000000000 + t.tv_nsec;
}

static sigset_t held(void) {
    static const int ends[] = {SIGINT, SIGTERM, SIGHUP};
    sigset_t set;
    sigemptyset(&set);
    for (size_t i = 0; i < sizeof ends / sizeof ends[0]; i++) {
        struct sigaction action;
        sigaction(ends[i], NULL, &action);
        if (action.sa_handler != SIG_IGN) // nohup
            sigaddset(&set, ends[i]);
    }
    return set;
}

void sim_hold_signals(void) {
    const sigset_t set = held();
    sigprocmask(SIG_BLOCK, &set, NULL);
}

int sim_wait_until(int64_t mono_ns) {
    const sigset_t set = held();
    for (;;) {
        const int64_t left = mono_ns - sim_mono_ns();
        const int64_t ns = left > 0 ? left : 0;
        const struct timespec wait = {(time_t)(ns / 1000000000), (long)(ns % 1000000000)};
        const int got = sigtimedwait(&set, NULL, &wait);
        if (got > 0)
            return got;
        if (errno != EINTR || left <= 0)
            return 0;
    }
}

int sim_signal_fd(void) {
    const sigset_t set = held();
    return signalfd(-1, &set, SFD_NONBLOCK | SFD_CLOEXEC);
}
