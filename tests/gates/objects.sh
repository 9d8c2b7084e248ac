#!/usr/bin/env bash
# What the core's objects may ask for and hold, read with nm and objdump: no allocation, no libm, no I/O, no double
# arithmetic, no writable data, no fused multiply-add. x86-64 (gcc, clang, with AVX2 and FMA allowed) and Cortex-M4F, M3.
. "$(dirname "$0")/lib.sh"

# symbols NM ALLOWED OBJECT...: undefined symbols that no object defines must be on the list of allowed ones.
symbols() {
    local nm=$1 allowed=$2
    shift 2
    "$nm" "$@" | awk -v allowed="^($allowed)\$" '
        NF == 2 && $1 == "U" { wanted[$2] = 1 }
        NF == 3 && $2 ~ /[TDRBCVW]/ { defined[$3] = 1 }
        NF == 3 && $2 ~ /[dDbBcCsSgG]/ { print "writable data: " $3; bad = 1 }
        END {
            for (s in wanted) if (!(s in defined) && s !~ allowed) { print "needs " s " from outside"; bad = 1 }
            exit bad
        }'
}

# sections OBJDUMP OBJECT...: no bytes in a writable section. (.data.rel.ro holds constant pointers.)
sections() {
    local objdump=$1
    shift
    "$objdump" -h "$@" | awk '
        $2 ~ /^\.(data|bss|tdata|tbss|sdata|sbss)/ && $2 !~ /^\.data\.rel\.ro/ && $3 !~ /^0+$/ { print "section " $2 " has 0x" $3 " bytes"; bad = 1 }
        END { exit bad }'
}

# instructions OBJDUMP PATTERN OBJECT...: none of the mnemonics. Only arithmetic, comparison and conversion count: moves
# and shuffles of 64-bit lanes (movsd, unpcklpd) work on any data.
instructions() {
    local objdump=$1 pattern=$2
    shift 2
    "$objdump" -d --no-show-raw-insn "$@" | awk -v p="^($pattern)\$" '
        /^[^ ].*:$/ { where = $0 }
        $1 ~ /^[0-9a-f]+:$/ && $2 ~ p { print where " " $0; if (++bad == 5) exit }
        END { exit bad > 0 }'
}
X86_DOUBLE='v?(add|sub|mul|div|sqrt|min|max|cmp[a-z]*|comi|ucomi|round|dp|hadd|addsub)[sp]d|v?cvt(t?)(ss2sd|sd2ss|ps2pd|pd2ps|si2sd|sd2si|pi2pd|dq2pd|pd2dq|pd2pi)[lqxy]?'
X86_X87='f(ld|st|stp|ild|ist|istp|add|sub|mul|div|sqrt|sin|cos|ptan|patan|yl2x|2xm1|chs|abs|com|comp|comi|ucomi)[a-z0-9]*'
X86_FUSED='vfn?m(add|sub)[a-z0-9]*'
ARM_WRONG='vfn?m[as]\.f32|v[a-z0-9]+(\.[usf0-9]+)?\.f64(\.[usf0-9]+)?'

# The compiler may ask a freestanding program for these three; nothing else. A part without FPU needs its float helpers.
FREE='memcpy|memset|memmove'
SOFT="$FREE|__aeabi_(f(add|sub|rsub|mul|div|cmpeq|cmplt|cmple|cmpge|cmpgt|cmpun|2iz|2uiz)|i2f|ui2f|mem(cpy|set|clr|move)[48]?|uidiv|idiv)"

x86_gate() {
    local rc=0
    symbols nm "$FREE" "$@" || rc=1
    sections objdump "$@" || rc=1
    instructions objdump "$X86_DOUBLE|$X86_X87|$X86_FUSED" "$@" || rc=1
    return $rc
}
arm_gate() {
    local rc=0
    symbols arm-none-eabi-nm "$1" "${@:2}" || rc=1
    sections arm-none-eabi-objdump "${@:2}" || rc=1
    instructions arm-none-eabi-objdump "$ARM_WRONG" "${@:2}" || rc=1
    return $rc
}

# objects_of FOLDER: those of the sources that are there now.
objects_of() {
    for source in src/*/*.c; do echo "$1/${source%.c}.o"; done
}
# must_say SAMPLE COMMAND...: the gate refuses it for the reason that the sample's line "Says:" names.
must_say() {
    local said
    if said=$("${@:2}"); then fail "the gate did not notice: $1"; fi
    grep -qE "$(sed -n 's|^// Says: ||p' "$1")" <<<"$said" || fail "$1 was refused for another reason: $said"
}
checked=0
if [ "$(uname -m)" = x86_64 ]; then
    quiet_make gates-objects
    for set in gcc clang; do
        mapfile -t objects < <(objects_of "$G/$set")
        x86_gate "${objects[@]}" || fail "x86-64, $set: see above"
        checked=$((checked + ${#objects[@]}))
    done
    for sample in tests/gates/bad/*.c; do
        bad=$G/bad-$(basename "$sample" .c).o
        gcc -std=c99 -O2 -mavx2 -mfma -ffp-contract=fast -fno-math-errno -c "$sample" -o "$bad" || fail "$sample does not compile"
        must_say "$sample" x86_gate "$bad"
    done
else
    echo "note: objects: x86-64 left out (this machine is a $(uname -m))"
fi
if have arm-none-eabi-gcc; then
    quiet_make cortexm-objects
    for board in m4f m3; do
        mapfile -t objects < <(objects_of "$B/cortexm/$board")
        if [ $board = m3 ]; then allowed=$SOFT; else allowed=$FREE; fi
        arm_gate "$allowed" "${objects[@]}" || fail "Cortex-M, $board: see above"
        checked=$((checked + ${#objects[@]}))
    done
    for sample in tests/gates/bad/*.c; do
        bad=$G/bad-m4f-$(basename "$sample" .c).o
        # shellcheck disable=SC2086
        arm-none-eabi-gcc -std=c99 -O2 $ARM -ffp-contract=fast -fno-math-errno -c "$sample" -o "$bad" || fail "$sample does not compile"
        must_say "$sample" arm_gate "$FREE" "$bad"
    done
else
    echo "note: objects: Cortex-M left out (package gcc-arm-none-eabi)"
fi
[ $checked -gt 0 ] || { echo "objects: nothing to check here"; exit 77; }
echo "note: objects: $checked core objects ask for nothing but memcpy, memset, memmove; $(ls tests/gates/bad/*.c | wc -l) bad samples refused"
[ $failed -eq 0 ]
