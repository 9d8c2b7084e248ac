/// Measures rows: errors, stack, time.
#ifndef TOOLS_TRADE_MEASURE_H
#define TOOLS_TRADE_MEASURE_H

#include "rows.h"
#include "subject.h"

/// Directions that costs are measured with: a dome from the zenith to 10 deg below the horizontal (from the ground: to
/// the horizontal), in rings; frames' work is spread over TRADE_DOME_VERTICES.
enum { TRADE_DOME = 128, TRADE_DOME_VERTICES = 2048 };
void trade_lay_dome(const trade_scene *scene, float direction[TRADE_DOME][3]);

/// Errors, sizes and build time of a row into it.
void trade_measure_error(trade_row *row, trade_subject *subject);

/// Frames that take longer are timed twice and counted once, in the first scene of the first air.
#define TRADE_SLOW_FRAME_NS 2e7

/// Bytes of stack below the caller's that a frame and its vertices use at most in any scene.
void trade_measure_stack(trade_row *row, trade_subject *subject);

/// Times the rows [n] of one air in one scene, all of them in turn, several times over. Rows without a subject (config
/// NULL) are passed over.
/// @param      repeats   rounds.
/// @param[out] checksum  the sum of all radiances is added to it.
/// @return 0; 1 out of memory.
int trade_measure_time(trade_row *rows, trade_subject *subjects, size_t n, int scene, int repeats, double *checksum);

#endif
