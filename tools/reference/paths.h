/// All orders of scattering in double by backward paths: the truth for the total light. Shares no code with src/.
///
/// The first order and the directly lit ground at the ray's end come from ref_single(). What is left, an integral over
/// the ray of the light that was scattered before, is estimated by paths from the observer. Each leg of a path is cut
/// into cells with one random point each; they give the sun's light along the leg (next-event estimation) and the
/// candidates among which the next vertex is chosen in proportion to the light expected from it (resampled importance
/// sampling [Talbot05]). Directions are chosen likewise from candidates drawn from the phase functions about the path
/// and about the sun. All bands share a path; choices weigh the bands relative to their totals, so no band's weight
/// grows. The expected light is a coarse map (guide.h), which changes the noise only. The first three choices of the
/// paths of a batch are a scrambled Sobol set; the standard error is that of the batches' means.
///
/// The same key gives the same bits, whatever the number of threads and however the batches are dealt out.
#ifndef TOOLS_REFERENCE_PATHS_H
#define TOOLS_REFERENCE_PATHS_H

#include <stdint.h>

#include "guide.h"

typedef struct ref_tracer {
    ref_air air;
    ref_guide guide;
} ref_tracer;

/// @return 0; -1 out of memory.
int ref_tracer_make(ref_tracer *tracer, const ref_atmosphere *atmosphere, int threads);
void ref_tracer_free(ref_tracer *tracer);

enum { REF_BATCH = 64 }; ///< paths

/// A ray made ready. About 100 KiB.
typedef struct ref_view {
    const ref_tracer *tracer;
    uint64_t key;
    int empty; ///< nothing beyond the first order can come in
    double from[3], view[3], sun[3];
    ref_line line;
    int cells, lit_ground;
    double edges[REF_CELLS_MAX + 1], reach[REF_CELLS_MAX + 2]; ///< reach: cumulative expectation of cells, then ground
    double single[REF_BANDS];                                  ///< first order, with its lit ground, for a unit sun
    double scale[REF_BANDS];                                   ///< 1/(expected total)
    double expected;                                           ///< later orders over the total, mean of the bands
} ref_view;

/// @param seed  with the four angles' bits it makes the key. @return 0; -1 iff the first order did not converge.
int ref_view_make(ref_view *view, const ref_tracer *tracer, double height_km, double sun_zenith_deg,
                  double view_zenith_deg, double azimuth_deg, int lit_ground, uint64_t seed);

/// Sums over batches of their means, and of the squares.
typedef struct ref_tally {
    uint64_t batches;
    double sum[REF_BANDS], squares[REF_BANDS];
} ref_tally;

/// Adds the next batch.
void ref_view_batch(const ref_view *view, ref_tally *tally);

/// Radiance with all orders and its standard error (0 with fewer than two batches), times the irradiance.
void ref_view_result(const ref_view *view, const ref_tally *tally, double radiance[REF_BANDS], double error[REF_BANDS]);
/// Largest relative standard error; INFINITY with fewer than two batches of a ray that is not empty.
double ref_view_error(const ref_view *view, const ref_tally *tally);

#endif
