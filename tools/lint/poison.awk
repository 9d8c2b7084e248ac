# Words that must not appear in the core and its headers: double, the heap, stdio, libm, errno, clocks, assembler.
# Comments and strings do not count.
function clean(line,   out) {
    out = ""
    while (line != "") {
        if (inside) {
            if (!match(line, /\*\//)) return out
            line = substr(line, RSTART + 2)
            inside = 0
        } else if (match(line, /\/\*|\/\/|"([^"\\]|\\.)*"/)) {
            out = out substr(line, 1, RSTART - 1) " "
            what = substr(line, RSTART, 2)
            if (what == "//") return out
            if (what == "/*") { inside = 1; line = substr(line, RSTART + 2) } else line = substr(line, RSTART + RLENGTH)
        } else return out line
    }
    return out
}
function refuse(what) {
    printf "%s:%d: %s\n", FILENAME, FNR, what
    bad = 1
}
BEGIN {
    n = split("double malloc calloc realloc free alloca printf fprintf sprintf snprintf puts fputs putchar fopen fwrite fread FILE stdin stdout stderr errno time clock rand srand getenv exit abort setjmp longjmp signal asm __asm __asm__ _Thread_local __thread goto", words, " ")
    for (i = 1; i <= n; i++) poison[words[i]] = 1
    n = split("sin cos tan asin acos atan atan2 sinh cosh tanh exp exp2 expm1 log log2 log10 log1p pow sqrt cbrt hypot fabs floor ceil trunc round rint lrint nearbyint fmod fmin fmax fma ldexp frexp modf copysign erf erfc isnan isinf isfinite", words, " ")
    for (i = 1; i <= n; i++) { libm[words[i]] = 1; libm[words[i] "f"] = 1 }
}
FNR == 1 { inside = 0 }
{
    line = clean($0)
    if (line ~ /^[ \t]*#[ \t]*(include|error|pragma)/) next
    rest = line
    while (match(rest, /[A-Za-z_][A-Za-z0-9_]*/)) {
        word = substr(rest, RSTART, RLENGTH)
        before = RSTART > 1 ? substr(rest, RSTART - 1, 1) : " "
        rest = substr(rest, RSTART + RLENGTH)
        if (before ~ /[0-9.>]/) continue
        if (word in poison || word in libm && rest ~ /^[ \t]*\(/) refuse(word)
    }
    # A constant with a point or an exponent and no f is a double.
    rest = " " line
    while (match(rest, /[^A-Za-z0-9_.]([0-9]+\.[0-9]*|\.[0-9]+|[0-9]+[eE])([eE]?[-+]?[0-9]+)?[A-Za-z_]*/)) {
        number = substr(rest, RSTART + 1, RLENGTH - 1)
        if (number !~ /[fF]$/) refuse("constant " number " is a double: write f behind it")
        rest = substr(rest, RSTART + RLENGTH)
    }
    rest = " " line
    while (match(rest, /[^A-Za-z0-9_.]0[xX][0-9A-Fa-f.]*[pP][-+]?[0-9]+[A-Za-z_]*/)) {
        number = substr(rest, RSTART + 1, RLENGTH - 1)
        if (number !~ /[fF]$/) refuse("constant " number " is a double: write f behind it")
        rest = substr(rest, RSTART + RLENGTH)
    }
}
END { exit bad }
