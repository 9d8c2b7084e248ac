#!/usr/bin/env bash
# Queries and answers of `skyvert eval`: every form of CSV, every bad row, the options, the numbers' meaning.
cd "$(dirname "$0")" && here=$PWD && cd - >/dev/null
. "$here/lib.sh"
cp "$here/air.ini" "$work/air.ini"
cd "$work" || exit 1
head=altitude_km,sun_zenith_deg,view_zenith_deg,rel_azimuth_deg
lit() { "$skyvert" eval --orders single --atmosphere air.ini "$@"; }
# text TEXT: as a file in.csv (printf escapes)
text() { printf "$1" >in.csv; }
text "$head\n1,60,50,30\n0,85,80.5,-200\n"
run in.csv lit
case $(cat stderr) in *libinih*) echo "skipped: this build lacks libinih (package libinih-dev)" && exit 77 ;; esac
does base in.csv lit
cp stdout base.csv
same 'header' "$(head -n 1 base.csv)" "$head,L_440,L_520.5,L_600,L_680"
same 'number of lines' "$(wc -l <base.csv)" 3
same 'queries come back as written' "$(cut -d, -f1-4 base.csv)" "$(cat in.csv)"

# form CASE TEXT: the same answers
form() {
    text "$2"
    does "$1" in.csv lit
    same "$1: answers" "$(cat stdout)" "$(cat base.csv)"
}
form 'CRLF' "$head\r\n1,60,50,30\r\n0,85,80.5,-200\r\n"
form 'no newline at the end' "$head\n1,60,50,30\n0,85,80.5,-200"
form 'byte order mark' "\xef\xbb\xbf$head\n1,60,50,30\n0,85,80.5,-200\n"
form 'blank lines' "\n$head\n\n  \n1,60,50,30\n\r\n0,85,80.5,-200\n\n"
form 'quotes' "\"altitude_km\",\"sun_zenith_deg\",view_zenith_deg,\"rel_azimuth_deg\"\n\"1\",60,\"50\",30\n0,85,80.5,\"-200\"\n"
form 'blanks' " altitude_km , sun_zenith_deg,view_zenith_deg\t, rel_azimuth_deg \n 1 , 60 ,50, 30\n0,85,80.5,-200 \n"
form 'trailing commas' "$head\n1,60,50,30,\n0,85,80.5,-200,,\n"
form 'columns in another order, further ones' "note,rel_azimuth_deg,view_zenith_deg,id,sun_zenith_deg,altitude_km\n\"a, \"\"b\"\"\n\",30,50,7,60,1\n,-200,80.5,nan,85,0\n"
form 'byte order mark before a quote' "\xef\xbb\xbf\"altitude_km\",sun_zenith_deg,view_zenith_deg,rel_azimuth_deg\n1,60,50,30\n0,85,80.5,-200\n"
text "$head\n"
does 'no rows, all orders' in.csv "$skyvert" eval --atmosphere air.ini
does 'no rows' in.csv lit
same 'no rows: the header alone' "$(wc -l <stdout)" 1
text "$head\n+1.0e0,6.e1,.5e2,30\n"
does 'forms of numbers' in.csv lit
same 'forms of numbers: echoed' "$(tail -n 1 stdout | cut -d, -f1-4)" "+1.0e0,6.e1,.5e2,30"
same 'forms of numbers: values' "$(tail -n 1 stdout | cut -d, -f5-)" "$(sed -n 2p base.csv | cut -d, -f5-)"

# --- bad headers ---
for name in altitude_km sun_zenith_deg view_zenith_deg rel_azimuth_deg; do
    text "${head/$name/x}\n1,2,3,4\n"
    refuses "no $name" 2 "^stdin:1: column $name is missing; needed .*$head" in.csv lit
    text "$head,$name\n1,2,3,4,5\n"
    refuses "$name twice" 2 "^stdin:1: column $name stands there more than once" in.csv lit
