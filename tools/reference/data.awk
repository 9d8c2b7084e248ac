# Random rays for the committed truth: -v seed=N -v radius=KM -v top=KM. The same on every awk: the generator of
# [ParkMiller88], whose products are exact in a double.
function uniform() { state = state * 16807 % 2147483647; return state / 2147483647 }
function arccos(x) { return atan2(sqrt(1 - x * x), x) / rad }
function normal() { return sqrt(-2 * log(uniform())) * cos(6.283185307179586 * uniform()) }
function ray(sun,   u, h, dip, view, turn) {
    u = uniform()
    h = u < .1 ? 0 : u < .5 ? 5 * uniform() : u < .75 ? 5 + 15 * uniform() : 20 + (top - 20) * uniform()
    dip = 90 + arccos(radius / (radius + h)) # of the horizon
    u = uniform()
    view = u < .4 ? 88 * uniform() : u < .75 ? dip + 5 * normal() : dip + (180 - dip) * uniform()
    turn = sun > 87 && uniform() < .33 ? 360 + 80 * uniform() - 40 : 360 * uniform()
    if (view > 180) view = 180
    if (turn >= 360) turn -= 360
    printf "%.6g,%.6g,%.6g,%.6g\n", h, sun, view, turn
}
BEGIN {
    rad = atan2(0, -1) / 180
    state = seed
    print "altitude_km,sun_zenith_deg,view_zenith_deg,rel_azimuth_deg"
    for (i = 0; i < 30; i++) ray(arccos(cos(75 * rad) + (1 - cos(75 * rad)) * uniform()))
    for (i = 0; i < 12; i++) ray(80 + 5 * uniform())
    for (i = 0; i < 28; i++) ray(88 + 4 * uniform())
    for (i = 0; i < 15; i++) ray(94)
    for (i = 0; i < 15; i++) ray(96)
}
