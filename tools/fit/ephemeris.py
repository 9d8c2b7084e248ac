#!/usr/bin/env python3
"""Writes src/scene/ephemeris_data.c: published angular arguments as 64-bit fixed-point turns.

usage: ephemeris.py [--check]

Each argument is phase + rate * time. In float the product loses whole degrees; as turns * 2^64 in wrapping integers it
is exact on every target. Only exact rational arithmetic here: the published decimals go in, the nearest integers out.

Sources
  [Bretagnon88] VSOP87, series D of the Earth (ecliptic and equinox of date): A cos(B + C t), t in Julian millennia of
                TDB from J2000.0, truncated as below.
  [Meeus98]     Astronomical Algorithms, 2nd edition, chapters 22 (nutation) and 47 (moon): degrees, T in Julian centuries.
  [Petit10]     IERS Conventions (2010), ch. 5: Earth rotation angle (eq. 5.15), accumulated precession (eq. 5.32).
"""
import os
import sys
from fractions import Fraction as F

from generated import write_or_check

PI = F("3.14159265358979323846264338327950288419716939937510582097494459")
TT_MINUS_UTC = F("69.184")  # s, since 2017
DAY = 86400
TICKS = 1 << 15  # per second
TURN = 1 << 64
# Time 0 of the tables is 2000-01-01 00:00 UTC; J2000.0 is noon of that day, in TT or (for the Earth's turning) in UT1.
START_TT = (F(-DAY, 2) + TT_MINUS_UTC) / DAY  # days from J2000.0
START_UT = F(-1, 2)

# name, degrees at J2000.0, degrees per Julian century, degrees per century squared; what
MEEUS = [
    ("MOON_LONGITUDE", "218.3164477", "481267.88123421", "-0.0015786", "L', mean longitude of the moon, light time included"),
    ("MOON_ELONGATION", "297.8501921", "445267.1114034", "-0.0018819", "D, mean elongation of the moon"),
    ("SUN_ANOMALY", "357.5291092", "35999.0502909", "-0.0001536", "M, mean anomaly of the sun"),
    ("MOON_ANOMALY", "134.9633964", "477198.8675055", "0.0087414", "M', mean anomaly of the moon"),
    ("MOON_LATITUDE", "93.2720950", "483202.0175233", "-0.0036539", "F, moon's argument of latitude"),
    ("MOON_NODE", "125.04452", "-1934.136261", "0.0020708", "Omega, longitude of the moon's ascending node"),
    ("VENUS_A1", "119.75", "131.849", "0", "A1, due to Venus"),
    ("JUPITER_A2", "53.09", "479264.290", "0", "A2, due to Jupiter"),
    ("MOON_A3", "313.45", "481266.484", "0", "A3"),
]

# VSOP87D, Earth. Amplitudes in 1e-8 rad or 1e-8 au, phase in rad, rate in rad per millennium; power of t.
LONGITUDE = [
    (0, 3341656.456, "4.66925680417", "6283.07584999140"),
    (0, 34894.275, "4.62610241759", "12566.15169998280"),
    (0, 3497.056, "2.74411800971", "5753.38488489680"),
    (0, 3417.571, "2.82886579606", "3.52311834900"),
    (0, 3135.896, "3.62767041758", "77713.77146812050"),
    (0, 2676.218, "4.41808351397", "7860.41939243920"),
    (0, 2342.687, "6.13516237631", "3930.20969621960"),
    (0, 1324.292, "0.74246356352", "11506.76976979360"),
    (0, 1273.166, "2.03709655772", "529.69096509460"),
    (0, 1199.167, "1.10962944315", "1577.34354244780"),
    (0, 990.250, "5.23268129594", "5884.92684658320"),
    (0, 901.855, "2.04505443513", "26.29831979980"),
    (0, 857.223, "3.50849156957", "398.14900340820"),
    (0, 779.786, "1.17882652114", "5223.69391980220"),
    (0, 753.141, "2.53339053818", "5507.55323866740"),
    (0, 505.264, "4.58292563052", "18849.22754997420"),
    (0, 492.379, "4.20506639861", "775.52261132400"),
    (0, 356.655, "2.91954116867", "0.06731030280"),
    (0, 317.087, "5.84901952218", "11790.62908865880"),
    (0, 284.125, "1.89869034186", "796.29800681640"),
    (0, 271.039, "0.31488607649", "10977.07880469900"),
    (0, 242.810, "0.34481140906", "5486.77784317500"),
    (0, 206.160, "4.80646606059", "2544.31441988340"),
    (0, 205.385, "1.86947813692", "5573.14280143310"),
    (1, 206058.863, "2.67823455584", "6283.07584999140"),
    (1, 4303.430, "2.63512650414", "12566.15169998280"),
    (1, 425.264, "1.59046980729", "3.52311834900"),
]
DISTANCE = [
    (0, 1670699.626, "3.09846350771", "6283.07584999140"),
    (0, 13956.023, "3.05524609620", "12566.15169998280"),
    (0, 3083.720, "5.19846674381", "77713.77146812050"),
    (0, 1628.461, "1.17387749012", "5753.38488489680"),
    (0, 1575.568, "2.84685245825", "7860.41939243920"),
    (0, 924.799, "5.45292234084", "11506.76976979360"),
    (0, 542.444, "4.56409149777", "3930.20969621960"),
    (1, 103018.608, "1.10748969588", "6283.07584999140"),
]
# L0, L1, L2 of the mean longitude (rad, rad per millennium, rad per millennium squared)
EARTH = ("1.75347045673", "6283.31966747491", "0.00052918870")
# Earth rotation angle, turns and turns per day of UT1, and the accumulated precession, arc seconds and per century (TT)
EARTH_ROTATION = ("0.7790572732640", "1.00273781191135448")
GST_PRECESSION = ("0.014506", "4612.156534", "1.3915817")


