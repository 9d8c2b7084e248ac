#include "sim_wire.h"

// Behind the check sequence: its delimiter, acknowledgement with delimiter, end of frame; then the gap. Never stuffed.
enum { TAIL_BITS = 1 + 2 + 7 + SIM_WIRE_GAP_BITS };

typedef struct wire {
    int bits, run; // sent; equal ones at the end
    int last;      // -1 at first
    unsigned crc;
} wire;

static void put_bit(wire *w, int bit) {
    w->run = bit == w->last ? w->run + 1 : 1;
    w->last = bit;
    w->bits++;
    if (w->run == 5) { // a bit of the other kind is put in
        w->bits++;
        w->last = !bit;
        w->run = 1;
    }
}

// x^15 + x^14 + x^10 + x^8 + x^7 + x^4 + x^3 + 1
static void check_bit(wire *w, int bit) {
    const unsigned carry = ((w->crc >> 14) ^ (unsigned)bit) & 1u;
    w->crc = (w->crc << 1 & 0x7FFFu) ^ (carry ? 0x4599u : 0u);
}

// The upper bit first.
static void put(wire *w, uint32_t value, int bits) {
    while (bits-- > 0) {
        const int bit = (int)(value >> bits & 1u);
        check_bit(w, bit);
        put_bit(w, bit);
    }
}

int sim_wire_bits(const skv_can_frame *frame) {
    wire w = {.last = -1};
    const uint32_t remote = (frame->flags & SKV_CAN_RTR) != 0;
    if (frame->flags & SKV_CAN_ERROR)
        return 0;
    put(&w, 0, 1);
    if (frame->flags & SKV_CAN_EXTENDED) {
        put(&w, frame->id >> 18, 11);
        put(&w, 3, 2);
        put(&w, frame->id & 0x3FFFFu, 18);
    } else {
        put(&w, frame->id, 11);
    }
    put(&w, remote << 2, 3);
    put(&w, frame->length, 4);
    for (int i = 0; i < frame->length && !remote; i++)
        put(&w, frame->data[i], 8);
    for (int i = 14; i >= 0; i--)
        put_bit(&w, (int)(w.crc >> i & 1u));
    return w.bits + TAIL_BITS;
}
