#!/usr/bin/env bash
# `skyvert sun`: its lines, published vectors, every form of input and every error line.
cd "$(dirname "$0")" && here=$PWD && cd - >/dev/null
. "$here/lib.sh"
cd "$work" || exit 1
sun() { "$skyvert" sun "$@"; }
# value NAME: of the last run
value() { awk -v n="$1" '$1 == n {print $2}' stdout; }
# near CASE GOT WANT TOLERANCE
near() {
    cases=$((cases + 1))
    awk -v g="$2" -v w="$3" -v t="$4" 'BEGIN{d = g - w; if (d < 0) d = -d; exit !(g != "" && d <= t)}' && return
    echo "FAILED $1: got $2, want $3, tolerance $4"
    bad=$((bad + 1))
}
names='sun_azimuth_deg deg,sun_elevation_deg deg,sun_elevation_refracted_deg deg,sun_distance_au au,moon_azimuth_deg deg,moon_elevation_deg deg,moon_phase 1,moon_phase_angle_deg deg,'
# Heights above the ellipsoid: the vectors' own, and no geoid grid is needed.
place='--lat 39.742476 --lon -105.1786 --height-m 1830.14 --height-datum ellipsoid'
does 'published vector' /dev/null sun $place --utc 2003-10-17T19:30:30Z --pressure-hpa 820 --temperature-c 11
same 'names and units' "$(awk '{printf "%s %s,", $1, $3}' stdout)" "$names"
# The vector of the solar position algorithm of Reda & Andreas 2004, table A5.1; .01 deg is the contract of the sun.
near 'vector: azimuth' "$(value sun_azimuth_deg)" 194.340241 .01
near 'vector: elevation' "$(value sun_elevation_deg)" 39.872046 .01
near 'vector: refracted elevation' "$(value sun_elevation_refracted_deg)" 39.888378 .01
does 'standard air' /dev/null sun $place --utc 2003-10-17T19:30:30Z
# 1830 m: 812 hPa, 3.1 C; the refraction scales as P/T: .01633 deg * (812/820) * (284/276.25) = .01663.
near 'standard air: refraction' "$(awk '/elevation_deg/ && /sun/{a=$2} /refracted/{print $2-a}' stdout)" .01663 .0003
base=$(cat stdout)
for utc in '2003-10-17 19:30:30Z' 2003-10-17T19:30:30 2003-10-17T19:30:30.0Z 2003-10-17T12:30:30-07:00 2003-10-17T12:30:30-0700 \
    2003-10-18T00:30:30+05 2003-10-17t19:30:30z 2003-10-17T19:30:30,000Z; do
    does "utc $utc" /dev/null sun $place --utc "$utc"
    same "utc $utc: lines" "$(cat stdout)" "$base"
done
does 'no seconds' /dev/null sun $place --utc 2003-10-17T19:30Z
does 'leap second' /dev/null sun $place --utc 2016-12-31T23:59:60Z
a=$(value sun_azimuth_deg)
does 'the second after it' /dev/null sun $place --utc 2017-01-01T00:00:00Z
near 'leap second: no jump of the azimuth' "$a" "$(value sun_azimuth_deg)" .0002 # (printed to .0001)
does 'pole' /dev/null sun --lat 90 --lon 0 --utc 2021-06-21T12:00:00Z --height-datum ellipsoid
near 'pole: elevation is the declination' "$(value sun_elevation_deg)" 23.436 .01 # solstice: the obliquity, 23.4364 deg in 2021
does 'new year 2021 perihelion' /dev/null sun --lat 0 --lon 0 --utc 2021-01-02T13:50Z --height-datum ellipsoid
near 'perihelion of 2021' "$(value sun_distance_au)" .983257 .0001 # almanac: .9832571 au
does 'full moon' /dev/null sun --lat 0 --lon 0 --utc 2021-05-26T11:14Z --height-datum ellipsoid
near 'full moon, total eclipse' "$(value moon_phase)" 1 .001
does 'new moon' /dev/null sun --lat 0 --lon 0 --utc 2021-06-10T10:53Z --height-datum ellipsoid
near 'new moon, annular eclipse' "$(value moon_phase)" 0 .001
does 'a high observer has no refraction' /dev/null sun --lat 0 --lon 0 --utc 2021-06-10T06:10Z --height-m 100000 --height-datum ellipsoid
same 'no refraction' "$(value sun_elevation_refracted_deg)" "$(value sun_elevation_deg)"

