#!/usr/bin/env bash
# run.sh [TEST...]: boots arm64 boards under QEMU (each with two CAN controllers on one bus and a GPIO chip), runs these tests on
# them, and prints a verdict for each. Without names: all of guest/ but long_*. RIG_SECONDS: the time allowed for all of it;
# RIG_BOARDS: how many side by side (2).
#
# To add a test: write guest/NAME.sh (busybox sh; lib.sh has fail, host, wait_for, can_up, ...; hooks.py what `host` can do:
# turn an encoder, await a lamp); a line `# takes: N` says how many seconds it takes. Exit 0 passes, 77 skips with a last line that says why. A program for it is one line in a
# programs.mk: $(eval $(call RIG_PROGRAM,NAME,SOURCES,LIBS)) gives /bin/NAME on the board, RIG_SANITIZED /bin/NAME-san.
# By hand: make rig RIG_TESTS=NAME; what it wrote is in build/rig/all/board*/out/NAME/.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
guest=${RIG_GUEST:-$here/guest}
B=${B:-build}
name=${RIG_NAME:-all}
rig=$B/rig
job=$rig/$name
if [ $# -eq 0 ]; then
    for file in "$guest"/*.sh; do
        case $file in */long_*) ;; *) set -- "$@" "$file" ;; esac
    done
fi
[ -d "$rig/guest/bin" ] || { echo "run.sh: no $rig/guest/bin: make rig-build" >&2; exit 2; }
rm -rf "$job"
mkdir -p "$job/root"
root=$job/root
mkdir -p "$root"/{bin,lib,modules,rig,tests}
sys=$rig/sysroot
cross=${RIG_LIB:-/usr/aarch64-linux-gnu/lib}

cp "$here/init" "$root/init"
cp "$here/lib.sh" "$here/one.sh" "$root/rig/"
chmod +x "$root/init"
cp "$sys/bin/busybox" "$sys"/usr/bin/{candump,cansend,cangen,canplayer,cansequence,slcan_attach,gpioinfo,gpioget,gpioset,gpiomon} "$root/bin/"
cp "$sys/bin/ip" "$root/rig/" # by its path: for a bare ip the shell takes busybox's own
cp "$rig/guest/bin/"* "$root/bin/" 2>/dev/null || true
cp -r "$rig/guest/files" "$root/files" 2>/dev/null || true
# Libraries that some program names, and the libraries these name.
wanted=1
while [ $wanted -ne 0 ]; do
    wanted=0
    for lib in $(aarch64-linux-gnu-readelf -d "$root"/bin/* "$root"/rig/ip "$root"/lib/* 2>/dev/null | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p' | sort -u); do
        [ -e "$root/lib/$lib" ] && continue
        for from in "$cross" "$sys/usr/lib/aarch64-linux-gnu" "$rig"/*/usr/lib/aarch64-linux-gnu; do
            [ -e "$from/$lib" ] && cp -L "$from/$lib" "$root/lib/" && wanted=1 && break
        done
        [ -e "$root/lib/$lib" ] || { echo "run.sh: no arm64 library $lib: add its package to RIG_PACKAGES" >&2; exit 1; }
    done
done
# Modules in the order in which they can be loaded.
for module in 9pnet 9pnet_virtio netfs fscache 9p virtio_pci_modern_dev virtio_pci_legacy_dev virtio_pci virtio_console \
    can can-raw can-bcm can-dev vcan sja1000 kvaser_pci slcan; do
    file=$(find "$sys"/lib/modules/*/kernel -name "$module.ko" | head -n 1)
    [ -n "$file" ] || { echo "run.sh: the kernel has no module $module" >&2; exit 1; }
    cp "$file" "$root/modules/"
    echo "$module" >>"$root/modules/order"
done
cp "$guest"/*.sh "$root/tests/" # one may be made of another
tests=()
for test in "$@"; do
    test=$(basename "$test" .sh)
    [ -e "$guest/$test.sh" ] || { echo "run.sh: no test $guest/$test.sh" >&2; exit 2; }
    tests+=("$test")
done
# Not packed: unpacking under emulation costs more than it saves.
(cd "$root" && find . -print0 | LC_ALL=C sort -z | cpio --quiet --null -o -H newc -R 0:0) >"$job/initrd"
rm -rf "$root"
kernel=$(ls "$sys"/boot/vmlinuz-* | tail -n 1)
exec python3 -B "$here/rig.py" "$job" "${RIG_SECONDS:-500}" "${RIG_BOARDS:-2}" "$kernel" "$job/initrd" "$guest" "${tests[@]}"
