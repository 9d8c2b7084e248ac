# skyvert bake: what it refuses, what it writes, and what an interrupt leaves.
. tests/picture/lib.sh
out=$work/t
mkdir "$out"
bake=("$skyvert" bake)

# ---- bad input: status 2, one line, no file
no() { refuses "$1" 2 "$2" /dev/null "${bake[@]}" "${@:3}"; }
sky=(--what sky-view --sun-zenith-deg 40)
no "nothing" "what sky-view, transmittance" --output "$out/x.exr"
no "no output" "output FILE is missing" "${sky[@]}"
no "unknown table" "allowed is sky-view, transmittance, scattering-3d, irradiance or model" --what clouds --output "$out/x.exr"
no "no format" "format exr, raw16f or c is needed" "${sky[@]}" --output "$out/x.png"
no "unknown format" "allowed is exr, raw16f or c" "${sky[@]}" --format tiff --output "$out/x"
no "model as exr" "model is written as c only" --what model --output "$out/x.exr"
no "raw floats" "raw16f is half" "${sky[@]}" --texel float --output "$out/x.raw16f"
no "odd rows" "even number" "${sky[@]}" --rows 33 --output "$out/x.exr"
no "few rows" "whole number from 4 to 4096" "${sky[@]}" --rows 2 --output "$out/x.exr"
no "an axis it lacks" "sky-view has no such axis" "${sky[@]}" --suns 32 --output "$out/x.exr"
no "too large" "16777216" --what scattering-3d --rows 4096 --azimuths 4096 --output "$out/x.exr"
no "a sun nowhere" "where\\?" --what sky-view --output "$out/x.exr"
no "a sun for all suns" "sky-view only" --what irradiance --sun-zenith-deg 40 --output "$out/x.exr"
no "colours of transmittance" "no colour of its own" --what transmittance --colours rgb --output "$out/x.exr"
no "phase of irradiance" "allowed with sky-view and scattering-3d" --what irradiance --phase deferred --output "$out/x.exr"
no "single model" "all orders" --what model --orders single --output "$out/x.c"
no "name" "C name" --what model --name 2nd --output "$out/x.c"
no "lowest sun" "from 91 to 120" --what irradiance --sun-lowest-deg 60 --output "$out/x.exr"
no "no folder" "No such file" "${sky[@]}" --output "$out/no/x.exr"
no "unknown option" "unknown option --colour-space" "${sky[@]}" --colour-space --output "$out/x.exr"
no "moon" "allowed with pictures" "${sky[@]}" --moon on --output "$out/x.exr"
no "water" "a table has no mirror" "${sky[@]}" --ground water --output "$out/x.exr"
no "atmosphere" "air.ini" "${sky[@]}" --atmosphere "$out/air.ini" --output "$out/x.exr"
leaves "refused: no file" "$out"
does "help" /dev/null "${bake[@]}" --help

# ---- the three formats hold the same numbers
small=(--rows 8 --azimuths 5 --phase deferred)
for f in raw16f exr h; do works "bake $f" "${bake[@]}" "${sky[@]}" "${small[@]}" --name baked --output "$out/sky.$f"; done
"$B/tests/bake/texels" "$out/sky.raw16f" >"$work/raw.txt"
same "texels" "$(wc -l <"$work/raw.txt")" $((3 * 8 * 5))
works "C compiles" gcc -std=c99 -Wall -Wextra -Wpedantic -Werror -Wconversion -Wdouble-promotion -Wshadow -D_POSIX_C_SOURCE=200809L -Iinclude -I. -Iport/bake \
    "-DBAKED=\"$out/sky.h\"" tests/bake/texels.c "$B/libskyvert.a" -lm -o "$work/texels"
