#!/usr/bin/env bash
# truth.sh: path traces what is missing of the truth for the 20 random scenes of seed 1 (tests/plan/truth). Called by `make
# plan-scenes`; delete a file to have it made anew.
set -eu
cd "$(dirname "$0")/../.."
B=${B:-build}
for k in $(seq 1 20); do
    out=tests/plan/truth/$k.csv ini=$B/plan-scene-$k.ini
    [ ! -s "$out" ] || continue
    awk -v seed=1 -v number="$k" -v what=scene -f tests/plan/scenes.awk </dev/null >"$ini"
    { head -n 1 "$ini" | sed 's/^;/#/'; nice -n 15 "$B/plan-truth" scene "$ini" 77 10 6; } >"$out.part"
    mv "$out.part" "$out"
    echo "$out"
done
