"""sim_log.py DBC LOG:FLIGHT.csv:NODE...: what canmatrix reads in logs of skyvert-sim by the DBC file.
sim_log.py make FOLDER: a flight as g.igc and as g.csv.

The flight is interpolated here, along the chord between two fixes, by the time of each frame: a log's clock is UTC. Sun and moon
are those of the Astronomical Almanac's low-precision formulas.
"""
import bisect
import calendar
import csv
import math
import os
import sys
import time

import canmatrix.formats


def read_log(path):
    rows = []
    for line in open(path, encoding="ascii"):
        stamp, interface, frame = line.split()
        identity, data = frame.split("#")
        rows.append((float(stamp[1:-1]), interface, int(identity, 16), bytes.fromhex(data)))
    return rows


def read_flight(path):
    rows = list(csv.DictReader(open(path, encoding="ascii")))
    times = [calendar.timegm(time.strptime(row["utc"], "%Y-%m-%dT%H:%M:%SZ")) for row in rows]
    return times, [(float(r["lat_deg"]), float(r["lon_deg"]), float(r["height_m"])) for r in rows]


def vector(lat, lon):
    lat, lon = math.radians(lat), math.radians(lon)
    return math.cos(lat) * math.cos(lon), math.cos(lat) * math.sin(lon), math.sin(lat)


def position(flight, stamp):
    """Latitude, longitude, height: the chord's point at that share of time, straight up from the centre."""
    times, fixes = flight
    i = min(max(bisect.bisect_right(times, stamp) - 1, 0), len(times) - 2)
    share = min(max((stamp - times[i]) / (times[i + 1] - times[i]), 0), 1)
    a, b = vector(*fixes[i][:2]), vector(*fixes[i + 1][:2])
    x, y, z = (p + share * (q - p) for p, q in zip(a, b))
    return math.degrees(math.atan2(z, math.hypot(x, y))), math.degrees(math.atan2(y, x)), fixes[i][2] + share * (fixes[i + 1][2] - fixes[i][2])


class Check:
    def __init__(self, name):
        self.name, self.wrong, self.worst = name, 0, {}

    def near(self, what, got, want, tolerance):
        error = abs(got - want)
        self.worst[what] = max(self.worst.get(what, 0), error)
        if not error <= tolerance:
            self.wrong += 1
            if self.wrong < 6:
                print(f"{self.name}: {what}: got {got!r}, want {want!r}, error {error:.3g}, tolerance {tolerance:.3g}")


def check_frame(check, flight, stamp, name, values):
    lat, lon, height = position(flight, stamp)
    # A frame is sampled when it is due and stamped when it ends: 1 ms later at 125 kbit/s, 2 ms where one waits. 250 m/s are
    # .0000022 deg of latitude a ms, .0000033 of longitude. The chord's share of time differs from the arc's by 1e-8 of 3 km.
    if name == "Latitude":
        check.near("latitude deg", values["Latitude_LONG"], lat, 5e-6)
    elif name == "Longitude":
        check.near("longitude deg", math.remainder(values["Longitude_LONG"] - lon, 360), 0, 7e-6)
    elif name == "TrueAltitude":
        check.near("altitude m", values["TrueAltitude"], height, 0.03)  # 15 m/s
    elif name == "HeightAboveEllipsoid":
        check.near("undulation m", values[name] - height, 0, 110)  # the geoid is -107 to +86 m from the ellipsoid
    elif name == "UTC":
        seconds = values["UTCHour"] * 3600 + values["UTCMinute"] * 60 + values["UTCSecond"]
        check.near("UTC s", seconds, int(stamp) % 86400, 0)
    elif name == "Date":
        day = time.gmtime(stamp)
        check.near("date", values["DateCentury"] * 100 + values["DateYearOfCentury"] + values["DateMonth"] / 100 + values["DateDay"] / 1e4, day.tm_year + day.tm_mon / 100 + day.tm_mday / 1e4, 1e-9)
    elif name in ("BodyPitchAngle", "BodyRollAngle"):  # their values: test_sim_flight.c
        check.near(name, values[name], 0, 45 if name == "BodyPitchAngle" else 60)
    elif name in ("GroundSpeed", "TrueTrack", "AltitudeRate"):
        check_motion(check, flight, stamp, name, values[name])
    elif name in ("SunAzimuth", "SunElevation", "MoonAzimuth", "MoonElevation"):
        check_light(check, flight, stamp, name, values[name])
    elif name == "StaticPressure":
        # [USSA76] up to 11 km; 20 Pa: geopotential against geometric height there
        check.near("pressure hPa", values[name], 1013.25 * (1 - 2.25577e-5 * height) ** 5.25588, 0.5)
    elif name == "StaticAirTemperature":
        check.near("temperature K", values[name], 288.15 - 0.0065 * height, 0.2)


