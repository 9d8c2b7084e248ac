#!/usr/bin/env bash
# packages.sh FOLDER PACKAGE...: Debian's arm64 packages, unpacked into FOLDER/sysroot: the board's kernel, its programs and
# libraries, and what programs for it are linked with. PACKAGE/SUITE is one of another release, into FOLDER/SUITE. apt keeps lists, state and cache in FOLDER, with the sources of this
# machine: nothing of its own packages is touched. What was fetched is kept: with the same names nothing is done.
set -eu
folder=$1
shift
[ "$(cat "$folder/names" 2>/dev/null)" = "$*" ] && exit 0
mkdir -p "$folder/apt/state/lists/partial" "$folder/apt/cache/archives/partial"
folder=$(cd "$folder" && pwd)
: >"$folder/apt/status"
cat >"$folder/apt/conf" <<END
#clear APT::Update::Post-Invoke;
#clear APT::Update::Post-Invoke-Success;
#clear APT::Architectures;
APT::Architecture "arm64";
APT::Architectures { "arm64"; };
APT::Sandbox::User "";
Dir::State "$folder/apt/state";
Dir::State::status "$folder/apt/status";
Dir::Cache "$folder/apt/cache";
Acquire::Languages "none";
END
say() {
    echo "the board's packages: $*" >&2
}
apt() {
    "$@" >"$folder/apt.log" 2>&1 || {
        tail -n 20 "$folder/apt.log" >&2
        say "'$*' failed: the list of packages is RIG_PACKAGES in tests/rig/build.mk"
        exit 1
    }
}
# unpack INTO PACKAGE...
unpack() {
    local into=$1
    shift
    rm -rf "$into" "$folder/debs"
    mkdir -p "$folder/debs"
    (cd "$folder/debs" && apt apt-get -q download "$@")
    for deb in "$folder/debs/"*.deb; do
        dpkg -x "$deb" "$into"
    done
    rm -r "$folder/debs" # 60 MB that are no longer needed
}
export APT_CONFIG=$folder/apt/conf
own=() other=() suites=()
for package in "$@"; do
    case $package in */*) other+=("$package") && suites+=("${package#*/}") ;; *) own+=("$package") ;; esac
done
rm -f "$folder/names" "$folder/apt/other.list"
apt apt-get -q update
# linux-image-arm64 is an empty package that names the newest kernel.
kernel=$(apt-cache depends linux-image-arm64 | sed -n 's/^ *Depends: \(linux-image-[0-9].*\)$/\1/p' | head -n 1)
[ -n "$kernel" ] || { say "apt knows no linux-image-arm64"; exit 1; }
say "downloading for arm64, not installed here: $kernel $*"
unpack "$folder/sysroot" "$kernel" "${own[@]}"
# The other releases, from where this one comes.
from=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Component: main' 'Origin: Debian' | head -n 1)
keys=/usr/share/keyrings/debian-archive-keyring.gpg
for suite in $(printf '%s\n' "${suites[@]}" | sort -u); do
    echo "deb [signed-by=$keys] $from $suite main" >"$folder/apt/other.list"
    cat >>"$folder/apt/conf" <<END
Dir::Etc::sourcelist "$folder/apt/other.list";
Dir::Etc::sourceparts "/dev/null";
END
    apt apt-get -q update
    names=()
    for package in "${other[@]}"; do
        [ "${package#*/}" != "$suite" ] || names+=("${package%/*}")
    done
    unpack "$folder/$suite" "${names[@]}"
done
# Libraries are named by absolute links in -dev packages at times; and some files lie in /lib that the linker looks for in /usr/lib.
cp -rn "$folder/sysroot/lib/aarch64-linux-gnu/." "$folder/sysroot/usr/lib/aarch64-linux-gnu/" 2>/dev/null || true
echo "$*" >"$folder/names"
