#!/usr/bin/env bash
# truth.sh [br16|br17o|smoke...]: regenerates tools/trade/truth/*.csv, the light of all orders that the trade measures against.
# Some minutes (THREADS, 2); when interrupted it goes on where it was (states in $B/trade-truth).
set -eu
cd "$(dirname "$0")/../.."
B=${B:-build}
mkdir -p "$B/trade-truth"
[ $# -gt 0 ] || set -- br16 br17o smoke
for air; do
    case $air in
    br16) seed=316 radius=6360 target=0.15% paths=32000000 ;;
    br17o) seed=317 radius=6360 target=0.15% paths=32000000 ;;
    smoke) seed=318 radius=6371 target=1% paths=8000000 ;; # the study of terms alone
    *) echo "truth.sh: $air: br16, br17o or smoke" >&2; exit 2 ;;
    esac
    ini=tools/bench/$air.ini
    work=$B/trade-truth/$air
    awk -v seed=$seed -v radius=$radius -f tools/trade/truth.awk </dev/null >"$work.queries"
    options="--orders all --ground lit --target-error $target --max-paths $paths --seed 1"
    "$B/skyvert-reference" $options --threads "${THREADS:-2}" --state "$work.state" --atmosphere $ini \
        <"$work.queries" >"$work.answers"
    {
        echo "# Radiance of all orders of scattering and its standard errors, 1/sr: 24 rays in each of nine scenes, ground lit."
        echo "# Made by \`make trade-truth\`: skyvert-reference $options --atmosphere $ini"
        echo "# queries: awk -v seed=$seed -v radius=$radius -f tools/trade/truth.awk"
        awk -F, -v OFS=, 'NR > 1 { for (i = 5; i <= NF; i++) $i = sprintf(i <= 8 ? "%.5e" : "%.1e", $i) } { print }' "$work.answers"
    } >"$work.csv"
    mv "$work.csv" tools/trade/truth/$air.csv
    rm -f "$work.state" "$work.answers" "$work.queries"
    echo "tools/trade/truth/$air.csv"
done
