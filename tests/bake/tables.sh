# Baked tables through the C sampler against direct evaluation, at random places between the texels: default sizes.
# Limits, mean/95 %/largest: what was measured, and half as much again for other seeds and compilers. The largest errors are
# where a table cannot help it: the shadow's edge in twilight seen from above 30 km, rays to the ground from below 10 m, and
# seen from space the edge at which the air ends.
. tests/command/lib.sh

# bakes NAME OPTION...: into $work/NAME.raw16f
bakes() {
    run /dev/null "$skyvert" bake "${@:2}" --output "$work/$1.raw16f"
    [ $status -eq 0 ] && [ ! -s "$work/stderr" ] || fails "bake ${*:2}" "want status 0 and nothing on stderr"
}

# compares PRESET NAME [LABEL MEAN P95 MAX]...
compares() {
    cases=$((cases + 1))
    "$B/tests/bake/compare" "$1" 1 "$work/$2.raw16f" "${@:3}" 2>&1 || bad=$((bad + 1))
}

bakes sky-view-noon --what sky-view --preset earth-hazy --sun-zenith-deg 40 --height-m 1000
compares earth-hazy sky-view-noon sky .25 .9 2 ground .25 .9 3 transmittance .06 .2 .5
bakes sky-view-sunset-12km --what sky-view --preset earth-clear --sun-zenith-deg 91 --height-m 12000
compares earth-clear sky-view-sunset-12km sky .8 2.5 8 ground .3 1 3 transmittance .15 .7 1.5
bakes sky-view-deferred --what sky-view --preset earth-hazy --sun-zenith-deg 40 --height-m 1000 --phase deferred
compares earth-hazy sky-view-deferred sky .2 .7 1.5 ground .25 .9 3 transmittance .06 .2 .5
bakes sky-view-mars --what sky-view --preset mars --sun-zenith-deg 85 --height-m 100 --phase deferred
compares mars sky-view-mars sky .3 1 3 ground .3 1 3 transmittance .1 .3 1
bakes sky-view-space --what sky-view --preset earth-clear --sun-zenith-deg 60 --height-m 400000 --phase deferred
compares earth-clear sky-view-space sky .15 .3 50 ground .15 .3 1 transmittance .1 .3 3
bakes transmittance --what transmittance --preset earth-clear
compares earth-clear transmittance "to the top" .1 .3 7 "to the ground" .1 .3 7
bakes irradiance --what irradiance --preset earth-hazy
compares earth-hazy irradiance "down, sun above 2 deg" .6 1.5 4 "up, sun above 2 deg" .6 2 8 \
    "down, below" 1 2 4 "up, below" 2.5 5 10 "beam, % of the sun" .12 .4 1
bakes scattering-3d --what scattering-3d --preset earth-clear
compares earth-clear scattering-3d "sky, sun zenith 0-75" 1.1 3.2 20 "ground, 0-75" 1.8 5 60 "sky, 75-88" 1.3 4 20 "ground, 75-88" 1.3 4 45 \
    "sky, 88-92" 2.5 9 35 "ground, 88-92" 2.5 8 60 "sky, 92-96" 4.5 15 150 "ground, 92-96" 2.5 7 60
echo "figure: bytes: $(cd "$work" && wc -c sky-view-noon.raw16f transmittance.raw16f irradiance.raw16f scattering-3d.raw16f | awk '{printf "%s %s, ", $2, $1}')"
finish
