#!/usr/bin/env bash
# skyvert plan: errors of the command line and of scene files, answers that hang together, what does not fit, nothing half-done,
# the same answer twice.
. tests/command/lib.sh
plan="$skyvert plan"
scene=tools/plan/cockpit-m4f.ini
mkdir "$work/out"
# One small air, few vertices: a plan takes a second.
cat >"$work/small.ini" <<'END'
[planet]
preset = mars
[observer]
height_m = 100
[sun]
elevation_deg = 30
[view]
elevation_deg = 5, 60
END
ask="--vertices 256 --target cortex-m4f --out $work/out"

# ---- the command line
# shellcheck disable=SC2086
bad() { refuses "$1" 2 "$2" /dev/null $plan "${@:3}"; }
bad "no scene" "--scene FILE.ini is missing" --max-error 2% --vertices 10 --target x86-avx2
bad "no error" "--max-error is missing.*0.1" --scene $scene --vertices 10 --target x86-avx2
bad "no vertices" "--vertices is missing: 1 to 1000000" --scene $scene --max-error 2% --target x86-avx2
bad "no target" "--target is missing: x86-avx2, x86-sse2, cortex-m4f, cortex-m7 or cortex-a53" --scene $scene --max-error 2% --vertices 10
for e in 0 0% 0.05% 101% 1.5 nan x 2%% -1 ""; do bad "error $e" "max-error .*allowed is 0.1% to 100%" --scene $scene --max-error "$e" --vertices 10 --target x86-avx2; done
for v in 0 1000001 2.5 x; do bad "vertices $v" "vertices $v: allowed is a whole number from 1 to 1000000" --scene $scene --max-error 2% --vertices $v --target x86-avx2; done
bad "target" "target z80: allowed is x86-avx2, .* or cortex-a53" --scene $scene --max-error 2% --vertices 10 --target z80
bad "budget" "budget-us 0: allowed" --scene $scene --max-error 2% --vertices 10 --target x86-avx2 --budget-us 0
bad "unknown option" "unknown option --foo" --scene $scene --foo
bad "more" "unexpected argument 'x'" --scene $scene --max-error 2% --vertices 10 --target x86-avx2 x
bad "no file" "none.ini: cannot be read" --scene "$work/none.ini" --max-error 2% --vertices 10 --target x86-avx2
bad "no folder" "none" --scene "$work/small.ini" --max-error 2% --vertices 10 --target x86-avx2 --out "$work/none/there"

# ---- scene files: the line is named
# file CASE LINE PATTERN SED: small.ini changed by sed
file() {
    sed -e "$4" "$work/small.ini" >"$work/bad.ini"
    refuses "$1" 2 "^$work/bad.ini:$2: .*$3" /dev/null $plan --scene "$work/bad.ini" --max-error 5% $ask
    leaves "$1" "$work/out"
}
leaves() { same "$1: left" "$(ls -A "$2")" "${3:-}"; }
file "unknown section" 1 "unknown section \[planets\]; allowed are" 's/^\[planet\]/[planets]/'
file "unknown key" 4 "unknown key height_km in \[observer\]; allowed are height_m, ground_m" 's/height_m/height_km/'
file "unknown preset" 2 "preset = venus: allowed are earth-clear" 's/mars/venus/'
file "height too large" 4 "height_m = 2e6: allowed is a number from -12000 to 1000000, or two" 's/height_m = 100/height_m = 2e6/'
file "range upside down" 4 "height_m = 200, 100: allowed" 's/height_m = 100/height_m = 200, 100/'
file "not a number" 6 "elevation_deg = high: allowed is a number from -12 to 90" 's/= 30/= high/'
file "infinite" 6 "elevation_deg = inf: allowed" 's/= 30/= inf/'
file "three numbers" 8 "elevation_deg = 5, 60, 70: allowed" 's/= 5, 60/= 5, 60, 70/'
file "below the ground" 4 "height_m = -100: allowed is from ground_m, 0, up" 's/height_m = 100/height_m = -100/'
file "missing section" 6 "section \[view\] is missing: elevation_deg is needed" '/view/,$d'
file "missing key" 5 "\[sun\] lacks elevation_deg" '6d'
file "not yes or no" 9 "terrain = maybe: allowed is yes or no" '$a terrain = maybe'
file "terrain alone" 9 "terrain_km: allowed with terrain = yes" '$a terrain_km = 1, 2'
file "visibility too good" 10 "visibility_km = 900: allowed is up to" 's/mars/earth-clear/;$a [air]\nvisibility_km = 900'
file "twice" 9 "elevation_deg stands in line 8 already" '$a elevation_deg = 1'
file "no value" 9 "no value" '$a stars'
printf '[planet]\npreset = tiny\n[observer]\nheight_m = 10\n[sun]\nelevation_deg = 30\n[view]\nelevation_deg = 5, 60\n' >"$work/tiny.ini"
refuses "no file of air" 2 "none.ini: cannot be read" /dev/null $plan --scene <(sed 's/preset = mars/atmosphere = none.ini/' "$work/small.ini") --max-error 5% $ask

