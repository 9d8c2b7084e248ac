#include "count.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "callgrind.h"

int trade_count_possible(void) {
    const char *path = callgrind_built() ? getenv("PATH") : NULL;
    while (path && *path) {
        char name[512];
        const int n = (int)strcspn(path, ":");
        snprintf(name, sizeof name, "%.*s/valgrind", n, path);
        if (access(name, X_OK) == 0)
            return 1;
        path += n + (path[n] == ':');
    }
    return 0;
}

static float direction[TRADE_DOME][3], radiance[TRADE_DOME][TRADE_BANDS];

static void stop(size_t row, int scene, const char *what) {
    char label[CALLGRIND_LABEL];
    snprintf(label, sizeof label, "%zu %d %s", row, scene, what);
    callgrind_end(label);
}

static void count_scene(trade_subject *s, size_t row, int k, const trade_scene *scene) {
    callgrind_begin();
    if (!trade_subject_frame(s, scene)) {
        callgrind_end(NULL);
        return;
    }
    stop(row, k, "frame");
    trade_lay_dome(scene, direction);
    trade_subject_radiance(s, 8, (const float(*)[3])direction,
                           radiance); // what is bound at first use is not the subject's
    callgrind_begin();
    trade_subject_radiance(s, TRADE_DOME, (const float(*)[3])direction, radiance);
    stop(row, k, "vertices");
}

static int count_row(trade_rows *rows, size_t i, int scenes, const trade_making *making) {
    const trade_row *const r = &rows->at[i];
    trade_subject subject;
    const char *why;
    callgrind_off();
    if (trade_subject_open(&subject, r->config, r->truth, making, &why) != TRADE_OK)
        return 0; // said so where errors were measured
    if (scenes > 1)
        (void)trade_subject_frame(&subject, &r->truth->scene[0]); // binds what is bound at first use
    callgrind_on();
    for (int k = 0; k < scenes; k++)
        count_scene(&subject, i, k, &r->truth->scene[k]);
    trade_subject_close(&subject);
    return 0;
}

int trade_count_rows(trade_rows *rows, const char *numbers, const trade_making *making) {
    int status = 0;
    if (!callgrind_built()) {
        fprintf(stderr, "skyvert trade: built without valgrind's header: nothing is counted\n");
        return 1;
    }
    while (*numbers && status == 0) {
        char *end;
        const unsigned long i = strtoul(numbers, &end, 10);
        if (end == numbers || i >= rows->n) {
            fprintf(stderr, "skyvert trade: there is no row %.20s\n", numbers);
            return 1;
        }
        const int once = *end == 's';
        status = count_row(rows, i, once ? 1 : TRADE_SCENES, making);
        end += once;
        numbers = end + (*end == ',');
    }
    return status;
}

static int counted(const trade_row *r) {
    for (int k = 0; k < TRADE_SCENES; k++)
        if (r->rays[k] > 0 && r->cost[k].instructions < 0)
            return 0;
    return 1;
}

static void take_count(void *taker, const char *label, double total) {
    trade_rows *const rows = taker;
    size_t i;
    int k;
    char what[16];
    if (sscanf(label, "%zu %d %15s", &i, &k, what) != 3 || i >= rows->n || k < 0 || k >= TRADE_SCENES)
        return;
    if (strcmp(what, "vertices") == 0)
        rows->at[i].cost[k].instructions = total / TRADE_DOME;
    else
        rows->at[i].cost[k].frame_instructions = total;
}

static int slow(const trade_row *r) {
    return r->cost[0].frame_ns > TRADE_SLOW_FRAME_NS;
}

/// The row of the first air.
static const trade_row *first_of(const trade_rows *rows, const trade_row *r) {
    const trade_row *first = rows->at;
    while (first->config != r->config)
        first++;
    return first;
}

/// Rows too slow to be counted everywhere take what was counted in the first scene of the first air.
static void spread_slow(const trade_rows *rows, trade_row *r) {
    const trade_cost *const from = &first_of(rows, r)->cost[0];
    for (int k = 0; slow(r) && k < TRADE_SCENES; k++)
        if (r->rays[k] > 0) {
            r->cost[k].instructions = from->instructions;
            r->cost[k].frame_instructions = from->frame_instructions;
        }
}

static char *numbers_of(const trade_rows *rows, size_t *n) {
    char *const numbers = malloc(8 * rows->n + 8);
    size_t used = 0;
    *n = 0;
    for (size_t i = 0; numbers && i < rows->n; i++)
        if (!counted(&rows->at[i]) && !(slow(&rows->at[i]) && first_of(rows, &rows->at[i]) != &rows->at[i])) {
            used += (size_t)snprintf(numbers + used, 8 * rows->n + 8 - used, "%s%zu%s", *n ? "," : "", i,
                                     slow(&rows->at[i]) ? "s" : "");
            ++*n;
        }
    return numbers;
}

int trade_count(trade_rows *rows, const trade_counting *how) {
    size_t n;
    char *const numbers = numbers_of(rows, &n);
    int status = numbers ? CALLGRIND_DONE : CALLGRIND_FAILED;
    if (numbers && n > 0) {
        const callgrind_run run = {.command = how->command,
                                   .last = numbers,
                                   .folder = how->folder,
                                   .expected = 2.0 * TRADE_SCENES * (double)n,
                                   .take = take_count,
                                   .taker = rows,
                                   .progress = how->progress,
                                   .context = how->context};
        status = callgrind_count(&run);
        if (status == CALLGRIND_FAILED)
            fprintf(stderr, "skyvert trade: valgrind failed (its log: %s/log): instructions are missing\n",
                    how->folder);
        for (size_t i = 0; i < rows->n; i++)
            spread_slow(rows, &rows->at[i]);
    }
    free(numbers);
    return status == CALLGRIND_DONE ? 0 : status == CALLGRIND_STOPPED ? TRADE_STOPPED : -1;
}
