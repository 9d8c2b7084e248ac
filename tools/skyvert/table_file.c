/// Two columns of numbers.
#include "table_file.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "command.h"
#include "csv.h"

void table_free(density_table *table) {
    free(table->altitude_km);
    free(table->density);
    *table = (density_table){0};
}

static const char *const names[] = {"altitude_km", "relative_density"};

typedef struct table_reader {
    csv_reader csv;
    density_table *table;
    size_t place[2];
} table_reader;

/// @return whether the row is the header
static bool take_header(table_reader *r) {
    size_t found = 0;
    for (size_t i = 0; i < r->csv.fields && i < 2; i++)
        for (size_t k = 0; k < 2; k++)
            if (strcmp(r->csv.field[i], names[k]) == 0) {
                r->place[k] = i;
                found++;
            }
    return found == 2 && r->place[0] != r->place[1] && r->csv.fields == 2;
}

static int fail_row(const table_reader *r, const char *what) {
    return fail_usage("%.200s:%ld: %s", r->csv.name, r->csv.line, what);
}

static int take_row(table_reader *r) {
    density_table *const t = r->table;
    double altitude, density;
    if (r->csv.problem)
        return fail_row(r, r->csv.problem);
    if (r->csv.fields != 2 || !parse_number(r->csv.field[r->place[0]], &altitude) ||
        !parse_number(r->csv.field[r->place[1]], &density))
        return fail_row(r, "not a row of the table; allowed are two numbers altitude_km,relative_density");
    if (altitude < -1000 || altitude > 1e6)
        return fail_row(r, "altitude_km: allowed is -1000 to 1e6");
    if (density < 0 || density > 1e6)
        return fail_row(r, "relative_density: allowed is 0 to 1e6");
    if (t->rows > 0 && !((float)altitude > t->altitude_km[t->rows - 1]))
        return fail_row(r, "altitude_km: allowed is more than in the row before");
    if (t->rows >= SKV_TABLE_ROWS_MAX)
        return fail_row(r, "too many rows; allowed are 512");
    t->altitude_km[t->rows] = (float)altitude;
    t->density[t->rows++] = (float)density;
    return 0;
}

static int read_rows(table_reader *r) {
    bool first = true;
    while (csv_next(&r->csv)) {
        if (r->csv.fields && (r->csv.field[0][0] == '#' || r->csv.field[0][0] == ';'))
            continue;
        const bool header = first && !r->csv.problem && take_header(r);
        const int result = header ? 0 : take_row(r);
        first = false;
        if (result)
            return result;
    }
    if (r->csv.failed)
        return csv_read_failed(&r->csv);
    return r->table->rows >= 2 ? 0
                               : fail_usage("%.200s:%ld: %u rows; allowed are 2 to 512 rows "
                                            "altitude_km,relative_density",
                                            r->csv.name, r->csv.line, (unsigned)r->table->rows);
}

int table_read(density_table *table, const char *path) {
    table_reader r = {.table = table, .place = {0, 1}};
    *table = (density_table){.altitude_km = malloc(SKV_TABLE_ROWS_MAX * sizeof(float)),
                             .density = malloc(SKV_TABLE_ROWS_MAX * sizeof(float))};
    FILE *const stream = fopen(path, "rb");
    const int error = errno;
    int result;
    if (!stream)
        result = fail_usage("%.200s: cannot be read: %s", path, strerror(error));
    else if (!table->altitude_km || !table->density || !csv_begin(&r.csv, stream, path))
        result = fail_job("out of memory");
    else
        result = read_rows(&r);
    csv_end(&r.csv);
    if (stream)
        fclose(stream);
    if (result)
        table_free(table);
    return result;
}
