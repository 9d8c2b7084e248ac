"""Spectra and cross-sections that presets.py and colour.py share. Units: nm, m, W m^-2 nm^-1; coefficients per km."""

import math
import os

HERE = os.path.dirname(os.path.abspath(__file__))

# Standard air, US Standard Atmosphere 1976: 288.15 K, 1013.25 hPa.
GAS_CONSTANT = 8.314462618
BOLTZMANN = 1.380649e-23
AIR_PER_CM3 = 2.546899e19
# One Dobson unit, molecules per m^2.
DOBSON = 2.687e20


def read_table(name):
    """Columns of a file of tools/fit/spectra, as lists; lines with # are comments."""
    with open(os.path.join(HERE, "spectra", name), encoding="ascii") as f:
        rows = [[float(x) for x in line.split()] for line in f if line.strip() and line[0] != "#"]
    return [list(column) for column in zip(*rows)]


def interpolate(x, xs, ys):
    """Linear between the points, constant beyond the ends."""
    if x <= xs[0]:
        return ys[0]
    for x0, x1, y0, y1 in zip(xs, xs[1:], ys, ys[1:]):
        if x <= x1:
            return y0 + (y1 - y0) * (x - x0) / (x1 - x0)
    return ys[-1]


def _binned(name):
    start, value = read_table(name)
    return [s + 5.0 for s in start], value


_SOLAR = _binned("solar_g173.txt")
_OZONE = _binned("ozone_serdyuchenko.txt")
_GRASS = read_table("grass_albedo.txt")


def solar(nm):
    """Solar irradiance at 1 au, mean of the 10 nm around nm (linear between bins)."""
    return interpolate(nm, *_SOLAR)


def ozone_m2(nm):
    """[Serdyuchenko14] cross-section at 233 K, m^2."""
    return interpolate(nm, *_OZONE)


def grass(nm):
    """[Feister95] albedo of grass."""
    return interpolate(nm, *_GRASS)


def rayleigh_air_cm2(nm):
    """[Bodhaine99] Eq. 29: cross-section of a molecule of dry air with 360 ppm CO2, cm^2; valid 250-850 nm."""
    w = nm * 1e-3
    top = 1.0455996 - 341.29061 / w**2 - 0.90230850 * w**2
    return 1e-28 * top / (1.0 + 0.0027059889 / w**2 - 85.968563 * w**2)


def rayleigh_air_bucholtz_cm2(nm):
    """[Bucholtz95] Eq. 8, table 3: the same by another author; the generators check one against the other."""
    w = nm * 1e-3
    a, b, c, d = (3.01577e-28, 3.55212, 1.35579, 0.11563) if w <= 0.5 else (4.01061e-28, 3.99668, 1.10298e-3, 2.71393e-2)
    return a * w ** -(b + c * w + d / w)


def rayleigh_air_per_km(nm):
    """At sea level of standard air."""
    return rayleigh_air_cm2(nm) * AIR_PER_CM3 * 1e5


def rayleigh_co2_cm2(nm):
    """[Sneep05]: refractive index of CO2 (after Bideau-Mehu 1973) and King factor, cm^2."""
    v = 1e7 / nm
    n1 = 1.1427e3 * (5799.25 / (128908.9**2 - v * v) + 120.05 / (89223.8**2 - v * v) + 5.3334 / (75037.5**2 - v * v)
                     + 4.3244 / (67837.7**2 - v * v) + 0.1218145e-4 / (2418.136**2 - v * v))
    n2 = (1.0 + n1) ** 2
    king = 1.1364 + 25.3e-12 * v * v
    return 24 * math.pi**3 * v**4 / AIR_PER_CM3**2 * ((n2 - 1) / (n2 + 2)) ** 2 * king


def rayleigh_n2_cm2(nm):
    """[Sneep05]: refractive index and King factor of N2 at 288.15 K, 1013.25 hPa, cm^2; valid 254-2060 nm."""
    v = 1e7 / nm
    a, b = (5677.465, 318.81874e12) if v < 21360 else (6498.2, 307.43305e12)
    n2 = (1.0 + (a + b / (14.4e9 - v * v)) * 1e-8) ** 2
    king = 1.034 + 3.17e-12 * v * v
    return 24 * math.pi**3 * v**4 / AIR_PER_CM3**2 * ((n2 - 1) / (n2 + 2)) ** 2 * king


def rayleigh_h2_cm2(nm):
    """[Dalgarno62]: cross-section of H2, cm^2."""
    a = nm * 10.0
    return 8.14e-13 / a**4 + 1.28e-6 / a**6 + 1.61 / a**8


def number_per_cm3(pascal, kelvin):
    return pascal / (BOLTZMANN * kelvin) * 1e-6


def scale_height_km(kelvin, kg_per_mol, gravity):
    """Hydrostatic: R T / (M g)."""
    return GAS_CONSTANT * kelvin / (kg_per_mol * gravity) * 1e-3


def check_sources():
    """The two air formulas agree within 1 % (0.3 % is what their papers state of each other)."""
    for nm in range(400, 701, 10):
        a, b = rayleigh_air_cm2(nm), rayleigh_air_bucholtz_cm2(nm)
        if abs(a - b) > 0.01 * a:
            raise SystemExit(f"rayleigh of air at {nm} nm: Bodhaine {a:.4g}, Bucholtz {b:.4g}")
