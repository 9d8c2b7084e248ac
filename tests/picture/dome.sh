# Domes read by a PLY reader of its own: counts, winding, and colours that are those of a picture of the same sky.
. tests/picture/lib.sh

sky=(--sun-zenith-deg 50 --sun-azimuth-deg 120 --height-m 1000 --exposure 0.2)
for kind in even horizon adaptive; do
    works "$kind" "$skyvert" dome "${sky[@]}" --kind $kind --rings 8 --rings-below 3 --azimuths 12 --format ascii --out "$work/$kind.ply"
    same "$kind: vertices" "$(awk '/^element vertex/ { print $3 }' "$work/$kind.ply")" 122 # zenith, 10 rings of 12, nadir
    # Every vertex a unit vector, every triangle counter-clockwise seen from the centre, all of them a closed surface:
    # 2 faces fewer than twice the vertices, each edge met once in each direction.
    same "$kind: mesh" "$(awk '/^element vertex/ { v = $3 } /^element face/ { f = $3 } h && n < v { x[n] = $1; y[n] = $2; z[n] = $3
            l = $1 * $1 + $2 * $2 + $3 * $3; if (l < .999999 || l > 1.000001) bad++; n++; next }
        h { a = $2; b = $3; c = $4; e[a "," b]++; e[b "," c]++; e[c "," a]++; faces++
            d = x[a] * (y[b] * z[c] - z[b] * y[c]) + y[a] * (z[b] * x[c] - x[b] * z[c]) + z[a] * (x[b] * y[c] - y[b] * x[c]); if (d >= 0) wrong++ }
        /^end_header/ { h = 1; n = 0 } END { for (k in e) { split(k, p, ","); if (e[k] != 1 || e[p[2] "," p[1]] != 1) open++ }
            print "bad " bad + 0, "wrong " wrong + 0, "open " open + 0, "faces " faces - f, faces - 2 * v + 4 }' "$work/$kind.ply")" "bad 0 wrong 0 open 0 faces 0 0"
done

# Binary says the same as text: 3 floats, 3 bytes, 4 floats a vertex, little-endian.
works "binary" "$skyvert" dome "${sky[@]}" --kind adaptive --rings 8 --rings-below 3 --azimuths 12 --out "$work/b.ply"
head_bytes=$(($(grep -ab '^end_header' "$work/b.ply" | cut -d: -f1) + 11))
same "binary: size" "$(($(wc -c <"$work/b.ply") - head_bytes))" $((122 * 31 + 240 * 13))
one=$(tail -c +$((head_bytes + 1 + 31 * 40)) "$work/b.ply" | head -c 31)
same "binary: floats" "$(tail -c +$((head_bytes + 1 + 31 * 40)) "$work/b.ply" | head -c 12 | od -An -tf4 --endian=little | xargs printf '%.5f ')" \
    "$(awk '/^end_header/ { getline; for (i = 0; i < 40; i++) getline; print $1, $2, $3; exit }' "$work/adaptive.ply" | xargs printf '%.5f ')"
same "binary: bytes" "$(tail -c +$((head_bytes + 13 + 31 * 40)) "$work/b.ply" | head -c 3 | od -An -tu1 | xargs)" \
    "$(awk '/^end_header/ { getline; for (i = 0; i < 40; i++) getline; print $4, $5, $6; exit }' "$work/adaptive.ply")"

# The zenith's linear colour is that of a latlong picture's first row.
works "picture" "$skyvert" render --sun-zenith-deg 50 --sun-azimuth-deg 120 --height-m 1000 --projection latlong --size 8x5 --out "$work/p.exr"
want=$(oiiotool --dumpdata "$work/p.exr" | awk '/Pixel \(0, 0\)/ { print $4, $5, $6 }')
got=$(awk '/^end_header/ { getline; print $7, $8, $9; exit }' "$work/even.ply")
for i in 1 2 3; do near "zenith, channel $i" "$(cut -d' ' -f$i <<<"$got")" "$(cut -d' ' -f$i <<<"$want")" 1e-6; done
works "to the standard output" "$skyvert" dome "${sky[@]}" --out -
same "to the standard output" "$(head -n 1 "$work/stdout")" ply
finish
