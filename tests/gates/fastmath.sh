#!/usr/bin/env bash
# Builds with other arithmetic than IEEE's are refused, or still give the same bits. gcc tells by macros; clang tells
# -ffast-math alone, so what it is silent about is tried: the elementary functions must then have the right checksum.
. "$(dirname "$0")/lib.sh"
SOURCES="tests/bits/bits.c tests/bits/elementary.c"
program() { "$1" -std=c99 -O2 -fno-math-errno -DBITS_ELEMENTARY_ONLY "${@:3}" -Iinclude -Isrc $SOURCES -o "$2" 2>"$2.err"; }
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
if have clang; then
    program clang "$G/ieee" -ffp-contract=off && "$G/ieee" >"$G/ieee.txt" || fail "fastmath: clang: the program does not run"
    for f in -funsafe-math-optimizations "-fassociative-math -fno-signed-zeros -fno-trapping-math" -freciprocal-math -fno-honor-nans -ffp-contract=on; do
        # shellcheck disable=SC2086
        if refused clang $f; then
            echo "note: clang $f: refused"
        elif program clang "$G/fast" $f && "$G/fast" >"$G/fast.txt" && cmp -s "$G/ieee.txt" "$G/fast.txt"; then
            echo "note: clang $f: not refused, same bits"
        else
            echo "note: clang $f: cannot be noticed at compile time and changes bits: see tests/bits"
        fi
    done
fi
[ $failed -eq 0 ]
