#!/usr/bin/env bash
# What config.h leaves out costs no bytes and no instructions: the core is built, for Cortex-M4F (-Os), with each macro at 0,
# and a vertex is counted with the thing left out and with it there but switched off at run time. Each selection must
# also compile without a warning with gcc and clang for the host.
. "$(dirname "$0")/lib.sh"
. "$(dirname "$0")/counts.sh"
# CONFIG=m4f does it for all selections; CONFIG=x86 for x86-64 with AVX2 (-O2, counted by callgrind): config-full.sh.
if [ "${CONFIG:-}" = x86 ]; then
    NAME="x86-64 gcc -O2 AVX2" COMPILE="gcc -O2 -mavx2" COUNT=count_x86 DIR=$G/config-x86 SIZE=size
    LINK="gcc -O2 -Iinclude tests/gates/count.c" LINK_END=""
    TOOLS="gcc clang valgrind"
    [ "$(uname -m)" = x86_64 ] || { echo "config: this machine is no x86-64"; exit 77; }
else
    NAME="Cortex-M4F -Os" COMPILE="arm-none-eabi-gcc -Os -ffunction-sections $ARM" COUNT=count_m4f DIR=$G/config SIZE=arm-none-eabi-size
    LINK="arm-none-eabi-gcc -Os $ARM -Iinclude -Iport/cortexm tests/gates/count.c"
    LINK_END="port/cortexm/start.c port/cortexm/semihosting.c port/cortexm/newlib.c -nostartfiles -Wl,-T,port/cortexm/cortexm.ld -Wl,--gc-sections -Wl,--no-warn-rwx-segments"
    TOOLS="arm-none-eabi-gcc qemu-system-arm gcc clang"
fi
for tool in $TOOLS; do
    have "$tool" || { echo "config: no $tool (packages gcc-arm-none-eabi libnewlib-arm-none-eabi qemu-system-arm clang valgrind)"; exit 77; }
