#!/usr/bin/env bash
# run.sh TEST...: runs each test program or script, shows the output of those that fail or skip, and sums up.
# Exit status of a test: 0 = passed, 77 = skipped (its last line says what and why), anything else = failed.
set -u
export B=${B:-build}
limit=${LIMIT:-600} # seconds a test may take
pass=0 fail=0 skip=0 failed=()
log=$(mktemp)
trap 'rm -f "$log"' EXIT
for t in "$@"; do
    start=$(date +%s.%N)
    run=("$t")
    case "$t" in *.sh) run=(bash "$t") ;; esac
    timeout --foreground -k 10 "$limit" "${run[@]}" >"$log" 2>&1 </dev/null
    rc=$?
    took=$(awk -v a="$start" -v b="$(date +%s.%N)" 'BEGIN{printf "%.1f", b-a}')
    case $rc in
    0) pass=$((pass + 1)); printf 'ok      %-40s %6s s\n' "$t" "$took"; grep -E '^(note|figure):' "$log" ;;
    77) skip=$((skip + 1)); printf 'SKIPPED %-40s %s\n' "$t" "$(tail -n 1 "$log")" ;;
    *) fail=$((fail + 1)); failed+=("$t"); printf 'FAILED  %-40s %6s s (exit %s)\n' "$t" "$took" "$rc"; tail -n 60 "$log" | sed 's/^/    /' ;;
    esac
done
[ $fail -eq 0 ] || printf 'failed: %s\n' "${failed[@]}"
echo "$pass passed, $fail failed, $skip skipped"
[ $fail -eq 0 ]
