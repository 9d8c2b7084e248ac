#!/usr/bin/env bash
# Where no library is found `make` still builds the command without a warning, says what it left out and which package
# adds it, and what is left works; what is not there says so with status 1.
set -u
B=${B:-build}
bare=$B/gates/bare
mkdir -p "$B/gates"
make --no-print-directory DEPS=no PKG_CONFIG=false OPT=-O0 B="$bare" all >"$bare.log" 2>&1 || { grep -m5 -E 'error|Error' "$bare.log"; exit 1; }
for package in libgeographiclib-dev libopenexr-dev libpng-dev libinih-dev; do
    grep -q "left out: .*$package" "$bare.log" || { echo "without_packages: nothing says that $package would add something"; exit 1; }
done
"$bare/skyvert" sun --lat 47 --lon 8 --utc 2021-08-17T04:30:00Z | grep -q '^sun_elevation_deg' || { echo "without_packages: no sun"; exit 1; }
"$bare/skyvert" render --sun-zenith-deg 40 --out "$bare/sky.png" 2>"$bare.err"
[ $? -eq 1 ] && grep -q libpng-dev "$bare.err" && [ ! -e "$bare/sky.png" ] || { echo "without_packages: render says: $(cat "$bare.err")"; exit 1; }
