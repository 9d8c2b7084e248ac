// The port on a kernel with CAN, as root: socket_check IP, where IP is iproute2's program; can0 and can1 are
// controllers on one bus and up. Each check prints its name; exit status 1 at the first that fails, 3 without CAN.
#define _GNU_SOURCE
#include <errno.h>
#include <fcntl.h>
#include <linux/can.h>
#include <net/if.h>
#include <poll.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

#include "port/canaerospace/skv_canaerospace.h"
#include "port/socketcan/skv_socketcan.h"

static const char *ip_program;
static const char *check = "start";

#define NEED(condition, ...)                                                                                           \
    do {                                                                                                               \
        if (!(condition))                                                                                              \
            failed(__LINE__, #condition, __VA_ARGS__);                                                                 \
    } while (0)

static void failed(int line, const char *condition, const char *format, ...) {
    va_list list;
    va_start(list, format);
    printf("FAIL: %s, line %d: %s: ", check, line, condition);
    vprintf(format, list);
    printf("\n");
    va_end(list);
    exit(1);
}

static void passed(const char *name) {
    printf("pass: %s\n", name);
    fflush(stdout);
}

static int64_t clock_ns(clockid_t id) {
    struct timespec t;
    clock_gettime(id, &t);
    return (int64_t)t.tv_sec * 1000000000 + t.tv_nsec;
}

static void ip(const char *format, ...) {
    char line[256];
    va_list list;
    int n = snprintf(line, sizeof line, "%s ", ip_program);
    va_start(list, format);
    vsnprintf(line + n, sizeof line - (size_t)n, format, list);
    va_end(list);
    NEED(system(line) == 0, "%s", line);
}

static int wait_for(int fd, short events, int ms) {
    struct pollfd p = {.fd = fd, .events = events};
    return poll(&p, 1, ms);
}

static skv_can_bus *open_bus(const char *interface, const skv_can_options *options) {
    skv_can_bus *bus = NULL;
    int error = 0;
    const skv_can_status s = skv_socketcan_open(&bus, interface, options, &error);
    NEED(s == SKV_CAN_OK, "%s: %s, errno %d", interface, skv_can_status_text(s), error);
    return bus;
}

// One frame within a time; 0 = none came.
static int one(skv_can_bus *bus, skv_can_received *r, int ms) {
    const int64_t end = clock_ns(CLOCK_MONOTONIC) + ms * 1000000ll;
    for (int n; clock_ns(CLOCK_MONOTONIC) < end;) {
        (void)wait_for(skv_can_fd(bus), POLLIN, ms);
        n = skv_can_receive(bus, r, 1);
        NEED(n >= 0, "receive: %s", skv_can_status_text((skv_can_status)n));
        if (n)
            return 1;
    }
    return 0;
}

static skv_can_frame frame_of(uint32_t id, uint8_t code) {
    return (skv_can_frame){id, 8, 0, {1, 2, 0, code, 0x42, 0x3E, 0, 0}};
}

static const skv_can_options everything = {.receive_all = 1, .receive_errors = 1};

static void raw_and_filters(const char *from, const char *to) {
    const skv_can_filter filter = {1036, 0x7FF, 0};
    const skv_can_options filtered = {.filters = &filter, .n_filters = 1};
    skv_can_bus *a = open_bus(from, NULL), *b = open_bus(to, &filtered), *c = open_bus(to, &everything);
    skv_can_frame plain = frame_of(1036, 0), other = frame_of(1037, 0), remote = {1036, 0, SKV_CAN_RTR, {0}};
    skv_can_frame extended = frame_of(1036, 0);
    skv_can_received r;
    extended.flags = SKV_CAN_EXTENDED;
    const skv_can_frame *all[] = {&other, &remote, &extended, &plain};
    for (int i = 0; i < 4; i++)
        NEED(skv_can_send(a, all[i]) == SKV_CAN_OK, "send %d: errno %d", i, skv_can_errno(a));
    for (int i = 0; i < 4; i++) {
        NEED(one(c, &r, 2000), "frame %d of 4 on %s", i, to);
        NEED(memcmp(&r.frame, all[i], sizeof r.frame) == 0, "frame %d is another: id %X flags %d", i,
             (unsigned)r.frame.id, r.frame.flags);
    }
    NEED(one(b, &r, 2000) && r.frame.id == 1036 && r.frame.flags == 0, "filtered: id %u", (unsigned)r.frame.id);
    NEED(!one(b, &r, 100), "another frame passed the filter: %X flags %d", (unsigned)r.frame.id, r.frame.flags);
    skv_can_close(a);
    skv_can_close(b);
    skv_can_close(c);
}

static void time_stamps(void) {
    skv_can_bus *a = open_bus("vcan0", NULL), *b = open_bus("vcan0", &everything);
    skv_can_received r;
    const skv_can_frame f = frame_of(1, 0);
    const int64_t before = clock_ns(CLOCK_REALTIME);
    NEED(skv_can_send(a, &f) == SKV_CAN_OK, "send");
    usleep(50000); // the stamp is of the frame's arrival, not of the reading
    NEED(one(b, &r, 2000), "no frame");
    NEED(r.time_ns >= before && r.time_ns < before + 40000000, "stamp %lld ns after the send",
         (long long)(r.time_ns - before));
    printf("figure: CAN: kernel time stamp %.0f us after the send, hardware stamp %s\n",
           (double)(r.time_ns - before) / 1e3, r.hardware_ns ? "there" : "not there");
    skv_can_close(a);
    skv_can_close(b);
}

static void own_frames(void) {
    const skv_can_options own = {.receive_all = 1, .receive_own = 1};
    skv_can_bus *a = open_bus("vcan0", &own), *b = open_bus("vcan0", &everything);
    skv_can_received r;
    const skv_can_frame f = frame_of(1, 0);
    NEED(skv_can_send(a, &f) == SKV_CAN_OK && one(a, &r, 2000) && r.own, "own frame, marked %d", r.own);
    NEED(one(b, &r, 2000) && !r.own, "marked %d", r.own);
    NEED(skv_can_send(b, &f) == SKV_CAN_OK && one(a, &r, 2000) && !r.own, "another's frame, marked %d", r.own);
    NEED(!one(b, &r, 50), "own frame unasked");
    skv_can_close(a);
    skv_can_close(b);
}

// An error frame as a driver would make it; only a raw socket by hand may send one.
static void error_frames(void) {
    skv_can_bus *a = open_bus("vcan0", &everything), *b = open_bus("vcan0", &(skv_can_options){.receive_all = 1});
    const struct can_frame bus_off = {.can_id = CAN_ERR_FLAG | 0x40, .can_dlc = 8};
    const struct sockaddr_can address = {.can_family = AF_CAN, .can_ifindex = (int)if_nametoindex("vcan0")};
    const int raw = socket(PF_CAN, SOCK_RAW, CAN_RAW);
    skv_can_received r;
    NEED(bind(raw, (const struct sockaddr *)&address, sizeof address) == 0, "bind: %d", errno);
    NEED(write(raw, &bus_off, sizeof bus_off) == sizeof bus_off, "write: %d", errno);
    NEED(one(a, &r, 2000) && skv_can_error_says(&r.frame) == SKV_CAN_SAYS_BUS_OFF, "says %X",
         skv_can_error_says(&r.frame));
    NEED(!one(b, &r, 50), "error frame unasked");
    NEED(skv_can_get_counts(a).error_frames == 1, "counted %llu",
         (unsigned long long)skv_can_get_counts(a).error_frames);
    close(raw);
    skv_can_close(a);
    skv_can_close(b);
}

static void drops(void) {
    const skv_can_options small = {.receive_all = 1, .receive_bytes = 20000};
    skv_can_bus *a = open_bus("vcan0", NULL), *b = open_bus("vcan0", &small);
    skv_can_received r[64];
    const skv_can_frame f = frame_of(1, 0);
    for (int i = 0; i < 2000; i++)
        NEED(skv_can_send(a, &f) == SKV_CAN_OK, "send %d", i);
    while (skv_can_receive(b, r, 64) > 0)
        ;
    NEED(skv_can_send(a, &f) == SKV_CAN_OK && one(b, r, 2000), "the frame that tells of the drops");
    const skv_can_counts c = skv_can_get_counts(b);
    printf("figure: CAN: %llu of 2001 frames dropped by a full buffer, each counted\n", (unsigned long long)c.dropped);
    NEED(c.dropped > 0 && c.dropped + c.received == 2001, "received %llu, dropped %llu", (unsigned long long)c.received,
         (unsigned long long)c.dropped);
    skv_can_close(a);
    skv_can_close(b);
}

static int by_size(const void *a, const void *b) {
    const int64_t x = *(const int64_t *)a, y = *(const int64_t *)b;
    return (x > y) - (x < y);
}

// 100 ms for 6 s, data changed every 37 ms: the codes go on, the period holds. Then silence, which the kernel notices.
static void cyclic(const char *from, const char *to) {
    skv_can_bus *a = open_bus(from, NULL), *b = open_bus(to, &everything);
    skv_can_cyclic c = {frame_of(1036, 230), 100000, 3};
    skv_can_received r;
    int64_t stamp[60], gap[59];
    uint32_t late[4];
    NEED(skv_can_watch(b, 1036, 300) == SKV_CAN_OK, "watch: errno %d", skv_can_errno(b));
    NEED(skv_can_cyclic_start(a, &c) == SKV_CAN_OK, "start: errno %d", skv_can_errno(a));
    for (int n = 0; n < 60;) {
        c.frame.data[7] = (uint8_t)n;
        NEED(skv_can_cyclic_update(a, &c.frame) == SKV_CAN_OK, "update: errno %d", skv_can_errno(a));
        (void)wait_for(skv_can_fd(b), POLLIN, 37);
        if (skv_can_receive(b, &r, 1) != 1)
            continue;
        NEED(r.frame.data[3] == ((230 + n) & 255), "code %d, want %d", r.frame.data[3], (230 + n) & 255);
        NEED(r.frame.data[7] + 1 >= n, "data of %d at %d", r.frame.data[7], n);
        stamp[n++] = r.time_ns;
    }
    for (int i = 0; i < 59; i++)
        gap[i] = stamp[i + 1] - stamp[i];
    qsort(gap, 59, sizeof gap[0], by_size);
    const double mean = (double)(stamp[59] - stamp[0]) / 59e6;
    printf("figure: CAN_BCM %s: 60 frames every 100 ms: mean %.3f ms, shortest %.2f, median %.2f, longest %.2f, data "
           "changed "
           "every 37 ms\n",
           from, mean, (double)gap[0] / 1e6, (double)gap[29] / 1e6, (double)gap[58] / 1e6);
    // The kernel counts each period from the frame before, so its delays add up: never early (1 ms: the stamp's own
    // jitter), and late by what an emulated board on a busy machine may take. An update that began the period anew
    // would be early.
    NEED(gap[0] > 99000000 - (gap[58] - 100000000) && mean > 99.5 && mean < 130.0, "shortest %.3f, mean %.3f ms",
         (double)gap[0] / 1e6, mean);
    NEED(skv_can_timeouts(b, late, 4) == 0, "a timeout while frames came");
    NEED(skv_can_cyclic_stop(a, 1036, 0) == SKV_CAN_OK, "stop: errno %d", skv_can_errno(a));
    NEED(wait_for(skv_can_timeout_fd(b), POLLIN, 2000) == 1, "no timeout");
    NEED(skv_can_timeouts(b, late, 4) == 1 && late[0] == 1036, "which id timed out");
    while (skv_can_receive(b, &r, 1) == 1)
        ;
    NEED(!one(b, &r, 250), "frames after the stop");
    skv_can_close(a);
    skv_can_close(b);
}

static int drain_until_down(skv_can_bus *bus) {
    skv_can_received r;
    for (int i = 0; i < 100; i++) {
        const int n = skv_can_receive(bus, &r, 1);
        if (n < 0)
            return n;
        if (n == 0)
            (void)wait_for(skv_can_fd(bus), POLLIN, 50);
    }
    return 0;
}

static void down_and_up(const char *from, const char *to) {
    skv_can_bus *a = open_bus(from, NULL), *b = open_bus(to, &everything);
    const skv_can_cyclic c = {frame_of(1037, 0), 20000, 3};
    const skv_can_frame f = frame_of(1, 0);
    skv_can_received r;
    skv_can_state s;
    NEED(skv_can_cyclic_start(a, &c) == SKV_CAN_OK && one(b, &r, 2000), "cyclic before");
    (void)skv_can_events(b);
    ip("link set %s down", to);
    int n = drain_until_down(b);
    NEED(n == SKV_CAN_DOWN, "receive: %s", skv_can_status_text((skv_can_status)n));
    NEED(wait_for(skv_can_event_fd(b), POLLIN, 2000) == 1 && skv_can_events(b) > 0, "no event");
    NEED(skv_can_get_state(b, &s) == SKV_CAN_OK && s.present && !s.up, "present %d up %d", s.present, s.up);
    NEED(skv_can_send(b, &f) == SKV_CAN_DOWN, "send: errno %d", skv_can_errno(b));
    ip("link set %s up", to);
    NEED(wait_for(skv_can_event_fd(b), POLLIN, 2000) == 1 && skv_can_events(b) > 0, "no event of up");
    NEED(skv_can_get_state(b, &s) == SKV_CAN_OK && s.up, "up %d", s.up);
    NEED(one(b, &r, 2000) && r.frame.id == 1037, "cyclic frames do not come back");
    NEED(skv_can_send(b, &f) == SKV_CAN_OK, "send: errno %d", skv_can_errno(b));
    skv_can_frame changed = c.frame;
    changed.data[7] = 99;
    NEED(skv_can_cyclic_update(a, &changed) == SKV_CAN_OK, "update after down: errno %d", skv_can_errno(a));
    for (int i = 0; i < 100 && r.frame.data[7] != 99; i++)
        NEED(one(b, &r, 2000), "no frame");
    NEED(r.frame.data[7] == 99, "the update is not sent");
    skv_can_close(a);
    skv_can_close(b);
}

static void gone(void) {
    skv_can_state s;
    ip("link add vcan9 type vcan");
    ip("link set vcan9 up");
    skv_can_bus *a = open_bus("vcan9", &everything);
    const skv_can_frame f = frame_of(1, 0);
    ip("link del vcan9");
    const int n = drain_until_down(a);
    NEED(n == SKV_CAN_GONE || n == SKV_CAN_DOWN, "receive: %d", n);
    const skv_can_status sent = skv_can_send(a, &f);
    NEED(sent == SKV_CAN_GONE, "send: %s, errno %d", skv_can_status_text(sent), skv_can_errno(a));
    NEED(skv_can_get_state(a, &s) == SKV_CAN_OK && !s.present, "present %d", s.present);
    skv_can_bus *none = NULL;
    NEED(skv_socketcan_open(&none, "vcan9", NULL, NULL) == SKV_CAN_NO_INTERFACE, "opened again");
    NEED(skv_socketcan_open(&none, "lo", NULL, NULL) == SKV_CAN_NO_INTERFACE, "lo is no CAN");
    skv_can_close(a);
}

static void controller(void) {
    skv_can_bus *a = open_bus("can0", NULL);
    skv_can_state s;
    NEED(skv_can_get_state(a, &s) == SKV_CAN_OK, "state");
    printf("note: can0: controller %d, bitrate %u, restart-ms %u, errors %u %u\n", s.controller, (unsigned)s.bitrate,
           (unsigned)s.restart_ms, s.tx_errors, s.rx_errors);
    NEED(s.up && s.controller == SKV_CAN_ACTIVE && s.bitrate == 500000 && s.restart_ms == 100, "not as set up");
    NEED(skv_can_restart(a) == SKV_CAN_BAD_ARGUMENT, "restart of a controller that is well: errno %d",
         skv_can_errno(a));
    skv_can_close(a);
}

static char adapter[IFNAMSIZ]; // its interface

// A serial CAN adapter on a pseudo-terminal whose other end is this program. @return the other end.
static int attach_adapter(int *line) {
    const int discipline = 17; // N_SLCAN
    struct ifreq request;
    const int master = posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK);
    NEED(master >= 0 && grantpt(master) == 0 && unlockpt(master) == 0, "pty: %d", errno);
    *line = open(ptsname(master), O_RDWR | O_NOCTTY);
    NEED(*line >= 0 && ioctl(*line, TIOCSETD, &discipline) == 0, "slcan: %d", errno);
    memset(&request, 0, sizeof request);
    NEED(ioctl(*line, SIOCGIFNAME, request.ifr_name) == 0, "name: %d", errno);
    snprintf(adapter, sizeof adapter, "%s", request.ifr_name);
    ip("link set %s txqueuelen 10", adapter);
    ip("link set %s up", adapter);
    return master;
}

