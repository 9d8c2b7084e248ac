/// Rays asked for on the standard input: a CSV with the four columns of `skyvert eval`.
#ifndef TOOLS_REFERENCE_QUERIES_H
#define TOOLS_REFERENCE_QUERIES_H

#include <stddef.h>
#include <stdio.h>

typedef struct ref_query {
    double altitude_km, sun_zenith_deg, view_zenith_deg, azimuth_deg;
    int line; ///< of the input
} ref_query;

/// Reads all. @return 0; 2 after a line on stderr (nothing is kept then).
int ref_queries_read(FILE *in, const char *name, ref_query **queries, size_t *count);

#endif
