#!/usr/bin/env bash
# The random and batch tests under the address and undefined-behaviour sanitizers; divisions by zero, which IEEE defines,
# are listed: they would stop a host that has floating-point traps on.
set -eu
CC=${SANITIZE_CC:-gcc}
command -v "$CC" >/dev/null || { echo "the sanitizer build needs $CC"; exit 77; }
san="-fsanitize=address,undefined,float-divide-by-zero,float-cast-overflow -fno-sanitize-recover=address,undefined"
s="$B/sanitized"
# -O0: optimising instrumented code takes minutes.
${MAKE:-make} --no-print-directory -s -j"$(nproc)" DEPS=no B="$s" CC="$CC" OPT=-O0 WARN=-w SAN="$san" "$s/tests/property/test_random" \
    "$s/tests/property/test_batch"
log=$(mktemp)
trap 'rm -f "$log"' EXIT
for t in random batch; do
    SKV_TEST_SHORT=1 "$s/tests/property/test_$t" >"$log" 2>&1 || { cat "$log"; exit 1; }
    grep -E '^figure:' "$log" || true
    grep -E 'runtime error: division by zero' "$log" | sort -u | sed 's/^/note: /' || true
done
