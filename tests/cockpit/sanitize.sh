#!/usr/bin/env bash
# The cockpit's programs and tests under address, undefined-behaviour and leak sanitizers (core, C++ and pictures' writers without):
# a flight's log, the made-up flight with a snapshot, 100,000 random frames.
set -u
B=${B:-build}
san=$B/sanitize
job=$san/job
export ASAN_OPTIONS=detect_leaks=1:abort_on_error=0 UBSAN_OPTIONS=print_stacktrace=1
rm -rf "$job"
mkdir -p "$job"
failed=0
# clean NAME COMMAND...: exits with 0 and says nothing like a report.
clean() {
    local name=$1
    shift
    "$@" >"$job/out" 2>"$job/said" </dev/null
    local got=$?
    if [ $got != 0 ] || grep -qE "ERROR: (Address|Leak)Sanitizer|runtime error" "$job/out" "$job/said"; then
        echo "FAIL: $name: status $got"
        tail -n 40 "$job/said" "$job/out"
        failed=1
    fi
}
for test in "$san"/test_*; do clean "$test" "$test"; done
flight=tools/flight/dusk-lszh-loww.csv
clean "skyvert-sim, a flight" "$san/skyvert-sim" $flight --log "$job/flight.log" --start 2024-03-20T17:10:00Z --duration 120
clean "skyvert-sim, a log" "$san/skyvert-sim" "$job/flight.log" --log "$job/again.log"
cmp "$job/flight.log" "$job/again.log" || failed=1
small=(--no-terminal --rate 30 --vertices 64 --shm "skyvert-san-$$")
clean "skyvert-cockpit, a flight" "$san/skyvert-cockpit" --replay "$job/flight.log" --speed 40 "${small[@]}" --config tools/cockpit/cockpit.ini --stats "$job/stats"
[ "$(awk '$1 == "can_accepted" {print $2}' "$job/stats")" -gt 3000 ] || { echo "FAIL: few frames: $(cat "$job/stats")"; failed=1; }
clean "skyvert-cockpit, the picture" "$san/skyvert-cockpit" --fake --duration 1.5 --speed 60 --terminal --rate 10 --vertices 64
"$san/skyvert-cockpit" --fake --duration 2 "${small[@]}" --png "$job/sky.png" >/dev/null 2>"$job/said" &
pid=$!
sleep 1
kill -USR1 $pid
wait $pid && [ -s "$job/sky.png" ] && [ ! -s "$job/said" ] || { echo "FAIL: a snapshot: $(cat "$job/said")"; failed=1; }
"$B/tests/can/random_frames" 100000 2026 250 >"$job/random.log" || { echo "FAIL: no random frames"; failed=1; }
clean "skyvert-cockpit, random frames" "$san/skyvert-cockpit" --replay "$job/random.log" --speed 10 "${small[@]}" --stats "$job/stats"
echo "figure: cockpit under the sanitizers: $(awk '$1 == "received" {print $2}' "$job/stats") of 100000 random frames heard, $(awk '$1 == "can_accepted" {print $2}' "$job/stats") accepted, no report"
[ "$(awk '$1 == "frames_refused" {print $2}' "$job/stats")" = 0 ] || { echo "FAIL: the core refused a sky"; failed=1; }
clean "skyvert-sim, random frames" "$san/skyvert-sim" "$job/random.log" --log "$job/again.log" --bitrate 1000000
exit $failed
