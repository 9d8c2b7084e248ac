// CAN_RAW: opening, receiving in batches with time stamps, sending.
#define _GNU_SOURCE // recvmmsg
#include "skv_socketcan.h"

#include <errno.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <linux/net_tstamp.h>
#include <net/if.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

#include "private.h"

#define BATCH 32 // frames a system call

skv_can_status skv_socketcan_failed(skv_socketcan *s, int error) {
    s->bus.last_errno = error;
    switch (error) {
    case ENOBUFS:
        return SKV_CAN_QUEUE_FULL;
    case EAGAIN:
        return SKV_CAN_AGAIN;
    case ENETDOWN:
        return SKV_CAN_DOWN;
    case ENODEV:
    case ENXIO:
        return SKV_CAN_GONE;
    case EAFNOSUPPORT:
    case EPROTONOSUPPORT:
        return SKV_CAN_UNAVAILABLE;
    case EPERM:
    case EACCES:
        return SKV_CAN_DENIED;
    case ENOMEM:
        return SKV_CAN_NO_MEMORY;
    default:
        return SKV_CAN_SYSTEM;
    }
}

void skv_socketcan_to_kernel(struct can_frame *to, const skv_can_frame *from) {
    memset(to, 0, sizeof *to);
    to->can_id =
        from->id | (from->flags & SKV_CAN_EXTENDED ? CAN_EFF_FLAG : 0) | (from->flags & SKV_CAN_RTR ? CAN_RTR_FLAG : 0);
    to->can_dlc = from->length;
    memcpy(to->data, from->data, from->length);
}

void skv_socketcan_from_kernel(skv_can_frame *to, const struct can_frame *from) {
    memset(to, 0, sizeof *to);
    if (from->can_id & CAN_ERR_FLAG) {
        to->flags = SKV_CAN_ERROR;
        to->id = from->can_id & CAN_ERR_MASK;
    } else {
        to->flags = (uint8_t)((from->can_id & CAN_EFF_FLAG ? SKV_CAN_EXTENDED : 0u) |
                              (from->can_id & CAN_RTR_FLAG ? SKV_CAN_RTR : 0u));
        to->id = from->can_id & (from->can_id & CAN_EFF_FLAG ? CAN_EFF_MASK : CAN_SFF_MASK);
    }
    to->length = from->can_dlc > 8 ? 8 : from->can_dlc;
    if (!(to->flags & SKV_CAN_RTR))
        memcpy(to->data, from->data, to->length);
}

static int raw_fd(const skv_can_bus *bus) {
    return ((const skv_socketcan *)(const void *)bus)->raw;
}

// ---------------------------------------------------------------------------------------------------- receiving

static int64_t ns_of(const struct timespec *t) {
    return (int64_t)t->tv_sec * 1000000000 + t->tv_nsec;
}

// Time stamps and the count of drops, from the ancillary data of one frame.
static void read_control(skv_socketcan *s, struct msghdr *message, skv_can_received *to) {
    for (struct cmsghdr *c = CMSG_FIRSTHDR(message); c; c = CMSG_NXTHDR(message, c)) {
        if (c->cmsg_level != SOL_SOCKET)
            continue;
        if (c->cmsg_type == SCM_TIMESTAMPING) { // [0] the kernel's, [2] the controller's
            struct timespec stamp[3];
            memcpy(stamp, CMSG_DATA(c), sizeof stamp);
            to->time_ns = ns_of(&stamp[0]);
            to->hardware_ns = ns_of(&stamp[2]);
        } else if (c->cmsg_type == SCM_TIMESTAMPNS) {
            struct timespec stamp;
            memcpy(&stamp, CMSG_DATA(c), sizeof stamp);
            to->time_ns = ns_of(&stamp);
        } else if (c->cmsg_type == SO_RXQ_OVFL) {
            uint32_t drops;
            memcpy(&drops, CMSG_DATA(c), sizeof drops);
            s->bus.counts.dropped += (uint32_t)(drops - s->overflow);
            s->overflow = drops;
        }
    }
}

typedef struct batch {
    struct can_frame frame[BATCH];
    struct iovec part[BATCH];
    struct mmsghdr message[BATCH];
    union {
        size_t aligned;
        char bytes[CMSG_SPACE(3 * sizeof(struct timespec)) + CMSG_SPACE(sizeof(uint32_t)) + 32];
    } control[BATCH];
} batch;

