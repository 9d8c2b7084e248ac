# Helpers of the command's tests: run, compare, count. Sourced.
set -u
B=${B:-build}
skyvert=$(readlink -f "$B/skyvert")
[ -x "$skyvert" ] || { echo "FAILED: there is no $B/skyvert" && exit 1; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
bad=0 cases=0

# fails CASE WHAT...: notes a failed case and shows what the program gave.
fails() {
    bad=$((bad + 1))
    [ $bad -le 20 ] || return
    echo "FAILED $1: ${*:2}"
    echo "  status: $status"
    sed 's/^/  stdout: /' "$work/stdout" | head -n 5
    sed 's/^/  stderr: /' "$work/stderr" | head -n 5
}

# run INPUT COMMAND...: runs it on the file INPUT.
run() {
    status=0
    "${@:2}" <"$1" >"$work/stdout" 2>"$work/stderr" || status=$?
    cases=$((cases + 1))
}

# refuses CASE STATUS PATTERN INPUT COMMAND...: that status, no output, and on stderr one line that fits the pattern.
refuses() {
    run "$4" "${@:5}"
    [ $status -eq "$2" ] || fails "$1" "want status $2"
    [ ! -s "$work/stdout" ] || fails "$1" "want no output"
    [ "$(wc -l <"$work/stderr")" -eq 1 ] || fails "$1" "want one line on stderr"
    grep -Eq -- "$3" "$work/stderr" || fails "$1" "want a line like: $3"
}

# does CASE INPUT COMMAND...: status 0, something on stdout, nothing on stderr.
does() {
    run "$2" "${@:3}"
    [ $status -eq 0 ] || fails "$1" "want status 0"
    [ -s "$work/stdout" ] || fails "$1" "want output"
    [ ! -s "$work/stderr" ] || fails "$1" "want nothing on stderr"
}

# same CASE GOT WANT: two texts.
same() {
    cases=$((cases + 1))
    [ "$2" = "$3" ] && return
    bad=$((bad + 1))
    [ $bad -le 20 ] || return
    head -c 500 <<<"FAILED $1: got: $2"
    head -c 500 <<<"  want: $3"
}

finish() {
    echo "figure: $(basename "$0"): $cases cases, $bad failed"
    [ $bad -eq 0 ]
}
