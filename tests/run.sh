#!/usr/bin/env bash
# run.sh TEST...: runs each test program or script, shows the output of those that fail or skip, and sums up. Programs and
# scripts go side by side, one of each at a time: scripts build things, programs do not. The board's tests come last, when
# nothing else runs: they have deadlines.
# Exit status of a test: 0 = passed, 77 = skipped (its last line says what and why), anything else = failed.
set -u
export B=${B:-build}
limit=${LIMIT:-600} # seconds a test may take
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'kill $(jobs -p) 2>/dev/null; exit 130' INT TERM

# one LANE TEST: runs it, says how it went, appends `verdict test` to LANE's file.
one() {
    local log=$work/$1.log t=$2 start rc took run=("$2")
    case "$t" in *.sh) run=(bash "$t") ;; esac
    start=$(date +%s.%N)
    timeout --foreground -k 10 "$limit" "${run[@]}" >"$log" 2>&1 </dev/null
    rc=$?
    took=$(awk -v a="$start" -v b="$(date +%s.%N)" 'BEGIN{printf "%.1f", b-a}')
    case $rc in
    0) echo "pass $t" >>"$work/$1"; printf 'ok      %-40s %6s s\n' "$t" "$took" && grep -E '^(note|figure):' "$log" ;;
    77) echo "skip $t" >>"$work/$1"; printf 'SKIPPED %-40s %s\n' "$t" "$(tail -n 1 "$log")" ;;
    *) echo "fail $t" >>"$work/$1"; printf 'FAILED  %-40s %6s s (exit %s)\n%s\n' "$t" "$took" "$rc" "$(tail -n 60 "$log" | sed 's/^/    /')" ;;
    esac
}

# lane NAME TEST...: one after the other; what a test says comes out in one piece.
lane() {
    local name=$1 t
    shift
    for t in "$@"; do
        one "$name" "$t" >"$work/$name.out"
        flock "$work" cat "$work/$name.out"
    done
}

programs=() scripts=() last=()
for t in "$@"; do
    case "$t" in
    tests/rig/*.sh) last+=("$t") ;;
    *.sh) scripts+=("$t") ;;
    *) programs+=("$t") ;;
    esac
done
touch "$work/programs" "$work/scripts" "$work/last"
lane programs "${programs[@]}" &
lane scripts "${scripts[@]}" &
wait
lane last "${last[@]}"

count() { cat "$work/programs" "$work/scripts" "$work/last" | grep -c "^$1 "; }
[ "$(count fail)" -eq 0 ] || cat "$work/programs" "$work/scripts" "$work/last" | sed -n 's/^fail /failed: /p'
echo "$(count pass) passed, $(count fail) failed, $(count skip) skipped"
[ "$(count fail)" -eq 0 ] && [ "$(count pass)" -gt 0 ]
