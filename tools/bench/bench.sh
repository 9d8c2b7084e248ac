#!/usr/bin/env bash
# bench.sh [errors|orders|cost|tables [BUILD]]: error, instructions and time of every rule and tier (errors, cost: light
# scattered once; orders, tables: all light); BUILD such as "gcc avx2" alone.
# Called by `make bench` with B set.
set -euo pipefail
B=${B:-build}
MAKE=${MAKE:-make}
air=tools/bench/br17o.ini
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

have() { command -v "$1" >/dev/null; }
have valgrind || { echo "bench.sh: valgrind is needed to count instructions (apt-get install valgrind)" >&2; exit 1; }

trim='-DSKV_BANDS=3 -DSKV_TERM_DUST=0 -DSKV_TERM_OZONE=0 -DSKV_TERM_GROUND=0 -DSKV_OUT_TRANSMITTANCE=0 -DSKV_PROFILE_TABULATED=0
 -DSKV_PHASE_HENYEY_GREENSTEIN=0 -DSKV_RULE_UNIFORM=0 -DSKV_RULE_KELLER=0 -DSKV_DEPTH_INNER=0 -DSKV_LIGHTS_MAX=1'
# name|compiler|ARCH|OPT|CORE_EXTRA
builds="gcc avx2|gcc|-mavx2|-O3|
gcc sse2|gcc||-O3|
gcc scalar|gcc||-O3 -fno-tree-vectorize -fno-tree-slp-vectorize|
gcc avx2 trimmed|gcc|-mavx2|-O3|$(echo "$trim" | tr -d '\n')"
have clang && builds="$builds
clang avx2|clang|-mavx2|-O3|
clang sse2|clang||-O3|
clang scalar|clang||-O3 -fno-vectorize -fno-slp-vectorize|
clang avx2 trimmed|clang|-mavx2|-O3|$(echo "$trim" | tr -d '\n')"

[ -z "${2:-}" ] || builds=$(grep "^$2|" <<<"$builds") || { echo "bench.sh: no build '$2'" >&2; exit 2; }

folder() { echo "$B/bench/${1// /-}"; }

build_one() {
    d=$(folder "$1")
    "$MAKE" --no-print-directory -s DEPS=no B="$d" CC="$2" ARCH="$3" OPT="$4" WARN=-w CORE_EXTRA="$5" "$d/bench-cost" "$d/bench-tables" >/dev/null </dev/null ||
        { echo "bench.sh: $1 does not build: left out" >&2; rm -f "$d/bench-cost" "$d/bench-tables"; }
}

build_all() {
    running=0
    while IFS='|' read -r name cc arch opt extra; do
        build_one "$name" "$cc" "$arch" "$opt" "$extra" &
        running=$((running + 1))
        [ $((running % $(nproc))) -ne 0 ] || wait
    done <<<"$builds"
    wait
}

# Runs a program of one build under callgrind and prints `build|what|rule|instructions per vertex`.
count() {
    [ -x "$(folder "$1")/$2" ] || return 0
    rm -f "$work"/cg.*
    valgrind --tool=callgrind --collect-atstart=no --callgrind-out-file="$work/cg" "$(folder "$1")/$2" count "$air" \
        >/dev/null 2>"$work/log" || { cat "$work/log" >&2; return 1; }
    awk -v build="$1" -F '|' '/^desc: Trigger: Client Request: /{sub(/.*Request: /,""); what=$1; rule=$2; n=$3}
        /^totals: /{split($0,t," "); if(n>0) printf "%s|%s|%s|%.1f\n", build, what, rule, t[2]/n; n=0}' $(ls -v "$work"/cg.*)
}

# Rows: rules; columns: builds. $1: what; $2: awk that folds several figures into one (max).
table() {
    awk -F '|' -v what="$1" '
        $2==what { if(!($3 in seen)){seen[$3]=1; rules[++nr]=$3} if(!($1 in col)){col[$1]=1; builds[++nb]=$1}
                   k=$1 SUBSEP $3; if(!(k in v)||$4>v[k]) v[k]=$4 }
        END{printf "%-22s","rule"; for(b=1;b<=nb;b++) printf " %17s",builds[b]; printf "\n";
            for(r=1;r<=nr;r++){printf "%-22s",rules[r]; for(b=1;b<=nb;b++){k=builds[b] SUBSEP rules[r]; if(k in v) printf " %17.0f",v[k]; else printf " %17s","-"} printf "\n"}}' \
        "$work/counts"
}