static void say(int master, const char *text) {
    NEED(write(master, text, strlen(text)) == (ssize_t)strlen(text), "write: %d", errno);
}

static skv_can_status fill(skv_can_bus *bus) {
    const skv_can_frame f = frame_of(1, 0);
    for (int i = 0; i < 20000; i++) {
        const skv_can_status s = skv_can_send(bus, &f);
        if (s != SKV_CAN_OK)
            return s;
    }
    return SKV_CAN_OK;
}

static void empty(int master) {
    char bytes[4096];
    for (int quiet = 0; quiet < 3;) {
        if (wait_for(master, POLLIN, 50) == 1 && read(master, bytes, sizeof bytes) > 0)
            quiet = 0;
        else
            quiet++;
    }
}

// Nobody reads the adapter's line: first the interface's queue is full, or a small socket's buffer before it.
static void full_queues(int master) {
    const skv_can_options small = {.send_bytes = 1};
    skv_can_bus *a = open_bus(adapter, NULL), *b = open_bus(adapter, &small);
    const skv_can_frame f = frame_of(1, 0);
    skv_can_status s = fill(a);
    NEED(s == SKV_CAN_QUEUE_FULL, "a full queue: %s", skv_can_status_text(s));
    NEED(skv_can_get_counts(a).queue_full == 1, "not counted");
    empty(master);
    NEED(skv_can_send(a, &f) == SKV_CAN_OK, "after emptying: errno %d", skv_can_errno(a));
    s = fill(b);
    NEED(s == SKV_CAN_AGAIN, "a full socket: %s", skv_can_status_text(s));
    empty(master);
    NEED(wait_for(skv_can_fd(b), POLLOUT, 2000) == 1 && skv_can_send(b, &f) == SKV_CAN_OK, "after emptying: errno %d",
         skv_can_errno(b));
    skv_can_close(a);
    skv_can_close(b);
}

