"""cockpit_picture.py EXR PNG LINES: where the sun stands in the snapshots."""
import re
import struct
import subprocess
import sys

WIDTH, HEIGHT = 720, 361


def green_of(path):
    """Rows from above: OpenImageIO makes it a TIFF of plain floats."""
    plain = path + ".tif"
    subprocess.run(["oiiotool", path, "--ch", "G", "-d", "float", "--compression", "none", "-o", plain], check=True)
    with open(plain, "rb") as f:
        data = f.read()
    order = {b"II": "<", b"MM": ">"}[data[:2]]
    at, = struct.unpack_from(order + "I", data, 4)
    tags = {}
    for n in range(struct.unpack_from(order + "H", data, at)[0]):
        tag, kind, count, value = struct.unpack_from(order + "HHII", data, at + 2 + 12 * n)
        short = {3: "H", 4: "I"}.get(kind)
        where = at + 2 + 12 * n + 8 if short and count * struct.calcsize(short) <= 4 else value
        tags[tag] = struct.unpack_from(f"{order}{count}{short}", data, where) if short else None
    assert (tags[256][0], tags[257][0]) == (WIDTH, HEIGHT), (tags[256], tags[257])
    values = []
    for offset, size in zip(tags[273], tags[279]):
        values += struct.unpack_from(f"{order}{size // 4}f", data, offset)
    assert len(values) == WIDTH * HEIGHT, len(values)
    return values


def find_sun(path):
    """Centre of the pixels that are over half as bright as the brightest, as azimuth and elevation."""
    green = green_of(path)
    most = max(green)
    x = y = weight = 0.0
    for i, value in enumerate(green):
        if value > 0.5 * most:
            x, y, weight = x + value * (i % WIDTH), y + value * (i // WIDTH), weight + value
    x, y = x / weight, y / weight
    return (360 * x / (WIDTH - 1) + 180) % 360, 90 - 180 * y / (HEIGHT - 1), most, green


lines = [re.match(r"live sun (\S+) (\S+)", line) for line in open(sys.argv[3])]
suns = [(float(m[1]), float(m[2])) for m in lines if m]
low, high = (min(s[0] for s in suns), min(s[1] for s in suns)), (max(s[0] for s in suns), max(s[1] for s in suns))
azimuth, elevation, most, _ = find_sun(sys.argv[1])
# Half a pixel, .25 deg, of where it stood in these seconds.
ok = low[0] - 0.25 <= azimuth <= high[0] + 0.25 and low[1] - 0.25 <= elevation <= high[1] + 0.25
print(f"figure: cockpit: sun in the EXR snapshot at {azimuth:.2f} {elevation:.2f} deg, shown at {low[0]:.2f} {low[1]:.2f}; {most:.3g} x 1000 cd/m2")
if not ok:
    print(f"FAIL: EXR: sun at {azimuth:.3f} {elevation:.3f}, shown from {low} to {high}")
# The disc is 1e9 cd/m2 above the air; low over haze a thousandth of it and spread over pixels of half a degree.
if not 100 < most < 1e7:
    ok = False
    print(f"FAIL: EXR: the brightest pixel is {most}")
_, _, most, green = find_sun(sys.argv[2])
at = round((low[0] + 180) % 360 / 360 * 719) + 720 * round((90 - low[1]) * 2)
away = (at + 360) % 720 + at // 720 * 720
if not (green[at] > 0.95 and green[away] < 0.8 * green[at]):
    ok = False
    print(f"FAIL: PNG: {green[at]} where the sun is, {green[away]} opposite")
sys.exit(not ok)
