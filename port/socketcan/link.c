// rtnetlink: the state of the interface, its changes, and the restart of a controller that is bus-off.
#include <errno.h>
#include <linux/can/netlink.h>
#include <linux/if.h>
#include <linux/if_link.h>
#include <linux/rtnetlink.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

#include "private.h"

// A netlink request with room for what is nested in it.
typedef struct request {
    struct nlmsghdr head;
    struct ifinfomsg link;
    char attributes[128];
} request;

typedef union answer {
    struct nlmsghdr head;
    char bytes[16384];
} answer;

// Attributes from `first` on, `bytes` of them; NULL = there is none of this type.
static const struct rtattr *find(const struct rtattr *first, int bytes, unsigned short type) {
    for (const struct rtattr *a = first; RTA_OK(a, bytes);
         a = (const struct rtattr *)(const void *)((const char *)a + RTA_ALIGN(a->rta_len))) {
        if ((a->rta_type & NLA_TYPE_MASK) == type)
            return a;
        bytes -= (int)RTA_ALIGN(a->rta_len);
    }
    return NULL;
}

static const struct rtattr *find_in(const struct rtattr *outer, unsigned short type) {
    return outer ? find((const struct rtattr *)RTA_DATA(outer), (int)RTA_PAYLOAD(outer), type) : NULL;
}

static uint32_t word_of(const struct rtattr *attribute) {
    uint32_t value = 0;
    if (attribute && RTA_PAYLOAD(attribute) >= sizeof value)
        memcpy(&value, RTA_DATA(attribute), sizeof value);
    return value;
}

static uint8_t controller_of(const struct rtattr *attribute) {
    static const uint8_t known[] = {SKV_CAN_ACTIVE,  SKV_CAN_WARNING, SKV_CAN_PASSIVE,
                                    SKV_CAN_BUS_OFF, SKV_CAN_STOPPED, SKV_CAN_SLEEPING};
    const uint32_t state = word_of(attribute);
    return attribute && state < sizeof known ? known[state] : SKV_CAN_UNKNOWN;
}

static void read_link(const struct nlmsghdr *head, skv_can_state *state) {
    const struct ifinfomsg *link = (const struct ifinfomsg *)NLMSG_DATA(head);
    const struct rtattr *first =
        (const struct rtattr *)(const void *)((const char *)link + NLMSG_ALIGN(sizeof(struct ifinfomsg)));
    const struct rtattr *info = find(first, (int)(head->nlmsg_len - NLMSG_LENGTH(sizeof *link)), IFLA_LINKINFO);
    const struct rtattr *data = find_in(info, IFLA_INFO_DATA);
    const struct rtattr *bits = find_in(data, IFLA_CAN_BITTIMING);
    const struct rtattr *errors = find_in(data, IFLA_CAN_BERR_COUNTER);
    state->present = 1;
    state->up = (link->ifi_flags & IFF_UP) != 0;
    state->controller = controller_of(find_in(data, IFLA_CAN_STATE));
    state->restart_ms = word_of(find_in(data, IFLA_CAN_RESTART_MS));
    state->bitrate = word_of(bits); // its first word
    if (errors && RTA_PAYLOAD(errors) >= sizeof(struct can_berr_counter)) {
        struct can_berr_counter counter;
        memcpy(&counter, RTA_DATA(errors), sizeof counter);
        state->tx_errors = counter.txerr;
        state->rx_errors = counter.rxerr;
    }
}

// Sends a request and takes the first answer. @return 0, or an errno.
static int ask(request *r, answer *a) {
    const int fd = socket(AF_NETLINK, SOCK_RAW | SOCK_CLOEXEC, NETLINK_ROUTE);
    if (fd < 0)
        return errno;
    int error = 0;
    ssize_t got = -1;
    if (send(fd, r, r->head.nlmsg_len, 0) < 0 || (got = recv(fd, a, sizeof *a, 0)) < 0)
        error = errno;
    close(fd);
    if (error)
        return error;
    if (!NLMSG_OK(&a->head, (unsigned)got))
        return EBADMSG;
    if (a->head.nlmsg_type == NLMSG_ERROR)
        return -((const struct nlmsgerr *)NLMSG_DATA(&a->head))->error;
    return 0;
}