// The adapter reports warning, then bus-off; the interface is set down and up and works again.
static void bus_off(int master) {
    skv_can_bus *a = open_bus(adapter, &everything);
    skv_can_received r;
    skv_can_state s;
    const skv_can_frame f = frame_of(1, 0);
    say(master, "t32130102FF\r");
    NEED(one(a, &r, 2000) && r.frame.id == 0x321 && r.frame.length == 3, "frame of the adapter: id %X",
         (unsigned)r.frame.id);
    say(master, "sw096000\r");
    NEED(one(a, &r, 2000) && skv_can_error_says(&r.frame) & SKV_CAN_SAYS_WARNING, "warning: says %X",
         skv_can_error_says(&r.frame));
    NEED(skv_can_get_state(a, &s) == SKV_CAN_OK && s.controller == SKV_CAN_WARNING, "controller %d", s.controller);
    (void)skv_can_events(a);
    say(master, "sb256000\r");
    NEED(one(a, &r, 2000) && skv_can_error_says(&r.frame) & SKV_CAN_SAYS_BUS_OFF, "bus-off: says %X",
         skv_can_error_says(&r.frame));
    NEED(wait_for(skv_can_event_fd(a), POLLIN, 3000) == 1 && skv_can_events(a) > 0, "no event of bus-off");
    NEED(skv_can_get_state(a, &s) == SKV_CAN_OK && s.controller == SKV_CAN_BUS_OFF, "controller %d", s.controller);
    // A send may say that all is well though the kernel throws the frame away: this is how it is, and the header says
    // so.
    const skv_can_status sent = skv_can_send(a, &f), again = skv_can_restart(a);
    printf("note: bus-off: a send says: %s; restart by the program on slcan: %s\n", skv_can_status_text(sent),
           skv_can_status_text(again));
    ip("link set %s down", adapter);
    ip("link set %s up", adapter);
    NEED(skv_can_get_state(a, &s) == SKV_CAN_OK && s.controller == SKV_CAN_ACTIVE, "controller %d", s.controller);
    (void)drain_until_down(a);
    say(master, "t3210\r");
    NEED(one(a, &r, 2000) && r.frame.id == 0x321, "no frame after bus-off");
    NEED(skv_can_send(a, &f) == SKV_CAN_OK, "send after bus-off: errno %d", skv_can_errno(a));
    skv_can_close(a);
}

