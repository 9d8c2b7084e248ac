#!/usr/bin/env bash
# extremes.sh [print]: runs the programs of this folder, puts their lines together to the table, and compares it with the
# one that README.md keeps between its markers (numbers within 10 %; those of the naive program, which
# any other libm changes, are not compared). With "print" the table is printed and
# README is left alone. EXTREMES_FULL=1: all sweeps.
set -u
cd "$(dirname "$0")/../.." || exit 1
B=${B:-build}
out=$B/tests/extremes
begin='<!-- extremes: make extremes -->' end='<!-- /extremes -->'
what=${1:-check}
failed=0
rows=$out/rows.txt
: >"$rows"
for p in points continuity weather light monotone unary; do
    if ! "$out/$p" >"$out/$p.txt" 2>&1; then
        failed=1
        grep -vE '^(\[|row:)' "$out/$p.txt"
    else
        grep -E '^(figure|note):' "$out/$p.txt"
    fi
    grep -E '^row:' "$out/$p.txt" >>"$rows"
done

# What the headers do with -ffast-math; tests/gates/fastmath.sh tries the other flags.
refused=no
if ! ${CC:-cc} -std=c99 -O2 -ffast-math -Iinclude -Isrc -fsyntax-only src/core/radiance.c 2>"$out/fast.txt" && grep -q '#error' "$out/fast.txt"; then
    refused=yes
fi
[ $refused = yes ] || { echo "extremes: -ffast-math is not refused"; failed=1; }
echo "row: 16 | a build with -ffast-math | inf and NaN tests are dropped | refused by the headers | - |" >>"$rows"

{
    echo '| input | naive float | **ours** | double |'
    echo '|---|---|---|---|'
    sort "$rows" | sed -E 's/^row: [0-9]+ //'
} >"$out/table.md"
if [ "$what" = print ]; then
    cat "$out/table.md"
    exit $failed
fi

awk -v b="$begin" -v e="$end" '$0 == e {p = 0} p {print} $0 == b {p = 1}' README.md >"$out/readme.md"
if [ ! -s "$out/readme.md" ]; then
    echo "extremes: README.md has no table between '$begin' and '$end'; make extremes prints it"
    exit 1
fi
# Words must be the same, numbers nearly.
awk '
function judged(s,   cell) { split(s, cell, "|"); return cell[2] "|" cell[4] "|" cell[5] } # naive: any libm
function words(s) { gsub(/[-+]?[0-9]*\.?[0-9]+([eE][-+]?[0-9]+)?/, "#", s); return s }
function numbers(s, to,   n) {
    n = 0
    while (match(s, /[-+]?[0-9]*\.?[0-9]+([eE][-+]?[0-9]+)?/)) {
        to[++n] = substr(s, RSTART, RLENGTH) + 0
        s = substr(s, RSTART + RLENGTH)
    }
    return n
}
NR == FNR { want[FNR] = $0; n = FNR; next }
{ got[FNR] = $0; m = FNR }
END {
    bad = n != m
    for (i = 1; i <= m && i <= n; i++) {
        a = judged(want[i]); b = judged(got[i])
        same = words(a) == words(b)
        k = numbers(a, x); numbers(b, y)
        for (j = 1; same && j <= k; j++) {
            d = x[j] - y[j]; d = d < 0 ? -d : d
            s = x[j] < 0 ? -x[j] : x[j]
            if (d > 0.1 * s + 1e-7 * (s < 1e-6 ? 0 : 1)) same = 0
        }
        if (!same) { bad = 1; print "README: " want[i]; print "   now: " got[i] }
    }
    exit bad
}' "$out/readme.md" "$out/table.md" || { echo "extremes: README.md's table is not what make extremes prints: replace it"; failed=1; }
exit $failed
