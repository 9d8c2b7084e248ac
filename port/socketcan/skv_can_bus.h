/// One small interface to a CAN bus: the kernel's (skv_socketcan.h) or a fake one in the same process (skv_can_fake.h).
///
/// All calls return at once. skv_can_fd() is for epoll: readable = frames (or errors of the interface) wait. Cyclic
/// sending and the state have file descriptors of their own, see there.
/// Not thread-safe: one thread for a bus.
#ifndef SKV_CAN_BUS_H
#define SKV_CAN_BUS_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// The same struct stands in port/canaerospace/skv_canaerospace.h: ports do not depend on one another.
#ifndef SKV_CAN_FRAME
#define SKV_CAN_FRAME
/// A classic CAN frame.
typedef struct skv_can_frame {
    uint32_t id;     ///< 11 bits; 29 bits with SKV_CAN_EXTENDED; the error class with SKV_CAN_ERROR
    uint8_t length;  ///< data bytes, [0, 8]
    uint8_t flags;   ///< SKV_CAN_... or 0
    uint8_t data[8]; ///< bytes from length on are 0
} skv_can_frame;
#define SKV_CAN_EXTENDED 1u ///< a 29-bit id
#define SKV_CAN_RTR      2u ///< a remote request: no data
#define SKV_CAN_ERROR    4u ///< not from the bus: the driver reports an error
#endif

/// What a call says. Negative: it did not work.
typedef enum skv_can_status {
    SKV_CAN_OK = 0,
    SKV_CAN_QUEUE_FULL = -1,   ///< ENOBUFS: the interface's queue is full; wait some frames' time and send again
    SKV_CAN_AGAIN = -2,        ///< EAGAIN: the socket's buffer is full; wait until it is writable (EPOLLOUT)
    SKV_CAN_DOWN = -3,         ///< the interface is down: wait for the state to change
    SKV_CAN_GONE = -4,         ///< the interface was removed: close and open again
    SKV_CAN_UNAVAILABLE = -5,  ///< this kernel has no CAN (AF_CAN, or its raw or cyclic protocol): exit status 3
    SKV_CAN_NO_INTERFACE = -6, ///< there is no interface of that name, or it is not CAN
    SKV_CAN_DENIED = -7,       ///< not permitted
    SKV_CAN_BAD_ARGUMENT = -8, ///< NULL, too many filters, a frame that is none
    SKV_CAN_NO_MEMORY = -9,
    SKV_CAN_SYSTEM = -10, ///< anything else: skv_can_errno()
} skv_can_status;

/// One line for people, without an end of line. For SKV_CAN_UNAVAILABLE it says what to do.
const char *skv_can_status_text(skv_can_status status);

/// A received frame.
typedef struct skv_can_received {
    skv_can_frame frame;
    int64_t time_ns;     ///< when the kernel took it: CLOCK_REALTIME, which jumps when the clock is set; 0 = not known
    int64_t hardware_ns; ///< when the controller took it, by its own clock; 0 = the driver has no such stamps
    uint8_t own;         ///< 1: sent by this very handle (only with receive_own)
} skv_can_received;

/// A filter: frames with (id ^ filter.id) & mask == 0 pass.
typedef struct skv_can_filter {
    uint32_t id;   ///< 11 or 29 bits
    uint32_t mask; ///< of the same bits; 0x7FF = exactly this 11-bit id
    uint8_t flags; ///< SKV_CAN_EXTENDED, SKV_CAN_RTR wanted; without them only plain data frames pass
} skv_can_filter;
#define SKV_CAN_MAX_FILTERS 256

/// How to open a bus. All 0: no frame is received (send only).
typedef struct skv_can_options {
    const skv_can_filter *filters; ///< [n_filters]; with n_filters 0 and receive_all 0 nothing is received
    size_t n_filters;              ///< at most SKV_CAN_MAX_FILTERS
    uint8_t receive_all;           ///< 1: every frame, filters are not looked at
    uint8_t receive_errors;        ///< 1: error frames too
    uint8_t receive_own;           ///< 1: what this handle sends comes back to it, marked
    int receive_bytes;             ///< size of the receive buffer; 0 = the system's
    int send_bytes;                ///< size of the send buffer; 0 = the system's
} skv_can_options;

