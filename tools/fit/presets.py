#!/usr/bin/env python3
"""The planets of skv_atmosphere_preset() from cited data. Sources: keys in brackets, README "Sources".

    presets.py           writes src/core/presets_data.h
    presets.py --check   computes it again and compares (exit status 1 where it differs)
    presets.py --report  prints visibility and optical depths
"""

import math
import os
import sys

import colour_physics as p
from generated import write_or_check

HEADER = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../src/core/presets_data.h")

BANDS = (450, 535, 610, 445, 520, 570, 630)  # three, then four

# Exact similarity: the tiny planet is the clear Earth with every length divided by this.
TINY_SCALE = 100


def cornette_shanks_parameter(mean_cosine):
    """g of the Cornette-Shanks phase function whose mean cosine is given: 3 g (4 + g^2) / (5 (2 + g^2)) [Cornette92]."""
    low, high = 0.0, 0.9999
    for _ in range(60):
        g = 0.5 * (low + high)
        low, high = (g, high) if 3 * g * (4 + g * g) / (5 * (2 + g * g)) < mean_cosine else (low, g)
    return 0.5 * (low + high)


def opac(extinction_550, albedo, g, alpha_below, alpha_above, depth_550):
    """A continental mixture of [Hess98] (tables 4 and 3): Angstrom exponents below and above 500 nm; the scale height is
    the one that gives the table's optical depth."""
    def extinction(nm):
        at_500 = extinction_550 * 1.1**alpha_above
        return at_500 * (nm / 500.0) ** -(alpha_below if nm < 500 else alpha_above)

    return {"extinction": extinction, "albedo": lambda nm: albedo, "height": depth_550 / extinction_550,
            "phase": "SKV_PHASE_CS", "g": cornette_shanks_parameter(g)}


def earth(aerosol):
    """Standard air [Bodhaine99], hydrostatic scale height (the true column); 300 DU of ozone [Serdyuchenko14] in a tent of
    25 +- 15 km, whose integral is 15 km [Bruneton17]; grass [Feister95]."""
    peak = 300 * p.DOBSON / 15000.0
    return {"radius": 6371.0, "top": 60.0, "au": 1.0, "height": p.scale_height_km(288.15, 0.0289644, 9.80665),
            "rayleigh": p.rayleigh_air_per_km, "albedo": p.grass, "aerosol": aerosol,
            "ozone": lambda nm: p.ozone_m2(nm) * peak * 1e3, "ozone_peak": 25.0, "ozone_half_width": 15.0}


def henyey_greenstein(g, nu):
    return (1 - g * g) / (4 * math.pi * (1 + g * g - 2 * g * nu) ** 1.5)


def two_modes(wavelengths, mean_cosine, wide, lobe, share_nm):
    """Two Henyey-Greenstein functions whose mix, in shares that give the mean cosine at each wavelength, is nearest to a
    phase function: in logarithms at 1 to 120 deg, and four times as much for the ratio of the shortest to the longest
    wavelength within 12 deg, which is the glow's colour. That function is what was measured at share_nm (forward lobe
    `lobe`, rest `wide`), the lobe narrower in proportion to the wavelength as diffraction is [Ehlers14]."""
    angles = list(range(1, 10)) + list(range(10, 125, 5))
    cosines = [math.cos(math.radians(x)) for x in angles]
    near = sum(x <= 12 for x in angles)

    def share(g, of, rest):
        return (g - rest) / (of - rest)

    def mix(w, of, rest):
        return [w * henyey_greenstein(of, nu) + (1 - w) * henyey_greenstein(rest, nu) for nu in cosines]

    def target(nm):
        narrow = 1 - (1 - lobe) * nm / share_nm
        return mix(share(mean_cosine(nm), narrow, wide), narrow, wide)

    wanted = [target(nm) for nm in wavelengths]
    best = (math.inf, 0, 0)
    for i in range(28):
        for j in range(33):
            g1, g2 = 0.84 + 0.005 * i, 0.02 * j
            shares = [share(mean_cosine(nm), g1, g2) for nm in wavelengths]
            if max(shares) > 1:
                continue
            logs = [[math.log(a / b) for a, b in zip(mix(w, g1, g2), t)] for w, t in zip(shares, wanted)]
            shape = sum(x * x for row in logs for x in row) / (len(logs) * len(angles))
            colour = sum((a - b) ** 2 for a, b in zip(logs[0][:near], logs[-1][:near])) / near
            best = min(best, (shape + 4 * colour, g1, g2))
    _, g1, g2 = best
    return g1, g2, lambda nm: share(mean_cosine(nm), g1, g2)


