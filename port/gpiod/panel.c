#include "port/gpiod/skv_gpio.h"

#include "port/gpiod/lines.h"
#include "port/gpiod/skv_debounce.h"
#include "port/gpiod/skv_quadrature.h"

#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/epoll.h>
#include <sys/timerfd.h>
#include <unistd.h>

// The kernel queues the edges of two lines apart: those of the encoder are put in order, and the newest wait this long
// for one that is older. A hand turns slower than that: 1,000 quarter steps a second.
#define HOLD_NS INT64_C(1000000)
// A line that never rests is left for the next call after so many reads.
enum { EDGES = 64, SWITCHES = 2, ROUNDS = 16 };

typedef struct {
    lines_request *request;
    skv_debounce debounce;
} contact;

struct skv_gpio {
    skv_gpio_config config;
    skv_gpio_say *say;
    void *context;
    lines_request *encoder;
    contact contacts[SWITCHES]; // button, toggle
    lines_request *lamp[2];
    bool lit[2];
    skv_quadrature quadrature;
    int32_t steps, seen; // of the encoder: not yet given as clicks; position up to which they were taken
    lines_edge edges[EDGES];
    int waiting;
    bool unchecked; // edges came since the encoder's levels were last compared
    int epoll, timer;
};

static const char *const words[SKV_GPIO_USES] = {"encoder_a", "encoder_b",  "button",
                                                 "toggle",    "lamp_night", "lamp_bus"};

static void complain(const skv_gpio *panel, skv_gpio_use use, const char *why) {
    char sentence[2 * SKV_GPIO_NAME + LINES_WHY + 64];
    if (use == SKV_GPIO_ENCODER_A && panel->config.line[SKV_GPIO_ENCODER_B][0])
        snprintf(sentence, sizeof sentence, "gpio: encoder (%s, %s): %s; goes on without it", panel->config.line[0],
                 panel->config.line[1], why);
    else
        snprintf(sentence, sizeof sentence, "gpio: %s (%s): %s; goes on without it", words[use],
                 panel->config.line[use], why);
    panel->say(panel->context, sentence);
}

// Whether an earlier use has this line.
static bool taken(const skv_gpio *panel, skv_gpio_use use) {
    int first = 0;
    while (strcmp(panel->config.line[first], panel->config.line[use]) != 0)
        first++;
    char why[LINES_WHY];
    snprintf(why, sizeof why, "this line is %s already", words[first]);
    if (first != (int)use)
        complain(panel, use, why);
    return first != (int)use;
}

// CHIP:OFFSET, with the chip as a number, gpiochipN or a path; anything else is a line's name.
static lines_spec spec_of(const skv_gpio_config *config, skv_gpio_use use, char chip[SKV_GPIO_NAME + 16]) {
    const char *text = config->line[use], *colon = strrchr(text, ':');
    lines_spec spec = {text, NULL, 0, config->active_low[use], config->pull_up[use]};
    char *end = NULL;
    const unsigned long offset = colon ? strtoul(colon + 1, &end, 10) : 0;
    if (!colon || colon == text || colon[1] < '0' || colon[1] > '9' || *end != '\0' || offset > 65535)
        return spec;
    const int length = (int)(colon - text);
    const bool path = text[0] == '/', number = strspn(text, "0123456789") == (size_t)length;
    if (!path && !number && strncmp(text, "gpiochip", 8) != 0)
        return spec;
    snprintf(chip, SKV_GPIO_NAME + 16, "%s%.*s", path ? "" : number ? "/dev/gpiochip" : "/dev/", length, text);
    spec.name = NULL;
    spec.chip = chip;
    spec.offset = (unsigned)offset;
    return spec;
}

static void listen_to(const skv_gpio *panel, const lines_request *request) {
    int fds[LINES_MAX];
    const int n = lines_fds(request, fds);
    for (int i = 0; i < n; i++) {
        struct epoll_event wanted = {.events = EPOLLIN, .data.fd = fds[i]};
        epoll_ctl(panel->epoll, EPOLL_CTL_ADD, fds[i], &wanted);
    }
}

