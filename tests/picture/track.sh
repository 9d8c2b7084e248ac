# Flights: what the CSV of `skyvert track` says about fixes written by hand, and the project's sample flight.
. tests/picture/lib.sh

small=(--size 4x4 --projection latlong)
rows() { tail -n +2 "$work/t/track.csv" | cut -d, -f"$1"; }
track() { rm -rf "$work/t"; works "$1" "$skyvert" track "${@:2}" "${small[@]}" --out "$work/t"; }

# ---- the sample flight: a picture a step, a sheet, a table whose sun is that of `skyvert sun --csv`
flight=tools/flight/dusk-lszh-loww.csv
rm -rf "$work/t"
works "sample" "$skyvert" track $flight --every 10min --size 32x32 --out "$work/t"
same "sample: files" "$(ls "$work/t" | wc -l)" 8 # 56 minutes: six pictures, sheet, table
has "sample: sheet" "$(pngcheck "$work/t/contact-sheet.png")" "24-bit RGB"
has "sample: names" "$(ls "$work/t")" "sky-00001-20240320T170900Z.exr"
{ echo utc,lat_deg,lon_deg,height_m; rows 1-4; } >"$work/again.csv"
"$skyvert" sun --csv <"$work/again.csv" >"$work/sun.csv" 2>/dev/null
[ -s "$work/sun.csv" ] || same "skyvert sun --csv answers" nothing rows
column() { awk -F, -v name="$1" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == name) k = i; next } { print $k }' "$2"; }
same "sample: azimuths" "$(rows 5 | xargs printf '%.2f ')" "$(column sun_azimuth_deg "$work/sun.csv" | xargs printf '%.2f ')"
same "sample: elevations" "$(rows 6 | xargs printf '%.2f ')" "$(column sun_elevation_deg "$work/sun.csv" | xargs printf '%.2f ')"
same "sample: dusk falls" "$(rows 7)" "$(rows 7 | sort -gr)"
for f in "$work"/t/*.exr; do has "$f" "$(oiiotool --info "$f" 2>&1)" "32 x   32, 4 channel, float openexr"; done
has "sample: altitude of a picture" "$(exrheader "$work/t/sky-00000-20240320T165900Z.exr")" "altitude (type float): 432"

# ---- between fixes: great circle over the date line and over the pole, heights linear, half a step left over
printf 'height_m,utc,lon_deg,lat_deg,more\n0,2024-03-20T12:00:00Z,179,0,x\n1000,2024-03-20T12:01:30Z,-179,0,y\n' >"$work/f.csv"
track "date line" "$work/f.csv" --every 45s
same "date line" "$(rows 2-4)" "$(printf '0.0000000,179.0000000,0.00\n0.0000000,180.0000000,500.00\n0.0000000,-179.0000000,1000.00')"
printf 'utc,lat_deg,lon_deg,height_m\n2024-03-20T12:00:00Z,89,0,0\n2024-03-20T12:00:10Z,89,180,0\n' >"$work/f.csv"
track "pole" "$work/f.csv" --every 2.5
near "pole: quarter" "$(rows 2 | sed -n 2p)" 89.5 1e-6
near "pole" "$(rows 2 | sed -n 3p)" 90 1e-6
printf 'utc,lat_deg,lon_deg,height_m\r\n2024-03-20T12:00:00Z,50,10,-400\r\n\r\n2024-03-20T12:00:00Z,50,10,-400\r\n2024-03-20T12:01:30Z,50,10,-400' >"$work/f.csv"
track "CRLF, blank line, the same moment twice, below the sea" "$work/f.csv" --every 1min --ground-m -420
same "whole steps only" "$(rows 1 | xargs)" "2024-03-20T12:00:00Z 2024-03-20T12:01:00Z"
printf 'utc,lat_deg,lon_deg,height_m\n2024-03-20T12:00:00Z,50,10,500\n' >"$work/f.csv"
track "one fix" "$work/f.csv" --every 1h
same "one fix" "$(rows 4)" 500.00
# Heights above the ellipsoid: at 16:46:33N 3:00:34W the geoid lies 28.708 m over it (GeographicLib's example, EGM96).
printf 'utc,lat_deg,lon_deg,height_m\n2024-03-20T12:00:00Z,16.775833,-3.009444,1000\n' >"$work/f.csv"
track "ellipsoid" "$work/f.csv" --every 1h --height-datum ellipsoid
near "ellipsoid" "$(rows 4)" 971.29 0.02 # two decimals, and the grid's steps

# ---- IGC: midnight, a fix without GNSS altitude, one without a position, other records, dates in both forms
cat >"$work/f.igc" <<'END'
AXXX001
HFDTEDATE:311220,01
HFDTM100GPSDATUM:WGS-84
I013638FXA
B2359504730000N00830000EA0050000548020
LXXXsome text
B2359553030000S17059999WV0051000000010
B2359580000000N00000000EV0000000000999
B0000054730600N00831000EA0052000568020
E000005PEV
END
track "igc" "$work/f.igc" --every 5s
same "igc: midnight" "$(rows 1 | xargs)" "2020-12-31T23:59:50Z 2020-12-31T23:59:55Z 2021-01-01T00:00:00Z 2021-01-01T00:00:05Z"
same "igc: latitude" "$(rows 2 | sed -n '1p;2p;4p' | xargs)" "47.5000000 -30.5000000 47.5100000"
same "igc: longitude" "$(rows 3 | sed -n 2p)" -170.9999833
near "igc: GNSS altitude above the sea" "$(rows 4 | sed -n 1p)" 500 2 # the geoid lies 48 m over the ellipsoid there
near "igc: pressure altitude without a fix" "$(rows 4 | sed -n 2p)" 510 0
has "igc: left out" "$(cat "$work/stdout")" "from 3 fixes (1 without a position left out)"
track "igc pressure" "$work/f.igc" --every 5s --igc-altitude pressure
same "igc: pressure" "$(rows 4 | sed -n '1p;4p' | xargs)" "500.00 520.00"
sed 's/^I.*/HFALG:GEO/' "$work/f.igc" >"$work/g.igc"
track "igc above the geoid" "$work/g.igc" --every 5s
same "igc: geoid" "$(rows 4 | sed -n 1p)" 548.00

# ---- flights recorded by others, where they are
data=../shared/data
if [ -d $data ]; then
    track "airliner" $data/flight-lszh-eddf-2021-08-17.csv --every 60s
    same "airliner: steps" "$(rows 1 | wc -l)" 37 # 12:43:24 to 13:19:29
    near "airliner: top" "$(rows 4 | sort -g | tail -n 1)" "$(tail -n +2 $data/flight-lszh-eddf-2021-08-17.csv | cut -d, -f4 | sort -g | tail -n 1)" 60
    track "glider" $data/glider-2009-12-27.igc --every 10min
    same "glider: steps" "$(rows 1 | wc -l)" 22 # 02:08:37 to 05:41:25
    same "glider: the sun stands in the north at noon" "$(rows 5 | awk '$1 > 300 || $1 < 60' | wc -l | awk '{ print ($1 > 5) }')" 1
    near "glider: on the airfield" "$(rows 4 | head -n 1)" 174 12 # barometer and receiver differ by some metres
else
    echo "note: no $data: recorded flights not tried"
fi
finish
