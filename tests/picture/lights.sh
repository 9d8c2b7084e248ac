# What shines in a picture: discs where sun and moon stand, as bright as they are; water, night, ground, grid, exposure.
. tests/picture/lib.sh

zurich=(--lat 47.459 --lon 8.534 --height-m 587 --ground-m 432)
luminance() { awk -F'[(,): ]+' '/Pixel/ { print $3, $4, .2126 * $5 + .7152 * $6 + .0722 * $7 }'; }
pixels() { oiiotool --dumpdata "$1" | luminance; }
attribute() { exrheader "$1" | awk -v n="skyvert.$2" '$1 == n { print $NF }'; }
said() { "$skyvert" sun --lat 47.459 --lon 8.534 --height-m 587 --utc "$1" | awk -v n="$2" '$1 == n { print $2 }'; }

# ---- finite, whatever shines: RGB may be negative outside the gamut, luminance may not
for options in "--sun-zenith-deg 0" "--sun-zenith-deg 90 --height-m 12000" "--sun-zenith-deg 99 --ground water" "--sun-zenith-deg 108 --night on" \
    "--sun-zenith-deg 180 --height-m 400000 --moon-zenith-deg 30 --ground water" "--sun-zenith-deg 60 --height-m 1000000000" \
    "--sun-zenith-deg 30 --height-m 0 --ground water --wind-m-s 0" "--sun-zenith-deg 80 --ground water --wind-m-s 40 --height-m 80000" \
    "--sun-zenith-deg 70 --preset mars --table small" "--sun-zenith-deg 120 --moon-zenith-deg 120 --night on --height-m 80000" \
    "--sun-zenith-deg 95 --atmosphere $here/sharp.ini --moon-zenith-deg 20" "--sun-zenith-deg 85 --bands 3 --ground none"; do
    works "$options" "$skyvert" render $options --projection latlong --size 25x25 --out "$work/any.exr"
    text=$(oiiotool --stats --dumpdata "$work/any.exr")
    has "$options: finite" "$text" "InfCount: 0 0 0"
    has "$options: no NaN" "$text" "NanCount: 0 0 0"
    same "$options: luminance" "$(luminance <<<"$text" | awk '$3 < -1e-9' | head -n 1)" ""
done

# ---- the sun from above the air: in the middle of a picture aimed at it, half a degree wide, and 133 klx in all
# (1361 W/m2 of the solar spectrum [Gueymard18] have 98 lm/W). 2 %: the disc's pixels, four bands for the spectrum.
sun_from_space() { # PIXELS: of 2 degrees
    works "sun, $1 pixels" "$skyvert" render --sun-zenith-deg 60 --sun-azimuth-deg 200 --height-m 400000 --projection perspective --fov-deg 2 \
        --azimuth-deg 200 --elevation-deg 30 --size "$1x$1" --out "$work/sun.exr"
    read -r lux x y wide <<<"$(pixels "$work/sun.exr" | awk -v n="$1" '{ a = 2 / n * atan2(0, -1) / 180; s += $3; x += $3 * ($1 + .5); y += $3 * ($2 + .5)
        if ($3 > m) m = $3; if (int(n / 2) == $2) row[$1] = $3 } END { for (i in row) if (row[i] > .25 * m) w++; print 1000 * s * a * a, x / s / n, y / s / n, w * 2 / n }')"
    near "sun, $1 pixels: lx" "$lux" 133000 2700
    near "sun, $1 pixels: across" "$x" 0.5 0.01
    near "sun, $1 pixels: up" "$y" 0.5 0.01
    echo "figure: render, the sun from space on $1 pixels of 2 deg: $lux lx"
}
sun_from_space 100
near "sun: width" "$wide" 0.533 0.04 # two pixels
sun_from_space 24
# Behind the planet there is none, nor without discs.
works "the sun below the limb" "$skyvert" render --sun-zenith-deg 125 --sun-azimuth-deg 200 --height-m 400000 --projection perspective --fov-deg 2 --azimuth-deg 200 --elevation-deg -35 --size 20x20 --out "$work/sun.exr"
same "the sun below the limb" "$(pixels "$work/sun.exr" | awk '$3 > 1' | wc -l)" 0
works "no disc" "$skyvert" render --sun-zenith-deg 60 --sun-azimuth-deg 200 --height-m 400000 --projection perspective --fov-deg 2 --azimuth-deg 200 --elevation-deg 30 --discs off --size 20x20 --out "$work/sun.exr"
same "no disc" "$(pixels "$work/sun.exr" | awk '$3 > 0' | wc -l)" 0

