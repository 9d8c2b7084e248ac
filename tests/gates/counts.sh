# counts.sh: instructions per vertex of tests/gates/count.c. Sourced after lib.sh.
# count_x86 BINARY OUT: `name instructions-per-vertex` lines by callgrind.
count_x86() {
    local dir program
    dir=$(mktemp -d) program=$(realpath "$1")
    (cd "$dir" && valgrind --tool=callgrind --callgrind-out-file=cg "$program") >"$dir/cases" 2>"$dir/log" || { cat "$dir/log"; rm -rf "$dir"; return 1; }
    awk '/^desc: Trigger: Client Request:/ { sub(/.*Request: /, ""); name = $0 }
         /^(totals|summary):/ && name != "" { print name, $2; name = "" }' "$dir"/cg.* >"$dir/counts"
    per_vertex "$dir/cases" "$dir/counts" >"$2"
    rm -rf "$dir"
}
# count_m4f ELF OUT: the same by the QEMU plugin.
count_m4f() {
    local dir from to
    dir=$(mktemp -d)
    from=$(arm-none-eabi-nm "$1" | awk '$3 == "window_begin" { print "0x" $1 }')
    to=$(arm-none-eabi-nm "$1" | awk '$3 == "window_end" { print "0x" $1 }')
    bash port/cortexm/run.sh m4f "$1" -plugin "$B/cortexm/libcount.so,from=$from,to=$to,out=$dir/plain" >"$dir/cases" || { cat "$dir/cases"; rm -rf "$dir"; return 1; }
    awk 'NR == FNR { name[NR] = $1; next } { print name[FNR], $1 }' "$dir/cases" "$dir/plain" >"$dir/counts"
    per_vertex "$dir/cases" "$dir/counts" >"$2"
    rm -rf "$dir"
}
# per_vertex CASES COUNTS: less the empty window, divided by the vertices.
per_vertex() {
    awk 'NR == FNR { count[$1] = $2; next }
         $1 == "empty" { none = count[$1]; next }
         $1 in count { printf "%s %.0f\n", $1, (count[$1] - none) / $2 }' "$2" "$1"
}
