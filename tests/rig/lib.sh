# Helpers of the board's tests (busybox sh). File descriptor 9 is the line to the host; the working folder is the test's own,
# and the files left there come back. fail TEXT ends the test; note and figure lines are shown by the host. A test has 60 s,
# or what a line `# seconds: N` in it says; what it leaves running is killed.

ip() { /rig/ip "$@"; }
fail() {
    echo "FAIL: $*" >&2
    exit 1
}
note() { echo "note: $*"; }
figure() { echo "figure: $*"; }

# host COMMAND...: an action outside the board (tests/rig/hooks.py lists them); its answer is printed. Fails the test on "error".
host() {
    echo "do $*" >&9
    read -r rig_answer <&9 || fail "host $*: no answer"
    case $rig_answer in
    ok*) rig_answer=${rig_answer#ok} && [ -z "$rig_answer" ] || echo "${rig_answer# }" ;;
    *) fail "host $*: $rig_answer" ;;
    esac
}

# wait_for SECONDS COMMAND...: until the command succeeds, tried ten times a second.
wait_for() {
    rig_tries=$(($1 * 10))
    shift
    while ! "$@" >/dev/null 2>&1; do
        rig_tries=$((rig_tries - 1))
        [ $rig_tries -gt 0 ] || return 1
        usleep 100000
    done
}

# has FILE TEXT: a file has the text in it. Mostly: wait_for 5 has log.txt "text" || fail "..."
has() { grep -q -- "$2" "$1"; }

# can_up [BITRATE]: both controllers up, 500 kbit/s unless told; frames cross can0 <-> can1.
can_up() {
    for rig_if in can0 can1; do
        ip link set $rig_if down 2>/dev/null
        ip link set $rig_if up type can bitrate "${1:-500000}" restart-ms 100 || fail "$rig_if does not come up"
        ip link set $rig_if txqueuelen 100
    done
}
can_down() {
    ip link set can0 down
    ip link set can1 down
}

# listens IF: until some program has a socket that hears this interface; before that a frame to it would be lost.
listens() { wait_for 10 rig_listener "$1" || fail "nobody listens on $1"; }
rig_listener() { cat /proc/net/can/rcvlist_* | grep -q "^ *$1  *[0-9a-f]"; }

# The cable of one controller, out and in: as the kernel sees it, the interface goes down and up. The rest of the bus goes on.
cable_out() { ip link set "$1" down; }
cable_in() { ip link set "$1" up || fail "$1 does not come up again"; }

# vcan0, a bus without controllers: what one program sends all others get.
vcan_up() {
    [ -e /sys/class/net/vcan0 ] || ip link add vcan0 type vcan || fail "no vcan0"
    ip link set vcan0 up
}
# An error frame that says bus-off (CAN_ERR_BUSOFF), as a controller's driver would make it; on vcan0.
bus_off_frame() { cansend "$1" 20000040#0000000000000000; }

# slcan0, whose adapter is the test: slcan LINE is what the adapter says (slcan_adapter.c has the list), adapter.log what it got.
slcan_start() {
    mkfifo adapter
    slcan-adapter <adapter >adapter.log 2>&1 &
    exec 7>adapter
    wait_for 5 has adapter.log "^interface " || fail "no interface for the adapter: $(cat adapter.log)"
    ip link set "$(sed -n 's/^interface //p' adapter.log)" name slcan0 || fail "no name for the adapter"
    ip link set slcan0 type can bitrate 500000 || fail "slcan0 takes no bit rate"
    ip link set slcan0 up || fail "slcan0 does not come up"
}
slcan() { echo "$1" >&7; }
# slcan_state STATE: whether it is in this state: ERROR-ACTIVE, ERROR-WARNING, ERROR-PASSIVE, BUS-OFF.
slcan_state() { ip -details link show slcan0 | grep -q "state $1"; }
slcan_restart() {
    ip link set slcan0 down
    ip link set slcan0 up || fail "slcan0 does not come up again"
}

# stop PID...: ends processes that the test started, and waits for them.
stop() {
    kill "$@" 2>/dev/null
    wait "$@" 2>/dev/null
    true
}
