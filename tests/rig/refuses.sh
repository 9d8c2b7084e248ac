#!/usr/bin/env bash
# The rig refuses what has to be refused: tests that fail, hang, or end the board (tests/rig/bad).
set -eu
B=${B:-build}
out=$B/rig/refuses.log
export RIG_GUEST=tests/rig/bad RIG_NAME=refuses RIG_BOARDS=1
refused() {
    local want=$1
    shift
    status=0
    bash tests/rig/run.sh "$@" >"$out" 2>&1 || status=$?
    [ $status -eq 1 ] || { cat "$out"; echo "$*: exit status $status, want 1"; exit 1; }
    grep -q "$want" "$out" || { cat "$out"; echo "$*: no line '$want'"; exit 1; }
}
refused "^rig: 1 passed, 3 failed, 0 skipped" fails subshell hangs passes
refused "the board died: dies was running" dies
RIG_SECONDS=3 refused "no end within the time: boot was running" passes
