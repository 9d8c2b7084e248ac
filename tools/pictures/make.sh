#!/usr/bin/env bash
# make.sh SKYVERT FOLDER SIDE: the pictures of the README, each SIDE pixels wide.
# No dithering: it would double the size of the files.
set -eu
skyvert=$1 folder=$2 side=$3
mkdir -p "$folder"
half=$((side / 2))

picture() { "$skyvert" render "${@:2}" --no-dither --tier high --out "$folder/$1.png" && echo "  $folder/$1.png  ${note}"; }

note="Zurich airport at noon in August: the whole sky, north up, east left"
picture noon --position "47:27:32N 8:32:2E" --height-m 587 --ground-m 432 --utc 2021-08-17T11:30:00Z --size "${side}x$side"
note="the sun 2 degrees up, straight ahead"
picture sun-2deg --sun-zenith-deg 88 --sun-azimuth-deg 270 --projection perspective --fov-deg 100 --elevation-deg 18 --supersample 3 --size "${side}x$half"
note="the sun 4 degrees down: up to 15 km overhead is in the planet's shadow"
picture sun-minus4deg --sun-zenith-deg 94 --sun-azimuth-deg 270 --projection perspective --fov-deg 100 --elevation-deg 18 --supersample 3 --size "${side}x$half"
note="12 km up, the sun 25 degrees up on the left"
picture 12km --sun-zenith-deg 65 --sun-azimuth-deg 180 --height-m 12000 --projection perspective --fov-deg 90 --azimuth-deg 250 --elevation-deg 2 --supersample 3 --size "${side}x$half"
note="from 400 km, above the top of the air: the limb by day"
picture space --sun-zenith-deg 70 --sun-azimuth-deg 180 --height-m 400000 --projection perspective --fov-deg 50 --azimuth-deg 250 --elevation-deg -19 --supersample 3 --size "${side}x$half"
