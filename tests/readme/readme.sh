#!/usr/bin/env bash
# The README's C example, as printed there, compiles without a warning with both compilers and prints a plausible sky; the
# files and targets that the README names are there.
set -u
B=${B:-build}
out=$B/tests/readme
mkdir -p "$out"
awk '/^```c$/{p=1;next} /^```$/{p=0} p' README.md >"$out/example.c"
[ -s "$out/example.c" ] || { echo "readme: no C example in README.md"; exit 1; }
for cc in "${CC:-cc}" clang; do
    command -v "$cc" >/dev/null || { echo "note: readme: no $cc"; continue; }
    $cc -std=c99 -Wall -Wextra -Wpedantic -Werror -Iinclude "$out/example.c" "$B/libskyvert.a" -o "$out/example" || exit 1
    "$out/example" >"$out/text" || { echo "readme: the example fails"; exit 1; }
    # r g b luminance of a blue noon zenith
    awk '{ok = NF == 4 && $3 > $2 && $2 > $1 && $1 > 0 && $4 > 300 && $4 < 8000} END {exit !ok}' "$out/text" ||
        { echo "readme: the example prints: $(cat "$out/text")"; exit 1; }
done
missing=0
for f in $(grep -oE '\]\([a-z][A-Za-z0-9_./-]*\)' README.md | tr -d '()]'); do
    [ -e "$f" ] || { echo "readme: $f is not there"; missing=1; }
done
for t in $(grep -oE '`make [a-z-]+' README.md | awk '{print $2}' | sort -u); do
    grep -qE "^$t:" Makefile port/*/build.mk tools/*/build.mk tests/*/build.mk || { echo "readme: no target $t"; missing=1; }
done
exit $missing
