#!/usr/bin/env bash
# The checksum over all rules, tiers, terms and functions: the same for each compiler, level, instruction set, number of
# lanes and processor. Targets whose tools are missing are named; fewer than two results are a failure.
set -u
cd "$(dirname "$0")/../.." || exit 1
B=${B:-build}
out=$B/bits/out
rm -rf "$out"
mkdir -p "$out"
failed=0 left=()
have() { command -v "$1" >/dev/null 2>&1; }
make_() { flock "$B/make.lock" env -u MAKEFLAGS -u MFLAGS -u MAKELEVEL "${MAKE:-make}" --no-print-directory -s DEPS=no B="$B" -j"$(nproc)" "$@" >"$out/make.log" 2>&1 ||
    { cat "$out/make.log"; echo "bits: building $* failed"; exit 1; }; }
# result NAME COMMAND...: runs it, keeps its lines.
result() {
    local name=$1
    shift
    "$@" >"$out/$name.txt" 2>"$out/$name.err" || { echo "bits: $name: exit status $?"; head -n 12 "$out/$name.txt" "$out/$name.err"; failed=1; }
}
cpu_has() { grep -qw "$1" /proc/cpuinfo; }

if [ "$(uname -m)" = x86_64 ] && have gcc && have clang; then
    wanted=(bits-host)
    [ "${BITS:-}" != full ] || wanted+=(bits-full)
    make_ "${wanted[@]}"
    if ! { cpu_has avx2 && cpu_has fma; }; then left+=("AVX2 variants (this processor has none)"); fi
    for name in $(env -u MAKEFLAGS -u MFLAGS -u MAKELEVEL "${MAKE:-make}" --no-print-directory -s DEPS=no B="$B" BITS_RUN="${BITS:-}" bits-names); do
        case $name in
        *avx2* | *fma* | *haswell* | *lanes[138]*) cpu_has avx2 && cpu_has fma || continue ;;
        esac
        result "$name" "$B/bits/$name/bits"
    done
else
    left+=("x86-64 variants (this is no x86-64, or gcc or clang is missing)")
fi
if have aarch64-linux-gnu-gcc && have qemu-aarch64-static; then
    make_ bits-aarch64
    result aarch64 qemu-aarch64-static "$B/bits/aarch64/bits"
    if [ "${BITS:-}" = full ]; then
        make_ bits-aarch64-full
        result aarch64-all qemu-aarch64-static "$B/bits/aarch64-all/bits"
    fi
else
    left+=("aarch64 (packages gcc-aarch64-linux-gnu libc6-dev-arm64-cross qemu-user-static)")
fi
if have arm-none-eabi-gcc && have qemu-system-arm; then
    boards=(m4f)
    make_ bits-boards
    if [ "${BITS:-}" = full ]; then make_ bits-boards-full && boards+=(m3 m7); fi
    for board in "${boards[@]}"; do
        result cortex-$board bash port/cortexm/run.sh $board "$B/cortexm/$board/bits/bits.elf"
    done
else
    left+=("Cortex-M (packages gcc-arm-none-eabi libnewlib-arm-none-eabi qemu-system-arm)")
fi

# same FILE...: every file's line of a part must be the first one's.
same() {
    awk 'FNR == 1 { name = FILENAME; sub(/.*\//, "", name); sub(/\.txt$/, "", name) }
         NF != 2 { next }
         !($1 in want) { want[$1] = $2; by[$1] = name }
         want[$1] != $2 { printf "bits: %s: %s is %s, but %s of %s\n", $1, name, $2, want[$1], by[$1]; bad = 1 }
         END { exit bad }' "$@"
}
same "$out"/*.txt || failed=1
n=$(find "$out" -name '*.txt' -size +0 | wc -l)
[ "$n" -ge 2 ] || { echo "bits: fewer than two results to compare"; failed=1; }
for f in "$out"/*.txt; do
    grep -q '^small ' "$f" || { echo "bits: $f has no checksum"; failed=1; }
    case $f in *cortex* | *aarch64.txt) ;; *) grep -q '^all ' "$f" || { echo "bits: $f is not whole"; failed=1; } ;; esac
done

# What a host may have set: all values stay finite and not negative; flush-to-zero changes no value above 1e-29.
if [ -f "$out/clang-O3.txt" ]; then
    for mode in "--flush" "--round up" "--round down" "--round zero" "--flush --round zero"; do
        # shellcheck disable=SC2086
        "$B/bits/clang-O3/bits" $mode >"$out/mode.log" || { echo "bits $mode: a value was wrong"; grep -B1 '^. wrong' "$out/mode.log"; failed=1; }
    done
    # (but for the angle of two subnormal numbers, in the part trig)
    "$B/bits/clang-O3/bits" --tiny-is-zero | grep -v '^[a-z]* \|trig' >"$out/tiny.log"
    "$B/bits/clang-O3/bits" --tiny-is-zero --flush | grep -v '^[a-z]* \|trig' >"$out/flushed.log"
    same "$out/tiny.log" "$out/flushed.log" || { echo "bits: flush-to-zero changes values above 1e-29"; failed=1; }
fi
if [ ${#left[@]} -gt 0 ]; then printf 'note: bits: left out: %s\n' "${left[@]}"; fi
# Proof that the comparison can fail: the elementary functions alone, built with contraction on.
if [ -f "$out/gcc-O3-fma.txt" ]; then
    gcc -std=c99 -O2 -march=haswell -fno-math-errno -ffp-contract=fast -DBITS_ELEMENTARY_ONLY -Iinclude -Isrc tests/bits/bits.c \
        tests/bits/elementary.c -o "$B/bits/contracted" && "$B/bits/contracted" >"$out/contracted" || failed=1
    ! same "$out/gcc-O3-fma.txt" "$out/contracted" >/dev/null || { echo "bits: contraction was not noticed"; failed=1; }
fi
echo "note: bits: $n builds, checksum $(awk '$1 == "all" { print $2; exit }' "$out"/*.txt) (small selection $(awk '$1 == "small" { print $2; exit }' "$out"/*.txt))"
[ $failed -eq 0 ]