static lines_request *open_inputs(skv_gpio *panel, skv_gpio_use first, int n) {
    char chips[LINES_MAX][SKV_GPIO_NAME + 16], why[LINES_WHY] = "";
    lines_spec specs[LINES_MAX];
    for (int i = 0; i < n; i++)
        specs[i] = spec_of(&panel->config, (skv_gpio_use)((int)first + i), chips[i]);
    lines_request *request = lines_inputs(specs, n, why);
    if (request)
        listen_to(panel, request);
    else
        complain(panel, first, why);
    return request;
}

// A line that is lost later: a chip on USB that was pulled.
static void lose(const skv_gpio *panel, lines_request **request, skv_gpio_use use) {
    complain(panel, use, "lost");
    lines_release(*request);
    *request = NULL;
}

static void open_encoder(skv_gpio *panel) {
    const char *a = panel->config.line[SKV_GPIO_ENCODER_A], *b = panel->config.line[SKV_GPIO_ENCODER_B];
    if (!a[0] && !b[0])
        return;
    if (!a[0] || !b[0]) {
        complain(panel, a[0] ? SKV_GPIO_ENCODER_A : SKV_GPIO_ENCODER_B, "an encoder needs encoder_a and encoder_b");
        return;
    }
    panel->encoder = open_inputs(panel, SKV_GPIO_ENCODER_A, 2);
    if (!panel->encoder)
        return;
    const int level_a = lines_level(panel->encoder, 0), level_b = lines_level(panel->encoder, 1);
    if (level_a < 0 || level_b < 0)
        lose(panel, &panel->encoder, SKV_GPIO_ENCODER_A);
    else
        skv_quadrature_start(&panel->quadrature, level_a > 0, level_b > 0);
}

static void open_contact(skv_gpio *panel, int i) {
    const skv_gpio_use use = (skv_gpio_use)(SKV_GPIO_BUTTON + i);
    contact *it = &panel->contacts[i];
    if (!panel->config.line[use][0] || taken(panel, use) || !(it->request = open_inputs(panel, use, 1)))
        return;
    const int level = lines_level(it->request, 0);
    if (level < 0)
        lose(panel, &it->request, use);
    else
        skv_debounce_start(&it->debounce, level > 0, (int64_t)panel->config.debounce_ms * 1000000);
}

static void open_lamp(skv_gpio *panel, int i) {
    char chip[SKV_GPIO_NAME + 16], why[LINES_WHY] = "";
    const skv_gpio_use use = (skv_gpio_use)(SKV_GPIO_LAMP_NIGHT + i);
    if (!panel->config.line[use][0] || taken(panel, use))
        return;
    const lines_spec spec = spec_of(&panel->config, use, chip);
    panel->lamp[i] = lines_output(&spec, why);
    if (!panel->lamp[i])
        complain(panel, use, why);
}

static skv_gpio *abandon(skv_gpio *panel) {
    if (panel->epoll >= 0)
        close(panel->epoll);
    if (panel->timer >= 0)
        close(panel->timer);
    free(panel);
    return NULL;
}

skv_gpio *skv_gpio_open(const skv_gpio_config *config, skv_gpio_say *say, void *context) {
    skv_gpio *panel = calloc(1, sizeof *panel);
    if (!panel)
        return NULL;
    panel->config = *config;
    panel->say = say;
    panel->context = context;
    panel->epoll = epoll_create1(EPOLL_CLOEXEC);
    panel->timer = timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK | TFD_CLOEXEC);
    struct epoll_event wanted = {.events = EPOLLIN};
    if (panel->epoll < 0 || panel->timer < 0 || epoll_ctl(panel->epoll, EPOLL_CTL_ADD, panel->timer, &wanted) != 0)
        return abandon(panel);
    open_encoder(panel);
    for (int i = 0; i < SWITCHES; i++)
        open_contact(panel, i);
    for (int i = 0; i < 2; i++)
        open_lamp(panel, i);
    return panel;
}