def argument(at_j2000, per_day, start=START_TT):
    """Initialiser of a skv_argument from turns and turns per day."""
    base = at_j2000 + per_day * start
    return "{%s, %s, %s}" % tuple(
        "UINT64_C(0x%016x)" % (round(x * TURN) % TURN) for x in (base, per_day, per_day / (DAY * TICKS))
    )


def vsop_rows(rows):
    for power, amplitude, phase, rate in rows:
        turns = argument(F(phase) / (2 * PI), F(rate) / (2 * PI) / 365250)
        a = amplitude * 1e-8 / 10**power  # per century from per millennium
        yield "    {%s, %s, %s},\n" % (turns, *(("%.8ef" % a, "0.0f") if power == 0 else ("0.0f", "%.8ef" % a)))


def linear_rows():
    """The mean longitudes and anomalies in the order of enum skv_linear."""
    for name, a0, a1, a2, what in MEEUS:
        yield name, argument(F(a0) / 360, F(a1) / 360 / 36525), F(a2) / 360, what
    l0, l1, l2 = (F(x) / (2 * PI) for x in EARTH)
    yield "EARTH_LONGITUDE", argument(l0, l1 / 365250), l2 / 100, "mean heliocentric longitude of the Earth"
    era0, era1 = (F(x) for x in EARTH_ROTATION)
    p0, p1, p2 = (F(x) / 3600 / 360 for x in GST_PRECESSION)
    # One argument for both: the precession's clock runs 69 s ahead of the rotation's, 1e-6 arc seconds.
    yield "SIDEREAL", argument(era0 + p0, era1 + p1 / 36525, START_UT), p2, "Greenwich mean sidereal time"


def text():
    out = [
        "// Written by tools/fit/ephemeris.py from published coefficients; do not edit.\n",
        "// Arguments are turns * 2^64: at 2000-01-01 00:00 UTC, per day, per 2^-15 s.\n",
        "// clang-format off\n",
        '#include "scene/ephemeris.h"\n\n',
        "const skv_linear_argument skv_linear[SKV_LINEAR_COUNT] = {\n",
    ]
    for name, numbers, square, what in linear_rows():
        out.append("    [SKV_%s] = {%s, %.8ef}, // %s\n" % (name, numbers, float(square * 2**32), what))
    for name, rows in (("longitude", LONGITUDE), ("distance", DISTANCE)):
        out.append("};\n\nconst skv_harmonic skv_earth_%s[SKV_EARTH_%s_TERMS] = {\n" % (name, name.upper()))
        out.extend(vsop_rows(rows))
    out.append("};\n// clang-format on\n")
    return "".join(out)


if __name__ == "__main__":
    here = os.path.dirname(os.path.abspath(__file__))
    sys.exit(write_or_check(sys.argv[1:], os.path.join(here, "../../src/scene/ephemeris_data.c"), text()))
