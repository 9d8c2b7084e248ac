/// Reads and checks queries.
#include "queries.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "csv.h"

const char *const query_names[QUERY_COLUMNS] = {"altitude_km", "sun_zenith_deg", "view_zenith_deg", "rel_azimuth_deg"};

static const struct {
    double low, high;
    const char *allowed;
} limits[QUERY_COLUMNS] = {{0, 1e6, "a number from 0 to 1e6"},
                           {0, 180, "a number from 0 to 180"},
                           {0, 180, "a number from 0 to 180"},
                           {-1.7976931348623157e308, 1.7976931348623157e308, "a finite number"}};

void queries_free(query_list *list) {
    free(list->row);
    free(list->text);
    *list = (query_list){0};
}

/// @return NULL iff memory ran out (the old list stays)
static void *make_room(void *list, size_t needed, size_t *capacity, size_t size) {
    if (needed <= *capacity)
        return list;
    const size_t wanted = needed + needed / 2 + 1024;
    if (wanted > SIZE_MAX / 2 / size)
        return NULL;
    void *const larger = realloc(list, wanted * size);
    if (larger)
        *capacity = wanted;
    return larger;
}

static bool add(query_list *list, const query *q, const csv_reader *csv, const csv_columns *columns) {
    size_t length = 0;
    for (int i = 0; i < QUERY_COLUMNS; i++)
        length += strlen(csv->field[columns->place[i]]) + 1;
    query *const rows = make_room(list->row, list->rows + 1, &list->row_capacity, sizeof *rows);
    if (!rows)
        return false;
    list->row = rows;
    char *const text = make_room(list->text, list->text_length + length, &list->text_capacity, 1);
    if (!text)
        return false;
    list->text = text;
    rows[list->rows] = *q;
    rows[list->rows++].text = list->text_length;
    for (int i = 0; i < QUERY_COLUMNS; i++) {
        const char *const field = csv->field[columns->place[i]];
        strcpy(text + list->text_length, field);
        list->text_length += strlen(field) + 1;
    }
    return true;
}

/// @return false after the row was named as a bad one
static bool parse_row(query *q, const csv_reader *csv, const csv_columns *columns, bad_rows *bad) {
    const char *const problem = csv_row_problem(csv, columns);
    if (problem) {
        bad_row(bad, csv->line, "%s", problem);
        return false;
    }
    for (int i = 0; i < QUERY_COLUMNS; i++) {
        const char *const field = csv->field[columns->place[i]];
        double *const v = &q->value[i];
        if (!parse_number(field, v) || *v < limits[i].low || *v > limits[i].high) {
            bad_row(bad, csv->line, "%s = %.40s: allowed is %s", query_names[i], *field ? field : "(nothing)",
                    limits[i].allowed);
            return false;
        }
    }
    return true;
}

static int read_rows(query_list *list, csv_reader *csv, const csv_columns *columns) {
    bad_rows bad = {.name = csv->name};
    query q;
    while (csv_next(csv)) {
        const bool good = parse_row(&q, csv, columns, &bad);
        if (good && bad.count == 0 && !add(list, &q, csv, columns))
            return fail_job("skyvert eval: out of memory at row %zu", list->rows + 1);
    }
    if (csv->failed)
        return csv_read_failed(csv);
    return bad_rows_end(&bad);
}

int queries_read(query_list *list, FILE *stream, const char *name) {
    csv_reader csv;
    csv_columns columns = {.names = query_names, .count = QUERY_COLUMNS};
    *list = (query_list){0};
    if (!csv_begin(&csv, stream, name))
        return fail_job("skyvert eval: out of memory");
    int result = csv_header(&csv, &columns);
    if (result == 0)
        result = read_rows(list, &csv, &columns);
    csv_end(&csv);
    return result;
}
