#include "callgrind.h"

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

int callgrind_built(void) {
    return 1;
}

void callgrind_on(void) {
    CALLGRIND_START_INSTRUMENTATION;
}

void callgrind_off(void) {
    CALLGRIND_STOP_INSTRUMENTATION;
}

void callgrind_begin(void) {
    CALLGRIND_ZERO_STATS;
    CALLGRIND_TOGGLE_COLLECT;
}

// The argument of a client request must be a string of the program's own.
void callgrind_end(const char *label) {
    char text[CALLGRIND_LABEL];
    CALLGRIND_TOGGLE_COLLECT;
    if (!label)
        return;
    snprintf(text, sizeof text, "%s", label);
    CALLGRIND_DUMP_STATS_AT(text);
}

#else

int callgrind_built(void) {
    return 0;
}

void callgrind_on(void) {}

void callgrind_off(void) {}

void callgrind_begin(void) {}

void callgrind_end(const char *label) {
    (void)label;
}

#endif

/// One dump; an unfinished one has no totals.
static void take_dump(const callgrind_run *run, const char *name) {
    static const char trigger[] = "desc: Trigger: Client Request: ";
    char text[512], label[CALLGRIND_LABEL] = "";
    FILE *const in = fopen(name, "r");
    if (!in)
        return;
    while (fgets(text, sizeof text, in)) {
        if (strncmp(text, trigger, sizeof trigger - 1) == 0)
            snprintf(label, sizeof label, "%.*s", (int)strcspn(text + sizeof trigger - 1, "\n"),
                     text + sizeof trigger - 1);
        if (strncmp(text, "totals: ", 8) == 0 && label[0])
            run->take(run->taker, label, strtod(text + 8, NULL));
    }
    fclose(in);
}

static void dump_name(const callgrind_run *run, int i, char name[400]) {
    snprintf(name, 400, "%.380s/cg.%d", run->folder, i);
}

/// Takes the dumps that are there and removes them. @return the number of the next
static int take_dumps(const callgrind_run *run, int from, int all) {
    char name[400], after[400];
    for (;; from++) {
        dump_name(run, from, name);
        dump_name(run, from + 1, after);
        if (access(name, R_OK) != 0 || (!all && access(after, R_OK) != 0)) // the last may be unfinished
            return from;
        take_dump(run, name);
        unlink(name);
    }
}

static void remove_dumps(const callgrind_run *run) {
    char name[400];
    for (int i = 1, gone = 0; gone < 100; i++) {
        dump_name(run, i, name);
        gone = unlink(name) == 0 ? 0 : gone + 1;
    }
}

static void remove_folder(const callgrind_run *run, int with_log) {
    char name[400];
    remove_dumps(run);
    snprintf(name, sizeof name, "%.380s/cg", run->folder);
    unlink(name);
    snprintf(name, sizeof name, "%.380s/log", run->folder);
    if (with_log)
        unlink(name);
    rmdir(run->folder);
}

static pid_t start(const callgrind_run *run) {
    char out[440], log[440];
    char *arguments[32] = {(char *)"valgrind",
                           (char *)"--tool=callgrind",
                           (char *)"--instr-atstart=no",
                           (char *)"--collect-atstart=no",
                           out,
                           log};
    int n = 6;
    snprintf(out, sizeof out, "--callgrind-out-file=%.380s/cg", run->folder);
    snprintf(log, sizeof log, "--log-file=%.380s/log", run->folder);
    for (int i = 0; run->command[i] && n < 30; i++)
        arguments[n++] = run->command[i];
    arguments[n++] = (char *)run->last;
    fflush(NULL);
    const pid_t child = fork();
    if (child == 0) {
        execvp("valgrind", arguments);
        _exit(127);
    }
    return child;
}

/// Waits for the child, taking what it has counted.
static int attend(const callgrind_run *run, pid_t child) {
    const struct timespec pause = {0, 100000000};
    int status = 0, next = 1, stopped = 0;
    pid_t ended;
    while ((ended = waitpid(child, &status, WNOHANG)) == 0) {
        nanosleep(&pause, NULL);
        next = take_dumps(run, next, 0);
        const double done = next / run->expected;
        if (!stopped && run->progress && run->progress(run->context, done < 1 ? done : 1)) {
            stopped = 1;
            kill(child, SIGKILL);
        }
    }
    take_dumps(run, next, 1);
    if (stopped || (run->progress && run->progress(run->context, 1))) // a Ctrl-C reaches the child, too
        return CALLGRIND_STOPPED;
    return ended == child && WIFEXITED(status) && WEXITSTATUS(status) == 0 ? CALLGRIND_DONE : CALLGRIND_FAILED;
}

int callgrind_count(const callgrind_run *run) {
    (void)mkdir(run->folder, 0777);
    remove_dumps(run); // of a run that was killed
    const pid_t child = start(run);
    const int status = child > 0 ? attend(run, child) : CALLGRIND_FAILED;
    remove_folder(run, status != CALLGRIND_FAILED);
    return status;
}
