/// Reads CSV (RFC 4180, leniently): quoted fields, CRLF, a byte order mark, blank lines, no newline at the end.
#ifndef SKYVERT_CSV_H
#define SKYVERT_CSV_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "command.h"

#define CSV_FIELDS_MAX 1024
#define CSV_RECORD_MAX 65536    ///< bytes
#define CSV_SKIP_MAX   67108864 ///< bytes of a row that is too long before the rest of the input is given up

typedef struct csv_reader {
    const char *name; ///< for messages: a path or "stdin"
    FILE *stream;
    long line;           ///< where the current record starts, from 1
    size_t fields;       ///< of the current record
    const char **field;  ///< [fields], blanks around them removed; valid until the next call
    const char *problem; ///< what is wrong with the current record, or NULL
    bool failed;         ///< reading failed (errno says why)
    char *text;          // the record
    size_t length, capacity;
    bool given_up;
    long next_line;
} csv_reader;

/// @return false iff memory ran out.
bool csv_begin(csv_reader *csv, FILE *stream, const char *name);
void csv_end(csv_reader *csv);
/// Next record that is not blank. A malformed one is returned too, with csv->problem set.
/// @return false at the end, or where reading failed (csv->failed).
bool csv_next(csv_reader *csv);

/// The error line for csv->failed. @return 2
int csv_read_failed(const csv_reader *csv);

#define CSV_COLUMNS_MAX 16

/// Columns wanted by name.
typedef struct csv_columns {
    const char *const *names;
    size_t count;
    size_t place[CSV_COLUMNS_MAX];
    size_t width; ///< fields of the header
} csv_columns;

/// Reads the header. @return 0; 2 after an error line (empty input, a column missing or twice, reading failed).
int csv_header(csv_reader *csv, csv_columns *columns);
/// Checks the current record against the header. @return NULL, or what is wrong (constant text).
const char *csv_row_problem(const csv_reader *csv, const csv_columns *columns);

#define BAD_ROWS_NAMED 20

/// Names the first twenty bad rows on stderr and counts the others.
typedef struct bad_rows {
    const char *name;
    size_t count;
} bad_rows;

void bad_row(bad_rows *bad, long line, const char *format, ...) SKV_PRINTF(3, 4);
/// @return 0 iff there was none; else 2, after a line with the count where there were more than twenty.
int bad_rows_end(const bad_rows *bad);

#endif