/// The controller.
typedef enum skv_can_controller {
    SKV_CAN_UNKNOWN = 0, ///< virtual interfaces have none
    SKV_CAN_ACTIVE,
    SKV_CAN_WARNING, ///< an error counter above 96
    SKV_CAN_PASSIVE, ///< above 127
    SKV_CAN_BUS_OFF,
    SKV_CAN_STOPPED,
    SKV_CAN_SLEEPING,
} skv_can_controller;

/// The state of an interface.
typedef struct skv_can_state {
    uint8_t present;    ///< the interface exists
    uint8_t up;         ///< and is up
    uint8_t controller; ///< skv_can_controller
    uint16_t tx_errors; ///< error counters of the controller
    uint16_t rx_errors;
    uint32_t restart_ms; ///< the kernel restarts the controller so long after bus-off; 0 = it does not
    uint32_t bitrate;    ///< bit/s; 0 = unknown
} skv_can_state;

/// Counts since a handle was opened.
typedef struct skv_can_counts {
    uint64_t received, sent;
    uint64_t dropped;      ///< frames the kernel threw away because this handle did not read in time
    uint64_t queue_full;   ///< sends that met ENOBUFS
    uint64_t again;        ///< sends that met EAGAIN
    uint64_t down;         ///< sends and receptions that met an interface that was down
    uint64_t error_frames; ///< received
} skv_can_counts;

/// Cyclic sending of one id. (The frames come back to the same handle's filters as any other program's do.) With
/// counter_byte the kernel sends a ring of 256 frames that differ in that byte: a message code that goes up by one, at
/// the exact period, without the program.
typedef struct skv_can_cyclic {
    skv_can_frame frame;
    uint32_t period_us;  ///< [1000, 3600 000 000]
    int8_t counter_byte; ///< [0, 7]; -1: none, always the same frame. The count starts at frame.data[counter_byte]
} skv_can_cyclic;

typedef struct skv_can_bus skv_can_bus;

/// What an implementation provides; programs call the functions below.
typedef struct skv_can_ops {
    int (*fd)(const skv_can_bus *bus);
    int (*receive)(skv_can_bus *bus, skv_can_received *frames, int n);
    skv_can_status (*send)(skv_can_bus *bus, const skv_can_frame *frame);
    skv_can_status (*cyclic_start)(skv_can_bus *bus, const skv_can_cyclic *cyclic);
    skv_can_status (*cyclic_update)(skv_can_bus *bus, const skv_can_frame *frame);
    skv_can_status (*cyclic_stop)(skv_can_bus *bus, uint32_t id, uint8_t flags);
    skv_can_status (*state)(skv_can_bus *bus, skv_can_state *state);
    skv_can_status (*restart)(skv_can_bus *bus);
    skv_can_status (*watch)(skv_can_bus *bus, uint32_t id, uint32_t timeout_ms);
    int (*timeouts)(skv_can_bus *bus, uint32_t *ids, int n);
    int (*event_fd)(const skv_can_bus *bus);
    int (*timeout_fd)(const skv_can_bus *bus);
    int (*events)(skv_can_bus *bus);
    void (*close)(skv_can_bus *bus);
} skv_can_ops;

/// The head of every implementation.
struct skv_can_bus {
    const skv_can_ops *ops;
    skv_can_counts counts;
    int last_errno;
};

/// File descriptor for epoll: readable when frames wait, writable after SKV_CAN_AGAIN.
int skv_can_fd(const skv_can_bus *bus);

