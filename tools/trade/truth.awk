# Rays of the trade's truth: -v seed=N -v radius=KM. 24 rays in each of nine scenes, the sun at 40, 88.5 and 94 deg from
# the zenith, seen from 0, 12 and 40 km. The same on every awk: the generator of [ParkMiller88], whose products are
# exact in a double; four decimals.
function uniform() { state = state * 16807 % 2147483647; return state / 2147483647 }
function arccos(x) { return atan2(sqrt(1 - x * x), x) / rad }
function turned() { return int(3600000 * uniform()) / 10000 }
function ray(view, turn) {
    if (view < 0) { view = -view; turn += 180 }
    if (view > 180) view = 180
    if (turn < 0) turn += 360
    if (turn >= 360) turn -= 360
    printf "%g,%g,%.4f,%.4f\n", h, sun, view, turn
}
# Evenly over the sky, every ring of it once.
function over_the_sky(n,   i) {
    for (i = 0; i < n; i++) ray(arccos(1 - (1 - cos(horizon * rad)) * (i + uniform()) / n), turned())
}
# Within 6 deg above the horizon, crowding at it.
function above_the_horizon(n,   i) {
    for (i = 0; i < n; i++) ray(horizon - .02 - 6 * ((i + uniform()) / n) ^ 2, turned())
}
# Within 20 deg of the sun; of the horizon below which it has set.
function toward_the_sun(n,   i, away, side, up, view) {
    for (i = 0; i < n; i++) {
        away = 20 * ((i + uniform()) / n) ^ 1.5
        side = 360 * uniform()
        up = away * cos(side * rad)
        view = (sun < horizon ? sun : horizon) - up
        if (view >= horizon) view = (sun < horizon ? sun : horizon) + (up < 0 ? up : -up) - .05
        ray(view, away * sin(side * rad) / (sun < 60 ? sin(sun * rad) : 1))
    }
}
function to_the_ground(n,   i) {
    for (i = 0; i < n; i++) ray(horizon + .05 + (180 - horizon - .05) * ((i + uniform()) / n) ^ 1.5, turned())
}
BEGIN {
    rad = atan2(0, -1) / 180
    state = seed
    print "altitude_km,sun_zenith_deg,view_zenith_deg,rel_azimuth_deg"
    split("0 12 40", heights)
    split("40 88.5 94", suns)
    for (k = 1; k <= 3; k++) for (s = 1; s <= 3; s++) {
        h = heights[k]
        sun = suns[s]
        horizon = h > 0 ? 90 + arccos(radius / (radius + h)) : 90
        over_the_sky(h > 0 ? 9 : 12)
        above_the_horizon(h > 0 ? 5 : 6)
        toward_the_sun(h > 0 ? 4 : 6)
        if (h > 0) to_the_ground(6)
    }
}
