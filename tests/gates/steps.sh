#!/usr/bin/env bash
# Instructions of the dearest step of a table's build (table.h: at most 120,000 where 8 rays go side by side; the goal was 50,000) and of whole
# builds, counted by callgrind: the library as gcc builds it by default, and scalar.
. "$(dirname "$0")/lib.sh"
[ "$(uname -m)" = x86_64 ] && have valgrind && have gcc || { echo "steps: needs an x86-64, gcc and valgrind"; exit 77; }
LIMIT=120000
# counted PROGRAM [KIND]: `name instructions` lines of its windows
counted() {
    local dir
    dir=$(mktemp -d)
    (cd "$dir" && valgrind --tool=callgrind --callgrind-out-file=cg "$@") >"$dir/out" 2>"$dir/log" || cat "$dir/log" >&2
    cat "$dir"/cg.* 2>/dev/null | awk '/^desc: Trigger: Client Request:/ { sub(/.*Request: /, ""); name = $0 }
        /^(totals|summary):/ && name != "" { print name, $2; name = "" }'
    rm -rf "$dir"
}
within() { [ -n "$2" ] && [ "$2" -le "$3" ] || { echo "steps: $1: ${2:-no} instructions, at most $3 allowed"; return 1; }; }
# measured NAME LIMIT FLAG...
measured() {
    local name=$1 limit=$2 program=$G/steps-$1 worst where kind
    shift 2
    # shellcheck disable=SC2086
    gcc -std=c99 "$@" $FP -Iinclude -Isrc tests/gates/steps.c src/core/*.c -o "$program" || { fail "steps: $name does not build"; return; }
    counted "$(realpath "$program")" >"$G/steps-$name.txt"
    read -r where worst < <(sort -k2n "$G/steps-$name.txt" | tail -n 1)
    echo "figure: a step of a table's build, $name: at most $worst instructions ($where, $(wc -l <"$G/steps-$name.txt") steps counted)"
    [ "$(wc -l <"$G/steps-$name.txt")" -gt 100 ] || fail "steps: $name: too few steps were counted"
    [ "$limit" = none ] || within "$name" "$worst" "$limit" || failed=1
    for kind in $KINDS; do
        echo "figure: a whole table, $kind, $name: $(counted "$(realpath "$program")" "$kind" | awk '{ printf "%.0f million instructions", $2 / 1e6 }')"
    done
}
KINDS="small ${STEPS_KINDS:-}" measured default $LIMIT -O3
KINDS=small measured scalar none -O2 -fno-tree-vectorize
must_fail "a dear step" within sample $((LIMIT + 1)) $LIMIT
must_fail "no step" within sample "" $LIMIT
[ $failed -eq 0 ]
