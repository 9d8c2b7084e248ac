/// What the parts of the command `skyvert` share: subcommands, errors, numbers, time, output files.
///
/// Exit statuses: 0 done; 1 the job failed (writing, memory, a package this build lacks); 2 bad input.
#ifndef SKYVERT_COMMAND_H
#define SKYVERT_COMMAND_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "skyvert/skyvert.h"

#if defined(__GNUC__)
#define SKV_PRINTF(text, first) __attribute__((format(printf, text, first)))
#else
#define SKV_PRINTF(text, first)
#endif

enum { EXIT_DONE = 0, EXIT_JOB = 1, EXIT_USAGE = 2 };

// --- subcommands: argv[0] is the subcommand's name; the result is the exit status ---

int cmd_eval(int argc, char **argv);
int cmd_sun(int argc, char **argv);
int cmd_render(int argc, char **argv);
int cmd_track(int argc, char **argv);
int cmd_dome(int argc, char **argv);
int cmd_bake(int argc, char **argv);
int cmd_plan(int argc, char **argv);
int cmd_trade(int argc, char **argv);

// --- errors.c: one line to stderr, as given (start it with "skyvert NAME: " or "file:line: "), control bytes masked
// ---

/// Bad input. @return 2
int fail_usage(const char *format, ...) SKV_PRINTF(1, 2);
/// The job failed. @return 1
int fail_job(const char *format, ...) SKV_PRINTF(1, 2);

// --- options.c: strict numbers, independent of the locale ---

/// Decimal number with an optional exponent, spaces around it allowed; no hexadecimal, infinity, NaN, nothing behind
/// it.
/// @return false iff text is no such number or is too large for a double (value is not written then).
bool parse_number(const char *text, double *value);

/// The place of text among `names` (NULL at the end). @param[out] allowed  "a, b or c". @return -1: it is none of them.
#define CHOICE_TEXT 256
int parse_choice(const char *text, const char *const names[], char allowed[CHOICE_TEXT]);

/// The value of `--option` in [low, high]. @return 0; 2 after an error line that names command, option and range.
int option_number(const char *command, const char *option, const char *text, double low, double high, double *value);
int option_integer(const char *command, const char *option, const char *text, int low, int high, int *value);
/// One of `names` (NULL at the end); *index is its place.
int option_choice(const char *command, const char *option, const char *text, const char *const names[], int *index);
/// After getopt_long() (called with opterr = 0 and ":" first in the short options) gave '?' or ':'. @return 2
int option_unknown(const char *command, int got, char **argv);
/// Left-over arguments after the options. @return 0; 2 after an error line.
int option_no_more(const char *command, int argc, char **argv);

/// The version line of `--version`. @return the exit status
int option_version(void);

// --- progress.c: a bar on stderr when that is a terminal and the job takes over two seconds ---

void progress_begin(const char *what, size_t total);
void progress_update(size_t done);
void progress_end(void); ///< wipes the bar

// --- utc_text.c: ISO 8601 ---

/// A moment. One struct for text, sums and differences; to_skv() gives the core's.
typedef struct utc_time {
    int32_t day;    ///< since 2000-01-01
    double seconds; ///< of the day, [0, 86401): 86400.x only within a leap second
} utc_time;

#define UTC_TEXT_SIZE 40

/// `2021-08-17T04:30:00Z`, also with a blank for T, fractions of a second, no seconds, a bare date (midnight),
/// `+hh:mm` instead of Z; no zone means UTC. Years 1900 to 2100.
/// @return NULL, or what is wrong and what is allowed (constant text).
const char *utc_parse(const char *text, utc_time *time);
/// `2021-08-17T04:30:00Z`, milliseconds only where they are not 0. @return text
char *utc_text(const utc_time *time, char text[UTC_TEXT_SIZE]);
void utc_calendar(const utc_time *time, int *year, int *month, int *day, int *hour, int *minute, double *second);
utc_time utc_add(const utc_time *time, double seconds);
double utc_difference(const utc_time *later, const utc_time *earlier); ///< seconds
skv_utc utc_to_skv(const utc_time *time);

// --- output.c: written beside, then renamed; nothing half-done is left, also on Ctrl-C ---

typedef struct output {
    FILE *stream; ///< NULL with output_reserve()
    char *path;   ///< what the user named; "-" is the standard output
    char *temp;   ///< where the bytes go until output_commit(); NULL: straight to path (standard output, a device)
} output;

/// Starts a file. @return 0; 1 after an error line (2 iff the path is a directory or its folder does not exist).
int output_open(output *out, const char *path);
/// As output_open() for a library that opens the file by name: write to output_name(out), then commit.
int output_reserve(output *out, const char *path);
const char *output_name(const output *out);
/// Flushes, syncs, renames. @return 0; 1 after an error line, nothing is left then.
int output_commit(output *out);
/// Gives up after a line that says why writing failed: removes what was written. @return 1
int output_fail(output *out, const char *why);
/// Gives up: removes what was written. Safe after a commit or on a zeroed struct.
void output_discard(output *out);
/// Flushes the standard output at the end of a job. @return 0; 1 after an error line (full disk, closed pipe).
int output_finish_stdout(void);

#endif