static request request_of(int type, int flags, int index) {
    request r;
    memset(&r, 0, sizeof r);
    r.head.nlmsg_len = NLMSG_LENGTH(sizeof r.link);
    r.head.nlmsg_type = (unsigned short)type;
    r.head.nlmsg_flags = (unsigned short)(NLM_F_REQUEST | flags);
    r.link.ifi_index = index;
    return r;
}

skv_can_status skv_socketcan_state(skv_can_bus *bus, skv_can_state *state) {
    skv_socketcan *s = (skv_socketcan *)(void *)bus;
    request r = request_of(RTM_GETLINK, 0, s->index);
    answer a;
    const int error = ask(&r, &a);
    if (error && error != ENODEV)
        return skv_socketcan_failed(s, error);
    memset(state, 0, sizeof *state);
    if (!error && a.head.nlmsg_type == RTM_NEWLINK)
        read_link(&a.head, state);
    return SKV_CAN_OK;
}

// Appends an attribute to a request; its length is set by whoever nests in it.
static struct rtattr *append(request *r, unsigned short type, const void *data, size_t size) {
    struct rtattr *a = (struct rtattr *)(void *)((char *)r + NLMSG_ALIGN(r->head.nlmsg_len));
    a->rta_type = type;
    a->rta_len = (unsigned short)RTA_LENGTH(size);
    if (size)
        memcpy(RTA_DATA(a), data, size);
    r->head.nlmsg_len = NLMSG_ALIGN(r->head.nlmsg_len) + (unsigned)RTA_ALIGN(a->rta_len);
    return a;
}

static void end_nest(request *r, struct rtattr *outer) {
    outer->rta_len = (unsigned short)((char *)r + r->head.nlmsg_len - (char *)outer);
}

skv_can_status skv_socketcan_restart(skv_can_bus *bus) {
    skv_socketcan *s = (skv_socketcan *)(void *)bus;
    const uint32_t one = 1;
    request r = request_of(RTM_NEWLINK, NLM_F_ACK, s->index);
    answer a;
    struct rtattr *info = append(&r, IFLA_LINKINFO, NULL, 0);
    (void)append(&r, IFLA_INFO_KIND, "can", 3);
    struct rtattr *data = append(&r, IFLA_INFO_DATA, NULL, 0);
    (void)append(&r, IFLA_CAN_RESTART, &one, sizeof one);
    end_nest(&r, data);
    end_nest(&r, info);
    const int error = ask(&r, &a);
    if (!error)
        return SKV_CAN_OK;
    s->bus.last_errno = error;
    // Not bus-off, restarts by itself, no controller at all.
    return error == EBUSY || error == EINVAL || error == EOPNOTSUPP ? SKV_CAN_BAD_ARGUMENT
                                                                    : skv_socketcan_failed(s, error);
}

// A socket that hears of every change of every interface; -1 = there is none, and the state must be asked for.
int skv_socketcan_link_open(void) {
    struct sockaddr_nl address = {.nl_family = AF_NETLINK, .nl_groups = RTMGRP_LINK};
    const int fd = socket(AF_NETLINK, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, NETLINK_ROUTE);
    if (fd >= 0 && bind(fd, (struct sockaddr *)&address, sizeof address)) {
        close(fd);
        return -1;
    }
    return fd;
}

int skv_socketcan_event_fd(const skv_can_bus *bus) {
    return ((const skv_socketcan *)(const void *)bus)->link;
}

int skv_socketcan_events(skv_can_bus *bus) {
    const skv_socketcan *s = (const skv_socketcan *)(const void *)bus;
    int changes = 0;
    answer a;
    while (s->link >= 0) {
        ssize_t got = recv(s->link, &a, sizeof a, MSG_DONTWAIT);
        if (got < 0) // ENOBUFS: changes were lost, so look
            return errno == ENOBUFS ? changes + 1 : changes;
        unsigned left = (unsigned)got;
        for (struct nlmsghdr *h = &a.head; NLMSG_OK(h, left); h = NLMSG_NEXT(h, left)) {
            const struct ifinfomsg *link = (const struct ifinfomsg *)NLMSG_DATA(h);
            changes += (h->nlmsg_type == RTM_NEWLINK || h->nlmsg_type == RTM_DELLINK) && link->ifi_index == s->index;
        }
    }
    return changes;
}
