/// Reads queries.
#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "queries.h"

static const char *const columns[4] = {"altitude_km", "sun_zenith_deg", "view_zenith_deg", "rel_azimuth_deg"};

static int find_columns(char *header, int at[4]) {
    int found = 0, i = 0;
    for (int k = 0; k < 4; k++)
        at[k] = -1;
    header[strcspn(header, "\r\n")] = '\0';
    for (char *name = header; name; i++) {
        char *comma = strchr(name, ',');
        if (comma)
            *comma = '\0';
        for (int k = 0; k < 4; k++)
            if (strcmp(name, columns[k]) == 0)
                found += at[k] < 0, at[k] = i;
        name = comma ? comma + 1 : NULL;
    }
    return found == 4;
}

static int read_query(const char *line, const int at[4], double query[4]) {
    int found = 0, i = 0;
    for (int k = 0; k < 4; k++)
        query[k] = 0;
    for (const char *field = line; field; i++) {
        char *end;
        const double value = strtod(field, &end);
        const int whole = end != field && strchr(", \t\r\n", *end) != NULL;
        for (int k = 0; k < 4; k++)
            if (at[k] == i && whole && isfinite(value))
                query[k] = value, found++;
        field = strchr(field, ',');
        field = field ? field + 1 : NULL;
    }
    return found == 4;
}

static int add(ref_query **queries, size_t *count, size_t *room, const double q[4], int line) {
    if (*count == *room) {
        ref_query *more = realloc(*queries, (*room = *room ? 2 * *room : 256) * sizeof *more);
        if (!more)
            return 0;
        *queries = more;
    }
    (*queries)[(*count)++] = (ref_query){q[0], q[1], q[2], q[3], line};
    return 1;
}

int ref_queries_read(FILE *in, const char *name, ref_query **queries, size_t *count) {
    char line[4096];
    int at[4];
    size_t room = 0;
    *queries = NULL;
    *count = 0;
    if (!fgets(line, sizeof line, in) || !find_columns(line, at)) {
        fprintf(stderr, "%s:1: the header must name altitude_km,sun_zenith_deg,view_zenith_deg,rel_azimuth_deg\n",
                name);
        return 2;
    }
    for (int number = 2; fgets(line, sizeof line, in); number++) {
        double q[4];
        if (line[strspn(line, " \t\r\n")] == '\0')
            continue;
        if (!read_query(line, at, q)) {
            fprintf(stderr, "%s:%d: four finite numbers are needed\n", name, number);
        } else if (add(queries, count, &room, q, number)) {
            continue;
        } else {
            fprintf(stderr, "%s:%d: out of memory\n", name, number);
        }
        free(*queries);
        *queries = NULL;
        *count = 0;
        return 2;
    }
    return 0;
}
