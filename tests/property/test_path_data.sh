#!/usr/bin/env bash
# The committed truth (tools/reference/data) is what the path tracer says now: some rays of each file, with other random
# numbers.
set -u
B=${B:-build}
ref=$B/skyvert-reference
[ -x "$ref" ] || { echo "test_path_data: no $ref (Debian: libinih-dev)"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
for data in tools/reference/data/*.csv; do
    ini=$(sed -n 's/^# skyvert-reference .*--atmosphere \([^ ]*\)$/\1/p' "$data")
    [ -f "$ini" ] || { echo "$data: names no atmosphere"; exit 1; }
    # Every 12th ray, from the 3rd on.
    grep -v '^#' "$data" | awk 'NR == 1 || NR % 12 == 4' >"$work/want"
    "$ref" --orders all --ground lit --target-error 1.5% --seed 99 --atmosphere "$ini" <"$work/want" >"$work/got" || exit 1
    # 8 rays of 4 correlated bands: five standard errors never by chance; their mean square is about 1.
    paste -d, "$work/want" "$work/got" | awk -F, -v data="$data" 'NR > 1 {
            for (k = 5; k <= 8; k++) {
                z = ($(k + 12) - $k) / sqrt($(k + 4) ^ 2 + $(k + 16) ^ 2)
                n++; sum += z * z
                if (z * z > 25) { print data ", ray " $1 "," $2 "," $3 "," $4 " band " k - 4 ": got " $(k + 12) ", want " $k ", apart " z " standard errors, allowed 5"; bad = 1 }
                if (!($(k + 4) <= .0031 * $k || $(k + 4) <= .02 * $k)) { print data ": standard error " $(k + 4) " of " $k; bad = 1 }
            }
        }
        END { printf "figure: %s: %d values again, mean square of difference over standard error %.2f\n", data, n, sum / n
            exit bad || n < 28 || sum / n > 3 }' || exit 1
done
