#!/usr/bin/env bash
# Seeded changes of an atmosphere file and of queries through the readers, built with the sanitizers.
cd "$(dirname "$0")/../.." || exit 1
B=${B:-build}
rounds=${ROUNDS:-8000}
for target in ini csv; do
    [ -x "$B/tests/command/fuzz_$target" ] || { echo "skipped: no $B/tests/command/fuzz_$target (package libinih-dev)" && exit 77; }
done
"$B/tests/command/fuzz_ini" "$rounds" tests/command/air.ini &&
    "$B/tests/command/fuzz_csv" "$rounds" tests/command/queries.csv
