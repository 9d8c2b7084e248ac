/// A rotary encoder from its two contacts, A and B. Pure: no I/O, no time.
#ifndef SKV_QUADRATURE_H
#define SKV_QUADRATURE_H

#include <stdbool.h>
#include <stdint.h>

/// State of an encoder. Forwards is A B = 00 01 11 10.
typedef struct {
    uint8_t levels;   ///< A in bit 1, B in bit 0
    int32_t position; ///< quarter steps, since skv_quadrature_start(); wraps
    uint32_t invalid; ///< transitions that a turning encoder cannot make: an edge was lost, or a contact is broken
} skv_quadrature;

/// Starts at these levels, position 0.
void skv_quadrature_start(skv_quadrature *encoder, bool a, bool b);

/// Both levels were seen to be these: a step, none, or (both changed) an invalid transition without one.
void skv_quadrature_levels(skv_quadrature *encoder, bool a, bool b);

/// One contact had an edge to this level. An edge to the level that it already has is an invalid transition.
void skv_quadrature_edge(skv_quadrature *encoder, bool is_a, bool level);

/// Takes whole clicks off the quarter steps in *steps; the rest stays. A contact that trembles about a click gives
/// none.
/// @param per_click quarter steps from one detent to the next, 1 to 4.
int32_t skv_quadrature_clicks(int32_t *steps, int32_t per_click);

#endif
