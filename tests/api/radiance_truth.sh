#!/usr/bin/env bash
# Expected radiances of tests/api/test_radiance.c: makes tests/api/radiance_truth.h anew with the double-precision
# reference and compares it; `B=build bash tests/api/radiance_truth.sh --write` writes it.
set -u
cd "$(dirname "$0")/../.." || exit 1
B=${B:-build}
header=tests/api/radiance_truth.h
[ -x "$B/skyvert-reference" ] || { echo "radiance_truth: no $B/skyvert-reference (Debian: libinih-dev)"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Sky by day; ground; horizon and just above and below it; tangents from 12 and 40 km; the top; space; twilight.
cat >"$work/rays.csv" <<'Q'
altitude_km,sun_zenith_deg,view_zenith_deg,rel_azimuth_deg
0,0,0,0
0,30,0,0
0,30,60,0
0,60,45,90
0,60,60,5
0,75,85,180
0,85,88,10
0,89,80,120
0,89,89.5,0
0,45,90,30
0,88,90,180
1,45,30,60
1,80,89,45
2,60,75,150
5,20,60,20
5,70,85,100
2,60,91.42,90
2,60,91.45,90
1,30,120,0
5,70,100,40
5,75,93,170
10,20,180,0
10,88,95,30
30,50,135,60
12,60,92,90
12,85,93,20
12,45,93.5,180
40,75,95,10
40,89,96,45
40,30,96.3,120
60,40,90.5,0
60,40,140,70
60,30,80,0
400,30,180,0
400,60,110,30
400,85,109,60
400,60,125,200
400,95,109.5,0
400,30,100,0
0,92,0,0
0,92,85,0
0,94,88,20
0,96,89,5
0,95,80,180
3,93,70,30
12,94,91,0
40,96,95,10
Q
: >"$work/rows"
for air in br16 br17o; do
    for ground in none lit; do
        "$B/skyvert-reference" --atmosphere tools/bench/$air.ini --ground $ground <"$work/rays.csv" >"$work/$ground" || exit 1
    done
    paste -d, "$work/none" "$work/lit" >"$work/answers"
    { echo "static const truth_row truth_$air[TRUTH_RAYS] = {"
      LC_ALL=C awk -v ini=tools/bench/$air.ini -f tests/api/radiance_truth.awk "$work/answers" || exit 1
      echo "};"; } >>"$work/rows"
done
{ cat <<H
// Made by tests/api/radiance_truth.sh: radiances of the double-precision reference, 1/sr. The script compares.
// clang-format off
#ifndef TESTS_API_RADIANCE_TRUTH_H
#define TESTS_API_RADIANCE_TRUTH_H

/// Angles of skyvert eval; azimuth 0 is toward the sun. Four bands each.
typedef struct truth_row {
    float altitude_km, sun_deg, view_deg, azimuth_deg;
    float radiance[4]; ///< converged single scattering, no light of the ground
    float lit[4];      ///< with it
    float transmittance[4];
    float keller[4];  ///< what the rule by Keller gives with 16x16 samples
    float uniform[4]; ///< equal steps, 64 and 16
} truth_row;

#define TRUTH_RAYS $(($(wc -l <"$work/rays.csv") - 1))

H
  cat "$work/rows"
  echo "#endif"; } >"$work/header"
if [ "${1:-}" = --write ]; then
    cp "$work/header" $header.new && mv $header.new $header
    exit
fi
# Numbers may differ in the last digits between C libraries: 1e-6 of themselves is under what any test here allows.
awk 'function number(x) { return x ~ /^[{ ]*[-0-9.][-+0-9.e]*f[}, ;]*$/ }
     function value(x) { gsub(/[{}f, ;]/, "", x); return x + 0 }
     NR == FNR { want[FNR] = $0; lines = FNR; next }
     { if ($0 == want[FNR]) next
       n = split($0, a, " "); m = split(want[FNR], b, " "); bad = n != m
       for (i = 1; i <= n && !bad; i++) {
           if (a[i] == b[i]) continue
           d = value(a[i]) - value(b[i])
           bad = !number(a[i]) || !number(b[i]) || (d < 0 ? -d : d) > 1e-6 * value(b[i])
       }
       if (bad) { print FILENAME ":" FNR ": got " $0 "\n    want " want[FNR]; failed = 1 } }
     END { if (FNR != lines) { print "the number of lines differs: " FNR ", want " lines; failed = 1 }
           if (failed) print "made anew by: tests/api/radiance_truth.sh --write"
           exit failed }' "$work/header" $header
