// No libgpiod when this was built: no line is there, and it is said why.
#include "port/gpiod/lines.h"

#include <stdio.h>

static lines_request *refuse(char why[LINES_WHY]) {
    snprintf(why, LINES_WHY, "built without libgpiod (package libgpiod-dev)");
    return NULL;
}

lines_request *lines_inputs(const lines_spec *specs, int n, char why[LINES_WHY]) {
    (void)specs, (void)n;
    return refuse(why);
}

lines_request *lines_output(const lines_spec *spec, char why[LINES_WHY]) {
    (void)spec;
    return refuse(why);
}

int lines_fds(const lines_request *request, int fds[LINES_MAX]) {
    (void)request, (void)fds;
    return 0;
}

int lines_read(lines_request *request, lines_edge *edges, int room) {
    (void)request, (void)edges, (void)room;
    return -1;
}

int lines_level(lines_request *request, int index) {
    (void)request, (void)index;
    return -1;
}

int lines_set(lines_request *request, bool level) {
    (void)request, (void)level;
    return -1;
}

void lines_release(lines_request *request) {
    (void)request;
}
