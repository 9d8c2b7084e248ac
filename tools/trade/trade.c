#include "trade.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

static int report(void *context, double done) {
    const trade *const t = context;
    return t->options.progress ? t->options.progress(t->options.context, t->step, done) : 0;
}

static int step(trade *t, const char *what, double done) {
    t->step = what;
    return report(t, done);
}

int trade_begin(trade *t, const trade_options *options) {
    char file[300];
    *t = (trade){.options = *options, .repeats = options->quick ? 7 : 21, .step = ""};
    t->n_configs = trade_configs(&t->configs, options->quick);
    t->n_truths = options->quick ? 1 : 2;
    t->truths = calloc(t->n_truths, sizeof *t->truths);
    if (t->n_configs == 0 || !t->truths) {
        fprintf(stderr, "skyvert trade: out of memory\n");
        return 1;
    }
    for (size_t i = 0; i < t->n_truths; i++) {
        const int status = trade_truth_load(&t->truths[i], options->root, trade_airs[i + (options->quick ? 1 : 0)]);
        if (status)
            return status;
    }
    snprintf(file, sizeof file, "%.280s/trade.state", options->out);
    const uint64_t program = trade_hash_file("/proc/self/exe");
    return trade_rows_begin(&t->rows, t->configs, t->n_configs, t->truths, t->n_truths, program, file);
}

void trade_end(trade *t) {
    trade_rows_free(&t->rows);
    free(t->truths);
    free(t->configs);
    *t = (trade){0};
}

static int timed(const trade_row *r) {
    for (int k = 0; k < TRADE_SCENES; k++)
        if (r->rays[k] > 0 && r->cost[k].ns < 0)
            return 0;
    return 1;
}

static int wants_subject(const trade_row *r) {
    const unsigned done = TRADE_DONE_ERROR | TRADE_DONE_STACK;
    return !r->beyond[0] && ((r->done & done) != done || !timed(r));
}

/// Keeps the rows when the last time is a while ago.
static int keep_now_and_then(const trade *t) {
    static time_t last;
    const time_t now = time(NULL);
    if (now - last < 2)
        return 0;
    last = now;
    return trade_rows_keep(&t->rows) ? -1 : 0;
}

static int open_row(trade *t, trade_row *r, trade_subject *s) {
    const trade_making making = {t->options.threads, t->options.cache, report, t};
    const char *why;
    char what[80];
    snprintf(what, sizeof what, "%s, %s", r->truth->air, r->config->name);
    if (step(t, what, 0))
        return TRADE_STOPPED;
    const int result = trade_subject_open(s, r->config, r->truth, &making, &why);
    t->step = "";
    if (result == TRADE_OK || result == TRADE_STOPPED)
        return result;
    s->config = NULL;
    if (result == TRADE_NO_MEMORY) {
        fprintf(stderr, "skyvert trade: out of memory for %s\n", r->config->name);
        return -1;
    }
    snprintf(r->beyond, sizeof r->beyond, "%s", result == TRADE_BEYOND ? why : "this build of the core lacks it");
    r->done |= TRADE_DONE_ERROR | TRADE_DONE_STACK;
    return TRADE_OK;
}

/// Errors and stack of the rows [n] of one air.
static int measure_rows(trade *t, trade_row *rows, trade_subject *subjects, size_t n) {
    for (size_t i = 0; i < n; i++) {
        if (!wants_subject(&rows[i]))
            continue;
        const int result = open_row(t, &rows[i], &subjects[i]);
        if (result)
            return result;
        if (!subjects[i].config)
            continue;
        if (step(t, "errors", (double)i / (double)n))
            return TRADE_STOPPED;
        if (!(rows[i].done & TRADE_DONE_ERROR))
            trade_measure_error(&rows[i], &subjects[i]);
        if (!(rows[i].done & TRADE_DONE_STACK))
            trade_measure_stack(&rows[i], &subjects[i]);
        if (keep_now_and_then(t))
            return -1;
    }
    return trade_rows_keep(&t->rows) ? -1 : 0;
}

static int time_rows(trade *t, trade_row *rows, trade_subject *subjects, size_t n) {
    for (int k = 0; k < TRADE_SCENES; k++) {
        int left = 0;
        for (size_t i = 0; i < n; i++)
            left = left || (subjects[i].config && rows[i].rays[k] > 0 && rows[i].cost[k].ns < 0);
        if (!left)
            continue;
        if (step(t, "times", (double)k / TRADE_SCENES))
            return TRADE_STOPPED;
        if (trade_measure_time(rows, subjects, n, k, t->repeats, &t->checksum)) {
            fprintf(stderr, "skyvert trade: out of memory\n");
            return -1;
        }
        if (trade_rows_keep(&t->rows))
            return -1;
    }
    return 0;
}

static int run_air(trade *t, size_t air) {
    const size_t n = t->n_configs;
    trade_row *const rows = t->rows.at + air * n;
    trade_subject *const subjects = calloc(n, sizeof *subjects);
    if (!subjects) {
        fprintf(stderr, "skyvert trade: out of memory\n");
        return -1;
    }
    int status = measure_rows(t, rows, subjects, n);
    if (status == 0)
        status = time_rows(t, rows, subjects, n);
    for (size_t i = 0; i < n; i++)
        trade_subject_close(&subjects[i]);
    free(subjects);
    return status;
}

static int count(trade *t) {
    char folder[300];
    snprintf(folder, sizeof folder, "%.280s/count", t->options.out);
    const trade_counting how = {t->options.command, folder, report, t};
    if (step(t, "instructions", 0))
        return TRADE_STOPPED;
    const int status = trade_count(&t->rows, &how);
    t->counted = status == 0;
    if (trade_rows_keep(&t->rows))
        return -1;
    return status == TRADE_STOPPED ? status : 0; // without counts: times are there
}

int trade_run(trade *t) {
    int status = 0;
    for (size_t i = 0; i < t->rows.n; i++)
        t->kept += !wants_subject(&t->rows.at[i]);
    for (size_t air = 0; air < t->n_truths && status == 0; air++)
        status = run_air(t, air);
    if (status == 0 && t->options.command && trade_count_possible())
        status = count(t);
    if (status == TRADE_STOPPED)
        (void)trade_rows_keep(&t->rows);
    return status;
}

int trade_count_only(trade *t, const char *numbers) {
    const trade_making making = {1, t->options.cache, NULL, NULL};
    return trade_count_rows(&t->rows, numbers, &making);
}
