#!/usr/bin/env bash
# skyvert-cockpit without a CAN bus: a flight's log is replayed; what it shows, publishes and writes is compared with other programs.
set -u
B=${B:-build}
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
work=$(mktemp -d)
shm=skyvert-test-$$
pid=
trap '[ -z "$pid" ] || kill "$pid" 2>/dev/null; rm -rf "$work" /dev/shm/"$shm"' EXIT
cockpit=$B/skyvert-cockpit
failed=0
fail() { echo "FAIL: $*"; failed=1; }
figure() { awk -v n="$2" -v t="$1" '$1 == n {$1 = ""; print "figure: cockpit: " t ":" $0}' "$work/stats"; }
value() { awk -v n="$1" '$1 == n {print $2}' "${2:-$work/stats}"; }

# --- bad input: one line, its place, what is allowed; status 2
refused() { # TEXT STATUS ARGUMENT...
    local text=$1 want=$2
    shift 2
    timeout 20 "$cockpit" "$@" >"$work/out" 2>"$work/err" </dev/null
    local got=$?
    [ $got = "$want" ] || fail "$*: status $got, want $want"
    [ "$(wc -l <"$work/err")" = 1 ] || fail "$*: not one line: $(cat "$work/err")"
    grep -qF -- "$text" "$work/err" || fail "$*: wanted '$text', got '$(cat "$work/err")'"
    [ -s "$work/out" ] && fail "$*: wrote to the standard output"
}
ini() { printf '%s\n' "$@" >"$work/bad.ini"; }
refused "--rate 0: allowed is a number from 1 to 240" 2 --rate 0
refused "--rate nan: allowed" 2 --rate nan
refused "--vertices 63: allowed is a whole number from 64 to 65536" 2 --vertices 63
refused "--interface" 2 --interface aNameThatIsTooLong
refused "option --speed needs a value" 2 --speed
refused "--speed goes with --replay or --fake" 2 --speed 2
refused "--fake, not both" 2 --fake --replay x
refused "No such file" 2 --replay "$work/none.log"
refused "No such file" 2 --config "$work/none.ini"
refused "--shm a/b" 2 --fake --shm a/b
refused "there are only options" 2 --fake more
ini "[can]" "interfaces = can0"
refused "bad.ini:2: [can] has no interfaces: allowed is interface, node, transmit" 2 --config "$work/bad.ini"
ini "[sky]" "air = mars"
refused "bad.ini:2: air = mars: allowed is earth-clear or earth-hazy" 2 --config "$work/bad.ini"
ini "[sky]" "geoid_m = 101"
refused "bad.ini:2: geoid_m = 101: allowed is a number from -120 to 100" 2 --config "$work/bad.ini"
ini "[knobs]" "" "visibility_per_click = 1"
refused "bad.ini:3: visibility_per_click = 1: allowed is a number from 1.01 to 10" 2 --config "$work/bad.ini"
ini "[gpio]" "debounce_ms = 2000"
refused "bad.ini:2: debounce_ms" 2 --config "$work/bad.ini"
ini "[lamp]" "x = 1"
refused "no section [lamp]: allowed is can, sky, knobs, gpio" 2 --config "$work/bad.ini"
printf '(1.000000) can0 123#00\nnonsense\n' >"$work/bad.log"
timeout 20 "$cockpit" --replay "$work/bad.log" >/dev/null 2>"$work/err"
[ $? = 2 ] && grep -q "bad.log:2: column" "$work/err" || fail "a log's bad line: $(cat "$work/err")"
printf '(1.000000) can0 123#00\n(1.1000' >"$work/bad.log"
timeout 20 "$cockpit" --replay "$work/bad.log" >/dev/null 2>"$work/err"
[ $? = 0 ] && grep -q "bad.log:2: the log ends within this line" "$work/err" || fail "a log that was cut: $(cat "$work/err")"
printf '(5.000000) c 123#00\n(1700000000.100000) c 123#02\n' >"$work/bad.log"
timeout 20 "$cockpit" --replay "$work/bad.log" --duration 0.3 >/dev/null 2>"$work/err"
[ $? = 0 ] && grep -q "bad.log:2: 1699999995 s behind the frame before: was the clock set" "$work/err" || fail "a clock that was set: $(cat "$work/err")"
# A kernel without CAN: one line, status 3. With CAN: there is no such interface.
"$cockpit" --interface nocan9 >/dev/null 2>"$work/err"
got=$?
case $got in
3) grep -q CAN "$work/err" || fail "status 3: $(cat "$work/err")" ;;
2) grep -q nocan9 "$work/err" || fail "status 2: $(cat "$work/err")" ;;
*) fail "no interface: status $got: $(cat "$work/err")" ;;
esac
[ "$(wc -l <"$work/err")" = 1 ] || fail "no CAN: not one line"

# No room for the vertices: said at the start, not by a SIGBUS in the middle.
if unshare -m mount -t tmpfs -o size=64k tmpfs /dev/shm 2>/dev/null; then
    unshare -m sh -c 'mount -t tmpfs -o size=64k tmpfs /dev/shm && exec "$0" --fake --duration 1 --no-terminal --shm full' "$cockpit" >/dev/null 2>"$work/err"
    [ $? = 1 ] && grep -q "shm /full: .* bytes: No space left on device" "$work/err" || fail "no room for the vertices: $(cat "$work/err")"
