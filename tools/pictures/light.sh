#!/usr/bin/env bash
# light.sh BUILD FOLDER: the sheets about all light. The path tracer's fisheyes take some minutes; what was traced once stays in
# BUILD/pictures.
set -eu
build=$1 folder=$2
here=tools/pictures air=tools/bench/br17o.ini side=48
mkdir -p "$build/pictures" "$folder"
traced=()
for sun in 0 60 80 85 88 90 92; do
    file=$build/pictures/fisheye-$sun.csv
    if [ ! -s "$file" ]; then
        awk -v side=$side -v sun=$sun -v height=0.1 -f $here/queries.awk >"$build/pictures/queries.csv"
        "$build/skyvert-reference" --atmosphere $air --orders all --ground lit --target-error 2% --state "$file.state" \
            <"$build/pictures/queries.csv" >"$file.part"
        rm -f "$file.state"
        mv "$file.part" "$file"
    fi
    traced+=("$file")
done
"$build/picture-views" "$folder"
echo "  $folder/fisheyes.png: path tracer, ours, error (red 5 %, yellow 10 %), luminance (red 32, yellow 1000, white 32000 cd/m2)"
"$build/picture-fisheyes" "$folder/fisheyes.png" $air $side "${traced[@]}"
