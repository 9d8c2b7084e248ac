#!/usr/bin/env bash
# The protocol on a microcontroller: builds freestanding for Cortex-M4F and M3, needs nothing but memcpy, memset, memcmp and the
# compiler's own helpers, has no writable data, and stays within its flash. And how fast it is here.
set -u
B=${B:-build}
job=$B/can-micro
rm -rf "$job"
mkdir -p "$job/m4f" "$job/m3"
"$B/tests/can/speed" || exit 1
# The frame stands in two headers, as ports do not depend on one another: it is the same.
frame() { sed -n '/^#ifndef SKV_CAN_FRAME/,/^#endif/p' "$1"; }
[ -n "$(frame port/canaerospace/skv_canaerospace.h)" ] && diff <(frame port/canaerospace/skv_canaerospace.h) <(frame port/socketcan/skv_can_bus.h) || { echo "skv_can_frame differs in the two headers"; exit 1; }
command -v arm-none-eabi-gcc >/dev/null || { echo "CANaerospace for a microcontroller: no package gcc-arm-none-eabi"; exit 77; }
warn=(-Wall -Wextra -Wpedantic -Werror -Wconversion -Wdouble-promotion -Wfloat-conversion -Wshadow -Wstrict-prototypes -Wundef -Wno-type-limits)
cpu_m4f=(-mcpu=cortex-m4 -mthumb -mfloat-abi=hard -mfpu=fpv4-sp-d16)
cpu_m3=(-mcpu=cortex-m3 -mthumb)
for board in m4f m3; do
    declare -n cpu=cpu_$board
    for f in port/canaerospace/*.c; do
        arm-none-eabi-gcc "${cpu[@]}" -ffreestanding -std=c99 -Os -ffunction-sections -fdata-sections "${warn[@]}" -Iinclude -fstack-usage -c "$f" -o "$job/$board/$(basename "$f" .c).o" || exit 1
    done
done
# What the objects ask of others.
others=$(arm-none-eabi-nm -u "$job"/m4f/*.o | awk '$1 == "U" { print $2 }' | grep -vE '^(skv_|__aeabi_|memcpy$|memset$|memcmp$)' | sort -u)
[ -z "$others" ] || { echo "the protocol needs: $others"; exit 1; }
writable=$(arm-none-eabi-size "$job"/m4f/*.o | awk 'NR > 1 { n += $2 + $3 } END { print n }')
[ "$writable" = 0 ] || { echo "the protocol has $writable bytes of writable data"; exit 1; }
# Flash of a receiver, linked: with the helpers for double that an FPU of single precision lacks.
cat >"$job/node.c" <<'END'
#include "port/canaerospace/skv_canaerospace.h"
static skv_cas_receiver receiver;
static skv_cas_sender sender;
volatile double shown;
static skv_can_frame frame[2], reply;
static const skv_cas_identity self = {1, 1, 1};
void *memcpy(void *to, const void *from, unsigned n);
void *memset(void *to, int c, unsigned n);
void *memcpy(void *to, const void *from, unsigned n) {
    for (unsigned i = 0; i < n; i++)
        ((volatile char *)to)[i] = ((const char *)from)[i];
    return to;
}
void *memset(void *to, int c, unsigned n) {
    for (unsigned i = 0; i < n; i++)
        ((volatile char *)to)[i] = (char)c;
    return to;
}
int main(void) {
    double value;
    (void)skv_cas_receive(&receiver, &frame[0], 0);
    (void)skv_cas_tick(&receiver, 0);
    if (skv_cas_value(&receiver, SKV_CAS_LATITUDE, &value) == SKV_CAS_FRESH)
        shown = value;
    (void)skv_cas_identify(&frame[0], &self, &reply);
#ifdef SEND
    (void)skv_cas_encode(&sender, SKV_CAS_SUN_AZIMUTH, 0, shown, frame);
#else
    (void)sender;
#endif
    return 0;
}
END
link() {
    arm-none-eabi-gcc "${cpu_m4f[@]}" -std=c99 -Os -ffunction-sections -Iinclude -I. "$@" "$job/node.c" "$job"/m4f/*.o -nostdlib -lgcc \
        -Wl,--gc-sections -Wl,-e,main -o "$job/node.elf" && arm-none-eabi-size "$job/node.elf" | awk 'NR == 2 { print $1 + $2 }'
}
receiver=$(link) && both=$(link -DSEND) || exit 1
ram=$(arm-none-eabi-nm -S "$job/node.elf" | awk '$4 == "receiver" { print $2 }')
stack=$(awk '{ if ($2 > n) n = $2 } END { print n }' "$job"/m4f/*.su)
echo "figure: CANaerospace on Cortex-M4F, -Os, helpers for double included: receiver with identification $receiver bytes of flash, with sender $both, receiver state $((16#$ram)) bytes, largest frame of stack $stack bytes"
# 8 KiB: an eighth of the smallest part that holds the core.
[ "$both" -le 8192 ] || { echo "flash $both bytes, allowed 8192"; exit 1; }
[ "$stack" -le 256 ] || { echo "stack $stack bytes, allowed 256"; exit 1; }
