/// What the fuzz targets of the command share: they stand in for errors.c and check every message.
#ifndef TESTS_COMMAND_FUZZ_H
#define TESTS_COMMAND_FUZZ_H

#include <ctype.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/skyvert/command.h"

#define FUZZ_CHECK(condition)                                                                                          \
    do {                                                                                                               \
        if (!(condition)) {                                                                                            \
            fprintf(stderr, "FAILED %s:%d: %s\n", __FILE__, __LINE__, #condition);                                     \
            abort();                                                                                                   \
        }                                                                                                              \
    } while (0)

static struct {
    int errors, notes;
    char last[1024];
} said;

/// A message names its file, then mostly the line: `NAME:12: what`.
static int say(const char *format, va_list arguments, int status) {
    vsnprintf(said.last, sizeof said.last, format, arguments);
    const char *const colon = strchr(said.last, ':');
    FUZZ_CHECK(colon != NULL && colon > said.last && strlen(colon) > 4);
    int behind = 0; // not just anywhere: the input's own bytes stand in messages
    sscanf(said.last, "%*[^:]:%*d: note: %n", &behind);
    if (behind > 0)
        said.notes++;
    else
        said.errors++;
    return status;
}

int fail_usage(const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    const int result = say(format, arguments, EXIT_USAGE);
    va_end(arguments);
    return result;
}

int fail_job(const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    const int result = say(format, arguments, EXIT_JOB);
    va_end(arguments);
    return result;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

#endif
