/// A folder for the files that a test writes, and what other programs print about them.
#ifndef TESTS_PICTURE_PORTS_H
#define TESTS_PICTURE_PORTS_H

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "check.h"

/// The folder, and the file opened last.
static char folder[300], path[400];

static inline int open_file(const char *name) {
    snprintf(path, sizeof path, "%s/%s", folder, name);
    const int fd = open(path, O_RDWR | O_CREAT | O_TRUNC, 0600);
    assert_true(fd >= 0);
    return fd;
}

/// Text that a program prints about the file.
static inline char *output_of(const char *program) {
    static char text[1 << 20];
    char command[1300];
    snprintf(command, sizeof command, "%s '%s' 2>&1", program, path);
    FILE *pipe = popen(command, "r");
    assert_true(pipe != NULL);
    const size_t n = fread(text, 1, sizeof text - 1, pipe);
    text[n] = '\0';
    const int status = pclose(pipe);
    if (status != 0)
        fail_msg("%s: status %d: %s", command, status, text);
    return text;
}

static inline void expect_line(const char *text, const char *line) {
    if (!strstr(text, line))
        fail_msg("want the line '%s' in:\n%.3000s", line, text);
}

static inline int set_up(void **state) {
    (void)state;
    const char *build = getenv("B"); // tests/run.sh exports it
    snprintf(folder, sizeof folder, "%.200s/ports-XXXXXX", build ? build : ".");
    return mkdtemp(folder) ? 0 : -1;
}

static inline int tear_down(void **state) {
    (void)state;
    char command[400];
    snprintf(command, sizeof command, "rm -rf '%s'", folder);
    return system(command);
}

#endif
