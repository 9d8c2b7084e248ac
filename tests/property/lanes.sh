#!/usr/bin/env bash
# The same bits with 1, 4, 16 and 64 directions side by side.
set -euo pipefail
first=
for n in 1 4 16 64; do
    sum=$("$B/tests/property/lanes-$n")
    echo "SKV_LANES $n: $sum"
    [[ $sum =~ ^[0-9a-f]{8}$ ]] || { echo "lanes.sh: no checksum of SKV_LANES $n"; exit 1; }
    [ "${first:=$sum}" = "$sum" ] || { echo "lanes.sh: SKV_LANES $n: got $sum, want $first"; exit 1; }
done
echo "figure: one checksum for SKV_LANES 1, 4, 16, 64: $first"
