#!/usr/bin/env bash
# The DBC file is the one that the table of messages gives; and canmatrix and tshark read from it, and a recorded log, the
# values that were encoded.
set -u
B=${B:-build}
bin=$B/tests/can
job=$B/can-dbc
rm -rf "$job"
mkdir -p "$job"
"$bin/dbc" >"$job/skyvert.dbc"
diff "$job/skyvert.dbc" port/canaerospace/skyvert.dbc >"$job/diff" || { head -20 "$job/diff"; echo "port/canaerospace/skyvert.dbc is not of this table: make dbc"; exit 1; }
python=
for p in python3 /usr/bin/python3; do "$p" -c 'import canmatrix' 2>/dev/null && python=$p && break; done
[ -n "$python" ] && command -v tshark >/dev/null || { echo "DBC against canmatrix and tshark: no package python3-canmatrix or tshark"; exit 77; }
"$bin/random_log" 40 2026 "$job/random.log" "$job/random.csv" || exit 1
"$python" tests/can/dbc.py port/canaerospace/skyvert.dbc "$job/random.log" "$job/random.csv" "$job/tshark" 2>"$job/errors" || { cat "$job/errors"; exit 1; }
"$python" tests/can/dbc.py port/canaerospace/skyvert.dbc "$job/random.log" "$job/random.csv" "$job/tshark" break >"$job/broken" 2>"$job/errors" && { echo "a broken DBC passed"; exit 1; }
grep -q canmatrix: "$job/broken" && grep -q tshark: "$job/broken" || { echo "a broken DBC was not noticed by both"; exit 1; }
