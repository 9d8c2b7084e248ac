/// Many rays with all orders of scattering: threads, progress, a target error, interruption and going on.
#ifndef TOOLS_REFERENCE_ORDERS_H
#define TOOLS_REFERENCE_ORDERS_H

#include <stddef.h>
#include <stdint.h>

#include "paths.h"
#include "queries.h"

typedef struct ref_job {
    double target;      ///< relative standard error of every band at which a ray is done
    uint64_t max_paths; ///< per ray; a ray that reaches it is done whatever its error
    uint64_t seed;
    int threads, lit_ground;
    const char *state; ///< file that keeps what is done; NULL: none
} ref_job;

typedef struct ref_total {
    double radiance[REF_BANDS], error[REF_BANDS]; ///< error: standard error
    ref_tally tally;
    int done;
} ref_total;

/// Results do not depend on threads, nor on how often the job was interrupted. SIGINT and SIGTERM stop it.
/// @return 0; 1 after a line on stderr: interrupted, out of memory, or the state cannot be written;
///         2: the state file belongs to another job.
int ref_orders_run(const ref_tracer *tracer, const ref_job *job, const ref_query *queries, size_t count,
                   ref_total *totals);

// --- state.c ---

/// A number that tells jobs apart whose paths differ: air, rays, seed and ground, not the target.
uint64_t ref_state_digest(const ref_atmosphere *atmosphere, const ref_job *job, const ref_query *queries, size_t count);
/// Fills the tallies that the file has. No file is no error. @return 0; 2 after a line on stderr.
int ref_state_read(const char *name, uint64_t digest, ref_total *totals, size_t count);
/// Written beside, then renamed. @return 0; 1 after a line on stderr.
int ref_state_write(const char *name, uint64_t digest, const ref_total *totals, size_t count);

#endif