def check_motion(check, flight, stamp, name, value):
    """Differences over the second around it, on a sphere as large as the Earth is there."""
    times, _ = flight
    before, after = max(stamp - 0.5, times[0]), min(stamp + 0.5, times[-1])
    a, b = position(flight, before), position(flight, after)
    lat = math.radians((a[0] + b[0]) / 2)
    prime = 6378137 / math.sqrt(1 - 0.00669438 * math.sin(lat) ** 2)
    meridian = prime**3 / 6378137**2 * (1 - 0.00669438)
    north = math.radians(b[0] - a[0]) * (meridian + a[2]) / (after - before)
    east = math.radians(math.remainder(b[1] - a[1], 360)) * math.cos(lat) * (prime + a[2]) / (after - before)
    speed = math.hypot(north, east)
    # At a fix the speed changes by up to 25 m/s: 2 ms of a second's mean are .05 m/s.
    if name == "GroundSpeed":
        check.near("ground speed m/s", value, speed, 0.05)
    elif name == "AltitudeRate":
        check.near("altitude rate m/s", value, (b[2] - a[2]) / (after - before), 0.05)
    elif speed > 5:
        check.near("track deg", math.remainder(value - math.degrees(math.atan2(east, north)), 360), 0, 0.2)


def equatorial(lon, lat, days):
    """Right ascension and declination of ecliptic coordinates, all in degrees."""
    e, lon, lat = math.radians(23.439 - 4e-7 * days), math.radians(lon), math.radians(lat)
    x = math.cos(lat) * math.cos(lon)
    y = math.cos(e) * math.cos(lat) * math.sin(lon) - math.sin(e) * math.sin(lat)
    z = math.sin(e) * math.cos(lat) * math.sin(lon) + math.cos(e) * math.sin(lat)
    return math.degrees(math.atan2(y, x)), math.degrees(math.asin(z))


def horizontal(ra, dec, days, lat, lon):
    hour = math.radians(15 * (18.697374558 + 24.06570982441908 * days) + lon - ra)
    dec, lat = math.radians(dec), math.radians(lat)
    up = math.sin(lat) * math.sin(dec) + math.cos(lat) * math.cos(dec) * math.cos(hour)
    north = math.cos(lat) * math.sin(dec) - math.sin(lat) * math.cos(dec) * math.cos(hour)
    return math.degrees(math.atan2(-math.cos(dec) * math.sin(hour), north)), math.degrees(math.asin(up))


def sun(days, lat, lon):
    """Azimuth and elevation to .01 deg [Almanac]."""
    g = math.radians(357.528 + 0.9856003 * days)
    along = 280.460 + 0.9856474 * days + 1.915 * math.sin(g) + 0.020 * math.sin(2 * g)
    return horizontal(*equatorial(along, 0, days), days, lat, lon)


def moon(days, lat, lon):
    """Azimuth and elevation to .3 deg [Almanac], parallax included."""
    t = days / 36525

    def sines(*terms):
        return sum(k * math.sin(math.radians(a + b * t)) for k, a, b in terms)

    along = 218.32 + 481267.881 * t + sines((6.29, 135.0, 477198.87), (-1.27, 259.3, -413335.36), (0.66, 235.7, 890534.22), (0.21, 269.9, 954397.74), (-0.19, 357.5, 35999.05), (-0.11, 186.5, 966404.03))
    up = sines((5.13, 93.3, 483202.02), (0.28, 228.2, 960400.89), (-0.28, 318.3, 6003.15), (-0.17, 217.6, -407332.21))
    azimuth, elevation = horizontal(*equatorial(along, up, days), days, lat, lon)
    return azimuth, elevation - 0.95 * math.cos(math.radians(elevation))


