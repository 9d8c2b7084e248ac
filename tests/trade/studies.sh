# skyvert trade --study NAME: files, pictures, a count of instructions, bad names.
. tests/command/lib.sh

out=$work/out
does "a quick study of domes" /dev/null "$skyvert" trade --study dome --quick --out "$out"
same "what is printed is kept" "$(cmp "$work/stdout" "$out/dome.txt" && echo same)" same
same "120 columns" "$(awk 'length > 120' "$out/dome.txt" | wc -l)" 0
# Two airs, six scenes, three domes of three sizes, two ways, with and without the sun's surroundings.
same "rows of the CSV" "$(awk -F, 'NR > 1 && NF == 12 && $8 > 0 && $8 + 0 <= $10 + 0' "$out/dome.csv" | wc -l)" $((2 * 6 * 3 * 3 * 2 * 2))
for air in br16 br17o; do
    same "picture of $air" "$(grep -c '<svg' "$out/dome-$air.svg")" 1
    same "picture of $air" "$(head -c 4 "$out/dome-$air.png" | tail -c 3)" PNG
done
same "nothing half-written" "$(find "$out" -name '*.part*' -o -name '*.gp' -o -name 'cg*')" ""

refuses "no such study" 2 "study.*ablation" /dev/null "$skyvert" trade --study night --out "$out"
refuses "no such root" 2 "nowhere" /dev/null "$skyvert" trade --study dome --root "$work/nowhere" --out "$out"

finish
