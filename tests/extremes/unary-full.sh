#!/usr/bin/env bash
# All 2^32 floats through each of the unary functions: some minutes a function.
set -u
cd "$(dirname "$0")/../.." || exit 1
B=${B:-build}
failed=0
for f in skv_exp2f skv_log2f skv_erfcxf skv_sinf skv_cosf skv_acosf; do
    "$B/tests/extremes/unary" all $f >"$B/tests/extremes/unary-$f.txt" 2>&1 || failed=1
    grep -E '^(figure|ERROR):?' "$B/tests/extremes/unary-$f.txt"
done
exit $failed
