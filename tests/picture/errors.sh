# What render, track and dome refuse: one line on stderr, status 2 (1 for a failed job), and nothing written.
. tests/picture/lib.sh

mkdir "$work/d"
cd "$work/d" || exit 1
r=(render --lat 47 --lon 8 --utc 2024-03-20T12:00:00Z --size 4x4 --projection latlong)
none=/dev/null
no() { refuses "$1" "$2" "$3" $none "$skyvert" "${@:4}"; }

no "no output" 2 '^skyvert render: --out' "${r[@]}"
no "ending" 2 '\.exr or \.png' "${r[@]}" --out x.jpg
no "ending only" 2 '\.exr or \.png' "${r[@]}" --out .png
no "lat 91" 2 '--lat.*-90.*90' render --lat 91 --lon 8 --utc 2024-03-20T12:00:00Z --out x.exr
no "lat NaN" 2 '--lat' render --lat nan --lon 8 --utc 2024-03-20T12:00:00Z --out x.exr
no "lon" 2 '--lon.*360' render --lat 1 --lon 361 --utc 2024-03-20T12:00:00Z --out x.exr
no "lat alone" 2 '--lat and --lon' render --lat 1 --utc 2024-03-20T12:00:00Z --out x.exr
no "position" 2 '--position' render --position "91:0:0N 8:0:0E" --utc 2024-03-20T12:00:00Z --out x.exr
no "position twice" 2 'not both' "${r[@]}" --position "1 2" --out x.exr
no "date" 2 "--utc '2021-02-29.*day" render --lat 1 --lon 1 --utc 2021-02-29T00:00:00Z --out x.exr
no "date words" 2 "--utc 'yesterday'.*ISO" render --lat 1 --lon 1 --utc yesterday --out x.exr
no "no time" 2 'when' render --lat 1 --lon 1 --out x.exr
no "no place" 2 'where' render --utc 2024-03-20T12:00:00Z --out x.exr
no "height" 2 '--height-m' "${r[@]}" --height-m 1e30 --out x.exr
no "datum" 2 '--height-datum' "${r[@]}" --height-m 1 --height-datum agl --out x.exr
no "datum without a place" 2 'needs a position' render --sun-zenith-deg 1 --height-m 1 --height-datum ellipsoid --out x.exr
no "projection" 2 '--projection.*fisheye' "${r[@]}" --projection cube --out x.exr
for size in 1x1 4 4x x4 axb 4x4x4 100000x4 -4x4 16384x16384 4.5x4; do no "size $size" 2 '--size' "${r[@]}" --size $size --out x.exr; done
no "fov" 2 '--fov-deg' render --sun-zenith-deg 1 --projection perspective --fov-deg 171 --out x.exr
no "fov of a latlong" 2 '--fov-deg' "${r[@]}" --fov-deg 90 --out x.exr
no "exposure" 2 '--exposure' "${r[@]}" --exposure -1 --out x.png
no "exposure words" 2 '--exposure' "${r[@]}" --exposure bright --out x.png
no "preset" 2 '--preset.*earth-clear' "${r[@]}" --preset venus --out x.exr
no "bands" 2 '--bands.*3.*4' "${r[@]}" --bands 5 --out x.exr
no "tier" 2 '--tier' "${r[@]}" --tier best --out x.exr
no "samples" 2 '--samples' "${r[@]}" --samples 65 --out x.exr
no "samples of gauss-exp" 2 '--samples 17.*2 to 16' "${r[@]}" --samples 17 --out x.exr
no "orders" 2 '--orders two: allowed is single or all' "${r[@]}" --orders two --out x.exr
no "table" 2 '--table huge: allowed is accurate, small or large' "${r[@]}" --table huge --out x.exr
no "grid" 2 '--grid maybe: allowed is off, on or auto' "${r[@]}" --grid maybe --out x.exr
no "discs" 2 '--discs auto: allowed is off or on' "${r[@]}" --discs auto --out x.exr
no "moon" 2 '--moon full: allowed is off, on or auto' "${r[@]}" --moon full --out x.exr
no "moon nowhere" 2 '--moon on: where.*--moon-zenith-deg' render --sun-zenith-deg 100 --moon on --out x.exr
no "moon zenith" 2 '--moon-zenith-deg.*180' "${r[@]}" --moon-zenith-deg 181 --out x.exr
no "moon's azimuth alone" 2 '--moon-azimuth-deg goes with --moon-zenith-deg' "${r[@]}" --moon-azimuth-deg 1 --out x.exr
no "night" 2 '--night dark: allowed is off, on or auto' "${r[@]}" --night dark --out x.exr
no "wind" 2 '--wind-m-s.*0 to 40' "${r[@]}" --ground water --wind-m-s 41 --out x.exr
no "wind's azimuth" 2 '--wind-azimuth-deg.*360' "${r[@]}" --ground water --wind-azimuth-deg 361 --out x.exr
no "kind of ground" 2 '--ground sand: allowed is none, lit, land or water' "${r[@]}" --ground sand --out x.exr
no "ground" 2 '--ground-m' "${r[@]}" --ground-m 13000 --out x.exr
no "ground over the air" 2 'below the top' render --sun-zenith-deg 1 --preset tiny --ground-m 12000 --out x.exr
no "png bits" 2 '--png-bits' "${r[@]}" --png-bits 10 --out x.png
no "atmosphere" 2 'nowhere.ini' "${r[@]}" --atmosphere nowhere.ini --out x.exr
no "sun" 2 '--sun-zenith-deg' render --sun-zenith-deg 181 --out x.exr
no "sun's azimuth alone" 2 '--sun-zenith-deg' "${r[@]}" --sun-azimuth-deg 1 --out x.exr
no "unknown option" 2 '--colour' "${r[@]}" --colour --out x.exr
no "option without a value" 2 '--out' "${r[@]}" --out
no "left over" 2 'extra' "${r[@]}" --out x.exr extra
no "no folder" 2 'nowhere/x.exr' "${r[@]}" --out nowhere/x.exr
mkdir folder.exr
no "a folder with the ending" 2 'folder' "${r[@]}" --out folder.exr
rmdir folder.exr
leaves "nothing is left" .

