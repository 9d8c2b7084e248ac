/// Where frames come from: the kernel's CAN bus, a candump log, or a made-up flight, the last two over a bus in this
/// process with the same filters. Time of frames is one steady clock: CLOCK_MONOTONIC, or that of the log.
#ifndef COCKPIT_BUS_H
#define COCKPIT_BUS_H

#include <stdio.h>

#include "cockpit.h"
#include "port/canaerospace/skv_candump.h"
#include "port/socketcan/skv_can_bus.h"
#include "port/socketcan/skv_can_fake.h"

typedef enum cockpit_source { COCKPIT_CAN, COCKPIT_REPLAY, COCKPIT_FAKE } cockpit_source;

typedef struct cockpit_bus {
    skv_can_bus *bus;
    cockpit_source source;
    char name[40];
    skv_can_filter filter[64];
    size_t filters;
    skv_can_state state;
    bool bus_off;          ///< by an error frame
    int64_t bus_off_ns;    ///< when
    uint32_t bus_offs;     ///< how often
    bool gone;             ///< the interface was removed: it is looked for once a second
    skv_can_counts before; ///< of handles that are closed
    bool denied;           ///< a restart was not permitted
    int64_t start_ns;      ///< CLOCK_MONOTONIC when the log or flight began
    double speed;
    // Log and flight.
    skv_can_fake_net *net;
    skv_can_bus *sender;
    FILE *log;
    const char *path;
    char *line;
    size_t line_size;
    skv_candump_reader reader;
    skv_candump_entry entry; ///< next
    bool has_entry, ended;
    int status; ///< what a bad line of the log makes the exit status
    int64_t first_ns;
    skv_cas_sender talker;
    int64_t next_ns;
} cockpit_bus;

/// A frame with both its times.
typedef struct cockpit_received {
    skv_can_frame frame;
    int64_t time_ns;    ///< of the clock of cockpit_bus_now()
    int64_t arrived_ns; ///< CLOCK_MONOTONIC
} cockpit_received;

/// @return 0; 3 after a line iff the kernel has no CAN; 1 or 2 after another one.
int cockpit_bus_open(cockpit_bus *b, const cockpit_options *options);
void cockpit_bus_close(cockpit_bus *b);

/// The clock of frames, now.
int64_t cockpit_bus_now(const cockpit_bus *b);

/// For epoll; -1: none (the interface is gone).
int cockpit_bus_fd(const cockpit_bus *b);
int cockpit_bus_event_fd(const cockpit_bus *b);

/// Takes frames that have come; error frames are counted and left out. @return how many; 0: none waits.
int cockpit_bus_receive(cockpit_bus *b, cockpit_received *frames, int n);

/// Sends, if it can. @return false iff the bus does not take it now
bool cockpit_bus_send(cockpit_bus *b, const skv_can_frame *frame);

/// Log and flight: sends what is due. Call it before receiving, until it answers false: nothing more is due.
bool cockpit_bus_play(cockpit_bus *b);

/// Asks for the state; once a second and when the event descriptor says so. Opens an interface again that was gone.
/// @return true iff the descriptors have changed
bool cockpit_bus_check(cockpit_bus *b);

/// Whether the controller or the cable is at fault. A bus-off shows for a second at least.
bool cockpit_bus_fault(const cockpit_bus *b);

/// "up 500 kbit/s", "down", "bus-off", ... @return constant text or `text`
const char *cockpit_bus_words(const cockpit_bus *b, char *text, size_t size);

skv_can_counts cockpit_bus_counts(const cockpit_bus *b);

#endif