done
text ''
refuses 'empty input' 2 '^stdin:1: empty input' in.csv lit
text '\n\n\r\n'
refuses 'blank input' 2 '^stdin:1: empty input' in.csv lit
text '1,2,3,4\n'
refuses 'no header' 2 '^stdin:1: column altitude_km is missing' in.csv lit
text "\001\002$head\n"
refuses 'binary header' 2 '^stdin:1: binary data' in.csv lit
refuses 'a folder for a file' 2 '^stdin: cannot be read' . lit
refuses 'closed input' 2 '^stdin: cannot be read|^stdin:1: empty' /dev/null bash -c "exec \"$skyvert\" eval --orders single --atmosphere air.ini <&-"
head -c 300000 /dev/zero >in.csv
refuses 'zeros' 2 '^stdin:1: ' in.csv lit

# --- bad rows ---
# row CASE PATTERN ROW: refused at line 3
row() {
    text "$head\n1,60,50,30\n$3\n1,60,50,30\n"
    refuses "$1" 2 "^stdin:3: .*($2)" in.csv lit
}
row 'below ground' 'altitude_km = -1: allowed is a number from 0 to 1e6' '-1,2,3,4'
row 'altitude too large' 'altitude_km = 1000001' '1000001,2,3,4'
row 'sun zenith' 'sun_zenith_deg = 180.1: allowed is a number from 0 to 180' '1,180.1,3,4'
row 'negative zenith' 'view_zenith_deg = -0.1: allowed is a number from 0 to 180' '1,2,-0.1,4'
row 'no finite azimuth' 'rel_azimuth_deg = 1e999: allowed is a finite number' '1,2,3,1e999'
for value in nan NaN inf -inf 0x1p3 '' x '1 2' 1e '1;5' '- 1' 1_000 '１'; do
    row "azimuth '$value'" 'rel_azimuth_deg = .*allowed' "1,2,3,$value"
done
row 'decimal comma' 'more fields' '1,2,3,4,5'
row 'too few fields' 'fewer fields' '1,2,3'
row 'one field' 'fewer fields' 'hello'
row 'open quote' 'a quote is not closed' '1,2,3,"4'
row 'text behind a quote' 'text behind a closing quote' '1,2,3,"4"5'
row 'NUL' 'binary data' '1,2,3,\0004'
row 'escape sequence' 'binary data' '1,2,3,\033[31m4'
row 'enormous row' 'too long' "1,2,3,$(printf '4%.0s' {1..66000})"
row 'thousands of fields' 'too many fields' "1,2,3,4$(printf ',%.0s' {1..1100})"
{ echo "$head" && yes 'x,60,50,30' | head -n 25; } >in.csv
run in.csv lit
same '25 bad rows: status' $status 2
same '25 bad rows: no output' "$(cat stdout)" ''
same '25 bad rows: twenty named' "$(grep -c '^stdin:[0-9]*: altitude_km = x' stderr)" 20
same '25 bad rows: the first and the last named' "$(sed -n '1p;20p' stderr | cut -d: -f2 | tr '\n' ' ')" '2 21 '
same '25 bad rows: then a count' "$(tail -n 1 stderr)" 'stdin: and 5 more bad rows'
same '25 bad rows: lines' "$(wc -l <stderr)" 21
{ echo "$head" && yes 'x,60,50,30' | head -n 20; } >in.csv
run in.csv lit
same '20 bad rows: lines' "$(wc -l <stderr)" 20
{ echo "$head" && yes '1,60,50,30' | head -n 100000 && echo '1,2,3'; } >in.csv
refuses 'a bad row behind 100000 good ones' 2 '^stdin:100002: fewer' in.csv lit

