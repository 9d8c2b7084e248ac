/// What both versions of libgpiod have in common: where a line is, why it cannot be had, the clock of its edges.
#ifndef SKV_GPIO_CHIPS_H
#define SKV_GPIO_CHIPS_H

#include "port/gpiod/lines.h"

enum { CHIPS_PATH = 80, CHIPS_ABSENT = -1, CHIPS_REFUSED = -2 };

typedef struct {
    char chip[CHIPS_PATH];
    unsigned offset;
} chips_place;

/// @return offset of the line `name` on the chip at this path, CHIPS_ABSENT, or CHIPS_REFUSED and errno.
typedef int chips_find(const char *path, const char *name);

/// Where n lines are.
/// @return false iff one is not found or they are not different lines of one chip, with a reason.
bool chips_gather(const lines_spec *specs, int n, chips_find *find, chips_place places[LINES_MAX], char why[LINES_WHY]);

/// Why a chip cannot be opened.
void chips_refused(const char *path, int error, char *why, size_t room);

/// Why lines of a chip cannot be had.
/// @param user who has one of them; NULL: nobody is known.
void chips_explain(int error, const char *user, bool inputs, char why[LINES_WHY]);

/// The time of an edge by the clock of lines_now(). Kernels before 5.7 stamp with the wall clock.
/// @param now_ns, wall_ns both clocks at one moment after the edge.
int64_t chips_steady(int64_t at_ns, int64_t now_ns, int64_t wall_ns);

#endif
