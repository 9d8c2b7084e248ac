/// A CAN bus in this process, for tests and for machines without CAN: any number of handles on one net, a clock that
/// the caller turns, and faults on request. The same seed gives the same faults.
#ifndef SKV_CAN_FAKE_H
#define SKV_CAN_FAKE_H

#include "skv_can_bus.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Chances of a fault, per frame and receiver, each in [0, 1].
typedef struct skv_can_faults {
    double drop;      ///< lost
    double duplicate; ///< comes twice
    double reorder;   ///< comes behind the next one
    double corrupt;   ///< one bit of the data turned (a real bus would catch it: for tests of the decoder)
    double delay;     ///< comes delay_ns later
    int64_t delay_ns;
    double queue_full; ///< a send meets ENOBUFS
    double again;      ///< a send meets EAGAIN
    uint32_t seed;
} skv_can_faults;

typedef struct skv_can_fake_net skv_can_fake_net;

/// A net without faults, up, clock at 0. @return NULL iff there is no memory.
skv_can_fake_net *skv_can_fake_new(void);

/// Frees the net; its handles must be closed before.
void skv_can_fake_free(skv_can_fake_net *net);

/// Opens a handle, as skv_socketcan_open(). Its fds are real (eventfd), for epoll.
skv_can_status skv_can_fake_open(skv_can_bus **bus, skv_can_fake_net *net, const skv_can_options *options);

/// Faults from now on; NULL = none.
void skv_can_fake_set_faults(skv_can_fake_net *net, const skv_can_faults *faults);

/// Turns the clock: cyclic frames, delayed frames and timeouts that are due by then happen, in order.
/// @param[in] now_ns  not before the last one.
void skv_can_fake_advance(skv_can_fake_net *net, int64_t now_ns);

/// The cable: 0 = the interface is down.
void skv_can_fake_set_up(skv_can_fake_net *net, int up);

/// Bus-off (as an error frame and in the state), until skv_can_restart(), or restart_ms later if that is not 0.
void skv_can_fake_bus_off(skv_can_fake_net *net, uint32_t restart_ms);

/// Every handle gets this frame, error frames too, whatever its sender; no faults. For frames no program would send.
void skv_can_fake_inject(skv_can_fake_net *net, const skv_can_frame *frame);

#ifdef __cplusplus
}
#endif
#endif