# ---- through the air, by time and place: the disc is the brightest, where `skyvert sun` says, and redder when low
utc=2021-08-17T05:10:00Z
works "morning sun" "$skyvert" render "${zurich[@]}" --utc $utc --projection perspective --fov-deg 3 --azimuth-deg "$(said $utc sun_azimuth_deg)" \
    --elevation-deg "$(said $utc sun_elevation_deg)" --size 61x61 --out "$work/sun.exr"
read -r x y <<<"$(pixels "$work/sun.exr" | awk '$3 > 1000 { s += $3; x += $3 * $1; y += $3 * $2 } END { print x / s, y / s }')"
near "morning sun: across" "$x" 30 0.5
near "morning sun: up" "$y" 30 0.5 # the air dims the lower limb more
same "morning sun: red" "$(oiiotool --dumpdata "$work/sun.exr" | awk -F'[(,): ]+' '/Pixel \(30, 30\)/ { print ($5 > 1.1 * $6 && $6 > 1.5 * $7) }')" 1

# ---- the moon: where it stands, its bright limb toward the sun, and as much light as moons give
moon_at() { # UTC ROLL
    works "moon at $1" "$skyvert" render "${zurich[@]}" --utc "$1" --projection perspective --fov-deg 1.6 --azimuth-deg "$(said "$1" moon_azimuth_deg)" \
        --elevation-deg "$(said "$1" moon_elevation_deg)" --size 81x81 --out "$work/moon.exr"
    works "no moon at $1" "$skyvert" render "${zurich[@]}" --utc "$1" --moon off --projection perspective --fov-deg 1.6 --azimuth-deg "$(said "$1" moon_azimuth_deg)" \
        --elevation-deg "$(said "$1" moon_elevation_deg)" --size 81x81 --out "$work/none.exr"
    read -r lux x y top <<<"$(paste -d' ' <(pixels "$work/moon.exr") <(pixels "$work/none.exr") | awk '{ a = 1.6 / 81 * atan2(0, -1) / 180; d = $3 - $6
        if (d > .05 * $6) { s += d; x += d * ($1 - 40); y += d * ($2 - 40) } if (d > m) m = d } END { print 1000 * s * a * a, x / s, y / s, 1000 * m }')"
    echo "figure: render, the moon at $1, light centred at $x $y of 81 pixels (illuminated $(said "$1" moon_phase)): $lux lx through the air, brightest $top cd/m2"
}
moon_at 2021-08-22T22:00:00Z # full, 22 deg up: 0.27 lx above the air [Allen73], about half of it here; 2500 to 6000 cd/m2
near "full moon: lx" "$lux" 0.17 0.08
near "full moon: across" "$x" 0 1
near "full moon: up" "$y" 0 1
moon_at 2021-08-14T18:00:00Z # a waxing crescent of .4: a twentieth of the full moon's light
# The great circle to the sun, 80 deg to the right and 20 deg lower, leaves the moon level: .0098 up for 1 to the right.
near "crescent: lx" "$lux" 0.014 0.01
near "crescent: its light is on the right, the sun's side" "$x" 9 3
near "crescent: neither up nor down" "$y" -0.09 0.5
# By hand: opposite to the sun it is full, beside it new; a lit sky by night.
works "moon by hand" "$skyvert" render --sun-zenith-deg 130 --moon-zenith-deg 50 --moon-azimuth-deg 0 --size 21x21 --out "$work/moon.exr"
near "moon by hand: full" "$(attribute "$work/moon.exr" moonIlluminatedFraction)" 1 1e-3
near "moon by hand: azimuth" "$(attribute "$work/moon.exr" moonAzimuthDeg)" 0 1e-4
works "moon by hand, new" "$skyvert" render --sun-zenith-deg 130 --moon-zenith-deg 130 --moon-azimuth-deg 180 --size 21x21 --out "$work/none.exr"
near "moon by hand: new" "$(attribute "$work/none.exr" moonIlluminatedFraction)" 0 1e-3
same "the full moon lights the sky, the new one does not" \
    "$(awk -v a="$(attribute "$work/moon.exr" zenithLuminance)" -v b="$(attribute "$work/none.exr" zenithLuminance)" 'BEGIN { print (a > 3e-4 && a < .03 && b < 1e-6) }')" 1

