#include "port/gpiod/fake.h"

#include "port/gpiod/lines.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/eventfd.h>
#include <unistd.h>

enum { LINES = 16, QUEUE = 16, NAME = 96 };

typedef struct {
    char name[NAME];
    const char *refused;
    bool level, active_low, lost, storm, early, by_name;
    lines_edge queue[QUEUE], next;
    int queued, fd;
} line;

struct lines_request {
    line *lines[LINES_MAX];
    int n;
};

static line all[LINES];
static int count, open_requests;
static int64_t clock_ns;

void fake_reset(void) {
    memset(all, 0, sizeof all);
    count = open_requests = 0;
    clock_ns = 0;
}

static line *find(const char *name) {
    for (int i = 0; i < count; i++)
        if (strcmp(all[i].name, name) == 0)
            return &all[i];
    return NULL;
}

void fake_line(const char *name, bool level) {
    line *it = &all[count++];
    snprintf(it->name, sizeof it->name, "%s", name);
    it->level = level;
    it->fd = -1;
}

void fake_refuse(const char *name, const char *why) {
    find(name)->refused = why;
}

void fake_time(int64_t now_ns) {
    clock_ns = now_ns;
}

void fake_edge(const char *name, int64_t at_ns, bool level) {
    line *it = find(name);
    it->level = level;
    if (it->queued == QUEUE || it->fd < 0)
        return;
    it->queue[it->queued++] = (lines_edge){at_ns, 0, level != it->active_low};
    const uint64_t one = 1;
    const ssize_t written = write(it->fd, &one, sizeof one);
    (void)written;
}

void fake_edge_before_level(const char *name, int64_t at_ns, bool level) {
    line *it = find(name);
    it->early = true;
    it->next = (lines_edge){at_ns, 0, level};
}

void fake_storm(const char *name) {
    find(name)->storm = true;
}

void fake_lose(const char *name) {
    find(name)->lost = true;
}

bool fake_level(const char *name) {
    return find(name)->level;
}

bool fake_by_name(const char *name) {
    return find(name)->by_name;
}

int fake_open(void) {
    return open_requests;
}

static line *take(const lines_spec *spec, char why[LINES_WHY]) {
    char name[NAME];
    snprintf(name, sizeof name, spec->name ? "%s" : "%s:%u", spec->name ? spec->name : spec->chip, spec->offset);
    line *it = find(name);
    if (it && !it->refused) {
        it->active_low = spec->active_low;
        it->by_name = spec->name != NULL;
        it->fd = eventfd(0, EFD_NONBLOCK);
        return it;
    }
    snprintf(why, LINES_WHY, "%s", it ? it->refused : "no such line");
    return NULL;
}

lines_request *lines_inputs(const lines_spec *specs, int n, char why[LINES_WHY]) {
    lines_request *request = calloc(1, sizeof *request);
    for (; request && request->n < n; request->n++) {
        request->lines[request->n] = take(&specs[request->n], why);
        if (!request->lines[request->n]) {
            open_requests++;
            lines_release(request);
            return NULL;
        }
    }
    open_requests++;
    return request;
}

lines_request *lines_output(const lines_spec *spec, char why[LINES_WHY]) {
    lines_request *request = lines_inputs(spec, 1, why);
    if (request)
        lines_set(request, false);
    return request;
}

int lines_fds(const lines_request *request, int fds[LINES_MAX]) {
    for (int i = 0; i < request->n; i++)
        fds[i] = request->lines[i]->fd;
    return request->n;
}

int lines_read(lines_request *request, lines_edge *edges, int room) {
    int total = 0;
    for (int i = 0; i < request->n; i++) {
        line *it = request->lines[i];
        uint64_t passed;
        if (it->lost || (it->queued > 0 && total + it->queued <= room && read(it->fd, &passed, sizeof passed) < 0))
            return -1;
        for (int at = 0; at < it->queued && total < room; at++) {
            edges[total] = it->queue[at];
            edges[total++].index = i;
        }
        it->queued = 0;
        for (bool level = it->level; it->storm && total < room; level = !level)
            edges[total++] = (lines_edge){clock_ns, i, level};
    }
    return total;
}

int lines_level(lines_request *request, int index) {
    line *it = request->lines[index];
    const bool early = it->early;
    it->early = false;
    if (early)
        fake_edge(it->name, it->next.at_ns, it->next.level);
    return it->lost ? -1 : it->level != it->active_low;
}

int lines_set(lines_request *request, bool level) {
    line *it = request->lines[0];
    it->level = level != it->active_low;
    return it->lost ? -1 : 0;
}

void lines_release(lines_request *request) {
    for (int i = 0; request && i < request->n; i++) {
        close(request->lines[i]->fd);
        request->lines[i]->fd = -1;
    }
    open_requests--;
    free(request);
}

int64_t lines_now(void) {
    return clock_ns;
}
