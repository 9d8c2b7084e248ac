/// Flights as CSV: utc,lat_deg,lon_deg,height_m in any order, further columns ignored.
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "csv.h"
#include "flight.h"
#include "moment.h"

enum { COLUMN_UTC, COLUMN_LAT, COLUMN_LON, COLUMN_HEIGHT, COLUMNS };

static const char *const column_names[COLUMNS] = {"utc", "lat_deg", "lon_deg", "height_m"};

/// One number of a row. @return 0; 2 after an error line.
static int number(const csv_reader *csv, const csv_columns *columns, int column, double low, double high,
                  double *value) {
    const char *text = csv->field[columns->place[column]];
    if (parse_number(text, value) && *value >= low && *value <= high)
        return 0;
    return fail_usage("%.200s:%ld: %s '%.40s': a number from %g to %g is needed", csv->name, csv->line,
                      column_names[column], text, low, high);
}

static int read_row(const csv_reader *csv, const csv_columns *columns, bool ellipsoid, fix *out) {
    const char *problem = csv_row_problem(csv, columns);
    if (problem)
        return fail_usage("%.200s:%ld: %s", csv->name, csv->line, problem);
    const char *utc = csv->field[columns->place[COLUMN_UTC]];
    problem = utc_parse(utc, &out->utc);
    if (problem)
        return fail_usage("%.200s:%ld: utc '%.40s': %s", csv->name, csv->line, utc, problem);
    int status = number(csv, columns, COLUMN_LAT, -90.0, 90.0, &out->lat_deg);
    if (status == 0)
        status = number(csv, columns, COLUMN_LON, -180.0, 360.0, &out->lon_deg);
    if (status == 0)
        status = number(csv, columns, COLUMN_HEIGHT, HEIGHT_LOW_M, HEIGHT_HIGH_M, &out->height_m);
    place at = {.lat_deg = out->lat_deg, .lon_deg = out->lon_deg};
    if (status == 0)
        status = moment_set_height(&at, out->height_m, ellipsoid ? HEIGHT_ELLIPSOID : HEIGHT_MSL);
    out->height_m = at.msl_m;
    return status;
}

static int read_all(csv_reader *csv, flight *track, bool ellipsoid) {
    csv_columns columns = {.names = column_names, .count = COLUMNS};
    int status = csv_header(csv, &columns);
    while (status == 0 && csv_next(csv)) {
        fix next;
        status = read_row(csv, &columns, ellipsoid, &next);
        if (status == 0)
            status = flight_append(track, &next, csv->name, csv->line);
    }
    return status == 0 && csv->failed ? csv_read_failed(csv) : status;
}

int flight_read_csv(flight *track, const char *path, bool ellipsoid) {
    FILE *stream = fopen(path, "rb");
    if (!stream)
        return fail_usage("%.200s: cannot be read: %s", path, strerror(errno));
    csv_reader csv;
    int status;
    if (csv_begin(&csv, stream, path)) {
        status = read_all(&csv, track, ellipsoid);
        csv_end(&csv);
    } else {
        status = fail_job("%.200s: out of memory", path);
    }
    fclose(stream);
    return status;
}
