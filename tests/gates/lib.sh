# shellcheck shell=bash disable=SC2034
# Shared by the gates: where things are, and `must_fail`, the proof that a gate can fail. Sourced, not run.
set -u
cd "$(dirname "${BASH_SOURCE[0]}")/../.." || exit 1
B=${B:-build}
G=$B/gates
mkdir -p "$G"
failed=0
have() { command -v "$1" >/dev/null 2>&1; }
fail() { echo "$*"; failed=1; }
# quiet_make TARGET...: builds, one script at a time; says what make said when it fails.
quiet_make() {
    local log=$G/make.$$.log
    if ! flock "$B/make.lock" env -u MAKEFLAGS -u MFLAGS -u MAKELEVEL "${MAKE:-make}" --no-print-directory -s DEPS=no B="$B" -j"$(nproc)" "$@" >"$log" 2>&1; then
        cat "$log"
        rm -f "$log"
        echo "building failed: $*"
        exit 1
    fi
    rm -f "$log"
}
# must_fail WHAT COMMAND...: the sample has to be refused.
must_fail() {
    local what=$1
    shift
    if "$@" >/dev/null 2>&1; then fail "the gate did not notice: $what"; fi
}
FP="-ffp-contract=off -fno-math-errno -fno-trapping-math"
ARM="-mcpu=cortex-m4 -mthumb -mfloat-abi=hard -mfpu=fpv4-sp-d16"
