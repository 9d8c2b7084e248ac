#!/usr/bin/env bash
# lint.sh: everything that can be said about the sources without building them. Each check is proved on bad/: files that it
# must refuse. Arguments: the checks to run (format includes poison paths length scripts analyse); none = all.
set -u
cd "$(dirname "$0")/../.." || exit 1
B=${B:-build}
L=tools/lint
failed=0
fail() { echo "$*"; failed=1; }
# Files that are there, in git or not yet; build folders never.
files() { find src include port tests tools -type f \( "$@" \) -not -path '*/lint/bad/*' -not -path '*/gates/bad/*' | sort; }
c_files() { files -name '*.c' -o -name '*.h' -o -name '*.cc' -o -name '*.hpp'; }
# refuses WHAT COMMAND...: the proof that a check can fail.
refuses() {
    local what=$1
    shift
    if "$@" >/dev/null 2>&1; then fail "lint: the check did not notice $what"; fi
}

format() { clang-format --dry-run -Werror "$@"; }
check_format() {
    command -v clang-format >/dev/null || { echo "note: lint: formatting left out (package clang-format)"; return; }
    local bad
    bad=$(c_files | xargs clang-format --dry-run -Werror 2>&1 | awk -F: '/error:/ { print $1 }' | sort -u)
    [ -z "$bad" ] || fail "lint: clang-format -i puts these right (make format):"$'\n'"$bad"
    refuses "an ill-formatted file" format $L/bad/format.c
}

includes() { awk -f $L/includes.awk "$@"; }
check_includes() {
    # shellcheck disable=SC2046
    includes $(c_files) || fail "lint: who includes what: see tools/lint/includes.awk"
    for sample in $L/bad/includes/*/*/*; do refuses "$sample" includes "$sample"; done
}

poison() { awk -f $L/poison.awk "$@"; }
check_poison() {
    # shellcheck disable=SC2046
    poison $(files -path 'src/*.[ch]' -o -path 'include/*.h') || fail "lint: the core does without these: see tools/lint/poison.awk"
    for sample in $L/bad/poison/*; do refuses "$sample" poison "$sample"; done
}

# Nothing may name a place of one machine (a template of mkdtemp is none). The patterns do not match themselves.
paths() { ! grep -nE '(^|[^A-Za-z0-9_.{}$-])/(hom[e]/[a-z]|roo[t]/|wor[k]/|tm[p]/[A-Za-z])' "$@" | grep -v XXXXXX; }
check_paths() {
    # shellcheck disable=SC2046
    paths Makefile $(ls README.md CHANGELOG.md 2>/dev/null) $(files -name '*') || fail "lint: a path of one machine"
    printf 'FILE *f = fopen("/%s/me/sky.exr", "r");\n' home >"$B/lint-path.c"
    refuses "a path of one machine" paths "$B/lint-path.c"
    rm -f "$B/lint-path.c"
}

# At most 600 lines, but for tables and data that a program wrote (their first lines say so).
too_long() {
    local f rc=0
    for f in "$@"; do
        if [ "$(wc -l <"$f")" -gt 600 ] && ! head -n 3 "$f" | grep -qiE 'generated|made by|written by'; then echo "$f: $(wc -l <"$f") lines"; rc=1; fi
    done
    return $rc
}
check_length() {
    # shellcheck disable=SC2046
    too_long $(c_files) $(files -name '*.sh' -o -name '*.awk' -o -name '*.mk' -o -name '*.py') || fail "lint: more than 600 lines: split it"
    seq 601 >"$B/lint-long.c"
    refuses "a long file" too_long "$B/lint-long.c"
    rm -f "$B/lint-long.c"
}

check_scripts() {
    files -name '*.sh' | while read -r f; do bash -n "$f" || echo "$f" >>"$B/lint-scripts"; done
    if [ -s "$B/lint-scripts" ]; then fail "lint: scripts that bash cannot read: $(tr '\n' ' ' <"$B/lint-scripts")"; fi
    rm -f "$B/lint-scripts"
}

# cppcheck looks at what changed since it last found nothing (its build folder), so a second run is quick.
analyse() {
    cppcheck --quiet --std=c99 --enable=warning,portability,performance --inline-suppr --suppressions-list=$L/cppcheck.txt \
        --error-exitcode=1 -Iinclude -Isrc -D__x86_64__ -D__GNUC__=12 "$@"
}
tidy() { clang-tidy --quiet "$@" -- -std=c99 -Iinclude -Isrc 2>/dev/null; }
check_analyse() {
    if command -v cppcheck >/dev/null; then
        mkdir -p "$B/cppcheck"
        # shellcheck disable=SC2046
        analyse --cppcheck-build-dir="$B/cppcheck" -j"$(nproc)" --max-configs=1 $(files -path 'src/*.c' -o -path 'tools/*.c' -o -path 'port/*.c') || fail "lint: cppcheck"
        refuses "a read past an array (cppcheck)" analyse $L/bad/analyse.c
    else
        echo "note: lint: cppcheck left out (package cppcheck)"
    fi
    if command -v clang-tidy >/dev/null; then
        tidy_changed || fail "lint: clang-tidy"
        refuses "a read past an array (clang-tidy)" tidy --warnings-as-errors='*' $L/bad/tidy.c
    else
        echo "note: lint: clang-tidy left out (package clang-tidy)"
    fi
}
# clang-tidy on the core's sources that are newer than their last clean run.
tidy_changed() {
    local newest f stamp todo=()
    mkdir -p "$B/tidy"
    newest=$(find src include .clang-tidy -name '*.h' -o -name .clang-tidy | xargs ls -t | head -n 1)
    for f in $(files -path 'src/*.c'); do
        stamp=$B/tidy/$(echo "$f" | tr / _)
        [ "$stamp" -nt "$f" ] && [ "$stamp" -nt "$newest" ] || todo+=("$f")
    done
    [ ${#todo[@]} -eq 0 ] && return 0
    printf '%s\n' "${todo[@]}" | xargs -P "$(nproc)" -n 1 bash -c \
        'out=$(clang-tidy --quiet --warnings-as-errors="*" "$1" -- -std=c99 -Iinclude -Isrc 2>/dev/null) && touch "$0/tidy/$(echo "$1" | tr / _)" || { echo "$out"; exit 1; }' "$B"
}

mkdir -p "$B"
for check in ${*:-format includes poison paths length scripts analyse}; do "check_$check"; done
[ $failed -eq 0 ] && echo "note: lint: clean"
exit $failed