#define RUN(name, call)                                                                                                \
    do {                                                                                                               \
        check = name;                                                                                                  \
        call;                                                                                                          \
        passed(name);                                                                                                  \
    } while (0)

int main(int argc, char **argv) {
    int line;
    if (skv_socketcan_available() == SKV_CAN_UNAVAILABLE) {
        fprintf(stderr, "socket_check: %s\n", skv_can_status_text(SKV_CAN_UNAVAILABLE));
        return 3;
    }
    if (argc != 2)
        return 2;
    ip_program = argv[1];
    ip("link add vcan0 type vcan");
    ip("link set vcan0 up");
    RUN("raw sockets and filters on vcan0", raw_and_filters("vcan0", "vcan0"));
    RUN("raw sockets and filters from can0 to can1", raw_and_filters("can0", "can1"));
    RUN("time stamps", time_stamps());
    RUN("own frames", own_frames());
    RUN("error frames", error_frames());
    RUN("drops are counted", drops());
    RUN("cyclic sending on vcan0", cyclic("vcan0", "vcan0"));
    RUN("cyclic sending from can0 to can1", cyclic("can0", "can1"));
    RUN("vcan0 down and up", down_and_up("vcan0", "vcan0"));
    RUN("can1 down and up", down_and_up("can0", "can1"));
    RUN("an interface that goes", gone());
    RUN("state of a controller", controller());
    const int master = attach_adapter(&line);
    RUN("full queues", full_queues(master));
    RUN("bus-off", bus_off(master));
    close(line);
    close(master);
    return 0;
}
