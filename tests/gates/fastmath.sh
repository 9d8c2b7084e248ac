#!/usr/bin/env bash
# Builds with other arithmetic than IEEE's are refused, or still give the same bits. gcc tells by macros, clang tells
# -ffast-math alone; what they are silent about must give the right checksum or be refused when the model is built.
. "$(dirname "$0")/lib.sh"
SOURCES="tests/bits/bits.c tests/bits/elementary.c"
refused() { ! "$1" -std=c99 -O2 "${@:2}" -Iinclude -Isrc -fsyntax-only src/core/radiance.c 2>"$G/fast.err" && grep -q '#error\|error: .*skyvert' "$G/fast.err"; }
tried=0
for cc in gcc clang arm-none-eabi-gcc; do
    have $cc || { echo "note: fastmath: $cc is not there"; continue; }
    tried=$((tried + 1))
    refused $cc -ffp-contract=off && fail "fastmath: $cc: the right flags are refused"
    flags=(-ffast-math -Ofast -ffinite-math-only)
    [ $cc = clang ] || flags+=(-funsafe-math-optimizations "-fassociative-math -fno-signed-zeros -fno-trapping-math" -freciprocal-math)
    for f in "${flags[@]}"; do
        # shellcheck disable=SC2086
        refused $cc $f || fail "fastmath: $cc $f is not refused"
    done
done
[ $tried -gt 0 ] || { echo "fastmath: no compiler"; exit 77; }

# builds CC FLAG...: the exit status of a program made with these flags: 0 it builds a model, 3 it refuses to.
builds() {
    "$1" -std=gnu99 -O2 -fno-math-errno "${@:2}" -Iinclude -Isrc tests/gates/arithmetic.c src/core/model.c src/core/column_table.c \
        src/core/presets.c -o "$G/arithmetic" 2>"$G/arithmetic.err" || { cat "$G/arithmetic.err"; return 1; }
    "$G/arithmetic"
}
# What no macro tells: contraction (the default of gcc in gnu mode, and of clang) and clang's reordering. The library
# finds out by itself at run time, or its pragmas make the flags void.
silent() {
    local cc=$1 same=1
    shift
    builds "$cc" "$@"
    local status=$?
    [ $status -eq 3 ] && { echo "note: $cc $*: refused by skv_model_build()"; return; }
    if [ $status -eq 0 ]; then
        "$cc" -std=gnu99 -O2 -fno-math-errno -DBITS_ELEMENTARY_ONLY "$@" -Iinclude -Isrc -c tests/bits/elementary.c -o "$G/fast.o" &&
            "$cc" -O2 -DBITS_ELEMENTARY_ONLY -Iinclude -Isrc tests/bits/bits.c "$G/fast.o" -o "$G/fast" && "$G/fast" >"$G/fast.txt" || return 1
        cmp -s "$G/ieee.txt" "$G/fast.txt" || same=0
        [ $same = 1 ] && { echo "note: $cc $*: same bits"; return; }
    fi
    fail "fastmath: $cc $*: other bits, and neither the compiler nor skv_model_build() refuses"
}
if [ "$(uname -m)" = x86_64 ]; then
    for cc in gcc clang; do
        have $cc || continue
        $cc -std=c99 -O2 $FP -DBITS_ELEMENTARY_ONLY -Iinclude -Isrc $SOURCES -o "$G/ieee" && "$G/ieee" >"$G/ieee.txt" || fail "fastmath: $cc: the program does not run"
        builds $cc -ffp-contract=off || fail "fastmath: $cc: refused though the flags are right"
        if grep -qw fma /proc/cpuinfo; then silent $cc -mfma -ffp-contract=fast; fi
    done
    if have clang; then
        for f in -funsafe-math-optimizations "-fassociative-math -fno-signed-zeros -fno-trapping-math" -freciprocal-math -fno-honor-nans; do
            # shellcheck disable=SC2086
            silent clang -ffp-contract=off $f
        done
    fi
fi
[ $failed -eq 0 ]
