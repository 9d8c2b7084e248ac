# takes: 10
# The CAN port on a real kernel: raw sockets, filters, stamps, drops, cyclic sending, cables, bus-off (tests/can/socket_check.c).
can_up
socket_check /rig/ip || fail "socket_check: $?"