# --- options ---
text "$head\n1,60,50,30\n"
refuses 'no atmosphere' 2 '^skyvert eval: --atmosphere FILE.ini is missing' in.csv "$skyvert" eval --orders single
refuses 'unknown option' 2 '^skyvert eval: unknown option --bogus' in.csv lit --bogus
refuses 'unknown letter' 2 '^skyvert eval: unknown option -x' in.csv lit -x
refuses 'option without a value' 2 '^skyvert eval: option --tier needs a value' in.csv lit --tier
refuses 'argument' 2 "^skyvert eval: unexpected argument 'in.csv'" in.csv lit in.csv
refuses 'tier' 2 '^skyvert eval: --tier best: allowed is fast, standard or high' in.csv lit --tier best
refuses 'rule' 2 '^skyvert eval: --rule simpson: allowed is uniform, keller or gauss-exp' in.csv lit --rule simpson
refuses 'orders' 2 '^skyvert eval: --orders 2: allowed is single or all' in.csv lit --orders 2
refuses 'ground' 2 '^skyvert eval: --ground wet: allowed is none or lit' in.csv lit --ground wet
refuses 'depth' 2 '^skyvert eval: --depth x: allowed is chapman or inner' in.csv lit --depth x
for n in 0 65 -1 2.5 x '' 1e9; do
    refuses "samples '$n'" 2 '^skyvert eval: --samples .*: allowed is a whole number from 1 to 64' in.csv lit --rule keller --samples "$n"
    refuses "depth samples '$n'" 2 '^skyvert eval: --depth-samples .*: allowed is a whole number from 1 to 64' in.csv lit --depth-samples "$n"
done
for n in 1 17; do
    refuses "gauss-exp with $n samples" 2 "^skyvert eval: --samples $n: allowed with gauss-exp is 2 to 16" in.csv lit --samples $n
done
for n in 1 17; do
    refuses "gauss-exp with $n depth samples" 2 "^skyvert eval: --depth-samples $n: allowed with gauss-exp is 2 to 16" in.csv lit --depth inner --depth-samples $n
done
does 'options win over the order they stand in' in.csv lit --samples 40 --rule keller
for options in '--tier fast' '--tier high' '--rule uniform' '--rule keller --samples 16 --depth-samples 16' \
    '--rule gauss-exp --samples 16' '--depth inner' '--depth inner --depth-samples 2' '--rule keller --depth chapman' '--ground lit' \
    '--ground=none' '--rule uniform --samples 1 --depth-samples 1' '--rule keller --samples 64 --depth-samples 64'; do
    does "$options" in.csv lit $options
    same "$options: two lines" "$(wc -l <stdout)" 2
done
refuses 'table' 2 '^skyvert eval: --table huge: allowed is accurate, small or large' in.csv lit --table huge
does 'all orders' in.csv "$skyvert" eval --atmosphere air.ini --orders all
cp stdout all.csv
does 'all orders are the default' in.csv "$skyvert" eval --atmosphere air.ini
same 'all orders are the default' "$(cat stdout)" "$(cat all.csv)"
for option in --help --version; do
    does "eval $option" /dev/null "$skyvert" eval $option
    does "sun $option" /dev/null "$skyvert" sun $option
    does "$option" /dev/null "$skyvert" $option
done
refuses 'no command' 2 '^skyvert: no command given: eval' /dev/null "$skyvert"
refuses 'unknown command' 2 "^skyvert: unknown command 'fly': eval" /dev/null "$skyvert" fly
refuses 'unknown option' 2 '^skyvert: unknown option --fly' /dev/null "$skyvert" --fly
# A file's bytes and an argument's must not reach the terminal.
refuses 'control bytes in a message' 2 "unknown command '\?\[31mx'" /dev/null "$skyvert" "$(printf '\033[31mx')"

