// Lines by libgpiod 1.6.
#include "port/gpiod/lines.h"
#include "port/gpiod/chips.h"

#include <errno.h>
#include <gpiod.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define CONSUMER "skyvert"

struct lines_request {
    struct gpiod_chip *chip;
    struct gpiod_line_bulk bulk;
};

static int find(const char *path, const char *name) {
    struct gpiod_chip *chip = gpiod_chip_open(path);
    if (!chip)
        return CHIPS_REFUSED;
    struct gpiod_line *line = gpiod_chip_find_line(chip, name);
    const int offset = line ? (int)gpiod_line_offset(line) : CHIPS_ABSENT;
    gpiod_chip_close(chip);
    return offset;
}

static struct gpiod_line *line_at(struct gpiod_chip *chip, unsigned offset, char why[LINES_WHY]) {
    const unsigned lines = gpiod_chip_num_lines(chip);
    if (offset >= lines) {
        snprintf(why, LINES_WHY, "%s has the lines 0 to %u", gpiod_chip_name(chip), lines - 1);
        return NULL;
    }
    struct gpiod_line *line = gpiod_chip_get_line(chip, offset);
    if (!line)
        snprintf(why, LINES_WHY, "%s", strerror(errno));
    return line;
}

static int flags_of(const lines_spec *spec) {
    return (spec->active_low ? GPIOD_LINE_REQUEST_FLAG_ACTIVE_LOW : 0) |
           (spec->pull_up ? GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_UP : 0);
}

static void explain(struct gpiod_line_bulk *bulk, bool inputs, int error, char why[LINES_WHY]) {
    const char *user = NULL;
    for (unsigned i = 0; i < gpiod_line_bulk_num_lines(bulk); i++) {
        struct gpiod_line *line = gpiod_line_bulk_get_line(bulk, i);
        if (gpiod_line_is_used(line))
            user = gpiod_line_consumer(line) ? gpiod_line_consumer(line) : "the kernel";
    }
    chips_explain(error, user, inputs, why);
}

static lines_request *give_up(lines_request *request) {
    if (request && request->chip)
        gpiod_chip_close(request->chip);
    free(request);
    return NULL;
}

// The lines, found but not yet requested.
static lines_request *gather(const lines_spec *specs, int n, char why[LINES_WHY]) {
    chips_place places[LINES_MAX];
    if (!chips_gather(specs, n, find, places, why))
        return NULL;
    lines_request *request = calloc(1, sizeof *request);
    if (!request || !(request->chip = gpiod_chip_open(places[0].chip))) {
        chips_refused(places[0].chip, errno, why, LINES_WHY);
        return give_up(request);
    }
    gpiod_line_bulk_init(&request->bulk);
    for (int i = 0; i < n; i++) {
        struct gpiod_line *line = line_at(request->chip, places[i].offset, why);
        if (!line)
            return give_up(request);
        gpiod_line_bulk_add(&request->bulk, line);
    }
    return request;
}

lines_request *lines_inputs(const lines_spec *specs, int n, char why[LINES_WHY]) {
    lines_request *request = gather(specs, n, why);
    if (!request)
        return NULL;
    // One request has one set of flags: lines that differ are asked for one by one.
    bool same = true;
    for (int i = 1; i < n; i++)
        same = same && flags_of(&specs[i]) == flags_of(&specs[0]);
    int failed = same ? gpiod_line_request_bulk_both_edges_events_flags(&request->bulk, CONSUMER, flags_of(specs)) : 0;
    for (int i = 0; !same && i < n && !failed; i++)
        failed = gpiod_line_request_both_edges_events_flags(gpiod_line_bulk_get_line(&request->bulk, (unsigned)i),
                                                            CONSUMER, flags_of(&specs[i]));
    if (!failed)
        return request;
    explain(&request->bulk, true, errno, why);
    return give_up(request);
}

lines_request *lines_output(const lines_spec *spec, char why[LINES_WHY]) {
    lines_request *request = gather(spec, 1, why);
    if (!request ||
        !gpiod_line_request_output_flags(gpiod_line_bulk_get_line(&request->bulk, 0), CONSUMER, flags_of(spec), 0))
        return request;
    explain(&request->bulk, false, errno, why);
    return give_up(request);
}

int lines_fds(const lines_request *request, int fds[LINES_MAX]) {
    struct gpiod_line_bulk bulk = request->bulk;
    const int n = (int)gpiod_line_bulk_num_lines(&bulk);
    for (int i = 0; i < n; i++)
        fds[i] = gpiod_line_event_get_fd(gpiod_line_bulk_get_line(&bulk, (unsigned)i));
    return n;
}

static int64_t ns_of(const struct timespec *at) {
    return (int64_t)at->tv_sec * 1000000000 + at->tv_nsec;
}

static int read_line(struct gpiod_line *line, int index, lines_edge *edges, int room) {
    struct gpiod_line_event events[16];
    struct pollfd waits = {.fd = gpiod_line_event_get_fd(line), .events = POLLIN};
    if (poll(&waits, 1, 0) <= 0)
        return 0;
    if (waits.revents & (POLLERR | POLLHUP | POLLNVAL))
        return -1;
    const int n = gpiod_line_event_read_multiple(line, events, (unsigned)(room < 16 ? room : 16));
    struct timespec wall;
    clock_gettime(CLOCK_REALTIME, &wall);
    const int64_t now_ns = lines_now();
    for (int i = 0; i < n; i++)
        edges[i] = (lines_edge){chips_steady(ns_of(&events[i].ts), now_ns, ns_of(&wall)), index,
                                events[i].event_type == GPIOD_LINE_EVENT_RISING_EDGE};
    return n;
}

int lines_read(lines_request *request, lines_edge *edges, int room) {
    int total = 0;
    for (unsigned i = 0; i < gpiod_line_bulk_num_lines(&request->bulk); i++)
        for (int n = 1; n > 0 && total < room; total += n) {
            n = read_line(gpiod_line_bulk_get_line(&request->bulk, i), (int)i, edges + total, room - total);
            if (n < 0)
                return -1;
        }
    return total;
}

int lines_level(lines_request *request, int index) {
    return gpiod_line_get_value(gpiod_line_bulk_get_line(&request->bulk, (unsigned)index));
}

int lines_set(lines_request *request, bool level) {
    return gpiod_line_set_value(gpiod_line_bulk_get_line(&request->bulk, 0), level);
}

void lines_release(lines_request *request) {
    if (request)
        gpiod_line_release_bulk(&request->bulk);
    give_up(request);
}
