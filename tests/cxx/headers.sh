#!/usr/bin/env bash
# Each public header alone, twice in a row and after the others, as C99 and as C++11 with every warning an error; and a
# C++ program that links with the library.
. "$(dirname "$0")/../gates/lib.sh"
W="-Wall -Wextra -Wpedantic -Werror -Wundef -Wshadow -Wconversion -Wdouble-promotion"
checked=0
compile() { "$1" "${@:2}" $W -Iinclude -fsyntax-only -; }
for cc in gcc clang; do
    have $cc || { echo "note: headers: $cc is not there"; continue; }
    for header in include/skyvert/*.h; do
        name=skyvert/$(basename "$header")
        text=$(printf '#include "%s"\n#include "%s"\n' "$name" "$name")
        compile $cc -x c -std=c99 <<<"$text"$'\ntypedef int not_empty;' || fail "$name as C99, $cc"
        compile $cc -x c++ -std=c++11 -Wold-style-cast <<<"$text" || fail "$name as C++11, $cc"
        checked=$((checked + 1))
    done
    compile $cc -x c++ -std=c++20 <<<'#include "skyvert/skyvert.h"' || fail "skyvert.h as C++20, $cc"
done
[ $checked -gt 0 ] || { echo "headers: no compiler"; exit 77; }
# Samples that must fail: a header that is not C++, one that needs another before it.
must_fail "a header that is no C++" compile gcc -x c++ -std=c++11 <<<'static inline float f(float *restrict p) { return *p; }'
must_fail "a header that does not stand alone" compile gcc -x c -std=c99 <<<'size_t skv_size(void);'
for cxx in g++ clang++; do
    have $cxx || continue
    $cxx -std=c++11 $W -Iinclude tests/cxx/use.cc "$B/libskyvert.a" -o "$G/use-cxx" && "$G/use-cxx" || fail "use.cc with $cxx"
done
echo "note: headers: $checked compiled alone as C99 and as C++11"
[ $failed -eq 0 ]
