"""cockpit_flight.py SKYVERT FLIGHT LINES READ: what skyvert-cockpit showed of a flight (its lines, and what a reader found in the
shared memory) against the flight's own rows and `skyvert sun`."""
import csv
import datetime
import re
import subprocess
import sys

skyvert, flight, lines, read = sys.argv[1:]
bad = 0


def check(what, got, want, tolerance):
    global bad
    if not abs(got - want) <= tolerance:
        bad += 1
        print(f"FAIL: {what}: got {got}, want {want}, error {got - want:.3g}, tolerance {tolerance}")


def moment(text):
    return datetime.datetime.fromisoformat(text.replace("Z", "+00:00")).timestamp()


def between(rows, t):
    for before, after in zip(rows, rows[1:]):
        if before[0] <= t <= after[0]:
            share = (t - before[0]) / (after[0] - before[0])
            return [a + share * (b - a) for a, b in zip(before[1:], after[1:])]
    sys.exit(f"FAIL: {t} is not of the flight")


rows = [(moment(r["utc"]), float(r["lat_deg"]), float(r["lon_deg"]), float(r["height_m"])) for r in csv.DictReader(open(flight))]
shape = re.compile(r'(\w+) sun (\S+) (\S+) utc (\S+) lat (\S+) lon (\S+) height (\S+) visibility (\S+) .*stale "(.*)"')
shown = [shape.match(line) for line in open(lines)]
live = [m.groups() for m in shown if m and m[1] == "live"]
held = [m.groups() for m in shown if m and m[1] == "held"]
if len(live) < 8 or len(held) < 1:
    sys.exit(f"FAIL: {len(live)} live lines, {len(held)} held ones:\n" + open(lines).read())
table = "utc,lat_deg,lon_deg,height_m\n" + "".join(f"{m[3]},{m[4]},{m[5]},{m[6]}\n" for m in live)
sun = list(csv.DictReader(subprocess.run([skyvert, "sun", "--csv"], input=table, capture_output=True, text=True, check=True).stdout.splitlines()))
for n, (m, s) in enumerate(zip(live, sun)):
    # The lines have three digits, and skyvert sun gets a time of three digits: half a thousandth, and the turning of 1 ms.
    check(f"line {n}: elevation, deg", float(m[2]), float(s["sun_elevation_deg"]), 0.0006)
    check(f"line {n}: azimuth, deg", float(m[1]), float(s["sun_azimuth_deg"]), 0.0008)
    if n < 2:
        continue  # the first second follows from one frame of each kind
    want = between(rows, moment(m[3]))
    # The UTC's frame is on the bus 8 ms behind the second, positions at their own times; at 250 m/s 20 ms are 5 m.
    check(f"line {n}: latitude, deg", float(m[4]), want[0], 7e-5)
    check(f"line {n}: longitude, deg", float(m[5]), want[1], 1e-4)
    check(f"line {n}: height, m", float(m[6]), want[2], 1.0)
    check(f"line {n}: visibility, km", float(m[7]), 30.0, 0.01)
# Nothing comes: the time stands three seconds behind its last frame, the sun with it.
for m in held[1:]:
    check("held: elevation, deg", float(m[2]), float(held[0][2]), 0)
    check("held: latitude, deg", float(m[4]), float(held[0][4]), 0)
# The shared memory says the same as the lines.
frames = [line.split() for line in open(read)]
if len(frames) != 80:
    sys.exit(f"FAIL: {len(frames)} frames read, want 80")
numbers = [int(f[1]) for f in frames]
if numbers != sorted(numbers) or numbers[-1] - numbers[0] < 20:
    bad += 1
    print(f"FAIL: frame numbers {numbers[0]} ... {numbers[-1]}")
low, high = min(float(m[2]) for m in live), max(float(m[2]) for m in live)
for f in frames:
    if not low - 0.01 <= float(f[8]) <= high + 0.01:
        bad += 1
        print(f"FAIL: elevation in the shared memory {f[8]}, shown {low} to {high}")
steps = [abs(float(b[8]) - float(a[8])) for a, b in zip(frames, frames[1:])]
check("largest step of the sun in .1 s and what the machine was late, deg", max(steps[10:]), 0, 0.004)  # .0004 a tenth of a second
sys.exit(bad > 0)