// One system call. Frames go to `to`; fewer than n may be read though more wait.
static int receive_batch(skv_socketcan *s, skv_can_received *to, int n) {
    batch b;
    n = n > BATCH ? BATCH : n;
    for (int i = 0; i < n; i++) {
        b.part[i] = (struct iovec){&b.frame[i], sizeof b.frame[i]};
        b.message[i] = (struct mmsghdr){.msg_hdr = {.msg_iov = &b.part[i],
                                                    .msg_iovlen = 1,
                                                    .msg_control = &b.control[i],
                                                    .msg_controllen = sizeof b.control[i]}};
    }
    const int got = recvmmsg(s->raw, b.message, (unsigned)n, MSG_DONTWAIT, NULL);
    if (got < 0)
        return errno == EAGAIN || errno == EINTR ? 0 : (int)skv_socketcan_failed(s, errno);
    int frames = 0;
    for (int i = 0; i < got; i++) {
        if (b.message[i].msg_len != sizeof(struct can_frame))
            continue;
        skv_can_received *r = &to[frames++];
        memset(r, 0, sizeof *r);
        skv_socketcan_from_kernel(&r->frame, &b.frame[i]);
        r->own = (b.message[i].msg_hdr.msg_flags & MSG_CONFIRM) != 0;
        read_control(s, &b.message[i].msg_hdr, r);
    }
    return frames;
}

static int raw_receive(skv_can_bus *bus, skv_can_received *frames, int n) {
    skv_socketcan *s = (skv_socketcan *)(void *)bus;
    int got = 0;
    while (got < n) {
        const int more = receive_batch(s, frames + got, n - got);
        if (more < 0) // told at the next call, if frames came before it
            return got ? got : more;
        got += more;
        if (more < BATCH)
            break;
    }
    return got;
}

static skv_can_status raw_send(skv_can_bus *bus, const skv_can_frame *frame) {
    skv_socketcan *s = (skv_socketcan *)(void *)bus;
    struct can_frame to;
    skv_socketcan_to_kernel(&to, frame);
    if (send(s->raw, &to, sizeof to, MSG_DONTWAIT) == (ssize_t)sizeof to)
        return SKV_CAN_OK;
    return skv_socketcan_failed(s, errno);
}

// ------------------------------------------------------------------------------------------------------ opening

// Which frames pass: both flag bits stand in the mask, or remote and extended frames would slip through.
static int set_filters(int fd, const skv_can_options *o) {
    struct can_filter filter[SKV_CAN_MAX_FILTERS] = {{0, 0}};
    const size_t n = o->receive_all ? 1 : o->n_filters; // {0, 0} lets everything through
    for (size_t i = 0; i < n && !o->receive_all; i++) {
        const skv_can_filter *f = &o->filters[i];
        const canid_t all = f->flags & SKV_CAN_EXTENDED ? CAN_EFF_MASK : CAN_SFF_MASK;
        filter[i].can_id = (f->id & all) | (f->flags & SKV_CAN_EXTENDED ? CAN_EFF_FLAG : 0) |
                           (f->flags & SKV_CAN_RTR ? CAN_RTR_FLAG : 0);
        filter[i].can_mask = (f->mask & all) | CAN_EFF_FLAG | CAN_RTR_FLAG;
    }
    return setsockopt(fd, SOL_CAN_RAW, CAN_RAW_FILTER, n ? filter : NULL, (socklen_t)(n * sizeof filter[0]));
}

static int set_int(int fd, int level, int name, int value) {
    return setsockopt(fd, level, name, &value, sizeof value);
}

// The best time stamps there are. Older kernels have only the second kind.
static void set_stamps(int fd) {
    const int wanted = SOF_TIMESTAMPING_RX_HARDWARE | SOF_TIMESTAMPING_RAW_HARDWARE | SOF_TIMESTAMPING_RX_SOFTWARE |
                       SOF_TIMESTAMPING_SOFTWARE;
    if (set_int(fd, SOL_SOCKET, SO_TIMESTAMPING, wanted))
        (void)set_int(fd, SOL_SOCKET, SO_TIMESTAMPNS, 1);
}

