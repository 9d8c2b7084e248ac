# scenes.awk -v seed=N -v number=K -v what=scene|options: random scene K, or its `vertices target max-error`. The same on every
# awk: the generator of [ParkMiller88], whose products are exact in a double.
function uniform() { state = state * 16807 % 2147483647; return state / 2147483647 }
function between(a, b) { return a + (b - a) * uniform() }
function pick(list,   n, part) { n = split(list, part, " "); return part[1 + int(n * uniform())] }
BEGIN {
    state = seed * 7919 # one stream; each scene takes its stretch of 40
    for (i = 0; i < 40 * number; i++) uniform()
    planet = pick("earth-clear earth-clear earth-clear earth-clear earth-hazy earth-hazy earth-hazy earth-hazy earth-hazy mars")
    time = pick("day day low low dusk")
    sun = time == "day" ? between(12, 50) : time == "low" ? between(2, 12) : between(-5, 1)
    sun_to = sun + (time == "day" ? between(5, 25) : time == "low" ? between(2, 8) : between(1, 4))
    level = pick("ground low flight")
    height = level == "ground" ? 0 : level == "low" ? between(100, 2500) : between(3000, 11000)
    height_to = height + (level == "ground" ? between(5, 300) : between(500, 2500))
    visibility = exp(between(log(20), log(70)))
    visibility_to = visibility * between(1, 1.6)
    view = pick("-10,90 0,90 -20,40 -5,60 -90,90")
    terrain = view == "0,90" ? "no" : pick("yes no")
    stars = time == "dusk" ? pick("yes no") : "no"
    vertices = pick("256 512 1024 2048 4096")
    split("x86-avx2 cortex-m4f x86-sse2 cortex-a53 cortex-m7", targets, " ")
    # Coarse dust is not known better than this.
    error = (time == "dusk" ? between(9, 16) : between(7, 15)) * (planet == "mars" ? 2.5 : 1)
    if (what == "options") { printf "%d %s %.1f\n", vertices, targets[number % 5 + 1], error; exit }
    printf "; random scene %d of seed %d (tests/plan/scenes.awk)\n[planet]\npreset = %s\n", number, seed, planet
    printf "[observer]\nheight_m = %.0f, %.0f\n[sun]\nelevation_deg = %.1f, %.1f\n", height, height_to, sun, sun_to
    if (planet != "mars") printf "[air]\nvisibility_km = %.1f, %.1f\n", visibility, visibility_to
    printf "[view]\nelevation_deg = %s\nterrain = %s\nstars = %s\n", view, terrain, stars
}