done
# name, macros. The names of single macros are those of count.c's cases. Those with a + are built by config-full.sh only.
selections() {
    sed "${CONFIG:+s/^+//;}/^+/d" <<'LIST'
all
SKV_BANDS=3 -DSKV_BANDS=3
+SKV_BANDS=4 -DSKV_BANDS=4
+SKV_RULE_UNIFORM=0 -DSKV_RULE_UNIFORM=0
+SKV_RULE_KELLER=0 -DSKV_RULE_KELLER=0
SKV_RULE_GAUSS_EXP=0 -DSKV_RULE_GAUSS_EXP=0
SKV_DEPTH_CHAPMAN=0 -DSKV_DEPTH_CHAPMAN=0
SKV_DEPTH_INNER=0 -DSKV_DEPTH_INNER=0
+SKV_TERM_RAYLEIGH=0 -DSKV_TERM_RAYLEIGH=0
SKV_TERM_AEROSOL=0 -DSKV_TERM_AEROSOL=0
+SKV_TERM_DUST=0 -DSKV_TERM_DUST=0
SKV_TERM_OZONE=0 -DSKV_TERM_OZONE=0
+SKV_TERM_GROUND=0 -DSKV_TERM_GROUND=0
SKV_TERM_DIFFUSE=0 -DSKV_TERM_DIFFUSE=0
+SKV_OUT_TRANSMITTANCE=0 -DSKV_OUT_TRANSMITTANCE=0
+SKV_PHASE_HENYEY_GREENSTEIN=0 -DSKV_PHASE_HENYEY_GREENSTEIN=0
+SKV_PHASE_CORNETTE_SHANKS=0 -DSKV_PHASE_CORNETTE_SHANKS=0
SKV_PROFILE_TABULATED=0 -DSKV_PROFILE_TABULATED=0
smallest-gauss-exp -DSKV_BANDS=3 -DSKV_RULE_UNIFORM=0 -DSKV_RULE_KELLER=0 -DSKV_DEPTH_INNER=0 -DSKV_TERM_DUST=0 -DSKV_TERM_OZONE=0 -DSKV_TERM_GROUND=0 -DSKV_TERM_DIFFUSE=0 -DSKV_OUT_TRANSMITTANCE=0 -DSKV_PHASE_CORNETTE_SHANKS=0 -DSKV_PROFILE_TABULATED=0 -DSKV_LIGHTS_MAX=1
smallest-keller -DSKV_BANDS=3 -DSKV_RULE_UNIFORM=0 -DSKV_RULE_GAUSS_EXP=0 -DSKV_DEPTH_CHAPMAN=0 -DSKV_TERM_DUST=0 -DSKV_TERM_OZONE=0 -DSKV_TERM_GROUND=0 -DSKV_TERM_DIFFUSE=0 -DSKV_OUT_TRANSMITTANCE=0 -DSKV_PHASE_CORNETTE_SHANKS=0 -DSKV_PROFILE_TABULATED=0 -DSKV_LIGHTS_MAX=1
+rayleigh-only -DSKV_BANDS=3 -DSKV_RULE_UNIFORM=0 -DSKV_RULE_KELLER=0 -DSKV_DEPTH_INNER=0 -DSKV_TERM_AEROSOL=0 -DSKV_TERM_DUST=0 -DSKV_TERM_OZONE=0 -DSKV_TERM_GROUND=0 -DSKV_TERM_DIFFUSE=0 -DSKV_OUT_TRANSMITTANCE=0 -DSKV_PROFILE_TABULATED=0 -DSKV_LIGHTS_MAX=1
LIST
}
WARN="-Wall -Wextra -Wpedantic -Werror -Wconversion -Wdouble-promotion -Wfloat-conversion -Wshadow -Wstrict-prototypes -Wundef"
# object FILE FLAG...: path of its object, without a warning of clang, the host's gcc and the target's compiler. Many selections leave a
# file as it is: the preprocessor's output tells, and one object serves them all.
# shellcheck disable=SC2086
object() {
    local f=$1 key
    shift
    key=$DIR/cache/$(basename "$f" .c)-$($COMPILE -std=c99 -E -P "$@" -Iinclude -Isrc "$f" | md5sum | cut -c 1-16)
    if [ ! -f "$key.o" ]; then
        clang -std=c99 -fsyntax-only $FP $WARN "$@" -Iinclude -Isrc "$f" || return 1
        gcc -std=c99 -fsyntax-only $FP $WARN "$@" -Iinclude -Isrc "$f" || return 1
        $COMPILE -std=c99 $FP $WARN -Wno-type-limits "$@" -Iinclude -Isrc -c "$f" -o "$key.$BASHPID" || return 1
        mv "$key.$BASHPID" "$key.o"
    fi
    echo "$key.o"
}
# build NAME FLAG...: the counting program and its objects' text bytes in $DIR/NAME; nothing where they are new.
# shellcheck disable=SC2086
build() {
    local dir=$DIR/$1 f one objects=()
    shift
    if [ -f "$dir/bytes" ] && [ -z "$(find src/core include port/cortexm tests/gates -newer "$dir/bytes" -name '*.[ch]' -print -quit)" ]; then return 0; fi
    rm -rf "$dir"
    mkdir -p "$dir"
    for f in src/core/*.c; do
        one=$(object "$f" "$@") || return 1
        objects+=("$one")
    done
    $LINK -std=c99 $FP "$@" "${objects[@]}" $LINK_END -o "$dir/count" || return 1
    $SIZE "${objects[@]}" | awk 'NR > 1 { sum += $1 } END { print sum }' >"$dir/bytes"
}
export -f object
export -f build
export DIR FP WARN COMPILE LINK LINK_END SIZE
[ "$COUNT" = count_x86 ] || quiet_make "$B/cortexm/libcount.so"
# The compilers' words of each selection by itself, two at a time.
mkdir -p "$DIR/cache"
selections | xargs -P "$(nproc)" -I{} bash -c 'set -- {}; build "$@" >"$DIR/$1.log" 2>&1 || rm -f "$DIR/$1/bytes"'
while read -r name _; do
    [ -f "$DIR/$name/bytes" ] && continue
    fail "config: $name does not build without a warning:"
    grep -E 'error|warning' "$DIR/$name.log" | head -n 4
done < <(selections)
[ -f "$DIR/all/bytes" ] || exit 1

$COUNT "$DIR/all/count" "$DIR/all/counts" || fail "config: counting failed"
all=$(cat "$DIR/all/bytes")
[ "$(grep -c '^off:' "$DIR/all/counts")" -ge 15 ] || fail "config: the full build answers too few cases"
# judge NAME BYTES LEFT-OUT SWITCHED-OFF: fewer bytes, no more instructions (one in a thousand is the compiler's choice of
# registers: two of 10,697 were seen).
judge() {
    [ "$2" -lt "$all" ] || { echo "config: $1: $2 bytes, not below the $all of everything"; return 1; }
    [ -n "$3" ] || { echo "config: $1: its case was not answered"; return 1; }
    [ "$3" -le $(($4 + $4 / 1000)) ] || { echo "config: $1: $3 instructions per vertex, $4 when switched off at run time"; return 1; }
}
echo "figure: core, $NAME, everything: $all bytes"
while read -r name flags; do
    [ -f "$DIR/$name/bytes" ] || continue
    bytes=$(cat "$DIR/$name/bytes")
    case $name in
    all) ;;
    SKV_*)
        $COUNT "$DIR/$name/count" "$DIR/$name/counts" || fail "config: $name: counting failed"
        out=$(awk -v c="off:$name" '$1 == c { print $2 }' "$DIR/$name/counts")
        off=$(awk -v c="off:$name" '$1 == c { print $2 }' "$DIR/all/counts")
        judge "$name" "$bytes" "$out" "$off" || failed=1
        printf 'figure: %-32s %6d bytes (-%d), %5d instructions/vertex, %5d when switched off at run time\n' "$name" "$bytes" $((all - bytes)) "$out" "$off"
        ;;
    *) printf 'figure: %-32s %6d bytes (%s)\n' "$name" "$bytes" "${flags//-DSKV_/}" ;;
    esac
done < <(selections)
# The other way to select: a header of the product's own.
printf '#define SKV_BANDS 3\n#define SKV_TERM_OZONE 0\n' >"$G/product.h"
gcc -std=c99 -fsyntax-only $FP $WARN '-DSKV_CONFIG_FILE="product.h"' -I"$G" -Iinclude -Isrc src/core/model.c || fail "config: SKV_CONFIG_FILE"
# Samples that must fail: as many bytes, more instructions.
must_fail "a selection as large as everything" judge sample "$all" 1 1
must_fail "a selection that costs instructions" judge sample 1 1002 1000
must_fail "an unknown number of bands" gcc -fsyntax-only -Iinclude -DSKV_BANDS=5 -x c include/skyvert/config.h
must_fail "no rule at all" gcc -fsyntax-only -Iinclude -DSKV_RULE_UNIFORM=0 -DSKV_RULE_KELLER=0 -DSKV_RULE_GAUSS_EXP=0 -x c include/skyvert/config.h
[ $failed -eq 0 ]