bool skv_gpio_has(const skv_gpio *panel, skv_gpio_use use) {
    switch (use) {
    case SKV_GPIO_ENCODER_A:
    case SKV_GPIO_ENCODER_B:
        return panel->encoder != NULL;
    case SKV_GPIO_BUTTON:
    case SKV_GPIO_TOGGLE:
        return panel->contacts[use - SKV_GPIO_BUTTON].request != NULL;
    case SKV_GPIO_LAMP_NIGHT:
    case SKV_GPIO_LAMP_BUS:
        return panel->lamp[use - SKV_GPIO_LAMP_NIGHT] != NULL;
    default:
        return false;
    }
}

int skv_gpio_fd(const skv_gpio *panel) {
    return panel->epoll;
}

static void sort_edges(lines_edge *edges, int n) {
    for (int i = 1; i < n; i++) {
        const lines_edge edge = edges[i];
        int at = i;
        for (; at > 0 && edges[at - 1].at_ns > edge.at_ns; at--)
            edges[at] = edges[at - 1];
        edges[at] = edge;
    }
}

static bool more_waits(const lines_request *request) {
    int fds[LINES_MAX];
    struct pollfd waits[LINES_MAX];
    const int n = lines_fds(request, fds);
    for (int i = 0; i < n; i++)
        waits[i] = (struct pollfd){.fd = fds[i], .events = POLLIN};
    return poll(waits, (nfds_t)n, 0) > 0;
}

// The kernel's queue is short (16 edges): when all is quiet the levels themselves show whether edges were lost.
static void check_encoder(skv_gpio *panel) {
    const int a = lines_level(panel->encoder, 0), b = lines_level(panel->encoder, 1);
    if (a < 0 || b < 0 || more_waits(panel->encoder))
        return;
    skv_quadrature_levels(&panel->quadrature, a > 0, b > 0);
    panel->unchecked = false;
}

static void take_edges(skv_gpio *panel, int64_t until_ns, skv_gpio_input *input) {
    int done = 0;
    for (; done < panel->waiting && panel->edges[done].at_ns <= until_ns; done++) {
        skv_quadrature_edge(&panel->quadrature, panel->edges[done].index == 0, panel->edges[done].level);
        if (panel->edges[done].at_ns > input->input_ns)
            input->input_ns = panel->edges[done].at_ns;
    }
    panel->waiting -= done;
    memmove(panel->edges, panel->edges + done, (size_t)panel->waiting * sizeof *panel->edges);
}

static void read_encoder(skv_gpio *panel, skv_gpio_input *input) {
    // Before the lines are read: all edges up to then are in the queues, but for those that an interrupt is at.
    const int64_t until_ns = lines_now() - HOLD_NS;
    int n = 1;
    for (int round = 0; n > 0 && round < ROUNDS; round++) {
        n = lines_read(panel->encoder, panel->edges + panel->waiting, EDGES - panel->waiting);
        if (n < 0) {
            lose(panel, &panel->encoder, SKV_GPIO_ENCODER_A);
            panel->waiting = 0;
            return;
        }
        panel->unchecked = panel->unchecked || n > 0;
        panel->waiting += n;
        sort_edges(panel->edges, panel->waiting);
        take_edges(panel, panel->waiting == EDGES ? panel->edges[EDGES / 2].at_ns : until_ns, input);
    }
    if (panel->waiting == 0 && panel->unchecked)
        check_encoder(panel);
}

static void changed(skv_gpio_use use, bool level, skv_gpio_input *input) {
    if (use == SKV_GPIO_BUTTON)
        input->presses += level;
    else
        input->toggled = true;
}

// The level that is about to count is read once more. Another one without an edge: the last edge was lost, and it waits
// anew.
static void settle(contact *it, skv_gpio_use use, int64_t now_ns, skv_gpio_input *input) {
    skv_debounce *debounce = &it->debounce;
    if (skv_debounce_due(debounce) > now_ns)
        return;
    const int level = lines_level(it->request, 0);
    if (more_waits(it->request))
        return;
    if (level >= 0 && (level > 0) != debounce->raw)
        skv_debounce_lost(debounce, now_ns, level > 0);
    else if (skv_debounce_time(debounce, now_ns))
        changed(use, debounce->level, input);
}

