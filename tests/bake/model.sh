# Model and table as C: no warning, the same bits as built at run time, from gcc, clang, C++ and on a Cortex-M4F; other
# config.h selections are refused at compile time, changed bytes at run time.
. tests/command/lib.sh
here=$B/tests/bake
flags=(-std=c99 -O2 -ffp-contract=off -Wall -Wextra -Wpedantic -Werror -Wconversion -Wshadow -Wundef -Iinclude "-I$here")
sums=()

for cc in gcc clang; do
    command -v $cc >/dev/null || { echo "note: model.sh: no $cc"; continue; }
    run /dev/null $cc "${flags[@]}" tests/bake/model.c "$B/libskyvert.a" -o "$work/model"
    [ $status -eq 0 ] || fails "baked C with $cc" "want that it compiles"
    does "baked C with $cc" /dev/null "$work/model"
    sums+=("$(grep checksum "$work/stdout")")
    grep '^note:' "$work/stdout"
done
if command -v g++ >/dev/null; then
    printf '#include "baked.h"\nint main() { return baked_check() == SKV_OK && baked_colour.rgb[0][0] != 0 ? 0 : 1; }\n' >"$work/use.cc"
    run /dev/null g++ -std=c++17 -Wall -Wextra -Wpedantic -Werror -Iinclude "-I$here" "$work/use.cc" "$B/libskyvert.a" -o "$work/use"
    [ $status -eq 0 ] || fails "baked C in C++" "want that it compiles"
    run /dev/null "$work/use"
    [ $status -eq 0 ] || fails "baked C in C++" "want status 0"
fi
if [ -f "$B/cortexm/m4f/bake/model.elf" ] && command -v qemu-system-arm >/dev/null; then
    run /dev/null bash port/cortexm/run.sh m4f "$B/cortexm/m4f/bake/model.elf"
    [ $status -eq 0 ] || fails "baked C on Cortex-M4F" "want status 0"
    sums+=("$(grep checksum "$work/stdout" | tr -d '\r')")
    # In flash and nowhere else.
    cases=$((cases + 1))
    ram=$(arm-none-eabi-nm -S "$B/cortexm/m4f/bake/model.elf" | awk '/baked_/ && $3 ~ /[BbDd]/')
    [ -z "$ram" ] || { echo "FAILED: baked C takes RAM: $ram" && bad=$((bad + 1)); }
else
    echo "note: model.sh: no Cortex-M4F (Debian: gcc-arm-none-eabi libnewlib-arm-none-eabi qemu-system-arm)"
fi
echo "figure: baked C: ${#sums[@]} builds, ${sums[0]}"
for s in "${sums[@]}"; do same "one checksum" "$s" "${sums[0]}"; done

# Other selections: refused when compiled.
for other in -DSKV_BANDS=4 -DSKV_TERM_OZONE=0 -DSKV_TERM_DUST=0 -DSKV_PROFILE_TABULATED=0 -DSKV_LIGHTS_MAX=1 -DSKV_TERM_DIFFUSE=0; do
    run /dev/null gcc "${flags[@]}" $other -fsyntax-only tests/bake/model.c
    [ $status -ne 0 ] && grep -q "another config.h selection" "$work/stderr" || fails "baked C with $other" "want an #error"
done
# A changed word of the table, of the model: refused at run time. (Words of the table begin with its "SKVT".)
changes() {
    mkdir -p "$work/changed"
    awk -v what="$1" '$0 ~ "word\\[" {seen = ""} $0 ~ what {on = 1} on && /^        0x/ {n++} on && n == 3 && !done {sub(/0x[0-9a-f]/, "0x5"); done = 1} {print}' \
        "$here/baked.h" >"$work/changed/baked.h"
    cmp -s "$here/baked.h" "$work/changed/baked.h" && fails "baked C, changed $1" "want a change to test with"
    run /dev/null gcc "${flags[@]/-I$here/-I$work/changed}" tests/bake/model.c "$B/libskyvert.a" -o "$work/model"
    run /dev/null "$work/model"
    [ $status -eq 1 ] && grep -q "$2" "$work/stdout" || fails "baked C, changed $1" "want: $2"
}
changes baked_table_words "skv_table_check"
changes baked_model_words "baked model differs"
finish