same "C as raw16f" "$("$work/texels" | md5sum)" "$(md5sum <"$work/raw.txt")"
# EXR: layers R G B A, aerosol.R ..., transmittance.R ...; values over the scale that its attributes say.
info=$(exrheader "$out/sky.exr")
has "EXR layers" "$info" "aerosol.R, 16-bit floating-point"
has "EXR layers" "$info" "transmittance.A, 16-bit floating-point"
has "EXR mapping" "$info" "skyvert-bake 1"
has "EXR numbers" "$info" "skyvert.radiusKm (type float): 6371"
has "EXR mapping for people" "$info" "sin(d/2) = u^2 sin(D/2)"
scales=$(sed -n 's/^ *scale_[0-9] = //p' <<<"$info" | tr '\n' ' ')
oiiotool --info -v --dumpdata "$out/sky.exr" | sed -n 's/^ *Pixel (\([0-9]*\), \([0-9]*\)): */\1 \2 /p' | tr -s ' ' >"$work/exr.txt"
same "EXR pixels" "$(wc -l <"$work/exr.txt")" 40
cases=$((cases + 1))
awk -v scales="$scales" 'BEGIN {if (split(scales, s, " ") != 3) {print "scales: " scales; bad = 1}}
    NR == FNR {for (i = 3; i <= NF; i++) v[$1, $2, i - 3] = $i; next}
    {for (c = 0; c < 4; c++) {k = 4*$1 + c; got = v[$2, $3, k]/s[$1 + 1]; want = $(5 + c); e = got - want; if (e < 0) e = -e
        if (!(($2, $3, k) in v) || e > 1e-5*want + 1e-9/s[$1 + 1]) { # nine decimals are printed
            print "texel", $2, $3, "channel", k, got, want; bad = 1}}}
    END {exit bad}' "$work/exr.txt" "$work/raw.txt" >"$work/differences" || { echo "FAILED EXR as raw16f: $(head -n 3 "$work/differences")"; bad=$((bad + 1)); }
has "raw16f header" "$(head -c 400 "$out/sky.raw16f" | tr -d '\0')" "little-endian"
# Files that are none are refused by the reader.
cut() { "$B/tests/bake/texels" "$work/cut.raw16f" >/dev/null 2>"$work/stderr"; same "$1" "$? $(cat "$work/stderr")" "1 FAILED: not a table"; }
head -c -1 "$out/sky.raw16f" >"$work/cut.raw16f" && cut "a file without its last byte"
sed 's/^width = 5$/width = 9/' "$out/sky.raw16f" >"$work/cut.raw16f" && cut "a file that is wider than it is long"
sed 's/^scale_1 = /scale_9 = /' "$out/sky.raw16f" >"$work/cut.raw16f" && cut "a file without a scale"
sed '1s/1$/2/' "$out/sky.raw16f" >"$work/cut.raw16f" && cut "a file of another version"
head -c 500 "$out/sky.raw16f" >"$work/cut.raw16f" && cut "a file that ends in its text"
# RGB: a picture that viewers know.
works "rgb" "${bake[@]}" "${sky[@]}" --colours rgb --texel float --output "$out/rgb.exr"
has "rgb EXR" "$(exrheader "$out/rgb.exr")" "chromaticities"
for what in transmittance irradiance scattering-3d; do
    works "bake $what as EXR" "${bake[@]}" --what $what --preset mars --bands 3 $([ $what = scattering-3d ] && echo --rows 8 --azimuths 3 --suns 6 --altitudes 3) \
        $([ $what = irradiance ] && echo --suns 8 --altitudes 3) --texel float --output "$out/$what.exr"
    works "$what is whole" oiiotool --stats "$out/$what.exr"
done
has "3-D slices" "$(exrheader "$out/scattering-3d.exr")" "3 slices of 8 lines"
works "twice the same" "${bake[@]}" "${sky[@]}" "${small[@]}" --output "$work/again.raw16f"
same "twice the same" "$(md5sum <"$work/again.raw16f")" "$(md5sum <"$out/sky.raw16f")"
works "to standard output" bash -c '"$@" --output - --format raw16f >"$0"' "$work/piped" "${bake[@]}" "${sky[@]}" "${small[@]}"
same "to standard output" "$(md5sum <"$work/piped")" "$(md5sum <"$out/sky.raw16f")"

# ---- a full disk, an interrupt: nothing half-done
rm -f "$out"/*
[ ! -e /dev/full ] || refuses "full disk" 1 "writing failed" /dev/null "${bake[@]}" --what model --format c --output /dev/full
echo old >"$out/s.exr"
setsid bash -c 'trap - INT; exec "$@"' start env --default-signal=INT "${bake[@]}" --what scattering-3d --rows 128 --suns 128 --output "$out/s.exr" >"$work/stdout" 2>"$work/stderr" &
pid=$!
sleep 1
kill -INT $pid
wait $pid
same "interrupted" "$? $(cat "$out/s.exr") $(ls -A "$out")" "130 old s.exr"
if command -v script >/dev/null; then
    script -qec "timeout -s INT -k 20 3.5 env --default-signal=INT $skyvert bake --what scattering-3d --rows 200 --suns 200 --output $out/p.exr" "$work/typescript" >/dev/null 2>&1 </dev/null
    has "a bar on a terminal" "$(tr '\r' '\n' <"$work/typescript")" "bake ["
    leaves "interrupted on a terminal" "$out" s.exr
fi
finish
