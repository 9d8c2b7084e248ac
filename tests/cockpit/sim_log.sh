#!/usr/bin/env bash
# Logs of skyvert-sim, read by canmatrix by the DBC file: the flight's positions at the frames' times, sun and moon, the periods,
# the message codes. The same input gives the same bytes, also paced and replayed.
set -u
B=${B:-build}
sim=$B/skyvert-sim
job=$B/cockpit-sim-log
rm -rf "$job"
mkdir -p "$job"
fail() { echo "$*"; exit 1; }
python=
for p in python3 /usr/bin/python3; do "$p" -c 'import canmatrix' 2>/dev/null && python=$p && break; done
[ -n "$python" ] || { echo "logs of skyvert-sim: no package python3-canmatrix"; exit 77; }
flight=tools/flight/dusk-lszh-loww.csv

"$sim" $flight --log "$job/whole.log" --speed max 2>"$job/said" || fail "the whole flight: $(cat "$job/said")"
"$sim" $flight --log "$job/again.log" --speed max 2>/dev/null
cmp "$job/whole.log" "$job/again.log" || fail "the same flight gave other bytes"
"$sim" "$job/whole.log" --log "$job/replay.log" --speed max 2>/dev/null || fail "a log as input"
cmp "$job/whole.log" "$job/replay.log" || fail "a log of a log differs from it"
"$sim" $flight --log - --speed max 2>/dev/null | cmp - "$job/whole.log" || fail "the standard output differs from the file"
rm "$job/again.log" "$job/replay.log"
# A board that logs while its clock is set: said, with a way on.
printf '(5.000000) c 123#00\n(5.100000) c 123#01\n(1700000000.100000) c 123#02\n' >"$job/set.log"
"$sim" "$job/set.log" --log "$job/mended.log" --speed max 2>"$job/said" || fail "a clock that was set: $(cat "$job/said")"
grep -q "set.log:3: 1699999995 s behind the frame before: .* --start 1699999995 begins here" "$job/said" || fail "a clock that was set: $(cat "$job/said")"
"$sim" "$job/set.log" --log - --start 1699999995 2>/dev/null | grep -q '123#02' || fail "--start behind the gap"
# A log whose writer was killed ends within a line: that line is left out, which is said.
head -c 100010 "$job/whole.log" >"$job/cut.log"
"$sim" "$job/cut.log" --log "$job/mended.log" --speed max 2>"$job/said" || fail "a log cut in a line: $(cat "$job/said")"
grep -q "cut.log:$(($(wc -l <"$job/cut.log") + 1)): the log ends within this line, which is left out" "$job/said" || fail "a log cut in a line: $(cat "$job/said")"
cmp <(head -n "$(wc -l <"$job/cut.log")" "$job/whole.log") "$job/mended.log" || fail "a log cut in a line: others are missing"
figure=$(wc -l <"$job/whole.log")
echo "figure: log of the sample flight: $figure frames, $(stat -c %s "$job/whole.log") bytes"

# A minute around take-off, one at night by its UTC, and a glider's IGC; decoded.
"$sim" $flight --log "$job/start.log" --speed max --start 230 --duration 60 --node 9 2>/dev/null || fail "--start in seconds"
"$sim" $flight --log "$job/late.log" --speed max --start 2024-03-20T17:41:07Z --duration 60 --bitrate 125000 2>/dev/null || fail "--start by UTC"
"$python" tests/cockpit/sim_log.py make "$job" || exit 1
"$sim" "$job/g.igc" --log "$job/g.log" --speed max 2>/dev/null || fail "an IGC file"
"$python" tests/cockpit/sim_log.py port/canaerospace/skyvert.dbc \
    "$job/start.log:$flight:9" "$job/late.log:$flight:1" "$job/g.log:$job/g.csv:1" 2>"$job/said" || { cat "$job/said"; exit 1; }
sed 's/ 40C#\(..\)03/ 40C#\1FF/;300q' "$job/start.log" >"$job/broken.log"
"$python" tests/cockpit/sim_log.py port/canaerospace/skyvert.dbc "$job/broken.log:$flight:9" >/dev/null 2>&1 && fail "a broken log passed"

# Paced: 4 s of flight at 4 times the pace take 1 s; stopped by a signal it keeps what it has, whole lines.
begin=$(date +%s%N)
"$sim" $flight --log "$job/paced.log" --speed 4 --start 230 --duration 4 --node 9 2>/dev/null || fail "--speed 4"
took=$((($(date +%s%N) - begin) / 1000000))
[ $took -ge 950 ] || fail "4 s at --speed 4 took $took ms"
cmp -n "$(stat -c %s "$job/paced.log")" "$job/paced.log" "$job/start.log" || fail "--speed changes what is in a log"
"$sim" $flight --log "$job/stopped.log" --speed 1 --start 230 --node 9 2>"$job/said" &
pid=$!
sleep 1.5
kill -TERM $pid
wait $pid || fail "stopped by SIGTERM: status $?"
grep -q "frames of .* s written" "$job/said" || fail "no summary: $(cat "$job/said")"
[ "$(stat -c %s "$job/stopped.log")" -gt 1000 ] && cmp -n "$(stat -c %s "$job/stopped.log")" "$job/stopped.log" "$job/start.log" || fail "a stopped log is not the beginning of a whole one"
# A reader that takes nothing for a while puts it behind its pace: a signal counts all the same.
mkfifo "$job/pipe"
"$sim" $flight --log - --speed 1000 >"$job/pipe" 2>/dev/null &
pid=$!
exec 3<"$job/pipe"
sleep 0.3
head -c 40000 <&3 >/dev/null # now it is behind, and writes until the pipe is full again
sleep 0.3
kill -TERM $pid
written=$(wc -c <&3)
exec 3<&-
wait $pid || fail "stopped behind its pace: status $?"
[ "$written" -lt 200000 ] || fail "stopped behind its pace it still wrote $written bytes" # a pipe holds 65536
# As fast as can be: stopped, it leaves nothing.
"$sim" $flight --log "$job/none.log" --speed max --duration 1e7 2>/dev/null &
pid=$!
sleep 0.5
kill -TERM $pid
wait $pid && fail "a log stopped half-way was called done"
[ -z "$(find "$job" -name '*none.log*')" ] || fail "a log stopped half-way left files: $(ls -A "$job")"
rm -f "$job/whole.log"
