# The trade's committed truth: the rays are those of its generator, and another seed gives the same light.
. tests/command/lib.sh
command -v "$B/skyvert-reference" >/dev/null || { echo "there is no $B/skyvert-reference: the truth is not traced again" && exit 77; }

for air in br16 br17o smoke; do
    file=tools/trade/truth/$air.csv
    generator=$(sed -n 's/^# queries: //p' "$file")
    same "$air: rays" "$(grep -v '^#' "$file" | tail -n +2 | cut -d, -f1-4 | awk -F, -v OFS=, '{ printf "%g,%g,%.4f,%.4f\n", $1, $2, $3, $4 }' | cksum)" \
        "$($generator </dev/null | tail -n +2 | cksum)"
    # Every 23rd ray with another seed to 2 %: four standard errors of both.
    { grep -v '^#' "$file" | head -n 1; grep -v '^#' "$file" | tail -n +2 | awk 'NR % 23 == 1'; } >"$work/some"
    run "$work/some" "$B/skyvert-reference" --orders all --ground lit --target-error 2% --max-paths 200000 --seed 77 --threads 1 --atmosphere tools/bench/$air.ini
    [ $status -eq 0 ] || fails "$air" "want status 0"
    same "$air: another seed" "$(paste -d, "$work/some" "$work/stdout" | awk -F, 'NR > 1 { for (b = 5; b <= 8; b++) {
        off = $b - $(b + 12); if (off < 0) off = -off; error = sqrt($(b + 4) ^ 2 + $(b + 16) ^ 2); n++
        if (off > 4 * error) print "line " NR ": " $b " and " $(b + 12) ", standard error " error } } END { print n " values" }')" "40 values"
done
finish