# --- rows ---
text() { printf "$1" >in.csv; }
head=utc,lat_deg,lon_deg,height_m
text "$head\n2003-10-17T19:30:30Z,39.742476,-105.1786,1830.14\n2021-06-21T12:00:00Z,90,0,0\n"
does rows in.csv sun --csv --height-datum ellipsoid
same 'rows: header' "$(head -n 1 stdout)" "$head,$(awk '{printf "%s%s", (NR>1 ? "," : ""), $1}' <<<"$base")"
same 'rows: like the single moment' "$(sed -n 2p stdout)" \
    "2003-10-17T19:30:30Z,39.742476,-105.1786,1830.14,$(awk '{printf "%s%s", (NR>1 ? "," : ""), $2}' <<<"$base")"
cp stdout rows.csv
does 'rows of a named file' /dev/null sun --csv --height-datum ellipsoid in.csv
same 'rows of a named file: lines' "$(cat stdout)" "$(cat rows.csv)"
text "height_m,note,lon_deg,utc,lat_deg\r\n1830.14,\"a,b\",-105.1786,2003-10-17T19:30:30Z,39.742476\r\n\r\n0,,0,2021-06-21T12:00:00Z,90"
does 'rows in another order' in.csv sun --csv --height-datum ellipsoid
same 'rows in another order: lines' "$(cat stdout)" "$(cat rows.csv)"
good='2003-10-17T19:30:30Z,39.742476,-105.1786,1830.14'
# row CASE PATTERN ROW
row() {
    text "$head\n$good\n$3\n$good\n"
    refuses "row: $1" 2 "^stdin:3: .*($2)" in.csv sun --csv --height-datum ellipsoid
}
row 'latitude 91' 'lat_deg = 91: allowed is a number from -90 to 90' 2003-10-17,91,0,0
row 'longitude' 'lon_deg = 361: allowed is a number from -360 to 360' 2003-10-17,1,361,0
row 'height' 'height_m = -12001: allowed is a number from -12000 to 1e\+09' 2003-10-17,1,2,-12001
row 'nothing' 'height_m = \(nothing\)' 2003-10-17,1,2,
row 'bad date' 'utc = 2003-02-29: no such day in that month' 2003-02-29,1,2,3
row 'no date' 'utc = \(nothing\): no ISO 8601 moment' ,1,2,3
row 'few fields' 'fewer fields' 2003-10-17,1,2
{ echo $head && yes x,1,2,3 | head -n 30; } >in.csv
run in.csv sun --csv
same '30 bad rows: lines' "$status $(wc -l <stderr) $(tail -n 1 stderr)" '2 21 stdin: and 10 more bad rows'
text ''
refuses 'no input' 2 '^stdin:1: empty input' in.csv sun --csv
text "utc,lat,lon_deg,height_m\n"
refuses 'no latitudes' 2 "^stdin:1: column lat_deg is missing; needed .*$head" in.csv sun --csv
refuses 'no such file' 2 '^none\.csv: cannot be read' /dev/null sun --csv none.csv
refuses 'folder' 2 '^\.: cannot be read' /dev/null sun --csv .
refuses 'rows and a position' 2 '^skyvert sun: --csv takes' /dev/null sun --csv --lat 3
refuses 'rows, two files' 2 "unexpected argument 'b'" /dev/null sun --csv a b

