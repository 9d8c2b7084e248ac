#!/usr/bin/env bash
# deps.sh WHAT PACKAGE...: lists the Debian packages that are missing for `make WHAT` and installs them by apt as root or
# with sudo; otherwise prints the line to type. DEPS=no does nothing.
set -eu
what=$1
shift
[ "${DEPS:-yes}" = no ] && exit 0
command -v dpkg-query >/dev/null 2>&1 || { echo "make $what: no dpkg here; make sure these are installed: $*"; exit 0; }
missing=()
for p in "$@"; do
    dpkg-query -W -f '${Status}\n' "$p" 2>/dev/null | grep -q 'ok installed' || missing+=("$p")
done
[ ${#missing[@]} -eq 0 ] && exit 0
echo "make $what: missing packages: ${missing[*]}"
run=()
if [ "$(id -u)" -ne 0 ]; then
    if command -v sudo >/dev/null 2>&1 && { sudo -n true 2>/dev/null || [ -t 0 ]; }; then
        run=(sudo)
    else
        echo "make $what: install them as root, then again: apt-get install --no-install-recommends ${missing[*]}" >&2
        exit 1
    fi
fi
log=$(mktemp)
trap 'rm -f "$log"' EXIT
apt() { DEBIAN_FRONTEND=noninteractive "${run[@]}" apt-get -y -q "$@" >>"$log" 2>&1; }
apt install --no-install-recommends "${missing[@]}" || { apt update && apt install --no-install-recommends "${missing[@]}"; } || {
    tail -n 20 "$log" >&2
    echo "make $what: apt-get failed; try: apt-get install --no-install-recommends ${missing[*]}" >&2
    exit 1
}
