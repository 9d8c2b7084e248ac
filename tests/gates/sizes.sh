#!/usr/bin/env bash
# Flash, stack, table bytes and instructions per vertex. Limits (DESIGN, README "Sizes"): the stack of skv_radiance() is at
# most 2 KiB on Cortex-M and 6 KiB on x86-64 (SSE2, what `make` builds), by the compiler's call graph and by painting the
# stack. The goal of 4 KiB is met without a table only: diffuse light holds 52 numbers a lane of the cells between it. With
# -mavx2 clang keeps every constant as a vector on the stack: 6.6 KiB.
. "$(dirname "$0")/lib.sh"
. "$(dirname "$0")/counts.sh"
X86_STACK=6144 AVX2_STACK=6784 CORTEX_M_STACK=2048 TABLE_STACK=3072
# within WHAT BYTES LIMIT
within() { [ -n "$2" ] && [ "$2" -le "$3" ] || { echo "sizes: $1: ${2:-no} bytes of stack, at most $3 allowed"; return 1; }; }
# call_graph FILE.ci...: the worst chain of each public function (gcc counts the return address in).
call_graph() { awk -f tests/gates/stack.awk "$@"; }
# stack_report NAME LIMIT GRAPH PAINTED
stack_report() {
    local worst graph
    if [ -s "$3" ]; then
        graph=$(awk '$1 == "skv_radiance" { print $2 }' "$3")
        within "$1, skv_radiance by the call graph ($(awk '$1 == "skv_radiance" { print $3 }' "$3"))" "$graph" "$2" || failed=1
        echo "figure: stack, $1, call graph: $(awk '/^skv_(radiance|model_build|frame_begin|table_step|frame_grid|irradiance|colour|sun_at|moon_at|dome_build|pack) / { printf "%s %d B  ", $1, $2 }' "$3")"
    fi
    grep '^failed' "$4" && failed=1
    worst=$(awk '$1 == "skv_radiance" && $3 > most { most = $3 } END { print most }' "$4")
    within "$1, skv_radiance, painted" "$worst" "$2" || failed=1
    # Building a table and a grid calls skv_radiance() with its rays, or its stages: TABLE_STACK on top of that.
    for call in skv_table_step skv_frame_grid skv_irradiance; do
        worst=$(awk -v call=$call '$1 == call && $3 > most { most = $3 } END { print most }' "$4")
        within "$1, $call, painted" "$worst" $(($2 + TABLE_STACK)) || failed=1
    done
    echo "figure: stack, $1, painted: $(awk '{ if ($3 > most[$1]) most[$1] = $3 } END { for (f in most) printf "%s %d B  ", f, most[f] }' "$4")"
}
counted() { # NAME FILE
    awk -v name="$1" '$1 !~ /^off:/ { printf "figure: instructions per vertex, %s: %-34s %d\n", name, $1, $2 }' "$2"
}
if [ "$(uname -m)" = x86_64 ]; then
    quiet_make gates-programs
    call_graph "$G"/gcc/src/*/*.ci >"$G/graph-x86.txt" || { cat "$G/graph-x86.txt"; failed=1; }
    "$G/gcc/stack" >"$G/stack-gcc.txt" && stack_report "x86-64 gcc AVX2" $AVX2_STACK "$G/graph-x86.txt" "$G/stack-gcc.txt" || failed=1
    "$G/clang/stack" >"$G/stack-clang.txt" && stack_report "x86-64 clang AVX2" $AVX2_STACK /dev/null "$G/stack-clang.txt" || failed=1
    "$G/cc/stack" >"$G/stack-cc.txt" && stack_report "this build's library" $X86_STACK /dev/null "$G/stack-cc.txt" || failed=1
    if have valgrind; then
        for cc in gcc clang; do count_x86 "$G/$cc/count" "$G/count-$cc.txt" && counted "x86-64 $cc AVX2" "$G/count-$cc.txt" || fail "sizes: callgrind failed"; done
    fi
fi
if have arm-none-eabi-gcc && have qemu-system-arm; then
    quiet_make cortexm-programs
    C=$B/cortexm/m4f
    call_graph "$C"/src/*/*.ci >"$G/graph-m4f.txt" || { cat "$G/graph-m4f.txt"; failed=1; }
    bash port/cortexm/run.sh m4f "$C/gates/stack.elf" >"$G/stack-m4f.txt" && stack_report "Cortex-M4F" $CORTEX_M_STACK "$G/graph-m4f.txt" "$G/stack-m4f.txt" || failed=1
    count_m4f "$C/gates/count.elf" "$G/count-m4f.txt" && counted "Cortex-M4F" "$G/count-m4f.txt" || fail "sizes: the plugin failed"
    for part in core scene; do
        arm-none-eabi-size "$C"/src/$part/*.o | awk -v part=$part 'NR > 1 { sum += $1 } END { printf "figure: flash, Cortex-M4F -O2, src/%s: %d bytes\n", part, sum }'
    done
    echo "figure: flash, Cortex-M4F -O2, the whole demo, no C library: $(arm-none-eabi-size "$C/demo.elf" | awk 'NR == 2 { print $1 " bytes, RAM " $2 + $3 " bytes beside the stack" }')"
    echo "figure: structs, Cortex-M4F, bytes: $(bash port/cortexm/run.sh m4f "$C/gates/sizes.elf" | paste -sd' ')"
else
    echo "note: sizes: Cortex-M left out (packages gcc-arm-none-eabi libnewlib-arm-none-eabi qemu-system-arm)"
fi
# Samples that must fail: a large frame by the call graph, recursion, a number over its limit.
if have gcc; then
    mkdir -p "$G/bad-stack"
    gcc -std=c99 -O1 -fcallgraph-info=su -c tests/gates/bad-stack/deep.c -o "$G/bad-stack/deep.o"
    gcc -std=c99 -O0 -fcallgraph-info=su -c tests/gates/bad-stack/recursive.c -o "$G/bad-stack/recursive.o"
    must_fail "a deep stack" within sample "$(call_graph "$G/bad-stack/deep.ci" | awk '$1 == "skv_radiance" { print $2 }')" $X86_STACK
    must_fail "recursion" call_graph "$G/bad-stack/recursive.ci"
fi
must_fail "a stack that was not measured" within sample "" 1
[ $failed -eq 0 ]