# ---- night: a dark site has 1.7e-4 to 4e-4 cd/m2 in the zenith and stars of magnitude 6 +- .7 [Leinert98, Crumey14]
works "dark night" "$skyvert" render "${zurich[@]}" --utc 2021-08-08T23:00:00Z --size 21x21 --out "$work/night.exr"
near "dark night: zenith" "$(attribute "$work/night.exr" zenithLuminance)" 2.8e-4 1.2e-4
near "dark night: limiting magnitude" "$(attribute "$work/night.exr" limitingMagnitude)" 6 0.7
works "moonlit night" "$skyvert" render "${zurich[@]}" --utc 2021-08-22T22:00:00Z --size 21x21 --out "$work/moonlit.exr"
near "moonlit night: limiting magnitude" "$(attribute "$work/moonlit.exr" limitingMagnitude)" 4.7 0.8
echo "figure: render, zenith of a dark night $(attribute "$work/night.exr" zenithLuminance) cd/m2, magnitude $(attribute "$work/night.exr" limitingMagnitude); under a full moon $(attribute "$work/moonlit.exr" zenithLuminance), $(attribute "$work/moonlit.exr" limitingMagnitude)"
works "no night" "$skyvert" render "${zurich[@]}" --utc 2021-08-08T23:00:00Z --night off --size 21x21 --out "$work/none.exr"
same "no night: less than a hundredth" "$(attribute "$work/none.exr" zenithLuminance | awk '{ print ($1 < 2e-6) }')" 1

# ---- all orders: brighter than light scattered once, everywhere, and most below a low sun
for z in 30 85; do
    for orders in single all; do
        works "orders $orders" "$skyvert" render --sun-zenith-deg $z --discs off --orders $orders --projection latlong --size 31x31 --out "$work/$orders.exr"
    done
    paste -d' ' <(pixels "$work/single.exr") <(pixels "$work/all.exr") >"$work/pair"
    same "sun zenith $z: all is more" "$(awk '!($6 > $3)' "$work/pair" | wc -l)" 0
    ground=$(awk '$2 > 15 { a += $3; b += $6 } END { print b / a }' "$work/pair") sky=$(awk '$2 < 15 { a += $3; b += $6 } END { print b / a }' "$work/pair")
    # The sky's own light on the ground: some 15 % of the sun's by day, twice the sun's where that is 5 deg up and .3 is left
    # of it on the way.
    [ $z = 30 ] && near "by day: ground" "$ground" 1.2 0.12
    [ $z = 85 ] && near "sun 5 deg up: ground" "$ground" 3 0.7
    echo "figure: render, sun zenith $z: all orders over light scattered once: sky $sky, ground $ground"
done

# ---- the grid gives the picture of the direct integral: 1 % of each pixel by day from 10 km
for grid in on off; do works "grid $grid" "$skyvert" render --sun-zenith-deg 60 --height-m 10000 --discs off --projection latlong --size 61x41 --grid $grid --out "$work/$grid.exr"; done
worst=$(paste -d' ' <(pixels "$work/on.exr") <(pixels "$work/off.exr") | awk '{ d = $3 / $6 - 1; if (d * d > w * w) w = d } END { print w }')
near "grid" "$worst" 0 0.01
echo "figure: render, the grid's largest error of luminance by day from 10 km: $worst"

# ---- water. A mirror shows the sky at +e times Fresnel's reflectance at -e (unpolarised, index 1.333) and what comes out of
# the water, which in the red is next to nothing: .0005 pi E/L. The 2 m of air between: .003.
sed '/wavelength/s/=.*/= 640, 660, 680, 700/' $here/sharp.ini >"$work/red.ini"
works "mirror" "$skyvert" render --atmosphere "$work/red.ini" --sun-zenith-deg 60 --sun-azimuth-deg 0 --azimuth-deg 90 --ground water --wind-m-s 0 --discs off --projection latlong --size 5x181 --out "$work/mirror.exr"
pixels "$work/mirror.exr" | awk '$1 == 1 { l[$2] = $3 } END { n = 1.333; for (e = 4; e <= 60; e += 4) { t = e * atan2(0, -1) / 180; c = sin(t); g = sqrt(n * n - 1 + c * c)
    p = (c * (g + c) - 1) / (c * (g - c) + 1); f = .5 * ((g - c) / (g + c)) ^ 2 * (1 + p * p); print e, l[90 + e] / l[90 - e] - f } }' >"$work/fresnel"
