#!/usr/bin/env bash
# linan23_truth.sh: makes tools/fit/linan23_truth.csv again, the light of the orders after the first that linan23.py fits
# the logistic of [Linan23] to: path tracer less single scattering, clear Earth with ozone (tools/bench/br17o.ini), sky rays.
# Some minutes on two threads. `make fit-check` does not run it.
set -eu
cd "$(dirname "$0")/../.."
B=${B:-build}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
{
    echo altitude_km,sun_zenith_deg,view_zenith_deg,rel_azimuth_deg
    for sun in 0 30 60 70 80 85 88 90 92; do # with those of the thesis's pictures
        for ray in 0,10,0 0,40,90 0,60,180 0,75,30 0,85,90 0,88,180 8,30,45 8,80,135; do
            IFS=, read -r height view azimuth <<<"$ray"
            echo "$height,$sun,$view,$azimuth"
        done
    done
} >"$work/queries"
options="--orders all --ground none --target-error 0.5% --max-paths 2000000 --seed 23"
"$B/skyvert-reference" $options --threads "${THREADS:-2}" --atmosphere tools/bench/br17o.ini <"$work/queries" >"$work/all"
"$B/skyvert-reference" --orders single --ground none --atmosphere tools/bench/br17o.ini <"$work/queries" >"$work/single"
{
    echo "# Light of the orders after the first (D) and of all (L), 1/sr. Made by tools/fit/linan23_truth.sh: skyvert-reference"
    echo "# $options --atmosphere tools/bench/br17o.ini, less --orders single."
    echo altitude_km,sun_zenith_deg,view_zenith_deg,rel_azimuth_deg,D_440,D_520,D_600,D_680,L_440,L_520,L_600,L_680
    paste -d, "$work/all" "$work/single" | awk -F, -v OFS=, 'NR > 1 {
        print $1, $2, $3, $4, f($5 - $17), f($6 - $18), f($7 - $19), f($8 - $20), f($5), f($6), f($7), f($8) }
        function f(x) { return sprintf("%.4g", x) }'
} >tools/fit/linan23_truth.csv.new
mv tools/fit/linan23_truth.csv.new tools/fit/linan23_truth.csv
