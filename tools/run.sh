#!/usr/bin/env bash
# run.sh BUILD: the main job. Renders the project's sample flight and a few single skies into out/, and prints where to
# look and what it cost.
set -eu
build=${1:-build}
skyvert=$build/skyvert
flight=tools/flight/dusk-lszh-loww.csv
out=out
mkdir -p $out

seconds() { awk -v a="$1" -v b="$(date +%s.%N)" 'BEGIN { printf "%.1f s", b - a }'; }

start=$(date +%s.%N)
echo "a dusk flight from Zurich to Vienna ($flight), a sky every two minutes:"
"$skyvert" track "$flight" --every 2min --size 256x256 --timing --out $out/dusk >$out/log 2>&1 || { cat $out/log >&2; rm -f $out/log; exit 1; }
sed 's/^/  /' $out/log
rm -f $out/log
echo "  $out/dusk/contact-sheet.png  all of them, small: look at this first"
echo "  $out/dusk/track.csv          sun angles and luminance of the zenith"
echo "  $out/dusk/sky-*.exr          linear light (BT.709, 1 = 1000 cd/m2), for any OpenEXR viewer"
echo "  $(seconds "$start")"

start=$(date +%s.%N)
echo "single skies:"
bash tools/pictures/make.sh "$skyvert" $out/skies 640
sky() { "$skyvert" render "${@:3}" --size 640x400 --projection perspective --out "$out/skies/$1.png" && echo "  $out/skies/$1.png  $2"; }
sky sea-3deg "glitter on the sea, the sun 3 degrees up" --sun-zenith-deg 87 --sun-azimuth-deg 270 --height-m 20 --ground water --fov-deg 90 --supersample 2
sky moonlit-sea "the full moon over the sea, exposed for minutes" --lat 43.5 --lon 7.0 --height-m 20 --utc 2021-08-22T21:30:00Z --ground water \
    --azimuth-deg 150 --elevation-deg 8 --fov-deg 80 --supersample 2
sky dark-night "airglow and faint stars' light, no moon" --lat 43.5 --lon 7.0 --height-m 20 --utc 2021-08-08T23:00:00Z --elevation-deg 20 --fov-deg 100
sky orbit-sunset "from 400 km, the sun setting behind the limb" --sun-zenith-deg 108 --sun-azimuth-deg 270 --height-m 400000 --elevation-deg -18 --fov-deg 30 --supersample 2
"$skyvert" render --position "47:27:32N 8:32:2E" --height-m 587 --utc 2021-08-17T04:30:00Z --projection latlong \
    --size 1024x512 --timing --out $out/skies/sunrise-latlong.exr 2>$out/log || { cat $out/log >&2; rm -f $out/log; exit 1; }
echo "  $out/skies/sunrise-latlong.exr  an environment map at sunrise: $(head -n 1 $out/log)"
rm -f $out/log
"$skyvert" dome --position "47:27:32N 8:32:2E" --height-m 587 --utc 2021-08-17T11:30:00Z --kind adaptive \
    --out $out/skies/dome.ply
echo "  $out/skies/dome.ply  a dome with vertex colours, for any mesh viewer"
echo "  $(seconds "$start")"
