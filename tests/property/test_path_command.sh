#!/usr/bin/env bash
# skyvert-reference --orders all: its answers' form, bad options, the same bytes for any number of threads, Ctrl-C.
set -u
B=${B:-build}
ref=$B/skyvert-reference
[ -x "$ref" ] || { echo "test_path_command: no $ref (Debian: libinih-dev)"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "$*"; exit 1; }
air=tools/bench/br16.ini
head4=altitude_km,sun_zenith_deg,view_zenith_deg,rel_azimuth_deg
printf '%s\n0,30,60,40\n2,75,89,10\n\n10,91,100,120\n' $head4 >"$work/rays"

"$ref" --orders all --target-error 2% --threads 1 --atmosphere $air <"$work/rays" >"$work/one" || fail "exit status $? of a good job"
"$ref" --orders all --target-error 0.02 --threads 2 --atmosphere $air <"$work/rays" >"$work/two" || fail "exit status $? of two threads"
cmp "$work/one" "$work/two" || fail "1 and 2 threads differ"
[ "$(head -1 "$work/one")" = $head4,L_440,L_520,L_600,L_680,E_440,E_520,E_600,E_680 ] || fail "header: $(head -1 "$work/one")"
awk -F, 'NR > 1 && !(NF == 12 && $5 > 0 && $9 > 0 && $9 <= .02 * $5 && $12 <= .02 * $8) { print "row " NR ": " $0; bad = 1 }
    END { exit bad || NR != 4 }' "$work/one" || fail "rows are wrong"
# More light than single scattering alone.
"$ref" --atmosphere $air <"$work/rays" >"$work/single" || fail "exit status $? of single"
paste -d, "$work/one" "$work/single" | awk -F, 'NR > 1 && !($5 > $17) { exit 1 }' || fail "not more light than single scattering"

bad() { # bad TEXT OPTION...: exit status 2, TEXT on stderr, nothing on stdout
    local text=$1
    shift
    "$ref" "$@" <"$work/rays" >"$work/out" 2>"$work/err"
    local status=$?
    [ $status -eq 2 ] || fail "$*: exit status $status, want 2"
    [ ! -s "$work/out" ] || fail "$*: wrote to stdout"
    grep -q -e "$text" "$work/err" || fail "$*: no '$text' in: $(cat "$work/err")"
}
bad 'orders two: single or all' --orders two --atmosphere $air
bad 'ground wet: none or lit' --ground wet --atmosphere $air
for x in 0 -1% 101% 3x % nan inf; do bad "target-error $x: 0.0001% to 100%" --target-error $x --atmosphere $air; done
for x in 0 63 1e6 -5 ten ''; do bad 'a whole number, 64 to' --max-paths "$x" --atmosphere $air; done
for x in 0 257 two; do bad 'a whole number, 1 to 256' --threads $x --atmosphere $air; done
bad 'a whole number, 0 to' --seed -1 --atmosphere $air
bad 'ground-km' --ground-km 60 --atmosphere $air
bad usage --atmosphere $air more
bad usage --orders all
bad 'absent.ini' --orders all --atmosphere "$work/absent.ini"
echo '1,2,3' >>"$work/rays"
bad 'stdin:6: four finite numbers' --orders all --atmosphere $air
printf 'altitude_km,altitude_km,sun_zenith_deg,view_zenith_deg\n' >"$work/rays"
bad 'stdin:1: the header' --orders all --atmosphere $air

# Ctrl-C keeps what is done; the same command goes on and ends as if nothing had been.
printf '%s\n0,30,60,40\n2,75,89,10\n10,91,100,120\n' $head4 >"$work/rays"
job=("$ref" --orders all --target-error 0.0001% --max-paths 6400 --atmosphere $air --ground lit)
"${job[@]}" <"$work/rays" >"$work/whole" || fail "exit status $? of the whole job"
sh -c 'trap - INT; exec "$@"' sh "${job[@]}" --threads 1 --max-paths 100000000 --state "$work/state" <"$work/rays" >"$work/part" 2>"$work/err" &
pid=$!
for _ in $(seq 600); do [ -s "$work/state" ] && break; sleep .1; done # it is written when the work starts
sleep 1
kill -TERM $pid
wait $pid
status=$?
[ $status -eq 1 ] || fail "interrupted: exit status $status, want 1: $(cat "$work/err")"
[ ! -s "$work/part" ] || fail "interrupted: wrote answers"
grep -q 'interrupted with 0 of 3 rays done; the same command goes on' "$work/err" || fail "interrupted: $(cat "$work/err")"
[ -s "$work/state" ] || fail "interrupted: no state"
"${job[@]}" --state "$work/state" <"$work/rays" >"$work/resumed" || fail "exit status $? of the resumed job"
sed 2d "$work/whole" >"$work/want"
sed 2d "$work/resumed" | cmp - "$work/want" || fail "rays differ after the interruption"
# The first ray had more paths by then than the job asks for: as if that had been asked.
paths=$(awk '$1 == 0 { print $2 * 64 }' "$work/state")
"${job[@]}" --max-paths "$paths" <<<"$(sed -n 1,2p "$work/rays")" | cmp - <(sed -n 1,2p "$work/resumed") || fail "the first ray differs"
echo "ok"
