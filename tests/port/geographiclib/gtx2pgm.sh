#!/usr/bin/env bash
# gtx2pgm refuses what is no global grid, in one line with status 2, and leaves nothing behind; a failed write is status 1.
set -u
tool=$B/tools/geoid/gtx2pgm
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
failed=0

# expect STATUS WORDS COMMAND...
expect() {
    local want=$1 words=$2 line rc
    shift 2
    line=$("$@" 2>&1 >"$dir/stdout")
    rc=$?
    if [ $rc -ne "$want" ] || [ "$(printf '%s\n' "$line" | wc -l)" -ne 1 ] || [[ $line != *"$words"* ]] || [ -s "$dir/stdout" ]; then
        echo "$*: got status $rc '$line', want $want '$words'"
        failed=1
    fi
    if ls "$dir/out"* >/dev/null 2>&1; then
        echo "$*: left something behind"
        rm -rf "$dir"/out*
        failed=1
    fi
}

# grid SOUTH WEST STEP ROWS COLUMNS VALUE: a small GTX of one value
grid() {
    perl -e '($s, $w, $d, $r, $c, $v) = @ARGV; print pack("d>d>d>d>l>l>", $s, $w, $d, $d, $r, $c), pack("f>", $v) x ($r * $c)' -- "$@"
}

expect 2 usage "$tool"
expect 2 usage "$tool" one
expect 2 "No such file" "$tool" "$dir/none" "$dir/out.pgm"
: >"$dir/empty"
expect 2 "shorter than" "$tool" "$dir/empty" "$dir/out.pgm"
head -c 100 /dev/zero >"$dir/zeros"
expect 2 "no GTX header" "$tool" "$dir/zeros" "$dir/out.pgm"
grid -90 -180 45 5 8 1 >"$dir/good"
head -c 190 "$dir/good" >"$dir/short"
expect 2 "cut short" "$tool" "$dir/short" "$dir/out.pgm"
{ cat "$dir/good"; echo; } >"$dir/long"
expect 2 "after its last row" "$tool" "$dir/long" "$dir/out.pgm"
grid -45 -180 45 5 8 1 >"$dir/region"
expect 2 "pole to pole" "$tool" "$dir/region" "$dir/out.pgm"
grid -90 -180 45 5 6 1 >"$dir/gap"
expect 2 "around the Earth" "$tool" "$dir/gap" "$dir/out.pgm"
grid -90 -170 45 5 8 1 >"$dir/offset"
expect 2 "longitude 0" "$tool" "$dir/offset" "$dir/out.pgm"
grid -90 -180 45 5 8 nan >"$dir/nan"
expect 2 "missing values" "$tool" "$dir/nan" "$dir/out.pgm"
grid -90 -180 45 5 8 -88.8888 >"$dir/missing"
expect 2 "missing values" "$tool" "$dir/missing" "$dir/out.pgm"
grid -90 -180 45 5 8 100 >"$dir/high"
expect 2 "outside -108 to 88.6" "$tool" "$dir/high" "$dir/out.pgm"
grid nan -180 45 5 8 1 >"$dir/nanpole"
expect 2 "pole to pole" "$tool" "$dir/nanpole" "$dir/out.pgm"
grid -90 nan 45 5 8 1 >"$dir/nanwest"
expect 2 "longitude 0" "$tool" "$dir/nanwest" "$dir/out.pgm"
expect 1 "No such file" "$tool" "$dir/good" "$dir/none/out.pgm"
"$tool" "$dir/good" "$dir/fine.pgm" || failed=1
[ "$(ls "$dir" | grep -c fine)" = 1 ] || failed=1
exit $failed