/// Takes what has been received.
/// @param[out] frames  [n].
/// @return how many, 0 = none waits; negative: skv_can_status (SKV_CAN_DOWN once when the interface goes down; the
///         handle stays usable and goes on when it is up again).
int skv_can_receive(skv_can_bus *bus, skv_can_received *frames, int n);

/// Sends a frame (not an error frame). At bus-off the kernel may take a frame, say SKV_CAN_OK and throw it away: watch
/// the state (skv_can_event_fd(), error frames).
skv_can_status skv_can_send(skv_can_bus *bus, const skv_can_frame *frame);

/// Starts cyclic sending, first frame at once; a second start of the same id begins anew. While the interface is down
/// the frames are lost and the counter goes on; when it is up again they come again by themselves. The kernel counts
/// each period from the frame before: its delays (.1 ms on a PC) add up.
skv_can_status skv_can_cyclic_start(skv_can_bus *bus, const skv_can_cyclic *cyclic);

/// New data for a cyclic id: the phase goes on undisturbed and so does the counter. Lengths must be the same.
/// SKV_CAN_BAD_ARGUMENT iff the id is not being sent.
skv_can_status skv_can_cyclic_update(skv_can_bus *bus, const skv_can_frame *frame);

/// Stops it. @param[in] flags  0 or SKV_CAN_EXTENDED.
skv_can_status skv_can_cyclic_stop(skv_can_bus *bus, uint32_t id, uint8_t flags);

/// Asks the kernel for the state now. An interface that is gone is no error: present = 0.
skv_can_status skv_can_get_state(skv_can_bus *bus, skv_can_state *state);

/// Restarts a controller that is bus-off. SKV_CAN_DENIED without CAP_NET_ADMIN; SKV_CAN_BAD_ARGUMENT iff it is not
/// bus-off, or restarts by itself.
skv_can_status skv_can_restart(skv_can_bus *bus);

/// Has the kernel watch an 11-bit id: no frame of it for timeout_ms counts as one timeout (until it comes again).
skv_can_status skv_can_watch(skv_can_bus *bus, uint32_t id, uint32_t timeout_ms);

/// The watched ids that timed out since the last call.
/// @return how many ids were written, at most n; negative: skv_can_status.
int skv_can_timeouts(skv_can_bus *bus, uint32_t *ids, int n);
/// Readable when skv_can_timeouts() has something; -1 before the first skv_can_watch().
int skv_can_timeout_fd(const skv_can_bus *bus);

/// Readable when the state of the interface changed (up, down, gone, back): call skv_can_events(), then
/// skv_can_get_state(). -1 iff it cannot be watched.
int skv_can_event_fd(const skv_can_bus *bus);
/// Takes the changes off. @return how many there were since the last call.
int skv_can_events(skv_can_bus *bus);

/// The counts.
skv_can_counts skv_can_get_counts(const skv_can_bus *bus);

/// errno of the last call that failed.
int skv_can_errno(const skv_can_bus *bus);

/// Closes a bus; NULL is allowed. What it sent cyclically ends.
void skv_can_close(skv_can_bus *bus);

/// What an error frame says. Bits.
enum {
    SKV_CAN_SAYS_BUS_OFF = 1,
    SKV_CAN_SAYS_RESTARTED = 2,
    SKV_CAN_SAYS_PASSIVE = 4,
    SKV_CAN_SAYS_WARNING = 8,
    SKV_CAN_SAYS_ACTIVE = 16, ///< back to error-active
    SKV_CAN_SAYS_NO_ACK = 32, ///< nobody else on the bus
    SKV_CAN_SAYS_OVERFLOW = 64,
    SKV_CAN_SAYS_BUS_ERROR = 128, ///< bit, stuff, form, CRC error
    SKV_CAN_SAYS_ARBITRATION = 256,
    SKV_CAN_SAYS_TX_TIMEOUT = 512,
};
/// @return bits of the above; 0 iff the frame is no error frame or says none of these.
unsigned skv_can_error_says(const skv_can_frame *frame);

#ifdef __cplusplus
}
#endif
#endif