machine() {
    echo "machine: $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1), $(uname -srm)"
    for c in gcc clang; do have $c && echo "compiler: $($c --version | head -n 1)"; done
    return 0
}

part=${1:-}
wanted() { [ -z "$part" ] || [ "$part" = "$1" ]; }

# Atmosphere files and the truth for them, as far as that is there.
truths() {
    for air in br16 br17o thin thick mars; do
        ini=tools/reference/data/$air.ini
        [ -e "$ini" ] || ini=tools/bench/$air.ini
        [ ! -e "tools/reference/data/$air.csv" ] || echo "$ini tools/reference/data/$air.csv"
    done
}

if wanted errors; then
    echo "== Error against the double-precision reference (single scattering; largest channel error / largest channel, at least 5 % of the dome mean)"
    "$B/bench-errors" tools/bench/br16.ini tools/bench/br17o.ini
fi
if wanted orders; then
    echo
    echo "== Error of all light against the path tracer (ground lit; largest channel error / largest channel, at least 5 % of the class mean)"
    echo "   columns: sun zenith; 'worst' rows can be replayed with skyvert eval --ground lit"
    "$B/bench-orders" $(truths)
fi
! wanted cost && ! wanted tables || build_all
if wanted cost; then
    while IFS='|' read -r name rest; do count "$name" bench-cost </dev/null; done <<<"$builds" >"$work/counts"
    echo
    echo "== Instructions per vertex (callgrind, inside skv_radiance and what it calls; air of br17o.ini)"
    machine
    echo "flags: -std=c99 -O3 -ffp-contract=off -fno-math-errno -fno-trapping-math; avx2: -mavx2; sse2: none; scalar: vectorisers off; trimmed: only the terms used are compiled in"
    for k in "bare|two species, three bands, 2048 sky vertices from 2 km, sun zenith 45" \
        "dome|four bands and ozone, 2048 vertices from 1 km, elevation 90 to -10, sun zenith 60" \
        "dusk|the same, sun zenith 94" \
        "worst|four bands and ozone, the dearest of 42 directions at 1 km (sun zenith 60, 92, 95)"; do
        printf '\n%s: %s\n' "${k%%|*}" "${k#*|}"
        table "${k%%|*}"
    done
    echo
    echo "== Time: median and minimum of 41 interleaved runs over 2048 vertices, one core, a checksum of the results inside"
    for b in "gcc avx2" "clang avx2"; do
        d=$(folder "$b")/bench-cost
        [ -x "$d" ] || continue
        printf '\n%-8s %-22s %14s %14s %14s   (%s)\n' scene rule "median ns/vtx" "min ns/vtx" "min ms/dome" "$b"
        "$d" time "$air" | awk -F '|' '/^checksum/{print "checksum " $2; next} {printf "%-8s %-22s %14s %14s %14s\n",$1,$2,$3,$4,$5}'
    done
fi
if wanted tables; then
    builds=$(grep -v trimmed <<<"$builds" || true)
    while IFS='|' read -r name rest; do count "$name" bench-tables </dev/null; done <<<"$builds" >"$work/counts"
    echo
    echo "== All light: sizes, standard tier, four bands (air of br17o.ini)"
    for b in "gcc avx2" "${2:-gcc sse2}"; do
        [ ! -x "$(folder "$b")/bench-tables" ] || { "$(folder "$b")/bench-tables" sizes "$air" | grep bytes; break; }
    done
    echo
    echo "== All light: instructions (callgrind)"
    machine
    for k in "build|a whole build of a table" "step|the dearest of the 12 steps that took longest" \
        "dome|per vertex, 2048 from 1 km, elevation 90 to -10, sun zenith 60; the grid's build is in it" "dusk|the same, sun zenith 94"; do
        printf '\n%s: %s\n' "${k%%|*}" "${k#*|}"
        table "${k%%|*}"
    done
    echo
    echo "== All light: time (builds: 9, the others 41 interleaved runs of a whole frame of 2048 vertices; one core)"
    while IFS='|' read -r name rest; do
        d=$(folder "$name")/bench-tables
        [ -x "$d" ] || continue
        printf '\n%-18s %-10s %12s %12s %12s   (%s)\n' what how median least "90 %" "$name"
        "$d" time "$air" </dev/null | awk -F '|' '/^checksum/{next} {printf "%-18s %-10s %12s %12s %12s\n",$1,$2,$3,$4,$5}'
    done <<<"$builds"
fi
