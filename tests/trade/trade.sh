# skyvert trade --quick end to end: rows, CSV, worst inputs replayed by skyvert eval, frontier, stop and resume, bad input.
. tests/command/lib.sh

out=$work/out
run /dev/null "$skyvert" trade --quick --out "$out"
[ $status -eq 0 ] || fails "a quick trade" "want status 0"
[ ! -s "$work/stderr" ] || fails "a quick trade" "want nothing on stderr"
cp "$work/stdout" "$work/text"
same "what is printed is kept" "$(cmp "$work/text" "$out/trade.txt" && echo same)" same
grep -q '^Metric: The error of a ray is ' "$work/text" || same "the metric in one sentence" none some
same "nothing half-written" "$(find "$out" -name '*.part*' -o -name '*.gp' -o -name 'cg*')" ""

# ---- rows of the quick subset, in both lights
for row in "uniform 8x8" "keller 4x4" fast standard high "single scattering, standard" "small, fast" "accurate, standard" "accurate, standard, grid"; do
    cases=$((cases + 1))
    [ "$(grep -Ec "^[ *]$row +[0-9]+ +[0-9.]+ +[0-9]+ +[0-9]+ \(" "$work/text")" -eq 1 ] || same "row '$row'" "$(grep -c "$row" "$work/text")" "one"
done

# ---- every line of the CSVs has every column; numbers are numbers; what callgrind counts is the same twice
cat >"$work/read.py" <<'END'
import csv, sys, xml.dom.minidom
folder, counted = sys.argv[1], sys.argv[2] == "yes"
rows = list(csv.DictReader(open(folder + "/trade.csv"), strict=True))
assert len(rows) == 9 * 9, len(rows)
texts = {"configuration", "kind", "light", "air", "sun", "height", "atmosphere", "eval_options"}
for row in rows:
    assert None not in row and None not in row.values(), row
    for name, value in row.items():
        if name in texts:
            assert value, (name, row)
        elif value == "":
            assert not counted and "instructions" in name, (name, row)
        else:
            assert float(value) >= 0, (name, value)
    assert float(row["error_mean_percent"]) <= float(row["error_p95_percent"]) <= float(row["error_max_percent"]) or row["rays"] == "18"
    assert float(row["vertex_ns_p10"]) <= float(row["vertex_ns_median"]) <= float(row["vertex_ns_p90"]), row
    if row["light"] == "full" and "single" not in row["configuration"]:
        assert 4000 < float(row["table_bytes"]) < 8192, row
assert len(list(csv.reader(open(folder + "/frontier.csv"), strict=True))) == 1 + 9 * 12
for name in ("pareto", "pareto-single", "pareto-full"):
    xml.dom.minidom.parse(folder + "/" + name + ".svg")
    assert open(folder + "/" + name + ".png", "rb").read(8) == b"\x89PNG\r\n\x1a\n", name
END
counted=no
command -v valgrind >/dev/null && counted=yes
run /dev/null python3 "$work/read.py" "$out" $counted
[ $status -eq 0 ] || fails "CSVs and pictures" "want that they are whole"

# ---- the frontier once more, by another program: nothing on it is beaten, everything beside it is (of equals the first stays)
awk '{ gsub(/"[^"]*"/, "x") } 1' "$out/frontier.csv" | awk -F, '
    NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
    $at["kind"] == "baseline-literal" || !$at["sees_ground"] { next }
    { n++; panel[n] = $1 "," $2 "," $3; cost[n] = $at["cost"] == "ns" ? $at["ns_per_vertex"] : $at["instructions_per_vertex"]
      error[n] = $at["error_mean_percent"]; on[n] = $at["on_frontier"]; marked += on[n] }
    END { for (i = 1; i <= n; i++) {
              beaten = 0
              for (k = 1; k <= n; k++)
                  if (panel[i] == panel[k] && cost[k] + 0 <= cost[i] + 0 && error[k] + 0 <= error[i] + 0 && (k < i || cost[k] + 0 < cost[i] + 0 || error[k] + 0 < error[i] + 0)) beaten = 1
              if (beaten == on[i]) print "line " i + 1 ": beaten " beaten ", marked " on[i] }
          if (!marked) print "no frontier"; print n " lines" }' >"$work/frontier"
same "the frontier" "$(cat "$work/frontier")" "108 lines"

# ---- the worst inputs give the same errors in skyvert eval
n=0
while IFS='|' read -r head options query truth scale; do
    n=$((n + 1))
    ini=${head##*: }
    printf 'altitude_km,sun_zenith_deg,view_zenith_deg,rel_azimuth_deg\n%s\n' "${query// /}" >"$work/query"
    # shellcheck disable=SC2086 # options are words
    does "replay of $head" "$work/query" "$skyvert" eval --atmosphere "${ini// /}" $options
    # Answers have nine digits, the error six.
    same "replay of $head" "$(awk -v got="$(tail -n 1 "$work/stdout")" -v truth="${truth# truth }" -v scale="${scale# scale }" -v want="${head%% *}" 'BEGIN {
        split(got, g, ","); m = split(truth, t, ",")
        for (i = 1; i <= m; i++) { d = g[4 + i] - t[i]; if (d < 0) d = -d; if (d > off) off = d }
        e = 100 * off / scale; print (e > want * .99998 && e < want * 1.00002 ? "same" : e " for " want) }')" same
done <"$out/worst.txt"
same "worst inputs" "$n" 9

# ---- stopped: the rows that were finished are kept, damaged lines are passed over, the results are the same
again=$work/again
quick="$skyvert trade --quick --instructions no --out $again"
for delay in .4 .8 1.6 3.2; do
    status=0
    setsid bash -c 'trap - INT; exec "$@"' start env --default-signal=INT $quick >"$work/stdout" 2>"$work/stderr" &
    pid=$!
    sleep $delay
    kill -INT $pid 2>/dev/null
    wait $pid || status=$?
    cases=$((cases + 1))
    [ -s "$again/trade.state" ] && break # the machine may be slow
done
if [ $status -ne 0 ]; then
    [ $status -eq 130 ] || fails "stopped" "want status 130"
    same "stopped: no results yet" "$(ls "$again" | grep -c csv)" 0
fi
[ "$(wc -l <"$again/trade.state")" -ge 2 ] || same "stopped: rows kept" "$(wc -l <"$again/trade.state")" "some"
tail -n 1 "$again/trade.state" | cut -c1-200 >>"$again/trade.state"
echo "0123456789abcdef 3 nonsense" >>"$again/trade.state"
run /dev/null $quick
[ $status -eq 0 ] && [ ! -s "$work/stderr" ] || fails "resumed" "want status 0 and nothing on stderr"
grep -q 'note: instructions were not counted' "$work/stdout" || same "without valgrind" "no note" "a note"
errors() { python3 -c 'import csv, sys; print([(r["configuration"], r["sun"], r["height"], r["error_mean_percent"], r["error_max_percent"]) for r in csv.DictReader(open(sys.argv[1]))])' "$1"; }
same "resumed: the same errors" "$(errors "$again/trade.csv" | cksum)" "$(errors "$out/trade.csv" | cksum)"
run /dev/null $quick
same "the third time nothing is left to do" "$(grep -o '[0-9]* taken over' "$work/stdout")" "9 taken over"
# Another program may give other results: what an older one kept does not count.
cp "$skyvert" "$work/other"
printf x >>"$work/other"
run /dev/null "$work/other" trade --quick --instructions no --out "$again"
[ $status -eq 0 ] || fails "another program" "want status 0"
same "another program takes nothing over" "$(grep -o "[0-9]* taken over" "$work/stdout")" "0 taken over"

# ---- bad input: status 2, one line, nothing written
refuses "no such option" 2 'unknown option --fast' /dev/null "$skyvert" trade --fast
refuses "threads" 2 '--threads 0: allowed is a whole number from 1 to 64' /dev/null "$skyvert" trade --threads 0
refuses "instructions" 2 '--instructions maybe: allowed is no or yes' /dev/null "$skyvert" trade --instructions maybe
refuses "an argument" 2 "unexpected argument 'fast'" /dev/null "$skyvert" trade fast
refuses "no name" 2 '--out' /dev/null "$skyvert" trade --out ""
echo file >"$work/file"
refuses "a file for a folder" 2 "$work/file: cannot be made a folder" /dev/null "$skyvert" trade --out "$work/file"
refuses "no truth there" 2 "$work/nowhere/tools/bench/br17o.ini" /dev/null "$skyvert" trade --quick --root "$work/nowhere" --out "$work/none"
mkdir -p "$work/root/tools/trade/truth" "$work/root/tools/bench"
cp tools/bench/br17o.ini "$work/root/tools/bench/"
head -n 60 tools/trade/truth/br17o.csv >"$work/root/tools/trade/truth/br17o.csv"
refuses "half a truth" 2 'br17o.csv:60: rays of a scene are missing' /dev/null "$skyvert" trade --quick --root "$work/root" --out "$work/none"
sed 's/^\(0,40,[^,]*,[^,]*\),/\1,nan/' tools/trade/truth/br17o.csv >"$work/root/tools/trade/truth/br17o.csv"
refuses "no numbers" 2 'br17o.csv:5: altitude, three angles' /dev/null "$skyvert" trade --quick --root "$work/root" --out "$work/none"
echo "figure: $(grep -c . "$out/trade.csv") lines, instructions counted: $counted"
finish
