#!/usr/bin/env bash
# make demo-cockpit: skyvert-sim and skyvert-cockpit on one machine without CAN hardware. On a vcan interface when the kernel has it
# (and this user may make one, or vcan0 is there), else on an arm64 board under QEMU. Ctrl-C ends it. DEMO_SECONDS: 60.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
B=${B:-build}
seconds=${DEMO_SECONDS:-60}
flight=$root/tools/flight/dusk-lszh-loww.csv
terminal=--terminal
[ -t 1 ] || terminal=--no-terminal
child= made=
finish() {
    trap - EXIT INT TERM
    [ -z "$child" ] || kill "$child" 2>/dev/null || true
    [ -z "$made" ] || ip link del vcan0 2>/dev/null || true
    wait 2>/dev/null || true
    printf '\033[0m\033[?25h\033[?1049l'
}
trap finish EXIT
trap 'exit 130' INT TERM

vcan() {
    [ -e /sys/class/net/vcan0 ] || { ip link add vcan0 type vcan 2>/dev/null && made=yes; } || return 1
    ip link set vcan0 up 2>/dev/null || grep -q 0x /sys/class/net/vcan0/flags
}
if vcan; then
    "$B/skyvert-sim" "$flight" --start 2024-03-20T17:10:00Z --speed 20 --loop --interface vcan0 2>/dev/null &
    child=$!
    "$B/skyvert-cockpit" --interface vcan0 --duration "$seconds" $terminal
    exit
fi
echo "This kernel has no vcan: the same programs on an arm64 board under QEMU (boots in some ten seconds)."
mkdir -p "$B/rig/guest/files"
cp "$flight" "$B/rig/guest/files/flight.csv"
echo "$seconds" >"$B/rig/guest/files/seconds"
log=$B/rig/demo/board1/out/demo/log
rm -f "$log"
RIG_GUEST=$here/board RIG_NAME=demo RIG_SECONDS=$((seconds + 240)) B=$B bash "$root/tests/rig/run.sh" demo >"$B/rig/demo.log" 2>&1 &
child=$!
while [ ! -e "$log" ] && kill -0 $child 2>/dev/null; do sleep 0.2; done
[ ! -e "$log" ] || tail -c +1 -f --pid=$child "$log"
status=0
wait $child || status=$?
child=
[ $status = 0 ] || cat "$B/rig/demo.log" >&2
exit $status
