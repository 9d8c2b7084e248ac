#!/usr/bin/env bash
# run.sh TEST...: runs each test program or script, shows the output of those that fail or skip, and sums up. As many go side by
# side as there are processors, four at most (JOBS), the scripts first: they take longer. The board's tests come last, when nothing else runs:
# they have deadlines.
# Exit status of a test: 0 = passed, 77 = skipped (its last line says what and why), anything else = failed.
set -u
export B=${B:-build}
limit=${LIMIT:-600} # seconds a test may take

# one WORK TEST: runs it, says in one piece how it went, and appends `verdict test` to WORK/verdicts.
one() {
    local work=$1 t=$2 log start rc took run=("$2") text
    log=$(mktemp "$work/log.XXXXXX")
    case "$t" in *.sh) run=(bash "$t") ;; esac
    start=$(date +%s.%N)
    timeout --foreground -k 10 "$limit" "${run[@]}" >"$log" 2>&1 </dev/null
    rc=$?
    took=$(awk -v a="$start" -v b="$(date +%s.%N)" 'BEGIN{printf "%.1f", b-a}')
    case $rc in
    0) verdict=pass text=$(printf 'ok      %-40s %6s s' "$t" "$took"; grep -E '^(note|figure):' "$log" | sed '1s/^/\n/') ;;
    77) verdict=skip text=$(printf 'SKIPPED %-40s %s' "$t" "$(tail -n 1 "$log")") ;;
    *) verdict=fail text=$(printf 'FAILED  %-40s %6s s (exit %s)\n%s' "$t" "$took" "$rc" "$(tail -n 60 "$log" | sed 's/^/    /')") ;;
    esac
    flock "$work" bash -c 'echo "$1"; echo "$2" >>"$3"' one "$text" "$verdict $t" "$work/verdicts"
}

if [ "${1:-}" = --one ]; then
    one "$2" "$3"
    exit 0
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 130' INT TERM
programs=() scripts=() last=()
for t in "$@"; do
    case "$t" in
    tests/rig/*.sh) last+=("$t") ;;
    *.sh) scripts+=("$t") ;;
    *) programs+=("$t") ;;
    esac
done
touch "$work/verdicts"
# side_by_side JOBS TEST...
side_by_side() {
    local jobs=$1
    shift
    [ $# -eq 0 ] || printf '%s\0' "$@" | xargs -0 -n 1 -P "$jobs" bash "$0" --one "$work"
}
cores=$(nproc)
side_by_side "${JOBS:-$((cores < 4 ? cores : 4))}" "${scripts[@]}" "${programs[@]}"
side_by_side 1 "${last[@]}"

count() { grep -c "^$1 " "$work/verdicts"; }
sed -n 's/^fail /failed: /p' "$work/verdicts"
echo "$(count pass) passed, $(count fail) failed, $(count skip) skipped"
[ "$(count fail)" -eq 0 ] && [ "$(count pass)" -gt 0 ]