# ---- a plan
value() { awk -v n="$1" '$2 == n { print $3 + 0 }' "$work/out/skv_config.h"; }
does "a plan" /dev/null $plan --scene "$work/small.ini" --max-error 25% $ask
cp "$work/stdout" "$work/first"
cp "$work/out/skv_config.h" "$work/first.h"
promised=$(awk '/^error/ { print $2 }' "$work/first")
same "promised is within the bound" "$(awk -v p="$promised" 'BEGIN { print (p > 0 && p <= 25) }')" 1
for line in "^scene mars" "^asked error 25 %, 256 vertices on cortex-m4f" "^bands [34]" "^species rayleigh" "^samples [0-9]+ per lit leg" \
    "^instructions [0-9]+ per frame" "^time .* us per frame" "^rate .*assumed: 168 MHz" "^flash [0-9]+ bytes" "^ram [0-9]+ bytes" "^stack [0-9]+ bytes" \
    "^(kept|dropped) +aerosol"; do
    same "a line like $line" "$(grep -cE "$line" "$work/first")" 1
done
for macro in SKV_BANDS SKV_TERM_AEROSOL SKV_TERM_DIFFUSE SKV_PLAN_SAMPLES SKV_PLAN_TERMS SKV_PLAN_TABLE SKV_PLAN_GRID; do
    same "$macro stands in the header once" "$(grep -c "^#define $macro " "$work/out/skv_config.h")" 1
done
same "no path of this machine in the header" "$(grep -c "$work" "$work/out/skv_config.h")" 0
# Every file of the core takes the header, without a warning.
for f in src/core/*.c; do
    gcc -std=c99 -fsyntax-only -Wall -Wextra -Wpedantic -Werror '-DSKV_CONFIG_FILE="skv_config.h"' -I"$work/out" -Iinclude -Isrc "$f" 2>"$work/gcc" ||
        same "$f with the header" "$(head -n 2 "$work/gcc")" ""
done
# cheapest CASE BOUND: nothing that could still be dropped is cheaper and within the bound. (Less than three samples is not planned.)
cheapest() {
    same "$1: the cheapest" "$(awk -v bound="$2" '/^samples/ { n = $2 }
        /^kept/ && !(/last sample/ && n == 3) { sub(/ *\(.*/, ""); rows++; if ($(NF - 1) <= bound && $NF > 0) print "without: " $0 }
        END { if (!rows) print "no rows" }' "$work/stdout")" ""
}
cheapest "a plan" 25
# Bytes are those of the build that was measured for what was chosen: species, bands, and a table or none.
read -r lanes model frame flash_single flash s0 s1 s2 < <(grep -F "{\"cortex-m4f\", $(value SKV_BANDS), $(($(value SKV_PLAN_TERMS) & 15))," tools/plan/costs_data.h |
    awk -F'[{}, ]+' '{ print $5, $6, $7, $8, $9, $10, $11, $12; exit }')
case "$(value SKV_PLAN_TABLE) $(value SKV_PLAN_GRID)" in
"0 0") want="$flash_single $s0" ;; *0) want="$flash $s1" ;; *) want="$flash $s2" ;;
esac
same "flash, stack, model, frame" "$(awk '/^(flash|stack)/ { printf "%s ", $2 } /^ram/ { m = $5 + 0; f = $7 + 0 } END { print m, f }' "$work/first")" "$want $model $frame"
[ "$lanes" = 1 ] || same "lanes of a Cortex-M4F" "$lanes" 1
# A program with the header's buffers builds the table, and none of them can be shorter. (In the whole library: without what the
# header leaves out of it.)
grep -E '^#define SKV_PLAN_[A-Z]+' "$work/out/skv_config.h" >"$work/buffers.h"
cat >"$work/buffers.c" <<'END'
#include "buffers.h"
#include "skyvert/skyvert.h"
static float table[SKV_PLAN_TABLE_BYTES / 4], work[SKV_PLAN_WORK_BYTES / 4];
static skv_status build(const skv_model *model, const skv_table_spec *spec, size_t less, size_t less_work) {
    return skv_table_build((skv_table *)(void *)table, sizeof table - less, work, sizeof work - less_work, model, spec);
}
int main(void) {
    static skv_model model;
    skv_atmosphere air;
    skv_table_spec spec;
    if (skv_atmosphere_preset(&air, SKV_PRESET_MARS, BANDS) != SKV_OK || skv_model_build(&model, &air) != SKV_OK ||
        skv_table_spec_for(&spec, &model, SKV_PLAN_TABLE == 1 ? SKV_TABLE_SMALL : SKV_TABLE_ACCURATE) != SKV_OK)
        return 1;
    if (build(&model, &spec, 4, 0) == SKV_OK || build(&model, &spec, 0, 4) == SKV_OK)
        return 2;
    return build(&model, &spec, 0, 0) == SKV_OK ? 0 : 3;
}
END
run /dev/null "${CC:-gcc}" -DBANDS="$(value SKV_BANDS)" -Iinclude "$work/buffers.c" "$B/libskyvert.a" -o "$work/buffers"
[ $status -eq 0 ] || fails "the header's buffers" "want that it compiles"
run /dev/null "$work/buffers"
[ $status -eq 0 ] || fails "the header's buffers" "want status 0"
does "the same again" /dev/null $plan --scene "$work/small.ini" --max-error 0.25 $ask
same "the same answer twice" "$(cat "$work/stdout")" "$(cat "$work/first")"
same "the same header twice" "$(cat "$work/out/skv_config.h")" "$(cat "$work/first.h")"
# Twice the vertices, beyond those that are looked at one by one: twice the instructions, but for the frame's own.
for vertices in 2048 4096; do
    does "$vertices vertices" /dev/null $plan --scene "$work/small.ini" --max-error 25% --vertices $vertices --target cortex-m4f --out "$work/out"
    cp "$work/stdout" "$work/$vertices"
