/// A flight on a bus: the kernel sends each message at its rate (CAN_BCM) and counts the message codes; each frame that
/// is heard on the bus tells when the next one will go, and what it holds is set for that moment.
#ifndef SIM_STREAM_H
#define SIM_STREAM_H

#include "sim.h"
#include "sim_bus.h"

typedef struct sim_beat {
    sim_slot slot;
    int64_t expect_ns; ///< when its next frame is due
    int64_t heard_ns;  ///< when it was last heard, 0 = not yet started
    uint8_t code;      ///< message code of the next frame
    bool started;      ///< the kernel sends it
} sim_beat;

typedef struct sim_stream {
    const sim_options *options;
    sim_flight *flight;
    sim_bus *bus;
    skv_cas_sender sender;
    sim_beat beat[SKV_CAS_MESSAGES];
    int beats;
    int64_t start_ns;
    unsigned generation;
    bool over;
    skv_can_status failed; ///< cyclic sending does not work at all
    uint64_t sent;         ///< heard on the bus
    uint64_t lost;         ///< due, but not on the bus: the interface was down, bus-off, or its queue full
    uint64_t left_out;     ///< values beyond the range of their message
    uint64_t others;       ///< frames of our messages from another node
    double shown_s;        ///< into the flight
} sim_stream;

/// options, flight, bus and sender.node are set, all else 0. The bus is open.
void sim_stream_begin(void *stream, int64_t now_ns);
/// What is due. @return when to call again; 0 = the flight is over, or sending failed.
int64_t sim_stream_tick(void *stream, int64_t now_ns);
/// Counts what is still missing; once.
void sim_stream_end(sim_stream *s, int64_t now_ns);
/// A frame from the bus.
void sim_stream_heard(void *stream, const skv_can_received *frame, int64_t mono_ns, int64_t now_ns);
/// One line about now, for a terminal.
void sim_stream_show(const void *stream, char *text, size_t size);

#endif