def check_light(check, flight, stamp, name, value):
    lat, lon, _ = position(flight, stamp)
    days = stamp / 86400 - 10957.5
    body, formula, tolerance = ("sun", sun, 0.02) if name.startswith("Sun") else ("moon", moon, 0.5)
    azimuth, elevation = formula(days, lat, lon)
    if name.endswith("Azimuth"):
        apart = math.remainder(value - azimuth, 360) * math.cos(math.radians(elevation))
        check.near(f"{body} azimuth deg", apart, 0, tolerance)
    else:
        check.near(f"{body} elevation deg", value, elevation, tolerance)


def check_periods(check, rows, cycles):
    """As a bus would see them: each within the time of the frames that may be before it in the queue."""
    last, codes, counts = {}, {}, {}
    for stamp, _, identity, data in rows:
        if identity in last:
            check.near("period s", stamp - last[identity], cycles[identity], 0.006)
            check.near("message code", data[3], (codes[identity] + 1) % 256, 0)
        last[identity], codes[identity] = stamp, data[3]
        counts[identity] = counts.get(identity, 0) + 1
    return counts


def by_canmatrix(database, rows):
    by_id = {frame.arbitration_id.id: frame for frame in database.frames}
    for stamp, _, identity, data in rows:
        frame = by_id[identity]
        yield stamp, frame.name, {name: float(signal.phys_value) for name, signal in frame.decode(data).items()}


def check_log(database, cycles, log, flight_path, node):
    check, rows, flight = Check(os.path.basename(log)), read_log(log), read_flight(flight_path)
    for _, interface, _, data in rows:
        check.near("node", data[0], int(node), 0)
        check.near("interface", interface == "can0", True, 0)
    counts = check_periods(check, rows, cycles)
    seconds = rows[-1][0] - rows[0][0]
    for identity, count in counts.items():
        check.near("frames of an id", count, seconds / cycles[identity], 1.5)
    check.near("kinds of messages", len(counts) in (21, 22), True, 0)  # height above the ellipsoid: with a geoid
    for stamp, name, values in by_canmatrix(database, rows):
        check_frame(check, flight, stamp, name, values)
    figures = ", ".join(f"{what} {error:.1e}" for what, error in sorted(check.worst.items()) if error)
    print(f"figure: {check.name}: {len(rows)} frames, {check.wrong} wrong; worst: {figures}")
    return check.wrong


def make(folder):
    """West to east across the date line at 67 degrees south, over midnight, climbing 2 m/s."""
    with open(f"{folder}/g.igc", "w") as igc, open(f"{folder}/g.csv", "w") as table:
        igc.write("HFDTE010709\nHFALGALTGPS:GEO\n")
        table.write("utc,lat_deg,lon_deg,height_m\n")
        for i in range(6):
            t = calendar.timegm((2009, 7, 1, 23, 59, 50)) + 4 * i
            south, east = 20 * i, 59900 + 40 * i  # thousandths of a minute behind 67 and 179 degrees
            lon = f"179{east:05d}E" if east < 60000 else f"179{120000 - east:05d}W" if east > 60000 else "18000000E"
            igc.write(time.strftime("B%H%M%S", time.gmtime(t)) + f"67{south:05d}S{lon}A{900 + 8 * i:05d}{1000 + 8 * i:05d}\n")
            lon = 179 + east / 60000
            table.write(time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime(t)) + f",{-67 - south / 60000:.9f},{lon - 360 * (lon > 180):.9f},{1000 + 8 * i}\n")


def main():
    if sys.argv[1] == "make":
        make(sys.argv[2])
        return
    database = canmatrix.formats.loadp_flat(sys.argv[1])
    cycles = {frame.arbitration_id.id: float(frame.attribute("GenMsgCycleTime", database)) / 1000 for frame in database.frames}
    sys.exit(sum(check_log(database, cycles, *job.split(":")) for job in sys.argv[2:]) != 0)


main()