done
same "the same choice" "$(grep -E '^(light|samples)' "$work/2048")" "$(grep -E '^(light|samples)' "$work/4096")"
same "twice the instructions" "$(awk '/^instructions/ { n = $2; for (i = 1; i < NF; i++) if ($i == "is") n -= $(i + 1); all[++k] = n }
    END { r = all[2] / all[1]; print (r > 1.95 && r < 2.01 ? "twice" : r) }' "$work/2048" "$work/4096")" twice
does "a faster target" /dev/null $plan --scene "$work/small.ini" --max-error 25% $ask --instructions-per-us 1000
same "its rate" "$(grep -c '^rate 1000 instructions per us (as given)' "$work/stdout")" 1

# ---- what does not fit: status 1, the bound and by how much, no header
rm "$work/out/skv_config.h"
run /dev/null $plan --scene "$work/small.ini" --max-error 0.1% $ask
[ $status -eq 1 ] || fails "error too small" "want status 1"
same "error too small" "$(grep -cE '^fails error: the best that can be promised is [0-9.]+ %, 0.1 % is asked for: [0-9.]+ too much' "$work/stdout")" 1
run /dev/null $plan --scene "$work/small.ini" --max-error 25% $ask --budget-us 1
[ $status -eq 1 ] || fails "budget too small" "want status 1"
same "budget too small" "$(grep -cE '^fails time: the cheapest within the error takes [0-9.e+]+ us, the budget is 1 us: [0-9.e+]+ too much' "$work/stdout")" 1
leaves "no header where nothing fits" "$work/out"

# ---- Ctrl-C: the old header stays, nothing beside it
echo old >"$work/out/skv_config.h"
for delay in 0.05 0.2 0.5; do
    setsid bash -c 'trap - INT; exec "$@"' start env --default-signal=INT "$skyvert" plan --scene tools/plan/training-day.ini --max-error 5% \
        --vertices 2048 --target x86-avx2 --out "$work/out" >"$work/stdout" 2>"$work/stderr" &
    pid=$!
    sleep $delay
    kill -INT $pid 2>/dev/null
    wait $pid
    status=$?
    cases=$((cases + 1))
    [ $status -eq 130 ] || fails "interrupted after $delay s" "want status 130"
    leaves "interrupted after $delay s" "$work/out" skv_config.h
    same "interrupted after $delay s: the old header" "$(cat "$work/out/skv_config.h")" old
done
# ---- a folder that cannot be written: before the work
run /dev/null $plan --scene "$work/small.ini" --max-error 25% --vertices 256 --target cortex-m4f --out /dev/null
[ $status -ne 0 ] || fails "no folder" "want an error"
same "one line" "$(wc -l <"$work/stderr")" 1
# ---- the sample scenes are read
for s in training-day dusk-airliner cockpit-m4f; do
    run /dev/null timeout 60 $plan --scene tools/plan/$s.ini --max-error 20% --vertices 512 --target x86-avx2 --out "$work/out"
    [ $status -eq 0 ] || fails "$s" "want status 0"
    cheapest "$s" 20
    # What is seen through the air, terrain or stars, needs its transmittance.
    same "$s: transmittance" "$(value SKV_OUT_TRANSMITTANCE)" "$(grep -cE '^(terrain|stars) = yes' tools/plan/$s.ini)"
done
finish
