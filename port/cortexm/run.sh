#!/usr/bin/env bash
# run.sh BOARD ELF [QEMU-OPTION...]: runs a program on a QEMU board (m4f, m7, m3); its text on stdout, its exit status ours.
set -u
case "$1" in
m4f) machine=mps2-an386 ;;
m7) machine=mps2-an500 ;;
m3) machine=mps2-an385 ;;
*) echo "run.sh: board '$1': m4f, m7 or m3" >&2; exit 2 ;;
esac
elf=$2
shift 2
exec timeout 120 qemu-system-arm -M $machine -nographic -monitor none -serial none -chardev stdio,id=s \
    -semihosting-config enable=on,target=native,chardev=s -kernel "$elf" "$@" </dev/null
