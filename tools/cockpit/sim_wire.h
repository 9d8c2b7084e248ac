/// How long a classic CAN frame is on the wire.
#ifndef SIM_WIRE_H
#define SIM_WIRE_H

#include "port/canaerospace/skv_canaerospace.h"

/// Bits between frames: not part of sim_wire_bits() when one asks for when a frame ends.
enum { SIM_WIRE_GAP_BITS = 3 };

/// Bits of this very frame and the gap behind it: its check sequence is computed and its stuff bits are counted;
/// skv_cas_frame_bits() says how many there can be. 0 for an error frame, which is not on the wire.
/// Source: [Bosch91] sections 3.1 and 5.
int sim_wire_bits(const skv_can_frame *frame);

#endif
