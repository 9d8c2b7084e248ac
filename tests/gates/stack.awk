# The deepest chain of calls from each public function, by gcc's -fcallgraph-info=su. Prints `function bytes chain`.
# Recursion and stack of unknown size are errors.
/^node:/ {
    match($0, /title: "[^"]*"/)
    name = substr($0, RSTART + 8, RLENGTH - 9)
    if (match($0, /[0-9]+ bytes \([a-z,]+\)/)) {
        split(substr($0, RSTART, RLENGTH), part, " ")
        bytes[name] = part[1]
        if ($0 ~ /bytes \(dynamic\)/) { print "unbounded stack in " name; bad = 1 }
    }
}
/^edge:/ {
    match($0, /sourcename: "[^"]*"/)
    from = substr($0, RSTART + 13, RLENGTH - 14)
    match($0, /targetname: "[^"]*"/)
    to = substr($0, RSTART + 13, RLENGTH - 14)
    calls[from] = calls[from] SUBSEP to
}
function deepest(f,   list, n, i, most, d) {
    if (f in depth) return depth[f]
    if (f in active) { print "recursion in " f; bad = 1; return 0 }
    active[f] = 1
    most = 0
    n = split(substr(calls[f], 2), list, SUBSEP)
    for (i = 1; i <= n; i++) {
        d = deepest(list[i])
        if (d > most) { most = d; via[f] = list[i] }
    }
    delete active[f]
    return depth[f] = bytes[f] + most
}
END {
    for (f in bytes) if (f ~ /^skv_/) {
        total = deepest(f)
        chain = f
        for (g = via[f]; g != ""; g = via[g]) { short = g; sub(/.*:/, "", short); chain = chain ">" short }
        print f, total, chain
    }
    exit bad
}
