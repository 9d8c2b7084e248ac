/// A switch whose contact bounces: its level counts once it has been steady for a while. Pure: the caller brings the
/// time.
#ifndef SKV_DEBOUNCE_H
#define SKV_DEBOUNCE_H

#include <stdbool.h>
#include <stdint.h>

/// State of a switch. All times in ns of one steady clock.
typedef struct {
    int64_t steady_ns; ///< how long a level has to last
    int64_t edge_ns;   ///< last edge
    bool raw;          ///< level after the last edge
    bool level;        ///< level that counts
    bool waiting;      ///< an edge came, and its level is not settled
    uint32_t bounces;  ///< edges that led to nothing
} skv_debounce;

/// Starts settled at this level.
void skv_debounce_start(skv_debounce *button, bool level, int64_t steady_ns);

/// An edge to this level. Edges come in the order of their times.
/// @return whether the level that counts had changed before this edge: the level before it was settled.
bool skv_debounce_edge(skv_debounce *button, int64_t at_ns, bool level);

/// The level was seen to be this, without an edge: it was lost. What came before it does not count.
void skv_debounce_lost(skv_debounce *button, int64_t now_ns, bool level);

/// The time has come to this.
/// @return whether the level that counts has changed.
bool skv_debounce_time(skv_debounce *button, int64_t now_ns);

/// When skv_debounce_time() is to be called; INT64_MAX where there is nothing to wait for.
int64_t skv_debounce_due(const skv_debounce *button);

#endif