def mars():
    """CO2 at 610 Pa and 210 K, 3.71 m/s^2, 1.52366 au [Williams NSSDCA]. Dust: optical depth 0.5 at 670 nm [Smith99], mixed
    with the gas, relative extinction and mean cosine [OckertBell97] as the Ames Mars climate model averages them over its
    bands, single scattering albedo [Wolff09] as the LMD Mars climate model has it, phase function at 650 nm
    [ChenChen19]: .743 parts of Henyey-Greenstein .889 in .094. One phase function serves all bands, so the dust is two
    species: a wide one (aerosol) and a forward lobe (dust) that has a larger share of the blue than of the red light: the
    blue glow about the low sun. Ground: geometric albedo in B, V, R [Mallama17]."""
    height = p.scale_height_km(210.0, 0.04334, 3.71)
    number = p.number_per_cm3(610.0, 210.0)
    q = lambda nm: p.interpolate(nm, (320, 600, 1050), (2.622, 2.938, 3.207))
    cosine = lambda nm: p.interpolate(nm, (320, 600, 1050), (0.856, 0.700, 0.634))
    albedo = lambda nm: p.interpolate(nm, (388, 650, 700), (0.73, 0.967, 0.975))
    extinction = lambda nm: 0.5 / height * q(nm) / q(670)
    lobe, wide, share = two_modes(BANDS[3:], cosine, 0.094, 0.889, 650.0)
    mode = lambda part, g: {"extinction": lambda nm: extinction(nm) * part(nm), "albedo": albedo, "height": height,
                            "phase": "SKV_PHASE_HG", "g": g}
    return {"radius": 3389.5, "top": 100.0, "au": 1.52366, "height": height,
            "rayleigh": lambda nm: p.rayleigh_co2_cm2(nm) * number * 1e5,
            "albedo": lambda nm: p.interpolate(nm, (436, 549, 641), (0.088, 0.170, 0.250)),
            "aerosol": mode(lambda nm: 1 - share(nm), wide), "dust": mode(share, lobe)}


# Titan's haze lies below and above this altitude, km; above it thins with this scale height [Tomasko08].
TITAN_BREAK, TITAN_HEIGHT, TITAN_TOP = 80.0, 65.0, 600.0


