/// What is known of every configuration on every air, kept in a file while a trade runs.
#ifndef TOOLS_TRADE_ROWS_H
#define TOOLS_TRADE_ROWS_H

#include <stdint.h>

#include "config.h"
#include "truth.h"

/// Costs of one scene. Not measured: negative.
typedef struct trade_cost {
    double ns, ns_low, ns_high; ///< a vertex, processor time: median, 10th and 90th percentile
    double frame_ns;            ///< before the first vertex of a frame: median
    double instructions;        ///< a vertex
    double frame_instructions;  ///< before the first vertex
} trade_cost;

/// Times and counts are done where they are not negative.
enum { TRADE_DONE_ERROR = 1, TRADE_DONE_STACK = 2 };

typedef struct trade_row {
    const trade_config *config;
    const trade_truth *truth;
    uint64_t digest;  ///< of all that decides about its numbers
    unsigned done;    ///< TRADE_DONE_*
    char beyond[120]; ///< why a baseline cannot do this air; "" where it can
    double build_s;   ///< processor time
    double table_bytes, grid_bytes, work_bytes, stack_bytes;
    int sees_ground;                 ///< 0: measured with sky rays alone
    int rays[TRADE_SCENES];          ///< measured; 0: cannot do this scene
    trade_error error[TRADE_SCENES]; ///< of the scene; worst: index of its ray
    double off_scale[TRADE_SCENES];  ///< radiance that the worst ray's error is relative to
    trade_cost cost[TRADE_SCENES];
} trade_row;

typedef struct trade_rows {
    trade_row *at; ///< [n]; all configurations of the first air, then of the next
    size_t n;
    char file[300]; ///< where they are kept
} trade_rows;

/// Rows of all configurations and truths; what the file has of them with the same digest is taken over.
/// @param program  digest of the program that measures.
/// @return 0; 1 after a line on stderr (memory).
int trade_rows_begin(trade_rows *rows, const trade_config *configs, size_t n_configs, const trade_truth *truths,
                     size_t n_truths, uint64_t program, const char *file);
/// Writes the file beside and renames it. @return 0; 1 after a line on stderr.
int trade_rows_keep(const trade_rows *rows);
void trade_rows_free(trade_rows *rows);

/// Mixes bytes into a number (FNV-1a); start with TRADE_HASH_START.
#define TRADE_HASH_START 14695981039346656037u
uint64_t trade_hash(uint64_t hash, const void *bytes, size_t n);
/// Digest of a file's bytes, 0 where it cannot be read.
uint64_t trade_hash_file(const char *name);

#endif
