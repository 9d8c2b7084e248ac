# shellcheck shell=bash
# One random scene: planned, built with the header, counted, compared. Sourced from the root after tools/plan/targets.sh.
# scene_measure NUMBER: in $B/plan-random/NUMBER; last line of its `result`:
#   (a term that is kept because it is faster with it is not "one more term" to drop)
#   number target promised measured library predicted-instructions counted-instructions least-drop max-error config
scene_measure() {
    local k=$1 d=$B/plan-random/$1 vertices target error x
    mkdir -p "$d"
    awk -v seed=1 -v number="$k" -v what=scene -f tests/plan/scenes.awk </dev/null >"$d/scene.ini"
    read -r vertices target error < <(awk -v seed=1 -v number="$k" -v what=options -f tests/plan/scenes.awk </dev/null)
    "$B/skyvert" plan --scene "$d/scene.ini" --max-error "$error%" --vertices "$vertices" --target "$target" --out "$d" >"$d/report" 2>"$d/errors" ||
        { echo "$k $target $(cat "$d/errors") $(grep ^fails "$d/report")" >"$d/result"; return 1; }
    value() { awk -v n="$1" '$2 == n { print $3 + 0 }' "$d/skv_config.h"; }
    "$B/plan-case" "$d/scene.ini" 77 10 6 "$vertices" "$(value SKV_BANDS)" "$(value SKV_PLAN_TERMS)" "$(value SKV_PLAN_TABLE)" \
        "$(grep -c '^stars = yes' "$d/scene.ini")" >"$d/case.h" || return 1
    target_build "$target" "$d" tests/plan/measure.c measure && target_count "$target" "$d" measure || return 1
    "$B/plan-compare" "$d/scene.ini" "tests/plan/truth/$k.csv" 77 10 6 "$(value SKV_BANDS)" "$(value SKV_PLAN_TERMS)" \
        "$(value SKV_PLAN_TABLE)" "$(value SKV_PLAN_GRID)" "$(value SKV_PLAN_SAMPLES)" "$d/lines" >"$d/compared" || return 1
    x=$(awk '/^error/ { print $2 } ' "$d/report")
    echo "$k $target $x $(awk '$1 == "measured" { print $2 }' "$d/compared") $(awk '$1 == "library" { print $2 }' "$d/compared")" \
        "$(awk '/^instructions/ { print $2 }' "$d/report") $(awk '{ s += $1 } END { printf "%.0f", s / NR }' "$d/counts")" \
        "$(awk 'NR == FNR { if (/yet dearer/) dearer[$2] = 1; next } # the first words of terms differ
            $1 == "drop" && $3 != "last" && !($3 in dearer) && (least == "" || $2 < least) { least = $2 }
            END { print least }' "$d/report" "$d/compared") $error" \
        "$(value SKV_BANDS)b/$(value SKV_PLAN_TERMS)/$(value SKV_PLAN_TABLE)/$(value SKV_PLAN_GRID)/$(value SKV_PLAN_SAMPLES)" >"$d/result"
}
export -f scene_measure