same "mirror: Fresnel's reflectance" "$(awk '$2 < -.003 || $2 > .01' "$work/fresnel")" ""
# Glitter lies below the sun; the mirror image of the disc at its elevation below the horizon.
works "glitter" "$skyvert" render --sun-zenith-deg 60 --sun-azimuth-deg 90 --ground water --wind-m-s 8 --discs off --projection latlong --size 73x37 --out "$work/glitter.exr"
same "glitter below the sun" "$(pixels "$work/glitter.exr" | awk '$2 > 18 && $3 > m { m = $3; x = $1 } END { print x }')" 54
works "image" "$skyvert" render --sun-zenith-deg 60 --sun-azimuth-deg 90 --ground water --wind-m-s 0 --projection latlong --size 181x91 --out "$work/image.exr"
same "the sun's mirror image" "$(pixels "$work/image.exr" | awk '$2 > 45 && $3 > m { m = $3; at = $1 " " $2 } END { print at }')" "135 60"
# From 1 km on each ray finds the sky over its own piece of water: no step there, and no day on the night's side of a sea planet.
for h in 990 1010; do works "sea from $h m" "$skyvert" render --sun-zenith-deg 80 --sun-azimuth-deg 90 --height-m $h --ground water --discs off --projection latlong --size 37x37 --out "$work/$h.exr"; done
worst=$(paste -d' ' <(pixels "$work/990.exr") <(pixels "$work/1010.exr") | awk '$2 > 19 { d = $3 / $6 - 1; if (d * d > w * w) w = d } END { print w }')
near "sea from 990 and 1010 m" "$worst" 0 0.02 # 20 m of air and .03 deg of the sun's height where the glitter is steep
works "sea planet" "$skyvert" render --sun-zenith-deg 100 --sun-azimuth-deg 0 --height-m 20000000 --projection perspective --elevation-deg -90 --azimuth-deg 0 --fov-deg 40 --ground water --size 41x41 --out "$work/planet.exr"
same "sea planet: day above, night below" "$(pixels "$work/planet.exr" | awk '$1 == 20 { l[$2] = $3 } END { print (l[12] > .1), (l[24] < 1e-3 * l[12]), (l[32] < 1e-3 * l[12]) }')" "1 1 1"
# Deep water is dark and blue where nothing shines in it: from straight above, sun high.
works "straight down" "$skyvert" render --sun-zenith-deg 40 --height-m 100 --ground water --projection perspective --elevation-deg -90 --fov-deg 10 --size 3x3 --out "$work/down.exr"
same "water is blue" "$(oiiotool --dumpdata "$work/down.exr" | awk -F'[(,): ]+' '/Pixel \(1, 1\)/ { print ($7 > 1.5 * $6 && $6 > $5) }')" 1

# ---- the exposure: a disc in the picture does not darken it; a darker scene gets more
key() { oiiotool --info -v "$1" | awk -F'exp\\(-' '/exposure/ { print $2 + 0 }'; }
for discs in on off; do works "exposure, discs $discs" "$skyvert" render --sun-zenith-deg 50 --sun-azimuth-deg 180 --discs $discs --size 101x101 --out "$work/$discs.png"; done
near "exposure with the sun in it" "$(awk -v a="$(key "$work/on.png")" -v b="$(key "$work/off.png")" 'BEGIN { print a / b }')" 1 0.03

# ---- a table of a flight says where the moon is: as `skyvert sun` does
printf 'utc,lat_deg,lon_deg,height_m\n2021-08-22T22:00:00Z,47.459,8.534,587\n' >"$work/f.csv"
works "track" "$skyvert" track "$work/f.csv" --every 1min --size 8x8 --out "$work/t"
column() { awk -F, -v name="$1" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == name) k = i; next } { print $k }' "$work/t/track.csv"; }
near "track: moon" "$(column moon_azimuth_deg)" "$(said 2021-08-22T22:00:00Z moon_azimuth_deg)" 0.001
near "track: moon" "$(column moon_elevation_deg)" "$(said 2021-08-22T22:00:00Z moon_elevation_deg)" 0.001
near "track: moon" "$(column moon_phase)" "$(said 2021-08-22T22:00:00Z moon_phase)" 0.0001
near "track: limiting magnitude" "$(column limiting_magnitude)" "$(attribute "$work/moonlit.exr" limitingMagnitude)" 0.01

# ---- what it costs
run /dev/null "$skyvert" render --sun-zenith-deg 50 --size 60x60 --timing --out "$work/a.exr"
has "timing" "$(cat "$work/stderr")" "ns of processor time each:"
has "timing: table" "$(cat "$work/stderr")" "table of "
has "timing: grid" "$(cat "$work/stderr")" "1 grids in "
run /dev/null "$skyvert" render --sun-zenith-deg 50 --size 60x60 --orders single --timing --out "$work/a.exr"
same "timing without a table" "$(grep -c table "$work/stderr")" 0
finish
