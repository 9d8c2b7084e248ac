#!/usr/bin/env bash
# All sweeps: a quarter of an hour.
set -u
cd "$(dirname "$0")/../.." || exit 1
B=${B:-build}
failed=0
for p in continuity weather light; do
    EXTREMES_FULL=1 "$B/tests/extremes/$p" >"$B/tests/extremes/$p-full.txt" 2>&1 || failed=1
    grep -E '^(figure|note|ERROR):?' "$B/tests/extremes/$p-full.txt"
done
exit $failed
