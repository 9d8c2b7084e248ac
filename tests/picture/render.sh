# Pictures read by other programs: sizes, channels, attributes, and the sun where `skyvert sun` puts it.
. tests/picture/lib.sh

# ---- EXR attributes
where=(--position "47:27:32N 8:32:2E" --height-m 587 --utc 2021-08-17T04:30:00Z)
works "latlong" "$skyvert" render "${where[@]}" --projection latlong --size 61x31 --owner "A. Pilot" --out "$work/a.exr"
text=$(exrheader "$work/a.exr")
has "channel" "$text" "R, 32-bit floating-point"
has "size" "$text" "dataWindow (type box2i): (0 0) - (60 30)"
has "envmap" "$text" "envmap (type envmap): latitude-longitude map"
has "local time" "$text" 'capDate (type string): "2021:08:17 05:30:00"' # 8.5 E lies in the zone of UTC+1
has "offset" "$text" "utcOffset (type float): -3600"
has "latitude" "$text" "latitude (type float): 47.4589"
has "longitude" "$text" "longitude (type float): 8.53389"
has "altitude" "$text" "altitude (type float): 587"
has "white" "$text" "whiteLuminance (type float): 1000"
has "primaries" "$text" "red   (0.64 0.33)"
has "owner" "$text" 'owner (type string): "A. Pilot"'
has "software" "$text" 'software (type string): "skyvert '
has "comments" "$text" "(1,1,1) = 1000 cd/m2"
has "zip" "$text" "compression (type compression): zip"
text=$(oiiotool --stats "$work/a.exr")
has "finite" "$text" "InfCount: 0 0 0"
has "no NaN" "$text" "NanCount: 0 0 0"
# Both ends of a latlong row look south; the first row is the zenith all along.
dump=$(oiiotool --dumpdata "$work/a.exr")
same "seam" "$(grep -F 'Pixel (0, 12)' <<<"$dump" | cut -d: -f2)" "$(grep -F 'Pixel (60, 12)' <<<"$dump" | cut -d: -f2)"
same "zenith row" "$(grep -E 'Pixel \([0-9]+, 0\)' <<<"$dump" | cut -d: -f2 | sort -u | wc -l)" 1

works "half fisheye" "$skyvert" render "${where[@]}" --half --size 41x31 --out "$work/b.exr"
text=$(exrheader "$work/b.exr")
has "half" "$text" "A, 16-bit floating-point"
! grep -q envmap <<<"$text" || same "a fisheye is no envmap" envmap none
dump=$(oiiotool --dumpdata "$work/b.exr")
same "corner" "$(grep -F 'Pixel (0, 0)' <<<"$dump" | cut -d: -f2 | xargs)" "0.000000000 0.000000000 0.000000000 0.000000000"
same "centre alpha" "$(grep -F 'Pixel (20, 15)' <<<"$dump" | awk '{ print $NF }')" 1.000000000

works "perspective" "$skyvert" render --sun-zenith-deg 50 --projection perspective --fov-deg 90 --size 40x20 --out "$work/c.exr"
text=$(exrheader "$work/c.exr")
has "screen window" "$text" "screenWindowWidth (type float): 2" # 2 tan 45
! grep -qE 'latitude \(|capDate' <<<"$text" || same "no place, no time" "$text" ""

# Very bright air: half stays finite.
works "hot half" "$skyvert" render --sun-zenith-deg 60 --turbidity 50 --atmosphere $here/sharp.ini --half --projection perspective --azimuth-deg 180 --elevation-deg 30 --fov-deg 1 --size 20x20 --out "$work/hot.exr"
has "hot half is finite" "$(oiiotool --stats "$work/hot.exr")" "InfCount: 0 0 0"

# ---- PNG
works "png" "$skyvert" render "${where[@]}" --size 40x40 --out "$work/d.png"
has "pngcheck" "$(pngcheck "$work/d.png")" "40x40, 32-bit RGB+alpha"
works "png 16" "$skyvert" render "${where[@]}" --projection latlong --png-bits 16 --size 40x20 --out "$work/e.png"
has "pngcheck 16" "$(pngcheck "$work/e.png")" "40x20, 48-bit RGB"
# Exposure: 16-bit sRGB of 1 - exp(-k L), with L from the EXR of the same view; half a step of 1/65535 and print.
works "exposed" "$skyvert" render --sun-zenith-deg 40 --projection perspective --exposure 0.3 --png-bits 16 --elevation-deg 20 --size 4x4 --out "$work/f.png"
works "not exposed" "$skyvert" render --sun-zenith-deg 40 --projection perspective --elevation-deg 20 --size 4x4 --out "$work/f.exr"
want=$(oiiotool --dumpdata "$work/f.exr" | awk '/Pixel \(2, 1\)/ { for (i = 4; i <= 6; i++) { l = 1 - exp(-.3 * $i);
    s = l <= .0031308 ? 12.92 * l : 1.055 * exp(log(l) / 2.4) - .055; printf "%d ", 65535 * s + .5 } }')
