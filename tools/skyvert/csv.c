/// CSV records, headers and the list of bad rows.
#include "csv.h"

#include <errno.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "command.h"

bool csv_begin(csv_reader *csv, FILE *stream, const char *name) {
    *csv = (csv_reader){.name = name, .stream = stream, .next_line = 1};
    csv->capacity = CSV_RECORD_MAX + 1;
    csv->text = malloc(csv->capacity);
    csv->field = malloc(CSV_FIELDS_MAX * sizeof *csv->field);
    if (csv->text && csv->field)
        return true;
    csv_end(csv);
    return false;
}

void csv_end(csv_reader *csv) {
    free(csv->text);
    free(csv->field);
    csv->text = NULL;
    csv->field = NULL;
}

/// Appends a byte of the record; notes what cannot be text.
static void keep(csv_reader *csv, int c) {
    if (c == '\0' || (c < 0x20 && c != '\t' && c != '\n' && c != '\r') || c == 0x7f)
        csv->problem = "binary data, not text";
    if (csv->length + 1 < csv->capacity)
        csv->text[csv->length++] = (char)c;
    else
        csv->problem = "the row is too long: allowed are 65535 bytes";
}

typedef enum place { FIELD_START, PLAIN, QUOTED, QUOTE_END } place;

/// Where a byte leads to: a quote counts at the start of a field only, and doubled within quotes.
static place step(place at, int c) {
    if (at == QUOTED)
        return c == '"' ? QUOTE_END : QUOTED;
    if (c == ',')
        return FIELD_START;
    if (c == '"' && (at == FIELD_START || at == QUOTE_END))
        return QUOTED;
    return at == FIELD_START && (c == ' ' || c == '\t') ? FIELD_START : PLAIN;
}

/// Reads one record into csv->text, ends of lines within quotes included. A row without end is given up at some length.
/// @return false at the end of the input
static bool read_record(csv_reader *csv) {
    place at = FIELD_START;
    int c = EOF;
    size_t bytes = 0;
    csv->length = 0;
    csv->problem = NULL;
    csv->line = csv->next_line;
    while (!csv->given_up && (c = getc(csv->stream)) != EOF) {
        csv->given_up = ++bytes > CSV_SKIP_MAX;
        if (c == '\n') {
            csv->next_line++;
            if (at != QUOTED)
                break;
        }
        at = step(at, c);
        keep(csv, c);
    }
    csv->failed = ferror(csv->stream) != 0;
    if (at == QUOTED && !csv->problem)
        csv->problem = "a quote is not closed";
    csv->text[csv->length] = '\0';
    return c != EOF || csv->length > 0;
}

static bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\r';
}

/// Unquotes one field in place. @return behind it: at the comma or the end
static char *take_field(csv_reader *csv, char *c) {
    while (is_blank(*c))
        c++;
    char *const first = c;
    char *out = c, *end = c; // end: behind the last byte that is not a blank
    if (*c == '"') {
        for (c++; *c && (*c != '"' || c[1] == '"'); c++) {
            if (*c == '"')
                c++;
            *out++ = *c;
        }
        end = out;
        c += *c == '"';
        while (is_blank(*c))
            c++;
        if (*c && *c != ',' && !csv->problem)
            csv->problem = "text behind a closing quote";
    }
    for (; *c && *c != ','; c++) {
        *out++ = *c;
        if (!is_blank(*c))
            end = out;
    }
    const char at = *c;
    *end = '\0';
    csv->field[csv->fields++] = first;
    return at ? c : NULL;
}

static void split(csv_reader *csv) {
    csv->fields = 0;
    char *c = csv->text;
    while ((c = take_field(csv, c)) != NULL) {
        c++;
        if (csv->fields == CSV_FIELDS_MAX) {
            csv->problem = "too many fields: allowed are 1024";
            return;
        }
    }
}

static bool is_empty_line(const csv_reader *csv) {
    for (size_t i = 0; i < csv->length; i++)
        if (!is_blank(csv->text[i]))
            return false;
    return !csv->problem;
}

static void skip_byte_order_mark(csv_reader *csv) {
    if (csv->line == 1 && csv->length >= 3 && memcmp(csv->text, "\xEF\xBB\xBF", 3) == 0) {
        csv->length -= 3;
        memmove(csv->text, csv->text + 3, csv->length + 1);
    }
}

bool csv_next(csv_reader *csv) {
    do {
        if (!read_record(csv) || csv->failed)
            return false;
        skip_byte_order_mark(csv);
    } while (is_empty_line(csv));
    split(csv);
    return true;
}

/// @return 0; 2 after a line that lists the columns where this one is not there exactly once
static int find_column(const csv_reader *csv, csv_columns *columns, size_t which) {
    size_t found = 0;
    for (size_t i = 0; i < csv->fields; i++)
        if (strcmp(csv->field[i], columns->names[which]) == 0 && found++ == 0)
            columns->place[which] = i;
    if (found == 1)
        return 0;
    char needed[256] = "";
    for (size_t i = 0; i < columns->count; i++) {
        const size_t used = strlen(needed);
        snprintf(needed + used, sizeof needed - used, "%s%s", i ? "," : "", columns->names[i]);
    }
    return fail_usage("%s:%ld: column %s %s; needed once each, in any order: %s", csv->name, csv->line,
                      columns->names[which], found ? "stands there more than once" : "is missing", needed);
}

int csv_read_failed(const csv_reader *csv) {
    return fail_usage("%s: cannot be read: %s", csv->name, errno ? strerror(errno) : "input error");
}

int csv_header(csv_reader *csv, csv_columns *columns) {
    errno = 0;
    if (!csv_next(csv)) {
        if (csv->failed)
            return csv_read_failed(csv);
        return fail_usage("%s:1: empty input; a header line with the names of the columns is needed", csv->name);
    }
    if (csv->problem)
        return fail_usage("%s:%ld: %s", csv->name, csv->line, csv->problem);
    for (size_t i = 0; i < columns->count; i++) {
        const int result = find_column(csv, columns, i);
        if (result)
            return result;
    }
    columns->width = csv->fields;
    return 0;
}

const char *csv_row_problem(const csv_reader *csv, const csv_columns *columns) {
    if (csv->problem)
        return csv->problem;
    if (csv->fields < columns->width)
        return "fewer fields than the header has";
    for (size_t i = columns->width; i < csv->fields; i++)
        if (csv->field[i][0] != '\0')
            return "more fields than the header has";
    return NULL;
}

void bad_row(bad_rows *bad, long line, const char *format, ...) {
    if (bad->count++ >= BAD_ROWS_NAMED)
        return;
    char text[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    fail_usage("%s:%ld: %s", bad->name, line, text);
}

int bad_rows_end(const bad_rows *bad) {
    if (bad->count == 0)
        return 0;
    if (bad->count > BAD_ROWS_NAMED)
        fail_usage("%s: and %zu more bad rows", bad->name, bad->count - BAD_ROWS_NAMED);
    return EXIT_USAGE;
}