# --- options ---
moment='--utc 2021-08-17T04:30:00Z'
refuses 'no options' 2 '^skyvert sun: --lat is missing' /dev/null sun
refuses 'no longitude' 2 '^skyvert sun: --lon is missing' /dev/null sun --lat 1 $moment
refuses 'no moment' 2 '^skyvert sun: --utc is missing' /dev/null sun --lat 1 --lon 2
refuses 'position twice' 2 'allowed is one or the other' /dev/null sun --lat 1 --lon 2 --position '1 2' $moment
for lat in 91 -90.001 nan 0x10 '' 47,5 1e3; do
    refuses "latitude '$lat'" 2 '^skyvert sun: --lat .*: allowed is a number from -90 to 90' /dev/null sun --lat "$lat" --lon 2 $moment
done
refuses 'longitude' 2 '^skyvert sun: --lon 400: allowed is a number from -360 to 360' /dev/null sun --lat 1 --lon 400 $moment
refuses 'height' 2 '^skyvert sun: --height-m -2e4: allowed is a number from -12000 to 1e\+09' /dev/null sun --lat 1 --lon 2 --height-m -2e4 $moment
refuses 'datum' 2 '^skyvert sun: --height-datum wgs84: allowed is msl or ellipsoid' /dev/null sun --height-datum wgs84
refuses 'pressure' 2 '^skyvert sun: --pressure-hpa -1: allowed is a number from 0 to 2000' /dev/null sun --pressure-hpa -1
refuses 'temperature' 2 '^skyvert sun: --temperature-c 293: allowed is a number from -100 to 100' /dev/null sun --temperature-c 293
for utc in '' now 2021 2021-08 2021-8-17 2021-08-17T 2021-08-17T04 2021-08-17T4:30Z 2021-08-17T04:30:00X 2021-08-17T04:30:00Zulu \
    2021-08-17T04:30:00.Z '2021-08-17  04:30' 17.08.2021 20210817T043000Z 2021-08-17T04:30:00+2 2021-08-17T04:30:00+15:00; do
    refuses "utc '$utc'" 2 '^skyvert sun: --utc .*: no ISO 8601 moment: allowed is like' /dev/null sun --lat 1 --lon 2 --utc "$utc"
done
for utc in 2021-02-29 1900-02-29 2021-04-31 2021-00-01 2021-13-01 2021-01-00 2021-01-01T24:00Z 2021-01-01T23:60Z 2021-01-01T23:59:61Z \
    2021-01-01T12:00:60Z 2021-01-01T23:59:60-01:00 1899-12-31 2101-01-01 1900-01-01T00:30+01:00; do
    refuses "utc $utc" 2 "^skyvert sun: --utc $(sed 's/+/\\+/' <<<"$utc"): no such" /dev/null sun --lat 1 --lon 2 --utc "$utc"
done
refuses 'unknown option' 2 '^skyvert sun: unknown option --alt' /dev/null sun --alt 3
refuses 'argument' 2 "unexpected argument 'x'" /dev/null sun --lat 1 --lon 2 $moment x
run /dev/null bash -c "\"$skyvert\" sun $place $moment >/dev/full"
same 'full disk' "$status $(cat stderr)" '1 standard output: writing failed: No space left on device'

# --- positions in other forms; heights above the sea ---
run /dev/null sun --position 'x' $moment
if grep -q 'lacks GeographicLib' stderr; then
    same 'position without GeographicLib' $status 1
    echo 'note: --position was not tried: this build lacks GeographicLib (package libgeographiclib-dev)'
else
    refuses 'bad position' 2 '^skyvert sun: --position: ' /dev/null sun --position 'x' $moment
    does 'decimal' /dev/null sun --lat 47.458889 --lon 8.533889 --height-datum ellipsoid $moment
    base=$(cat stdout)
    does 'degrees, minutes, seconds' /dev/null sun --position '47:27:32N 8:32:2.0004E' --height-datum ellipsoid $moment
    near 'DMS: azimuth' "$(value sun_azimuth_deg)" "$(awk '/sun_azimuth/{print $2}' <<<"$base")" .0002 # (printed to .0001)
    does 'decimal pair' /dev/null sun --position '47.458889, 8.533889' --height-datum ellipsoid $moment
    same 'decimal pair: lines' "$(cat stdout)" "$base"
fi
does 'height above the sea' /dev/null sun --lat 47 --lon 8 --height-m 400 $moment
finish
