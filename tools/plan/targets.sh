# shellcheck shell=bash
# The planner's targets: how a program is built with a header on each and how instructions are counted. Sourced from the root,
# with B set (make's build folder); functions are exported for xargs.
B=${B:-build} MAKE=${MAKE:-make}
FP="-ffp-contract=off -fno-math-errno -fno-trapping-math"
PLAN_BOARD=$B/plan-board.ld

# targets_need TARGET...: says which package is missing. Status 1 then.
targets_need() {
    local t
    for t in "$@"; do
        case $t in
        x86-*) need_command gcc gcc && need_command valgrind valgrind || return 1 ;;
        cortex-a53) need_command aarch64-linux-gnu-gcc "gcc-aarch64-linux-gnu libc6-dev-arm64-cross" && need_command qemu-aarch64 qemu-user || return 1 ;;
        *) need_command arm-none-eabi-gcc "gcc-arm-none-eabi libnewlib-arm-none-eabi" && need_command qemu-system-arm qemu-system-arm || return 1 ;;
        esac
    done
}
need_command() { command -v "$1" >/dev/null || { echo "the program $1 is missing (apt-get install $2)"; return 1; }; }
# targets_begin: what is shared by all.
targets_begin() {
    mkdir -p "$B"
    env -u MAKEFLAGS -u MFLAGS -u MAKELEVEL "$MAKE" --no-print-directory -s DEPS=no B="$B" "$B/cortexm/libcount.so"
    # The boards have megabytes of RAM; tables and whole domes take more than the 64 KiB of the port's own script.
    sed -e 's/LENGTH = 64K/LENGTH = 1M/' -e '/ASSERT(LENGTH/d' port/cortexm/cortexm.ld >"$PLAN_BOARD"
}
target_compiler() {
    case $1 in
    x86-avx2) echo "gcc -O3 -mavx2" ;;
    x86-sse2) echo "gcc -O3" ;;
    cortex-m4f) echo "arm-none-eabi-gcc -O2 -mcpu=cortex-m4 -mthumb -mfloat-abi=hard -mfpu=fpv4-sp-d16 -ffunction-sections -fdata-sections" ;;
    cortex-m7) echo "arm-none-eabi-gcc -O2 -mcpu=cortex-m7 -mthumb -mfloat-abi=hard -mfpu=fpv5-sp-d16 -ffunction-sections -fdata-sections" ;;
    cortex-a53) echo "aarch64-linux-gnu-gcc -O2 -mcpu=cortex-a53" ;;
    esac
}
# target_build TARGET DIR SOURCE NAME: core objects and the program DIR/NAME, with DIR/skv_config.h.
# shellcheck disable=SC2046,SC2086
target_build() {
    local dir=$2 cc flags f
    cc=$(target_compiler "$1")
    flags="-std=c99 $FP -DSKV_CONFIG_FILE=\"skv_config.h\" -I$dir -I. -Iinclude"
    for f in src/core/*.c; do
        case $f in */colour.c | */irradiance.c) continue ;; esac
        $cc $flags -Isrc -c "$f" -o "$dir/$(basename "$f" .c).o" || return 1
    done
    case $1 in
    x86-*) $cc $flags -D_POSIX_C_SOURCE=200809L "$3" "$dir"/*.o -lm -o "$dir/$4" ;;
    cortex-a53) $cc $flags -D_POSIX_C_SOURCE=200809L -static "$3" "$dir"/*.o -lm -o "$dir/$4" ;;
    *) $cc $flags -Iport/cortexm "$3" port/cortexm/start.c port/cortexm/semihosting.c port/cortexm/newlib.c "$dir"/*.o \
        -nostartfiles -Wl,-T,"$PLAN_BOARD" -Wl,--gc-sections -Wl,--no-warn-rwx-segments -lm -o "$dir/$4" ;;
    esac
}
target_symbol() { "$1" "$2" | awk -v n="$3" '$3 == n { print "0x" $1 }'; }
# target_count TARGET DIR NAME: runs DIR/NAME; its text in DIR/lines, the instructions of each window in DIR/counts.
target_count() {
    local dir=$2 nm=arm-none-eabi-nm plugin
    case $1 in
    x86-*)
        rm -f "$dir"/cg*
        (cd "$dir" && valgrind --tool=callgrind --callgrind-out-file=cg "./$3" >lines 2>log) || { tail -n 3 "$dir/log" >&2; return 1; }
        awk '/^desc: Trigger: Client Request:/ { sub(/.*Request: /, ""); name = $0 }
             /^(totals|summary):/ && name != "" { print name, $2; name = "" }' "$dir"/cg.* | sort -n | cut -d' ' -f2 >"$dir/counts"
        rm -f "$dir"/cg*
        return 0
        ;;
    cortex-a53) nm=aarch64-linux-gnu-nm ;;
    esac
    plugin="$B/cortexm/libcount.so,from=$(target_symbol $nm "$dir/$3" window_begin),to=$(target_symbol $nm "$dir/$3" window_end),out=$dir/counts"
    case $1 in
    cortex-a53) qemu-aarch64 -plugin "$plugin" "$dir/$3" >"$dir/lines" ;;
    *) bash port/cortexm/run.sh "${1#cortex-}" "$dir/$3" -plugin "$plugin" >"$dir/lines" ;;
    esac
}
# target_bytes TARGET DIR LEFT-OUT: of all core objects but these (and those that a product need not link).
target_bytes() {
    local size=size
    case $1 in cortex-a53) size=aarch64-linux-gnu-size ;; cortex-m*) size=arm-none-eabi-size ;; esac
    $size "$2"/*.o | awk -v out="^($3|work|presets)\\\\.o$" 'NR > 1 { f = $6; sub(/.*\//, "", f); if (f !~ out) sum += $1 + $2 } END { print sum }'
}
export B FP PLAN_BOARD
export -f target_compiler target_build target_symbol target_count target_bytes
