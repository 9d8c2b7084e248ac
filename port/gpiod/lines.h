/// What the panel needs of a GPIO library. One of gpiod1.c, gpiod2.c, none.c or (tests) fake.c stands behind it.
#ifndef SKV_GPIO_LINES_H
#define SKV_GPIO_LINES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { LINES_MAX = 2, LINES_WHY = 200 };

/// One line as configured: by name, or where name is NULL by chip (a path) and offset.
typedef struct {
    const char *name;
    const char *chip;
    unsigned offset;
    bool active_low, pull_up;
} lines_spec;

typedef struct {
    int64_t at_ns; ///< CLOCK_MONOTONIC
    int index;     ///< in the request
    bool level;    ///< after the edge, active_low regarded
} lines_edge;

typedef struct lines_request lines_request;

/// Both edges of n lines of one chip, in one request.
/// @return NULL on error, with a reason.
lines_request *lines_inputs(const lines_spec *specs, int n, char why[LINES_WHY]);

/// One output, starting inactive.
lines_request *lines_output(const lines_spec *spec, char why[LINES_WHY]);

/// Descriptors that are readable when edges wait. @return how many.
int lines_fds(const lines_request *request, int fds[LINES_MAX]);

/// Edges that wait; never blocks; those of different lines need not be in order. @return how many, -1 iff the lines are
/// lost.
int lines_read(lines_request *request, lines_edge *edges, int room);

/// Level of an input now. @return 0, 1, or -1 iff the line is lost.
int lines_level(lines_request *request, int index);

/// @return 0, or -1 iff the line is lost.
int lines_set(lines_request *request, bool level);

void lines_release(lines_request *request);

/// The clock of the edges, ns.
int64_t lines_now(void);

#endif
