#!/usr/bin/env bash
# data.sh [NAME...]: regenerates tools/reference/data/*.csv, the truth for all orders of scattering that tests compare with. Some
# minutes; when interrupted it goes on where it was (states in $B/reference-data).
set -eu
cd "$(dirname "$0")/../.."
B=${B:-build}
mkdir -p "$B/reference-data"
for name in "${@:-br16 br17o mars thin thick coarse}"; do for air in $name; do
    target=0.3%
    case $air in
    br16) ini=tools/bench/br16.ini radius=6360 top=60 seed=16 ;;
    br17o) ini=tools/bench/br17o.ini radius=6360 top=60 seed=17 ;;
    mars) ini=tools/reference/data/mars.ini radius=3389.5 top=100 seed=4 ;;
    thin) ini=tools/reference/data/thin.ini radius=6360 top=60 seed=2 ;;
    thick) ini=tools/reference/data/thick.ini radius=6360 top=60 seed=5 ;;
    coarse) ini=tools/reference/data/coarse.ini radius=3389.5 top=100 seed=6 target=1% ;;
    *) echo "data.sh: $air: br16, br17o, mars, thin, thick or coarse" >&2; exit 2 ;;
    esac
    work=$B/reference-data/$air
    awk -v seed=$seed -v radius=$radius -v top=$top -f tools/reference/data.awk </dev/null >"$work.queries"
    options="--orders all --ground lit --target-error $target --max-paths 8000000 --seed 1"
    "$B/skyvert-reference" $options --state "$work.state" --atmosphere $ini <"$work.queries" >"$work.answers"
    {
        echo "# Radiance of all orders of scattering and its standard errors, 1/sr: 30 rays with the sun at 0-75 deg from the zenith,"
        echo "# 12 at 80-85, 28 at 88-92, 15 at 94, 15 at 96. Made by \`make reference-data\`:"
        echo "# skyvert-reference $options --atmosphere $ini"
        echo "# queries: awk -v seed=$seed -v radius=$radius -v top=$top -f tools/reference/data.awk"
        awk -F, -v OFS=, 'NR > 1 { for (i = 5; i <= NF; i++) $i = sprintf(i <= 8 ? "%.5e" : "%.1e", $i) } { print }' "$work.answers"
    } >"$work.csv"
    mv "$work.csv" tools/reference/data/$air.csv
    rm "$work.state" "$work.answers" "$work.queries"
    echo "tools/reference/data/$air.csv"
done; done
