/// The rows of `skyvert eval`'s input.
#ifndef SKYVERT_QUERIES_H
#define SKYVERT_QUERIES_H

#include <stddef.h>
#include <stdio.h>

enum { QUERY_ALTITUDE, QUERY_SUN, QUERY_VIEW, QUERY_AZIMUTH, QUERY_COLUMNS };
extern const char *const query_names[QUERY_COLUMNS];

typedef struct query {
    double value[QUERY_COLUMNS];
    size_t text; ///< place of its four texts in query_list.text, each 0-terminated
} query;

typedef struct query_list {
    query *row;
    size_t rows, row_capacity;
    char *text;
    size_t text_length, text_capacity;
} query_list;

/// Reads and checks all rows. @return 0; 2 after error lines; 1 iff memory ran out. queries_free() in any case.
int queries_read(query_list *list, FILE *stream, const char *name);
void queries_free(query_list *list);

#endif
