#!/usr/bin/env bash
# The tests of tests/api and the demo on a Cortex-M4F with 64 KiB of RAM (QEMU mps2-an386). Needs what `make test` built.
set -u
cd "$(dirname "$0")/../.." || exit 1
B=${B:-build}
for tool in arm-none-eabi-gcc qemu-system-arm; do
    command -v $tool >/dev/null || { echo "Cortex-M4F: no $tool (Debian: gcc-arm-none-eabi libnewlib-arm-none-eabi qemu-system-arm)"; exit 77; }
done
log=$(mktemp)
trap 'rm -f "$log"' EXIT
failed=0 passed=0 skipped=0 programs=0
for source in tests/api/test_*.c; do
    name=$(basename "$source" .c) elf=$B/cortexm/m4f/api/$(basename "$source" .c).elf
    [ -f "$elf" ] || { echo "$name: $elf was not built (make cortexm)"; failed=$((failed + 1)); continue; }
    programs=$((programs + 1))
    bash port/cortexm/run.sh m4f "$elf" >"$log" 2>&1
    rc=$?
    # Figures of the host are the ones that are printed; the same tests' would only repeat them here.
    sed -e 's/^figure:/figure (cortex-m4f):/' "$log"
    passed=$((passed + $(grep -c '^\[       OK \]' "$log")))
    skipped=$((skipped + $(grep -c '^\[  SKIPPED \] [a-z_]' "$log")))
    if [ $rc -ne 0 ] || ! grep -q '^\[  PASSED  \]' "$log"; then
        echo "$name: FAILED on Cortex-M4F, exit status $rc"
        failed=$((failed + 1))
    fi
done
bash port/cortexm/run.sh m4f "$B/cortexm/m4f/demo.elf" || { echo "demo: FAILED"; failed=$((failed + 1)); }
[ $programs -gt 0 ] || { echo "no tests/api/test_*.c was there to run"; failed=1; }
echo "note: Cortex-M4F, 64 KiB RAM: $passed tests of $programs programs passed, $skipped skipped"
[ $failed -eq 0 ]
