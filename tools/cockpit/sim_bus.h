/// The bus as a sender sees it: works, is down, bus-off or gone, and comes back; identification requests are answered.
/// Time is given by the caller: CLOCK_MONOTONIC, which nobody sets.
#ifndef SIM_BUS_H
#define SIM_BUS_H

#include <stdbool.h>

#include "port/canaerospace/skv_canaerospace.h"
#include "port/socketcan/skv_can_bus.h"

typedef enum sim_bus_phase { SIM_BUS_WORKS = 0, SIM_BUS_DOWN, SIM_BUS_OFF, SIM_BUS_GONE } sim_bus_phase;

/// Now by two clocks; real_ns is that of the frames' stamps.
typedef struct sim_now {
    int64_t mono_ns, real_ns;
} sim_now;

#define SIM_REPLIES 16

typedef struct sim_bus {
    skv_can_status (*open)(void *context, skv_can_bus **bus); ///< opens the interface, again after it was gone
    void *context;
    const char *name; ///< of the interface, for people
    bool quiet;       ///< says nothing
    skv_cas_identity self;
    double most_bits_s; ///< a bit rate below this is too low, which is said when the interface gets one; 0 = none is

    skv_can_bus *bus; ///< NULL while it is gone
    skv_can_state state;
    sim_bus_phase phase;
    unsigned generation; ///< goes up whenever the interface was opened: what was sent cyclically is to be started then
    uint64_t frames;     ///< taken by the kernel from sim_bus_send()
    uint64_t waits;      ///< sends that met a full queue or buffer
    uint64_t downs, bus_offs, gone, recoveries;
    uint64_t requests, answers; ///< identification
    uint64_t unread;            ///< frames that the kernel threw away because they were not read in time
    int64_t longest_answer_ns;  ///< from the request's stamp to the reply
    skv_can_frame reply[SIM_REPLIES];
    int64_t asked_ns[SIM_REPLIES]; ///< of each reply
    int replies;
    int64_t look_ns, restart_ns; ///< when to look next; when to restart it next
    bool denied, refused;        ///< said once
} sim_bus;

/// Opens it for the first time: all but open, context, name, quiet and self start as 0.
/// @return SKV_CAN_OK or why not.
skv_can_status sim_bus_begin(sim_bus *b, int64_t now_ns);
void sim_bus_end(sim_bus *b);

/// Takes what has come; `heard` gets each frame but error frames, with its time by CLOCK_MONOTONIC.
void sim_bus_receive(sim_bus *b, sim_now now,
                     void (*heard)(void *self, const skv_can_received *frame, int64_t mono_ns, int64_t now_ns),
                     void *self);
/// Asks for the state at once: after an event.
void sim_bus_look(sim_bus *b, int64_t now_ns);
/// What is due: the state once a second, opening again, restarts, replies that wait.
/// @return when to call again.
int64_t sim_bus_tick(sim_bus *b, int64_t now_ns);

/// Sends one frame. @return SKV_CAN_OK; else it has to be sent later: at bus-off, where the kernel would throw it away,
/// SKV_CAN_DOWN.
skv_can_status sim_bus_send(sim_bus *b, const skv_can_frame *frame, int64_t now_ns);

/// Says once why sending does not work where no waiting helps: permission, memory, a driver's own errors.
void sim_bus_say_why(sim_bus *b, skv_can_status status);

#endif
