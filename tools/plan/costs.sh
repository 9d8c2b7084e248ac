#!/usr/bin/env bash
# costs.sh [TARGET...]: makes tools/plan/costs_data.h anew (`make plan-costs`): builds tools/plan/count.c for each target,
# number of bands and choice of species, counts instructions and fits them to events. Called with B set.
set -eu
cd "$(dirname "$0")/../.."
. tools/plan/targets.sh
export W=$B/plan-costs
ALL="x86-avx2 x86-sse2 cortex-m4f cortex-m7 cortex-a53"
TARGETS=${*:-$ALL}
# Species as the letters of Rayleigh, aerosol, dust, ozone.
SPECIES="R RO RA RAO RAD RADO"
# shellcheck disable=SC2086
targets_need $TARGETS >&2
mkdir -p "$W"
targets_begin

# has LETTERS LETTER: 1 or 0.
has() { case $1 in *$2*) echo 1 ;; *) echo 0 ;; esac; }
# header BANDS LETTERS: as skyvert plan writes it, with every output.
header() {
    echo "#define SKV_BANDS $1"
    echo "#define SKV_RULE_UNIFORM 0"
    echo "#define SKV_RULE_KELLER 0"
    echo "#define SKV_DEPTH_INNER 0"
    echo "#define SKV_TERM_AEROSOL $(has "$2" A)"
    echo "#define SKV_TERM_DUST $(has "$2" D)"
    echo "#define SKV_TERM_OZONE $(has "$2" O)"
    echo "#define SKV_PHASE_HENYEY_GREENSTEIN $(has "$2" D)"
    echo "#define SKV_PHASE_CORNETTE_SHANKS $((1 - $(has "$2" D)))"
    echo "#define SKV_PROFILE_TABULATED 0"
    echo "#define SKV_LIGHTS_MAX 1"
}
# build TARGET BANDS LETTERS: the counting program in $W/TARGET-BANDS-LETTERS; nothing where it is new.
build() {
    local dir=$W/$1-$2-$3
    mkdir -p "$dir"
    header "$2" "$3" >"$dir/skv_config.h.new"
    if [ -f "$dir/count" ] && cmp -s "$dir/skv_config.h" "$dir/skv_config.h.new" &&
        [ -z "$(find src/core include tools/plan/count.c tools/plan/grid_rays.h tools/plan/targets.sh -newer "$dir/count" -print -quit)" ]; then return 0; fi
    mv "$dir/skv_config.h.new" "$dir/skv_config.h"
    rm -f "$dir/count" "$dir/rows"
    target_build "$1" "$dir" tools/plan/count.c count
}
# count TARGET BANDS LETTERS: `instructions line-of-count.c`, and the bytes.
count() {
    local dir=$W/$1-$2-$3
    if [ -f "$dir/rows" ] && [ "$dir/rows" -nt "$dir/count" ]; then return 0; fi
    target_count "$1" "$dir" count || return 1
    if grep -q '^failed' "$dir/lines"; then
        grep -m1 '^failed' "$dir/lines" >&2
        return 1
    fi
    {
        grep -v '^sizes' "$dir/lines" | paste -d' ' "$dir/counts" -
        echo "0 $(grep '^sizes' "$dir/lines") $(target_bytes "$1" "$dir" 'table|table_fit|table_pack|fine_fit|diffuse|grid|frame_table') $(target_bytes "$1" "$dir" none)"
    } >"$dir/rows.new"
    mv "$dir/rows.new" "$dir/rows"
}
one() { build "$@" && count "$@" || { echo "costs.sh: $*: failed" >&2; return 255; }; }
export -f one build count header has
for t in $TARGETS; do for b in 3 4; do for s in $SPECIES; do echo "$t $b $s"; done; done; done |
    xargs -P "$(nproc)" -L1 bash -c 'one "$@"' one
for t in x86-avx2 x86-sse2; do case " $TARGETS " in *" $t "*) "$W/$t-4-RAO/count" time >"$W/$t.time" ;; esac; done
for t in $ALL; do
    for b in 3 4; do for s in $SPECIES; do
        [ ! -f "$W/$t-$b-$s/rows" ] || sed "s/^/$t $b $s /" "$W/$t-$b-$s/rows"
    done; done
    [ ! -f "$W/$t.time" ] || sed "s/^/$t 4 RAO 0 /" "$W/$t.time"
done >"$W/all-rows"
python=python3 # another python3 may come before Debian's, which has python3-numpy
! /usr/bin/python3 -c 'import numpy' 2>/dev/null || python=/usr/bin/python3
$python tools/plan/costs.py "$W/all-rows" >"$W/costs_data.h"
mv "$W/costs_data.h" tools/plan/costs_data.h