static int set_options(int fd, const skv_can_options *o) {
    const can_err_mask_t errors = o->receive_errors ? CAN_ERR_MASK : 0;
    if (set_filters(fd, o) || setsockopt(fd, SOL_CAN_RAW, CAN_RAW_ERR_FILTER, &errors, sizeof errors) ||
        set_int(fd, SOL_CAN_RAW, CAN_RAW_RECV_OWN_MSGS, o->receive_own))
        return -1;
    set_stamps(fd);
    (void)set_int(fd, SOL_SOCKET, SO_RXQ_OVFL, 1);
    // Beyond the system's limit only root may go; the system cuts it silently.
    if (o->receive_bytes > 0 && set_int(fd, SOL_SOCKET, SO_RCVBUFFORCE, o->receive_bytes))
        (void)set_int(fd, SOL_SOCKET, SO_RCVBUF, o->receive_bytes);
    if (o->send_bytes > 0)
        (void)set_int(fd, SOL_SOCKET, SO_SNDBUF, o->send_bytes);
    return 0;
}

static void raw_close(skv_can_bus *bus) {
    skv_socketcan *s = (skv_socketcan *)(void *)bus;
    const int fds[] = {s->raw, s->cyclic, s->watch, s->link};
    for (int i = 0; i < 4; i++)
        if (fds[i] >= 0)
            close(fds[i]);
    free(s);
}

static const skv_can_ops ops = {
    .fd = raw_fd,
    .receive = raw_receive,
    .send = raw_send,
    .cyclic_start = skv_socketcan_cyclic_start,
    .cyclic_update = skv_socketcan_cyclic_update,
    .cyclic_stop = skv_socketcan_cyclic_stop,
    .state = skv_socketcan_state,
    .restart = skv_socketcan_restart,
    .watch = skv_socketcan_watch,
    .timeouts = skv_socketcan_timeouts,
    .event_fd = skv_socketcan_event_fd,
    .timeout_fd = skv_socketcan_timeout_fd,
    .events = skv_socketcan_events,
    .close = raw_close,
};

static int raw_socket(void) {
    return socket(PF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW);
}

skv_can_status skv_socketcan_available(void) {
    skv_socketcan none = {0};
    const int fd = raw_socket();
    if (fd < 0)
        return skv_socketcan_failed(&none, errno);
    close(fd);
    return SKV_CAN_OK;
}

static skv_can_status open_raw(skv_socketcan *s, const skv_can_options *options) {
    s->raw = raw_socket();
    if (s->raw < 0)
        return skv_socketcan_failed(s, errno);
    s->index = (int)if_nametoindex(s->name);
    struct sockaddr_can address = {.can_family = AF_CAN, .can_ifindex = s->index};
    if (s->index == 0) {
        s->bus.last_errno = ENODEV;
        return SKV_CAN_NO_INTERFACE;
    }
    if (set_options(s->raw, options))
        return skv_socketcan_failed(s, errno);
    if (bind(s->raw, (struct sockaddr *)&address, sizeof address)) {
        const skv_can_status status = skv_socketcan_failed(s, errno);
        return status == SKV_CAN_GONE ? SKV_CAN_NO_INTERFACE : status;
    }
    s->link = skv_socketcan_link_open();
    return SKV_CAN_OK;
}

skv_can_status skv_socketcan_open(skv_can_bus **bus, const char *interface, const skv_can_options *options,
                                  int *error) {
    static const skv_can_options send_only = {0};
    if (bus)
        *bus = NULL;
    if (!options)
        options = &send_only;
    if (!bus || !interface || !interface[0] || strlen(interface) > 15 || options->n_filters > SKV_CAN_MAX_FILTERS ||
        (options->n_filters && !options->filters))
        return SKV_CAN_BAD_ARGUMENT;
    skv_socketcan *s = calloc(1, sizeof *s);
    if (!s)
        return SKV_CAN_NO_MEMORY;
    s->bus.ops = &ops;
    s->raw = s->cyclic = s->watch = s->link = -1;
    memcpy(s->name, interface, strlen(interface) + 1);
    const skv_can_status status = open_raw(s, options);
    if (error)
        *error = s->bus.last_errno;
    if (status == SKV_CAN_OK)
        *bus = &s->bus;
    else
        raw_close(&s->bus);
    return status;
}
