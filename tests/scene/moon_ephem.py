"""Compares the rows of moon_rows with PyEphem's moon (Moshier's lunar theory, its own time and horizon code)."""
import math
import sys

import ephem

# Ours is within 0.010 deg of ERFA. PyEphem's own guess at TT - UT1 is up to 20 s away by 2050: 0.003 deg of the moon. Its
# places are rounded to float on the way: 0.00002 deg.
LIMIT_DEG = 0.014


def direction(day, seconds, lat, lon, height_km):
    o = ephem.Observer()
    o.lat, o.lon, o.elevation, o.pressure = math.radians(lat), math.radians(lon), height_km * 1000, 0
    o.date = ephem.Date("2000/1/1") + day + seconds / 86400
    m = ephem.Moon(o)
    return math.cos(m.alt) * math.sin(m.az), math.cos(m.alt) * math.cos(m.az), math.sin(m.alt)


def angle_deg(a, b):
    cross = (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
    return math.degrees(math.atan2(math.hypot(*cross), sum(x * y for x, y in zip(a, b))))


def main():
    rows = [[float(x) for x in line.split()] for line in sys.stdin]
    errors = [angle_deg(direction(*row[:5]), row[5:]) for row in rows]
    worst = max(range(len(rows)), key=errors.__getitem__)
    rms = math.sqrt(sum(e * e for e in errors) / len(errors))
    print("figure: moon against PyEphem, %d places: max %.4f deg, rms %.4f deg" % (len(rows), errors[worst], rms))
    if not errors[worst] <= LIMIT_DEG:
        sys.exit("moon: off by %.4f deg, allowed %.4f, at %s" % (errors[worst], LIMIT_DEG, rows[worst][:5]))


main()
