#!/usr/bin/env python3
"""The planets of skv_atmosphere_preset() from cited data. Sources: keys in brackets, README "Sources".

    presets.py           writes src/core/presets_data.h
    presets.py --check   computes it again and compares (exit status 1 where it differs)
    presets.py --report  prints visibility and optical depths
"""

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


def mars():
    """CO2 at 610 Pa and 210 K, 3.71 m/s^2, 1.52366 au [Williams NSSDCA]. Dust: optical depth 0.5 at 670 nm [Smith99], mixed
    with the gas, relative extinction [OckertBell97], single scattering albedo [Wolff09] as the LMD Mars
    climate model has it, mean cosine 0.69 at 650 nm [ChenChen19].
    Ground: geometric albedo in B, V, R [Mallama17]."""
    height = p.scale_height_km(210.0, 0.04334, 3.71)
    number = p.number_per_cm3(610.0, 210.0)
    q = lambda nm: p.interpolate(nm, (320, 600, 1050), (2.622, 2.938, 3.207))
    dust = {"extinction": lambda nm: 0.5 / height * q(nm) / q(670),
            "albedo": lambda nm: p.interpolate(nm, (388, 650, 700), (0.73, 0.967, 0.975)), "height": height,
            "phase": "SKV_PHASE_HG", "g": 0.69}
    return {"radius": 3389.5, "top": 100.0, "au": 1.52366, "height": height,
            "rayleigh": lambda nm: p.rayleigh_co2_cm2(nm) * number * 1e5,
            "albedo": lambda nm: p.interpolate(nm, (436, 549, 641), (0.088, 0.170, 0.250)), "aerosol": dust}


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
           ("MARS", mars()), ("GIANT", giant()))


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
        numbers(f) for f in (planet["albedo"], planet["rayleigh"], lambda nm: a["extinction"](nm) * a["albedo"](nm),
                             a["extinction"], planet.get("ozone", none))) + "},\n")


def header():
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
// Rayleigh scattering, aerosol scattering and extinction, ozone absorption, per km.
static const skv_preset_row skv_preset_rows[{len(PLANETS)}] = {{
{rows}}};

#endif
""")


def report():
    for name, x in PLANETS:
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