def titan():
    """N2 at 146645 Pa and 93.5 K (Huygens' HASI [Fulchignoni05]) with 5 % CH4, 1.352 m/s^2, 9.58 au [Williams NSSDCA].
    Haze [Tomasko08]: optical depths below 30 km, 30-80 km and above 80 km as powers of the wavelength, even below 80 km,
    scale height 65 km above. Single scattering albedo [Doose16]: below 80 km .940 at 500 nm and .988 at 650 nm, linear
    (nothing is known below 490 nm); above 200 km 1.5 times that less .565; between, linear in altitude: .456 of the haze
    above 80 km has it. Mean cosines .75 and .76, the middle of [Tomasko08]'s table. Methane: 2.80 km-amagat above the
    ground times [Karkoschka98]'s coefficients around the bands, to one digit. Ground [Karkoschka16]."""
    height = p.scale_height_km(93.5, 0.0278, 1.352)
    number = p.number_per_cm3(146645.0, 93.5)
    below = lambda nm: 627.0 * nm**-0.9706 + 20290.0 * nm**-1.409
    above = lambda nm: 1.012e7 * nm**-2.339
    low = lambda nm: 0.940 + (0.988 - 0.940) * (nm - 500) / 150
    high = lambda nm: 0.544 * low(nm) + 0.456 * (1.5 * low(nm) - 0.565)
    methane = lambda nm: p.interpolate(nm, (450, 520, 535, 570, 610, 630), (0.0, 0.005, 0.02, 0.01, 0.05, 0.07))
    return {"radius": 2575.0, "top": TITAN_TOP, "au": 9.58, "height": height,
            "rayleigh": lambda nm: p.rayleigh_n2_cm2(nm) * number * 1e5,
            "absorption": lambda nm: 2.80 / height * methane(nm),
            "albedo": lambda nm: p.interpolate(nm, (360, 450, 555, 600, 830), (0.041, 0.072, 0.105, 0.108, 0.150)),
            "aerosol": {"extinction": lambda nm: above(nm) / TITAN_HEIGHT, "albedo": high, "height": 0.0,
                        "phase": "SKV_PHASE_HG", "g": 0.76},
            "dust": {"extinction": lambda nm: below(nm) / TITAN_BREAK, "albedo": low, "height": 0.0,
                     "phase": "SKV_PHASE_HG", "g": 0.75}}


def titan_tables():
    """Relative densities: 1 below the break; above it, the exponential. Both change over 10 km."""
    edge = (TITAN_BREAK - 5, TITAN_BREAK + 5)
    heights = [x for x in range(90, 200, 10)] + [x for x in range(200, int(TITAN_TOP) + 1, 25)]
    thin = lambda h: math.exp(-(h - TITAN_BREAK) / TITAN_HEIGHT)
    return [(edge[0], 1.0), (edge[1], 0.0)], [(edge[0], 0.0), (edge[1], thin(edge[1]))] + [(h, thin(h)) for h in heights]


def smoke():
    """Smoke of boreal forests [Dubovik02]: single scattering albedo .94 and .935, mean cosine .69 and .61 at 440 and
    670 nm (.66 for all bands), Angstrom exponent 1.8; a layer at 2 to 5 km as seen over Kuopio [Shang21], optical depth
    .5 at 550 nm."""
    half = 1.5
    return {"extinction": lambda nm: 0.5 / half * (nm / 550.0) ** -1.8, "peak": 3.5, "half_width": half,
            "albedo": lambda nm: p.interpolate(nm, (440, 670), (0.94, 0.935)), "phase": "SKV_PHASE_HG", "g": 0.66}


def giant():
    """The air of Jupiter above 1 bar: 165 K, 24.79 m/s^2, 5.2038 au, H2 0.864, He 0.136 [Niemann98]; H2 [Dalgarno62], He's 1 % of
    the scattering is left out; no haze; the deck's albedo is the geometric one in B, V, R [Mallama17]."""
    number = 0.864 * p.number_per_cm3(1e5, 165.0)
    return {"radius": 71492.0, "top": 250.0, "au": 5.2038,
            "height": p.scale_height_km(165.0, 0.864 * 2.016e-3 + 0.136 * 4.0026e-3, 24.79),
            "rayleigh": lambda nm: p.rayleigh_h2_cm2(nm) * number * 1e5,
            "albedo": lambda nm: p.interpolate(nm, (436, 549, 641), (0.443, 0.538, 0.513))}


PLANETS = (("EARTH_CLEAR", earth(opac(0.026, 0.972, 0.709, 1.10, 1.42, 0.064))),
           ("EARTH_HAZY", earth(opac(0.075, 0.925, 0.703, 1.11, 1.42, 0.151))),
           ("MARS", mars()), ("GIANT", giant()), ("TITAN", titan()))
LAYERS = (("mars", PLANETS[2][1]["dust"]), ("titan", PLANETS[4][1]["dust"]), ("smoke", smoke()))


def number(x):
    text = f"{x:.7g}"
    return text + ("f" if any(c in text for c in ".e") else ".0f")


