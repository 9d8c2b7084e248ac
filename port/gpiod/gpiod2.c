// Lines by libgpiod 2.
#include "port/gpiod/lines.h"
#include "port/gpiod/chips.h"

#include <errno.h>
#include <gpiod.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define CONSUMER "skyvert"
// Edges that the kernel keeps while the program is busy (by itself 16 a line), and that are read at once.
enum { QUEUE = 512, BUFFER = 16 };

struct lines_request {
    struct gpiod_line_request *held;
    struct gpiod_edge_event_buffer *buffer;
    unsigned offsets[LINES_MAX];
    int n;
};

static int find(const char *path, const char *name) {
    struct gpiod_chip *chip = gpiod_chip_open(path);
    if (!chip)
        return CHIPS_REFUSED;
    const int offset = gpiod_chip_get_line_offset_from_name(chip, name);
    gpiod_chip_close(chip);
    return offset < 0 ? CHIPS_ABSENT : offset;
}

// Whether the chip has this line.
static bool in_range(struct gpiod_chip *chip, unsigned offset, char why[LINES_WHY]) {
    struct gpiod_chip_info *info = gpiod_chip_get_info(chip);
    if (!info) {
        snprintf(why, LINES_WHY, "%s", strerror(errno));
        return false;
    }
    const size_t lines = gpiod_chip_info_get_num_lines(info);
    if (offset >= lines)
        snprintf(why, LINES_WHY, "%s has the lines 0 to %d", gpiod_chip_info_get_name(info), (int)lines - 1);
    gpiod_chip_info_free(info);
    return offset < lines;
}

static void explain(struct gpiod_chip *chip, const lines_request *request, bool output, char why[LINES_WHY]) {
    const int error = errno;
    chips_explain(error, NULL, !output, why);
    for (int i = 0; error == EBUSY && i < request->n; i++) {
        struct gpiod_line_info *info = gpiod_chip_get_line_info(chip, request->offsets[i]);
        if (info && gpiod_line_info_is_used(info)) {
            const char *user = gpiod_line_info_get_consumer(info);
            chips_explain(error, user ? user : "the kernel", !output, why);
        }
        gpiod_line_info_free(info);
    }
}

static bool settle(struct gpiod_line_config *lines, const lines_spec *spec, unsigned offset, bool output) {
    struct gpiod_line_settings *settings = gpiod_line_settings_new();
    if (!settings)
        return false;
    gpiod_line_settings_set_active_low(settings, spec->active_low);
    gpiod_line_settings_set_direction(settings, output ? GPIOD_LINE_DIRECTION_OUTPUT : GPIOD_LINE_DIRECTION_INPUT);
    if (output)
        gpiod_line_settings_set_output_value(settings, GPIOD_LINE_VALUE_INACTIVE);
    else
        gpiod_line_settings_set_edge_detection(settings, GPIOD_LINE_EDGE_BOTH);
    if (spec->pull_up)
        gpiod_line_settings_set_bias(settings, GPIOD_LINE_BIAS_PULL_UP);
    const bool added = gpiod_line_config_add_line_settings(lines, &offset, 1, settings) == 0;
    gpiod_line_settings_free(settings);
    return added;
}

static bool ask_for(struct gpiod_chip *chip, const lines_spec *specs, lines_request *request, bool output) {
    struct gpiod_request_config *name = gpiod_request_config_new();
    struct gpiod_line_config *lines = gpiod_line_config_new();
    bool ready = name && lines;
    for (int i = 0; ready && i < request->n; i++)
        ready = settle(lines, &specs[i], request->offsets[i], output);
    if (ready) {
        gpiod_request_config_set_consumer(name, CONSUMER);
        gpiod_request_config_set_event_buffer_size(name, QUEUE);
        request->held = gpiod_chip_request_lines(chip, name, lines);
    }
    const int error = errno;
    gpiod_line_config_free(lines);
    gpiod_request_config_free(name);
    errno = error;
    return request->held != NULL;
}

static bool open_lines(const lines_spec *specs, lines_request *request, bool output, char why[LINES_WHY]) {
    chips_place places[LINES_MAX];
    if (!chips_gather(specs, request->n, find, places, why))
        return false;
    struct gpiod_chip *chip = gpiod_chip_open(places[0].chip);
    if (!chip) {
        chips_refused(places[0].chip, errno, why, LINES_WHY);
        return false;
    }
    bool good = true;
    for (int i = 0; good && i < request->n; i++) {
        request->offsets[i] = places[i].offset;
        good = in_range(chip, places[i].offset, why);
    }
    if (good && !ask_for(chip, specs, request, output)) {
        explain(chip, request, output, why);
        good = false;
    }
    gpiod_chip_close(chip); // the request outlives it
    return good;
}

static lines_request *request_lines(const lines_spec *specs, int n, bool output, char why[LINES_WHY]) {
    lines_request *request = calloc(1, sizeof *request);
    if (request)
        request->buffer = gpiod_edge_event_buffer_new(BUFFER);
    if (!request || !request->buffer)
        snprintf(why, LINES_WHY, "%s", strerror(ENOMEM));
    else {
        request->n = n;
        if (open_lines(specs, request, output, why))
            return request;
    }
    lines_release(request);
    return NULL;
}

lines_request *lines_inputs(const lines_spec *specs, int n, char why[LINES_WHY]) {
    return request_lines(specs, n, false, why);
}

lines_request *lines_output(const lines_spec *spec, char why[LINES_WHY]) {
    return request_lines(spec, 1, true, why);
}

int lines_fds(const lines_request *request, int fds[LINES_MAX]) {
    fds[0] = gpiod_line_request_get_fd(request->held);
    return 1;
}

static lines_edge edge_of(const lines_request *request, struct gpiod_edge_event *event) {
    const unsigned offset = gpiod_edge_event_get_line_offset(event);
    return (lines_edge){(int64_t)gpiod_edge_event_get_timestamp_ns(event), offset == request->offsets[0] ? 0 : 1,
                        gpiod_edge_event_get_event_type(event) == GPIOD_EDGE_EVENT_RISING_EDGE};
}

int lines_read(lines_request *request, lines_edge *edges, int room) {
    int total = 0;
    while (total < room) {
        struct pollfd waits = {.fd = gpiod_line_request_get_fd(request->held), .events = POLLIN};
        if (poll(&waits, 1, 0) <= 0)
            break;
        const size_t most = (size_t)(room - total < BUFFER ? room - total : BUFFER);
        if (waits.revents & (POLLERR | POLLHUP | POLLNVAL))
            return -1;
        const int n = gpiod_line_request_read_edge_events(request->held, request->buffer, most);
        if (n < 0)
            return -1;
        for (int i = 0; i < n; i++)
            edges[total + i] = edge_of(request, gpiod_edge_event_buffer_get_event(request->buffer, (unsigned long)i));
        total += n;
    }
    return total;
}

int lines_level(lines_request *request, int index) {
    const enum gpiod_line_value value = gpiod_line_request_get_value(request->held, request->offsets[index]);
    return value == GPIOD_LINE_VALUE_ERROR ? -1 : value == GPIOD_LINE_VALUE_ACTIVE;
}

int lines_set(lines_request *request, bool level) {
    return gpiod_line_request_set_value(request->held, request->offsets[0],
                                        level ? GPIOD_LINE_VALUE_ACTIVE : GPIOD_LINE_VALUE_INACTIVE);
}

void lines_release(lines_request *request) {
    if (!request)
        return;
    if (request->held)
        gpiod_line_request_release(request->held);
    gpiod_edge_event_buffer_free(request->buffer);
    free(request);
}
