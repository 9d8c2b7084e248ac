#include "count.h"

#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#ifdef __has_include
#if __has_include(<valgrind/callgrind.h>)
#define HAVE_CALLGRIND 1
#include <valgrind/callgrind.h>
#endif
#endif

#ifdef HAVE_CALLGRIND

int trade_count_possible(void) {
    const char *path = getenv("PATH");
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

static void start(void) {
    CALLGRIND_ZERO_STATS;
    CALLGRIND_TOGGLE_COLLECT;
}

// The argument of a client request must be a string of the program's own.
static void stop(size_t row, int scene, const char *what) {
    char label[64];
    CALLGRIND_TOGGLE_COLLECT;
    snprintf(label, sizeof label, "%zu %d %s", row, scene, what);
    CALLGRIND_DUMP_STATS_AT(label);
}

static void count_scene(trade_subject *s, size_t row, int k, const trade_scene *scene) {
    start();
    if (!trade_subject_frame(s, scene)) {
        CALLGRIND_TOGGLE_COLLECT;
        return;
    }
    stop(row, k, "frame");
    trade_lay_dome(scene, direction);
    trade_subject_radiance(s, 8, (const float(*)[3])direction,
                           radiance); // what is bound at first use is not the subject's
    start();
    trade_subject_radiance(s, TRADE_DOME, (const float(*)[3])direction, radiance);
    stop(row, k, "vertices");
}

static int count_row(trade_rows *rows, size_t i, int scenes, const trade_making *making) {
    const trade_row *const r = &rows->at[i];
    trade_subject subject;
    const char *why;
    CALLGRIND_STOP_INSTRUMENTATION;
    if (trade_subject_open(&subject, r->config, r->truth, making, &why) != TRADE_OK)
        return 0; // said so where errors were measured
    if (scenes > 1)
        (void)trade_subject_frame(&subject, &r->truth->scene[0]); // binds what is bound at first use
    CALLGRIND_START_INSTRUMENTATION;
    for (int k = 0; k < scenes; k++)
        count_scene(&subject, i, k, &r->truth->scene[k]);
    trade_subject_close(&subject);
    return 0;
}

#else

int trade_count_possible(void) {
    return 0;
}

static int count_row(trade_rows *rows, size_t i, int scenes, const trade_making *making) {
    (void)rows, (void)i, (void)scenes, (void)making;
    fprintf(stderr, "skyvert trade: built without valgrind's header: nothing is counted\n");
    return 1;
}

#endif

int trade_count_rows(trade_rows *rows, const char *numbers, const trade_making *making) {
    int status = 0;
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

static void take_count(trade_rows *rows, const char *label, double total) {
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

/// One dump; an unfinished one has no totals.
static void take_dump(trade_rows *rows, const char *name) {
    static const char trigger[] = "desc: Trigger: Client Request: ";
    char text[512], label[64] = "";
    FILE *const in = fopen(name, "r");
    if (!in)
        return;
    while (fgets(text, sizeof text, in)) {
        if (strncmp(text, trigger, sizeof trigger - 1) == 0)
            snprintf(label, sizeof label, "%.*s", (int)strcspn(text + sizeof trigger - 1, "\n"),
                     text + sizeof trigger - 1);
        if (strncmp(text, "totals: ", 8) == 0 && label[0])
            take_count(rows, label, strtod(text + 8, NULL));
    }
    fclose(in);
}

/// Takes the dumps that are there and removes them. @return the number of the next
static int take_dumps(trade_rows *rows, const char *folder, int from, int all) {
    char name[400], after[400];
    for (;; from++) {
        snprintf(name, sizeof name, "%s/cg.%d", folder, from);
        snprintf(after, sizeof after, "%s/cg.%d", folder, from + 1);
        if (access(name, R_OK) != 0 || (!all && access(after, R_OK) != 0)) // the last may be unfinished
            return from;
        take_dump(rows, name);
        unlink(name);
    }
}

static void remove_dumps(const char *folder) {
    char name[400];
    for (int i = 1, gone = 0; gone < 100; i++) {
        snprintf(name, sizeof name, "%s/cg.%d", folder, i);
        gone = unlink(name) == 0 ? 0 : gone + 1;
    }
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

static pid_t run_under_valgrind(const trade_counting *how, char *numbers) {
    char out[400], log[400];
    char *arguments[32] = {(char *)"valgrind",
                           (char *)"--tool=callgrind",
                           (char *)"--instr-atstart=no",
                           (char *)"--collect-atstart=no",
                           out,
                           log};
    size_t n = 6;
    snprintf(out, sizeof out, "--callgrind-out-file=%s/cg", how->folder);
    snprintf(log, sizeof log, "--log-file=%s/log", how->folder);
    for (size_t i = 0; how->command[i] && n < 30; i++)
        arguments[n++] = how->command[i];
    arguments[n++] = numbers;
    fflush(NULL);
    const pid_t child = fork();
    if (child == 0) {
        execvp("valgrind", arguments);
        _exit(127);
    }
    return child;
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

/// Waits for the child, taking what it has counted. @return 0; TRADE_STOPPED; -1
static int attend(trade_rows *rows, const trade_counting *how, pid_t child, size_t n) {
    const struct timespec pause = {0, 100000000};
    int status, next = 1, stopped = 0;
    pid_t ended;
    while ((ended = waitpid(child, &status, WNOHANG)) == 0) {
        nanosleep(&pause, NULL);
        next = take_dumps(rows, how->folder, next, 0);
        const double done = (double)next / (2.0 * TRADE_SCENES * (double)n);
        if (!stopped && how->progress && how->progress(how->context, done < 1 ? done : 1)) {
            stopped = 1;
            kill(child, SIGKILL);
        }
    }
    take_dumps(rows, how->folder, next, 1);
    if (stopped || (how->progress && how->progress(how->context, 1))) // a Ctrl-C reaches the child, too
        return TRADE_STOPPED;
    return ended == child && WIFEXITED(status) && WEXITSTATUS(status) == 0 ? 0 : -1;
}

int trade_count(trade_rows *rows, const trade_counting *how) {
    size_t n;
    char name[400];
    char *const numbers = numbers_of(rows, &n);
    int status = numbers ? 0 : -1;
    if (numbers && n > 0) {
        (void)mkdir(how->folder, 0777);
        remove_dumps(how->folder); // of a run that was killed
        const pid_t child = run_under_valgrind(how, numbers);
        status = child > 0 ? attend(rows, how, child, n) : -1;
        if (status == -1)
            fprintf(stderr, "skyvert trade: valgrind failed (its log: %s/log): instructions are missing\n",
                    how->folder);
        for (size_t i = 0; i < rows->n; i++)
            spread_slow(rows, &rows->at[i]);
        remove_dumps(how->folder);
        snprintf(name, sizeof name, "%s/cg", how->folder);
        unlink(name);
        snprintf(name, sizeof name, "%s/log", how->folder);
        if (status != -1)
            unlink(name);
        rmdir(how->folder);
    }
    free(numbers);
    return status;
}