got=$(oiiotool --dumpdata "$work/f.png" | awk '/Pixel \(2, 1\)/ { print $4, $5, $6 }')
for i in 1 2 3; do near "exposed channel $i" "$(cut -d' ' -f$i <<<"$got")" "$(cut -d' ' -f$i <<<"$want")" 1; done
# Dithering moves no sample by more than a step, and the mean by less than a tenth of one.
works "dithered" "$skyvert" render --sun-zenith-deg 40 --projection perspective --elevation-deg 20 --size 60x60 --out "$work/g.png"
works "not dithered" "$skyvert" render --sun-zenith-deg 40 --projection perspective --elevation-deg 20 --no-dither --size 60x60 --out "$work/h.png"
diff=$(paste <(oiiotool --dumpdata "$work/g.png" | grep Pixel) <(oiiotool --dumpdata "$work/h.png" | grep Pixel) |
    awk '{ for (i = 4; i <= 6; i++) { d = $i - $(i + 9); s += d; if (d < 0) d = -d; if (d > m) m = d; n++ } } END { print m, s / n }')
near "dither: largest" "${diff% *}" 1 0
near "dither: mean" "${diff#* }" 0 0.1
# The same command gives the same bytes.
works "again" "$skyvert" render "${where[@]}" --size 40x40 --out "$work/d2.png"
cmp -s "$work/d.png" "$work/d2.png" || same "the same bytes" different equal

# ---- the sun's place. A pixel is a degree: the brightest one lies within half its diagonal, and the glare of
# sharp.ini peaks within .02 degrees of the sun.
sun_in() { # LAT LON HEIGHT UTC
    works "sun picture" "$skyvert" render --lat "$1" --lon "$2" --height-m "$3" --utc "$4" --atmosphere $here/sharp.ini --projection latlong --size 361x181 --out "$work/sun.exr"
    read -r x y <<<"$(oiiotool --dumpdata "$work/sun.exr" | awk -F'[(,): ]+' '/Pixel/ { l = $6 + 0; if (l > m) { m = l; x = $3; y = $4 } } END { print x, y }')"
    said=$("$skyvert" sun --lat "$1" --lon "$2" --height-m "$3" --utc "$4")
    az=$(awk '/^sun_azimuth_deg/ { print $2 }' <<<"$said") el=$(awk '/^sun_elevation_deg/ { print $2 }' <<<"$said")
    # azimuth of column x: x - 180, north in the centre, east right
    off=$(awk -v x="$x" -v y="$y" -v a="$az" -v e="$el" 'BEGIN { r = atan2(0, -1) / 180; A = (x - 180) * r; E = (90 - y) * r; a *= r; e *= r
        s = sin(E) * sin(e) + cos(E) * cos(e) * cos(A - a); s = s > 1 ? 1 : s; print atan2(sqrt(1 - s * s), s) / r }')
    near "sun at $1 $2 $4 (azimuth $az, elevation $el)" "$off" 0 0.73
    echo "figure: sun of a latlong picture off by $off deg at azimuth $az, elevation $el (a pixel is 1 deg)"
}
sun_in 47.4589 8.5339 587 2021-08-17T05:45:00Z
east=$x
[ "$east" -gt 225 ] && [ "$east" -lt 300 ] || same "a morning sun stands east, right of the centre" "$east" "about 264"
sun_in 47.4589 8.5339 587 2021-08-17T16:00:00Z
[ "$x" -gt 60 ] && [ "$x" -lt 135 ] || same "an evening sun stands west, left of the centre" "$x" "about 82"
sun_in -33.9 151.2 10 2021-08-17T02:00:00Z
sun_in 78.2 15.6 400 2024-06-20T23:00:00Z

# The sun placed by hand at azimuth 90: three quarters from the left of a latlong picture, left in a fisheye.
works "azimuth 90" "$skyvert" render --sun-zenith-deg 60 --sun-azimuth-deg 90 --atmosphere $here/sharp.ini --projection latlong --size 361x181 --out "$work/s.exr"
same "east right of the centre" "$(oiiotool --dumpdata "$work/s.exr" | awk -F'[(,): ]+' '/Pixel/ { if ($6 + 0 > m) { m = $6 + 0; at = $3 " " $4 } } END { print at }')" "270 60"
works "fisheye azimuth 90" "$skyvert" render --sun-zenith-deg 60 --sun-azimuth-deg 90 --atmosphere $here/sharp.ini --size 181x181 --out "$work/s.exr"
same "east left in a fisheye" "$(oiiotool --dumpdata "$work/s.exr" | awk -F'[(,): ]+' '/Pixel/ { if ($6 + 0 > m) { m = $6 + 0; at = $3 " " $4 } } END { print at }')" "30 90"
works "perspective toward the sun" "$skyvert" render --sun-zenith-deg 60 --sun-azimuth-deg 300 --atmosphere $here/sharp.ini --projection perspective --elevation-deg 30 --fov-deg 40 --size 41x31 --out "$work/s.exr"
same "the sun in the middle" "$(oiiotool --dumpdata "$work/s.exr" | awk -F'[(,): ]+' '/Pixel/ { if ($6 + 0 > m) { m = $6 + 0; at = $3 " " $4 } } END { print at }')" "20 15"
finish
