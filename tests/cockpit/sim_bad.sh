#!/usr/bin/env bash
# Bad input to skyvert-sim: one line that says what and where, exit status 2, no file; and no CAN at all: status 3.
set -u
B=${B:-build}
sim=$B/skyvert-sim
job=$B/cockpit-sim-bad
rm -rf "$job"
mkdir -p "$job"
flight=tools/flight/dusk-lszh-loww.csv
wrong=0
# bad STATUS PATTERN ARGUMENT...
bad() {
    local status=$1 pattern=$2
    shift 2
    "$sim" "$@" >"$job/out" 2>"$job/said"
    local got=$?
    if [ $got != "$status" ] || [ "$(wc -l <"$job/said")" != 1 ] || ! grep -qE -- "$pattern" "$job/said" || [ -s "$job/out" ]; then
        echo "skyvert-sim $*: status $got, want $status with one line like '$pattern': $(cat "$job/said")"
        wrong=1
    fi
    if [ -e "$job/never.log" ] || [ -n "$(find "$job" -name '*.part')" ]; then
        echo "skyvert-sim $*: left a file"
        wrong=1
    fi
}
log="--log $job/never.log --speed max"
bad 2 "which flight"
bad 2 "unexpected argument 'b'" a b
bad 2 "no-such.csv: cannot be read: No such file" "$job/no-such.csv" $log
bad 2 "option --frobnicate is unknown" $flight --frobnicate
bad 2 "option --log needs a value" $flight --log
for value in 0 -1 1001 nan fast 1x; do bad 2 "--speed $value: allowed is a number from 0.01 to 1000, or max" $flight --speed $value; done
bad 2 "--speed max goes with --log" $flight --speed max
bad 2 "--loop goes with a bus" $flight --loop $log
bad 2 "--interface '': a name of 1 to 15" $flight --interface ""
bad 2 "--interface 'sixteen-letters-': a name" $flight --interface sixteen-letters-
bad 2 "--interface 'a b': a name" $flight --interface "a b" $log
bad 2 "--node 0: allowed is a whole number from 1 to 255" $flight --node 0
bad 2 "--node 1.5: allowed" $flight --node 1.5
bad 2 "--bitrate 1: allowed is a number from 5000 to 1e\+06" $flight --bitrate 1
bad 2 "--max-load 101: allowed" $flight --max-load 101
bad 2 "--visibility-m 0: allowed" $flight --visibility-m 0
bad 2 "--height-datum sea: allowed is msl or ellipsoid" $flight --height-datum sea
bad 2 "--start 2031-13-01: .*month|--start '2031-13-01'" $flight --start 2031-13-01 $log
bad 2 "--start 99999: .* lasts 3360.0 s" $flight --start 99999 $log
bad 2 "--duration -1: allowed" $flight --duration -1 $log
bad 2 "takes up to 1[0-9][0-9]\.[0-9] % of a bus of 10000 bit/s; --max-load allows 80 %" $flight --bitrate 10000 $log
bad 2 "no-folder/x.log: cannot be written" $flight --log "$job/no-folder/x.log"
bad 2 "is a folder" $flight --log "$job"
printf 'utc,lat_deg,lon_deg,height_m\n2024-03-20T16:59:00Z,47,8,400\n2024-03-20T16:59:10Z,97,8,400\n' >"$job/lat.csv"
bad 2 "lat.csv:3: lat_deg '97': a number from -90 to 90 is needed" "$job/lat.csv" $log
printf 'HFDTE010709\nB2559003500000S13800000EA0010000100\n' >"$job/time.igc"
bad 2 "time.igc:2: B record: a time" "$job/time.igc" $log
: >"$job/empty.csv"
bad 2 "empty.csv" "$job/empty.csv" $log
printf '(1.000000) can0 123#11\n(1.100000) can0 123#1\n' >"$job/half.log"
bad 2 "half.log:2: column 22: half a byte of data" "$job/half.log" $log
printf '(1.000000) can0 123##1AA\n' >"$job/fd.log"
bad 2 "fd.log: a candump log without a frame that can be sent" "$job/fd.log" $log
printf '(1.000000) can0 123#11\n(2.000000) can0 123#11\n' >"$job/two.log"
bad 2 "--start 'noon': of a candump log: seconds" "$job/two.log" --start noon $log
awk 'BEGIN {for (i = 0; i < 2000; i++) printf "(1.%06d) can0 123#1122334455667788\n", i * 100}' >"$job/dense.log"
bad 2 "dense.log takes up to 216.0 % of a bus of 125000 bit/s" "$job/dense.log" --bitrate 125000 $log
head -c 3000 /dev/urandom | tr -d '\n' >"$job/noise.csv"
bad 2 "noise.csv" "$job/noise.csv" $log
if [ -e /dev/full ]; then bad 1 "/dev/full: writing failed" $flight --log /dev/full --duration 60; fi
# A kernel with CAN knows no such interface.
if "$sim" $flight --interface nocan7 2>"$job/said"; then
    echo "an interface that is none was taken"
    wrong=1
fi
"$sim" $flight --interface nocan7 2>/dev/null
case $? in
3) bad 3 "^skyvert-sim: this kernel has no CAN \(AF_CAN\)" $flight --interface nocan7 ;;
2) bad 2 "--interface nocan7: there is no CAN interface of that name" $flight --interface nocan7 ;;
*) echo "no such interface: neither status 3 nor 2"; wrong=1 ;;
esac
"$sim" --help | grep -q "usage: skyvert-sim FLIGHT" || { echo "no --help"; wrong=1; }
"$sim" --version | grep -qE "^skyvert-sim [0-9]+\.[0-9]+\.[0-9]+$" || { echo "no --version"; wrong=1; }
exit $wrong
