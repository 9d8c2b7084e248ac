# Helpers of the picture tests. Sourced.
. tests/command/lib.sh
here=tests/picture

# works CASE COMMAND...: status 0 and nothing on stderr.
works() {
    run /dev/null "${@:2}"
    [ $status -eq 0 ] || fails "$1" "want status 0"
    [ ! -s "$work/stderr" ] || fails "$1" "want nothing on stderr"
}

# near CASE GOT WANT TOLERANCE: numbers.
near() {
    cases=$((cases + 1))
    awk -v g="$2" -v w="$3" -v t="$4" 'BEGIN { d = g - w; if (d < 0) d = -d; exit !(g != "" && d <= t) }' && return
    bad=$((bad + 1))
    echo "FAILED $1: got $2, want $3, tolerance $4"
}

# has CASE TEXT LINE: a text contains a line or part of one.
has() {
    cases=$((cases + 1))
    grep -qF -- "$3" <<<"$2" && return
    bad=$((bad + 1))
    echo "FAILED $1: want '$3' in:"
    head -n 40 <<<"$2" | sed 's/^/  /'
}

# leaves CASE FOLDER NAME...: exactly these files are there.
leaves() { same "$1" "$(ls -A "$2" | sort | tr '\n' ' ')" "$([ $# -gt 2 ] && printf '%s\n' "${@:3}" | sort | tr '\n' ' ')"; }