else
    echo "note: not tried: a full /dev/shm (no right to mount one)"
fi

# --- a flight: 14 s of its log, 19 s of the cockpit, so that at last nothing comes
"$B/skyvert-sim" "$root/tools/flight/dusk-lszh-loww.csv" --start 2024-03-20T17:10:00Z --duration 14 --visibility-m 30000 --log "$work/flight.log" 2>"$work/err" ||
    fail "no log: $(cat "$work/err")"
# The configuration that is delivered, but with lines that no machine has: a line each, and it runs on.
sed 's/gpiochip0:/gpiochip99:/' "$root/tools/cockpit/cockpit.ini" >"$work/cockpit.ini"
: >"$work/lines"
"$cockpit" --config "$work/cockpit.ini" --replay "$work/flight.log" --duration 19 --shm "$shm" --png "$work/sky.png" --exr "$work/sky.exr" --stats "$work/stats" \
    >"$work/lines" 2>"$work/err" &
pid=$!
for try in $(seq 50); do grep -q '^live' "$work/lines" && break; sleep 0.1; done
"$B/tests/cockpit/reader" "/$shm" 8 >"$work/read" || fail "the reader's status: $?"
kill -USR1 $pid
"$cockpit" --fake --shm "$shm" >/dev/null 2>"$work/second"
[ $? = 1 ] && grep -q "is writing there" "$work/second" || fail "a second writer: $(cat "$work/second")"
wait $pid || fail "the cockpit's status: $?"
pid=
[ -e "/dev/shm/$shm" ] && fail "the shared memory is left"
[ "$(grep -c '^skyvert-cockpit: gpio: .*gpiochip99.*; goes on without it$' "$work/err")" -ge 5 ] || fail "lines that are not there: $(cat "$work/err")"
grep -v gpio: "$work/err" && fail "more was said"

python3 "$here/cockpit_flight.py" "$B/skyvert" "$root/tools/flight/dusk-lszh-loww.csv" "$work/lines" "$work/read" || fail "what it showed of the flight"
for name in can_missing can_duplicate can_out_of_order can_out_of_range can_not_finite can_wrong_type dropped frames_refused; do
    [ "$(value $name)" = 0 ] || fail "$name: $(value $name)"
done
[ "$(value can_accepted)" -gt 400 ] || fail "accepted: $(value can_accepted)"
tail -n 1 "$work/lines" | grep -q '^held .*lamps .1 .*stale ".*Latitude' || fail "at last: $(tail -n 1 "$work/lines")"

# --- a bus that says heights above the ellipsoid alone: less what the file says of the sea
grep -v ' 40E#' "$work/flight.log" | sed 's/ 14C#/ 40E#/' >"$work/gps.log"
for geoid in 0 40; do
    ini "[sky]" "geoid_m = $geoid"
    "$cockpit" --config "$work/bad.ini" --replay "$work/gps.log" --speed 20 --duration 1.5 --no-terminal >"$work/gps$geoid" 2>"$work/err" || fail "geoid: $(cat "$work/err")"
done
height() { tail -n 1 "$1" | sed 's/.* height \([-0-9.]*\) .*/\1/'; }
awk -v a="$(height "$work/gps0")" -v b="$(height "$work/gps40")" 'BEGIN {exit !(a - b > 39.8 && a - b < 40.2)}' ||
    fail "geoid_m = 40: height $(height "$work/gps40"), without $(height "$work/gps0")"

# --- the snapshots, read by OpenImageIO
python3 "$here/cockpit_picture.py" "$work/sky.exr" "$work/sky.png" "$work/lines" || fail "snapshots"
ls "$work" | grep -q part && fail "parts of files are left"

# --- the terminal
python3 "$here/cockpit_terminal.py" "$cockpit" || fail "terminal"

# --- the reader of the lines goes away
timeout 20 "$cockpit" --fake --no-terminal 2>"$work/err" | head -n 1 >"$work/out"
[ "${PIPESTATUS[0]}" = 1 ] || fail "closed standard output: status ${PIPESTATUS[0]}"

# --- figures of 60 Hz with 2048 vertices on this machine; nothing grows
"$cockpit" --fake --duration 10 --rate 60 --vertices 2048 --shm "$shm" --no-terminal --stats "$work/stats" >/dev/null 2>"$work/err" || fail "10 s: $(cat "$work/err")"
figure "latency, median" latency_median
figure "latency, 99 of 100" latency_p99
figure "a frame of 2048 vertices, median" evaluate_median
figure "60 Hz, 2048 vertices" processor
figure "memory" memory
early=$(value memory_early) late=$(value memory)
[ "$late" -le $((early + 300)) ] || fail "memory grew from $early to $late KB" # a page or two of the C library's buffers
[ "$(value frames)" -ge 100 ] || fail "frames in 10 s: $(value frames)"        # of 600: what a machine that is busy gets done
exit $failed
