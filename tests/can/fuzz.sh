#!/usr/bin/env bash
# The decoder under address and undefined-behaviour sanitizers: 100,000 random frames, then libFuzzer for a few seconds.
set -u
B=${B:-build}
job=$B/can-fuzz
mkdir -p "$job/corpus"
command -v clang >/dev/null || { echo "fuzzing the CAN decoder: no package clang"; exit 77; }
flags=(-std=c99 -g -O1 -fno-omit-frame-pointer -fsanitize=address,undefined -fno-sanitize-recover=all -Wall -Wextra -Werror -Iinclude -I.)
clang "${flags[@]}" tests/can/fuzz.c port/canaerospace/*.c -o "$job/fuzz" || exit 1
"$job/fuzz" "${CAN_FUZZ_FRAMES:-100000}" 2026 || exit 1
clang "${flags[@]}" -fsanitize=fuzzer -DSKV_LIBFUZZER tests/can/fuzz.c port/canaerospace/*.c -o "$job/libfuzzer" || exit 1
"$job/libfuzzer" -seed=1 -max_len=256 -runs=20000 -max_total_time=10 "$job/corpus" >"$job/log" 2>&1 || { tail -30 "$job/log"; exit 1; }
sed -n 's/^#\([0-9]*\)\tDONE *cov: \([0-9]*\).*/figure: libFuzzer: \1 inputs, \2 edges/p' "$job/log"
# The check can fail: a decoder that lets NaN through is caught.
sed 's/if (!(value - value == 0.0))/if (0)/; s/if (!(value >= (double)info->low/if (0 \&\& !(value >= (double)info->low/' port/canaerospace/receive.c >"$job/receive.c"
clang "${flags[@]}" -Iport/canaerospace tests/can/fuzz.c "$job/receive.c" $(ls port/canaerospace/*.c | grep -v /receive.c) -o "$job/broken" || exit 1
{ "$job/broken" 10000 1; } >/dev/null 2>&1 && { echo "a decoder that lets anything through passed"; exit 1; }
exit 0
