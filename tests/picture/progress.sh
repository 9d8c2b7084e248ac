# The progress bar: on a terminal for work of over two seconds, nowhere else; wiped at the end.
. tests/picture/lib.sh
command -v script >/dev/null || { echo "progress bar: no script(1) to make a terminal with" && exit 77; }

slow="$skyvert render --sun-zenith-deg 60 --rule uniform --samples 64 --depth-samples 64 --size 2000x2000 --out $work/slow.exr"
script -qec "timeout -s INT -k 20 3.5 env --default-signal=INT $slow" "$work/typescript" >/dev/null 2>&1 </dev/null
has "a bar on a terminal" "$(tr '\r' '\n' <"$work/typescript")" "render ["
has "it tells what is left" "$(tr '\r' '\n' <"$work/typescript")" "left"
cases=$((cases + 1))
status=0
timeout -s INT -k 20 3.5 env --default-signal=INT $slow >"$work/stdout" 2>"$work/stderr" || status=$?
[ ! -s "$work/stderr" ] || fails "no bar in a file" "want nothing on stderr"
same "interrupted: nothing is left" "$(ls "$work" | grep slow)" ""
script -qec "$skyvert render --sun-zenith-deg 60 --size 20x20 --out $work/quick.exr" "$work/typescript" >/dev/null 2>&1 </dev/null
same "no bar for quick work" "$(grep -c 'render \[' "$work/typescript")" 0
finish
