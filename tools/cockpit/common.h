/// What skyvert-sim and skyvert-cockpit share: error lines of options, and the exit status where there is no CAN.
#ifndef COCKPIT_COMMON_H
#define COCKPIT_COMMON_H

#include "tools/skyvert/command.h"

/// Exit status of a program that needs a CAN bus on a kernel without CAN.
enum { EXIT_NO_CAN = 3 };

/// The value of `option` ("--speed") in [low, high]. @return 0; 2 after an error line that names program and range.
int common_number(const char *program, const char *option, const char *text, double low, double high, double *value);
/// The same for whole numbers.
int common_integer(const char *program, const char *option, const char *text, int low, int high, int *value);
/// One of `names` (NULL at the end); *index is its place.
int common_choice(const char *program, const char *option, const char *text, const char *const names[], int *index);
/// After getopt_long() (called with opterr = 0 and ":" first in the short options) gave '?' or ':'. @return 2
int common_unknown(const char *program, int got, char **argv);
/// The line of --version. @return the exit status
int common_version(const char *program);

#endif