# --- writing ---
run in.csv bash -c "\"$skyvert\" eval --orders single --atmosphere air.ini >/dev/full"
same 'full disk: status' $status 1
same 'full disk: line' "$(cat stderr)" 'standard output: writing failed: No space left on device'
run in.csv bash -c "\"$skyvert\" eval --orders single --atmosphere air.ini >&-"
same 'closed output: status' $status 1
same 'closed output: line' "$(cat stderr)" 'standard output: writing failed: Bad file descriptor'
{ echo "$head" && yes '1,60,50,30' | head -n 20000; } >big.csv
run big.csv bash -c "set -o pipefail; \"$skyvert\" eval --orders single --atmosphere air.ini | head -n 1 >/dev/null"
same 'closed pipe: status' $status 1
same 'closed pipe: one line' "$(wc -l <stderr)" 1
run big.csv bash -c "\"$skyvert\" eval --orders single --atmosphere air.ini >/dev/full"
same 'full disk, many rows: status' $status 1
same 'full disk, many rows: one line' "$(wc -l <stderr)" 1

# --- what the numbers mean ---
# answers ROW...: the answers alone
answers() {
    { echo "$head" && printf '%s\n' "$@"; } >in.csv
    does "rows $1" in.csv lit $options
    tail -n +2 stdout | cut -d, -f5-
}
options=
a=$(answers 1,60,50,30 1,60,50,-30 1,60,50,390 1,60,50,-330 1,60,50,3630)
same 'azimuths by turns and mirrored' "$(sort -u <<<"$a" | wc -l)" 1
a=$(answers 0,60,90,30 0,60,90.000001,30)
same 'view zenith 90 on the ground is the sky' "$(sed -n 1p <<<"$a" | awk -F, '{print ($1 > .01)}')" 1
same 'just below it is the ground' "$(sed -n 2p <<<"$a")" 0,0,0,0
a=$(answers 1,60,60,0 1,60,60,40 1,60,60,180 | awk -F, '{printf "%s ", $1}' | awk '{print ($1 > $2 && $2 > $3)}')
same 'azimuth 0 is toward the sun' "$a" 1
# Shuffled rows of many frames: each row's answer is that of the row alone.
awk 'BEGIN{srand(7); for(i=0;i<300;i++) printf "%.9g,%.9g,%.9g,%.9g\n", int(rand()*4)*3, 20*int(rand()*5)+5, 180*rand(), 720*rand()-360}' >rows
{ echo "$head" && cat rows; } >in.csv
does 'shuffled rows' in.csv lit
cp stdout all.csv
same 'shuffled rows: in the order given' "$(tail -n +2 all.csv | cut -d, -f1-4)" "$(cat rows)"
{ echo "$head" && tac rows; } >in.csv
does 'reversed rows' in.csv lit
same 'reversed rows: the same answers' "$(tail -n +2 stdout | tac)" "$(tail -n +2 all.csv)"
for i in 2 77 150 301; do
    { echo "$head" && sed -n "${i}p" all.csv | cut -d, -f1-4; } >in.csv
    does "row $i alone" in.csv lit
    same "row $i alone: the same answer" "$(tail -n 1 stdout)" "$(sed -n "${i}p" all.csv)"
done
# The ground of albedo a under a sun at zenith z, from the ground itself: a/pi cos(z) T(z); at most a/pi cos(z).
options='--ground lit'
a=$(answers 0,60,180,0)
same 'lit ground: at most albedo cos(z)/pi, and most of that in the red' \
    "$(awk -F, '{m=.5/3.14159265; print ($1>.2*.1*m && $1<.1*m && $4>.8*.4*m && $4<.4*m)}' <<<"$a")" 1
# Radiance is proportional to the irradiance; a power of two scales every float exactly.
sed '8s/1, 1, 1, 1/4, 4, 4, 4/' air.ini >air4.ini
text "$head\n1,60,50,30\n"
does 'four times the sun' in.csv "$skyvert" eval --orders single --atmosphere air4.ini
same 'four times the sun: four times the light' "$(tail -n 1 stdout | cut -d, -f5- | tr , '\n' | awk '{printf "%.6g ", $1/4}')" \
    "$(sed -n 2p base.csv | cut -d, -f5- | tr , '\n' | awk '{printf "%.6g ", $1}')"
finish
