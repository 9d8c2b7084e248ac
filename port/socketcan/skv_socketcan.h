/// The CAN bus of the Linux kernel: CAN_RAW to receive and send, CAN_BCM to send cyclically, rtnetlink for the state.
/// Needs no root to receive and send; restarting a controller needs CAP_NET_ADMIN.
#ifndef SKV_SOCKETCAN_H
#define SKV_SOCKETCAN_H

#include "skv_can_bus.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Opens an interface. It may be down: then sending says SKV_CAN_DOWN until it is up.
/// Time stamps: the controller's where the driver has them, else the kernel's (SO_TIMESTAMPING), else none.
/// @param[out] bus      to be closed by skv_can_close(); NULL on error.
/// @param[in] interface "can0", "vcan0", ...
/// @param[in] options   NULL: all 0, send only.
/// @param[out] error    errno of what failed, for messages; may be NULL.
/// @return SKV_CAN_OK; SKV_CAN_UNAVAILABLE, SKV_CAN_NO_INTERFACE, SKV_CAN_DENIED, SKV_CAN_BAD_ARGUMENT,
///         SKV_CAN_NO_MEMORY, SKV_CAN_SYSTEM.
skv_can_status skv_socketcan_open(skv_can_bus **bus, const char *interface, const skv_can_options *options, int *error);

/// Whether this kernel has CAN at all, asked without an interface.
/// @return SKV_CAN_OK; SKV_CAN_UNAVAILABLE; SKV_CAN_DENIED.
skv_can_status skv_socketcan_available(void);

#ifdef __cplusplus
}
#endif
#endif
