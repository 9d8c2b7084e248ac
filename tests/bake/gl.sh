# The GLSL sampler in OpenGL ES 3 against direct evaluation (mean limits as in tables.sh) and against the C sampler: .01 %,
# for the filter weighs with floats and a software renderer's square roots are not the host's.
. tests/command/lib.sh
[ -x "$B/tests/bake/gl" ] || { echo "GLSL sampler: not built (Debian: libegl-dev libgles-dev)" && exit 77; }

# looks_up PRESET NAME MEAN OPTION...
looks_up() {
    run /dev/null "$skyvert" bake --preset "$1" "${@:4}" --output "$work/$2.raw16f"
    [ $status -eq 0 ] || fails "bake ${*:4}" "want status 0"
    "$B/tests/bake/gl" "$1" "$work/$2.raw16f" "$3" .01 2>&1
    local rc=$?
    [ $rc -ne 77 ] || exit 77
    [ $rc -eq 0 ] || bad=$((bad + 1))
}
looks_up earth-hazy sky-view .25 --what sky-view --sun-zenith-deg 40 --height-m 1000
looks_up earth-hazy sky-view-deferred .25 --what sky-view --sun-zenith-deg 70 --height-m 9000 --phase deferred
looks_up mars sky-view-mars .3 --what sky-view --sun-zenith-deg 85 --phase deferred
looks_up earth-clear sky-view-space .5 --what sky-view --sun-zenith-deg 60 --height-m 400000
looks_up earth-clear transmittance .15 --what transmittance
looks_up earth-clear scattering-3d 2.5 --what scattering-3d --rows 48 --azimuths 10 --suns 48 --altitudes 20
looks_up earth-clear three-bands-irradiance 0 --what irradiance --bands 3 --suns 32 --altitudes 8
finish