def numbers(f):
    return "{" + ", ".join(number(f(nm)) for nm in BANDS) + "}"


def row(planet):
    none = lambda nm: 0.0
    a = planet.get("aerosol") or {"extinction": none, "albedo": none, "height": 0.0, "phase": "SKV_PHASE_HG", "g": 0.0}
    scalars = (planet["radius"], planet["top"], planet["au"] ** -2, planet["height"], a["height"], a["g"],
               planet.get("ozone_peak", 0.0), planet.get("ozone_half_width", 0.0))
    return ("    {" + ", ".join(number(x) for x in scalars) + f", {a['phase']},\n     " + ",\n     ".join(
        numbers(f) for f in (planet["albedo"], planet["rayleigh"], planet.get("absorption", none), lambda nm: a["extinction"](nm) * a["albedo"](nm),
                             a["extinction"], planet.get("ozone", none))) + "},\n")


def layer(a):
    shape = (a["peak"], a["half_width"]) if "peak" in a else (a["height"], 0.0)
    return ("    {" + ", ".join(number(x) for x in (*shape, a["g"])) + f", {a['phase']},\n     " + ",\n     ".join(
        numbers(f) for f in (lambda nm: a["extinction"](nm) * a["albedo"](nm), a["extinction"])) + "},\n")


def table(name, rows):
    line = lambda values: ", ".join(number(x) for x in values)
    return (f"static const float {name}_km[{len(rows)}] = {{{line(x for x, _ in rows)}}};\n"
            f"static const float {name}_density[{len(rows)}] = {{{line(y for _, y in rows)}}};\n")


def header():
    low, high = titan_tables()
    tables = table("skv_titan_low", low) + table("skv_titan_high", high)
    layers = "".join(f"    // {name}\n{layer(a)}" for name, a in LAYERS)
    rows = "".join(f"    // {name}\n{row(planet)}" for name, planet in PLANETS)
    return (f"""// Made by tools/fit/presets.py, where figures, units and sources stand. `make fit-check` compares.
// clang-format off
#ifndef SKV_CORE_PRESETS_DATA_H
#define SKV_CORE_PRESETS_DATA_H

// Every length of the tiny planet is the clear Earth's divided by this.
#define SKV_TINY_SCALE {TINY_SCALE}.0f

// nm: three bands, then four.
static const float skv_preset_nm[7] = {numbers(float)};
// W m^-2 nm^-1 at 1 au.
static const float skv_preset_solar[7] = {numbers(p.solar)};
// radius, top, sun relative to 1 au, scale heights of air and aerosol, g, ozone peak and half width, phase; per band: albedo,
// Rayleigh scattering, absorption of the gas, aerosol scattering and extinction, ozone absorption, per km.
static const skv_preset_row skv_preset_rows[{len(PLANETS)}] = {{
{rows}}};

// Dust: scale height, or peak and half width of a tent; g, phase; per band: scattering and extinction, per km.
static const skv_preset_layer skv_preset_layers[{len(LAYERS)}] = {{
{layers}}};

// Titan's haze below and above its break.
{tables}
#endif
""")


def report():
    for name, x in PLANETS[:4]:
        a = x.get("aerosol")
        total = x["rayleigh"](550) + (a["extinction"](550) if a else 0.0)
        print(f"figure: {name}: visibility (Koschmieder, 3.912 / extinction at 550 nm) {3.912 / total:.0f} km; optical depth at "
              f"550 nm: gas {x['rayleigh'](550) * x['height']:.4f}, "
              f"aerosol {a['extinction'](550) * a['height'] if a else 0:.3f}, "
              f"ozone {x['ozone'](550) * x['ozone_half_width'] if 'ozone' in x else 0:.4f}; "
              f"scale heights {x['height']:.2f}, {a['height'] if a else 0:.2f} km")


def main(arguments):
    p.check_sources()
    if arguments == ["--report"]:
        report()
        return 0
    return write_or_check(arguments, HEADER, header())


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