static void read_contact(skv_gpio *panel, int i, skv_gpio_input *input) {
    contact *it = &panel->contacts[i];
    const skv_gpio_use use = (skv_gpio_use)(SKV_GPIO_BUTTON + i);
    lines_edge edges[EDGES];
    int n = 1;
    for (int round = 0; n > 0 && round < ROUNDS; round++) {
        n = lines_read(it->request, edges, EDGES);
        if (n < 0)
            lose(panel, &it->request, use);
        for (int at = 0; at < n; at++) {
            if (skv_debounce_edge(&it->debounce, edges[at].at_ns, edges[at].level))
                changed(use, it->debounce.level, input);
            if (edges[at].at_ns > input->input_ns)
                input->input_ns = edges[at].at_ns;
        }
    }
    if (it->request)
        settle(it, use, lines_now(), input);
}

// The next time at which something is to be done without an edge.
static void set_timer(const skv_gpio *panel) {
    int64_t due = panel->waiting > 0 ? panel->edges[0].at_ns + HOLD_NS : INT64_MAX;
    for (int i = 0; i < SWITCHES; i++) {
        const int64_t settled = panel->contacts[i].request ? skv_debounce_due(&panel->contacts[i].debounce) : INT64_MAX;
        due = settled < due ? settled : due;
    }
    struct itimerspec at = {.it_value = {0, 0}};
    if (due != INT64_MAX)
        at.it_value = (struct timespec){(time_t)(due / 1000000000), (long)(due % 1000000000)};
    timerfd_settime(panel->timer, TFD_TIMER_ABSTIME, &at, NULL);
}

void skv_gpio_read(skv_gpio *panel, skv_gpio_input *input) {
    uint64_t passed;
    const ssize_t rung = read(panel->timer, &passed, sizeof passed); // only to silence it
    (void)rung;
    *input = (skv_gpio_input){.clicks = 0};
    if (panel->encoder)
        read_encoder(panel, input);
    for (int i = 0; i < SWITCHES; i++)
        if (panel->contacts[i].request)
            read_contact(panel, i, input);
    panel->steps += (int32_t)((uint32_t)panel->quadrature.position - (uint32_t)panel->seen);
    panel->seen = panel->quadrature.position;
    input->clicks = skv_quadrature_clicks(&panel->steps, panel->config.encoder_steps);
    input->position = panel->quadrature.position;
    input->invalid = panel->quadrature.invalid;
    input->button = panel->contacts[0].request && panel->contacts[0].debounce.level;
    input->toggle = panel->contacts[1].debounce.level;
    input->bounces = panel->contacts[0].debounce.bounces + panel->contacts[1].debounce.bounces;
    set_timer(panel);
}

void skv_gpio_lamp(skv_gpio *panel, skv_gpio_use lamp, bool lit) {
    if (lamp != SKV_GPIO_LAMP_NIGHT && lamp != SKV_GPIO_LAMP_BUS)
        return;
    const int i = lamp == SKV_GPIO_LAMP_BUS;
    if (!panel->lamp[i] || panel->lit[i] == lit)
        return;
    panel->lit[i] = lit;
    if (lines_set(panel->lamp[i], lit) != 0)
        lose(panel, &panel->lamp[i], lamp);
}

void skv_gpio_close(skv_gpio *panel) {
    if (!panel)
        return;
    for (int i = 0; i < 2; i++) {
        skv_gpio_lamp(panel, (skv_gpio_use)(SKV_GPIO_LAMP_NIGHT + i), false);
        if (panel->lamp[i])
            lines_release(panel->lamp[i]);
    }
    for (int i = 0; i < SWITCHES; i++)
        if (panel->contacts[i].request)
            lines_release(panel->contacts[i].request);
    if (panel->encoder)
        lines_release(panel->encoder);
    abandon(panel);
}
