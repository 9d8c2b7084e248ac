/// Instructions of the ablation's skies, counted by callgrind.
#include "study_count.h"

#include <signal.h>
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
#ifndef HAVE_CALLGRIND
#define HAVE_CALLGRIND 0
#endif

#if HAVE_CALLGRIND

void study_count_on(void) {
    CALLGRIND_START_INSTRUMENTATION;
}

void study_count_off(void) {
    CALLGRIND_STOP_INSTRUMENTATION;
}

void study_count_begin(void) {
    CALLGRIND_ZERO_STATS;
    CALLGRIND_TOGGLE_COLLECT;
}

// The argument of a client request must be a string of the program's own.
void study_count_end(const char *label) {
    char text[STUDY_LABEL];
    CALLGRIND_TOGGLE_COLLECT;
    snprintf(text, sizeof text, "%s", label);
    CALLGRIND_DUMP_STATS_AT(text);
}

#else

void study_count_on(void) {}

void study_count_off(void) {}

void study_count_begin(void) {}

void study_count_end(const char *label) {
    (void)label;
}

#endif

/// One dump; an unfinished one has no totals.
static void take_dump(study_counts *counts, const char *name) {
    static const char trigger[] = "desc: Trigger: Client Request: ";
    char text[512], label[STUDY_LABEL] = "";
    FILE *const in = fopen(name, "r");
    while (in != NULL && fgets(text, sizeof text, in) != NULL) {
        if (strncmp(text, trigger, sizeof trigger - 1) == 0)
            snprintf(label, sizeof label, "%.*s", (int)strcspn(text + sizeof trigger - 1, "\n"),
                     text + sizeof trigger - 1);
        if (strncmp(text, "totals: ", 8) == 0 && label[0] != '\0' && counts->n < STUDY_COUNTS_MAX) {
            memcpy(counts->label[counts->n], label, sizeof label);
            counts->instructions[counts->n++] = strtod(text + 8, NULL);
        }
    }
    if (in != NULL)
        fclose(in);
}

static void dump_name(const trade_study *how, int i, char name[400]) {
    snprintf(name, 400, "%.380s/cg.%d", how->folder, i);
}

static void remove_dumps(const trade_study *how) {
    char name[400];
    for (int i = 1, gone = 0; gone < 100; i++) {
        dump_name(how, i, name);
        gone = unlink(name) == 0 ? 0 : gone + 1;
    }
    snprintf(name, sizeof name, "%.380s/cg", how->folder);
    unlink(name);
    snprintf(name, sizeof name, "%.380s/log", how->folder);
    unlink(name);
    rmdir(how->folder);
}

static pid_t start(const trade_study *how) {
    char out[440], log[440];
    char *arguments[32] = {(char *)"valgrind",
                           (char *)"--tool=callgrind",
                           (char *)"--instr-atstart=no",
                           (char *)"--collect-atstart=no",
                           out,
                           log};
    int n = 6;
    snprintf(out, sizeof out, "--callgrind-out-file=%.380s/cg", how->folder);
    snprintf(log, sizeof log, "--log-file=%.380s/log", how->folder);
    for (int i = 0; how->command[i] != NULL && n < 31; i++)
        arguments[n++] = how->command[i];
    fflush(NULL);
    const pid_t child = fork();
    if (child == 0) {
        execvp("valgrind", arguments);
        _exit(127);
    }
    return child;
}

static int dumps_there(const trade_study *how, int from) {
    char name[400];
    for (;; from++) {
        dump_name(how, from + 1, name);
        if (access(name, R_OK) != 0)
            return from;
    }
}

/// Waits for the child. @return DONE, STOPPED, FAILED
static int attend(const trade_study *how, pid_t child, int expected) {
    const struct timespec pause = {0, 100000000};
    int status = 0, stopped = 0, there = 0;
    pid_t ended;
    while ((ended = waitpid(child, &status, WNOHANG)) == 0) {
        nanosleep(&pause, NULL);
        there = dumps_there(how, there);
        if (!stopped && how->progress != NULL &&
            how->progress(how->context, there < expected ? (double)there / expected : 1)) {
            stopped = 1;
            kill(child, SIGKILL);
        }
    }
    if (stopped || (how->progress != NULL && how->progress(how->context, 1))) // a Ctrl-C reaches the child, too
        return TRADE_STUDY_STOPPED;
    return ended == child && WIFEXITED(status) && WEXITSTATUS(status) == 0 ? TRADE_STUDY_DONE : TRADE_STUDY_FAILED;
}

int study_count_run(const trade_study *how, int expected, study_counts *counts) {
    char name[400];
    counts->n = 0;
    if (how->command == NULL)
        return TRADE_STUDY_DONE;
    if (!HAVE_CALLGRIND) {
        fprintf(stderr, "trade: built without valgrind's header: instructions are not counted\n");
        return TRADE_STUDY_DONE;
    }
    (void)mkdir(how->folder, 0777);
    const pid_t child = start(how);
    const int status = child > 0 ? attend(how, child, expected) : TRADE_STUDY_FAILED;
    for (int i = 1; status == TRADE_STUDY_DONE && i <= STUDY_COUNTS_MAX; i++) {
        dump_name(how, i, name);
        take_dump(counts, name);
    }
    if (status == TRADE_STUDY_FAILED)
        fprintf(stderr, "trade: valgrind is missing or failed: instructions are not counted\n");
    remove_dumps(how);
    return status == TRADE_STUDY_STOPPED ? status : TRADE_STUDY_DONE;
}

double study_count_of(const study_counts *counts, const char *label) {
    for (int i = 0; i < counts->n; i++)
        if (strcmp(counts->label[i], label) == 0)
            return counts->instructions[i];
    return -1;
}