# ---- tracks
head='utc,lat_deg,lon_deg,height_m'
csv() { printf '%s\n' "${@:4}" >../t.csv; no "$1" "$2" "$3" track ../t.csv --every 60s --size 4x4 --out out; }
igc() { printf '%s\n' "${@:4}" >../t.igc; no "$1" "$2" "$3" track ../t.igc --every 60s --size 4x4 --out out; }
ok='2024-03-20T12:00:00Z,47,8,500'
csv "empty track" 2 't.csv.*empty track' "$head"
csv "date" 2 't.csv:3:.*utc' "$head" "$ok" 2024-02-30T12:00:00Z,47,8,500
csv "lat 91" 2 't.csv:2:.*lat_deg.*-90 to 90' "$head" 2024-03-20T12:00:00Z,91,8,500
csv "lon" 2 't.csv:2:.*lon_deg' "$head" 2024-03-20T12:00:00Z,47,-181,500
csv "height" 2 't.csv:2:.*height_m' "$head" 2024-03-20T12:00:00Z,47,8,high
csv "height infinite" 2 't.csv:2:.*height_m' "$head" 2024-03-20T12:00:00Z,47,8,inf
csv "backwards" 2 't.csv:3:.*backwards in time: 2024-03-20T11:59:59Z after 2024-03-20T12:00:00Z' "$head" "$ok" 2024-03-20T11:59:59Z,47,8,500
csv "short row" 2 't.csv:2:' "$head" 2024-03-20T12:00:00Z,47
csv "column missing" 2 't.csv:1:.*height_m' utc,lat_deg,lon_deg "$ok"
csv "too many steps" 2 'at most 100000' "$head" "$ok" 2034-03-20T12:00:00Z,47,8,500
: >../t.csv
no "empty file" 2 't.csv' track ../t.csv --every 60s --out out
no "no file" 2 'nothing.csv.*No such file' track nothing.csv --every 60s --out out
no "a folder" 2 'directory' track . --every 60s --out out
no "no flight" 2 'FLIGHT' track --every 60s --out out
printf '%s\n' "$head" "$ok" >../t.csv
if [ "$(id -u)" = 0 ] && command -v setpriv >/dev/null; then
    chmod 711 .. && chmod 000 ../t.csv && chmod 777 .
    refuses "unreadable" 2 't.csv.*Permission denied' $none setpriv --reuid 65534 --regid 65534 --clear-groups "$skyvert" track ../t.csv --every 60s --out out
    chmod 644 ../t.csv && chmod 755 .
fi
no "no step" 2 '--every' track ../t.csv --out out
for every in 0 -5s 60x s 1e3s 25h 60ss ''; do no "every '$every'" 2 '--every' track ../t.csv --every "$every" --out out; done
no "no out" 2 '--out' track ../t.csv --every 60s
: >file
no "out is a file" 2 'a file has that name' track ../t.csv --every 60s --out file
rm file
no "out below nothing" 2 'nowhere/out' track ../t.csv --every 60s --out nowhere/out
no "igc altitude" 2 '--igc-altitude' track ../t.csv --every 60s --out out --igc-altitude radar
b='B1200004730000N00830000EA0050000548'
igc "no date" 2 't.igc:1:.*date' "$b"
igc "bad date" 2 't.igc:1:.*HFDTE' HFDTE320121 "$b"
igc "no fixes" 2 'empty track' HFDTE310121
igc "short record" 2 't.igc:2:' HFDTE310121 B1200004730000N
igc "time" 2 't.igc:2:.*time' HFDTE310121 B1260004730000N00830000EA0050000548
igc "latitude" 2 't.igc:2:.*latitude' HFDTE310121 B1200009100000N00830000EA0050000548
igc "minutes" 2 't.igc:2:.*latitude' HFDTE310121 B1200004760000N00830000EA0050000548
igc "longitude" 2 't.igc:2:.*longitude' HFDTE310121 B1200004730000N18100000EA0050000548
igc "validity" 2 't.igc:2:.*validity' HFDTE310121 B1200004730000N00830000EX0050000548
igc "backwards" 2 't.igc:3:.*backwards' HFDTE310121 "$b" B1159594730000N00830000EA0050000548
leaves "nothing is left by tracks" .

# ---- domes
d=(dome --sun-zenith-deg 40)
no "dome without out" 2 '--out' "${d[@]}"
no "rings" 2 '--rings' "${d[@]}" --rings 1 --out x.ply
no "azimuths" 2 '--azimuths' "${d[@]}" --azimuths 2 --out x.ply
no "kind" 2 '--kind' "${d[@]}" --kind round --out x.ply
no "lowest over the horizon" 2 '--lowest-deg' "${d[@]}" --height-m 100000 --rings-below 3 --lowest-deg -1 --out x.ply
no "format" 2 '--format' "${d[@]}" --format obj --out x.ply
no "dome on a full device" 1 '/dev/full.*No space' "${d[@]}" --out /dev/full
leaves "nothing is left by domes" .
finish
