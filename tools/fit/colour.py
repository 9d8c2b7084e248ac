#!/usr/bin/env python3
"""Matrices from bands to linear RGB, fitted to computed skies. Sources: README "Colour".

    colour.py           writes src/core/colour_fitted.h, src/scene/colour_basis.h, tests/api/colour_spectra.h
    colour.py --check   computes them again and compares (exit status 1 where they differ); further arguments: the three
                        files to compare instead
    colour.py --report  prints Delta E on skies that the fit has not seen, as lines `figure: ...`
    colour.py --search  looks for better wavelengths and prints a table (a minute)
"""

import os
import re
import sys

try:
    import numpy as np
except ImportError:  # another python3 comes first in the path than Debian's, which has python3-numpy
    if sys.executable == "/usr/bin/python3" or not os.path.exists("/usr/bin/python3"):
        sys.exit("colour.py: needs the package python3-numpy")
    os.execv("/usr/bin/python3", ["/usr/bin/python3"] + sys.argv)

import colour_matrix as m
import colour_physics as p
import colour_sky as sky
from generated import write_or_check

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../..")
FILES = [os.path.join(ROOT, f) for f in ("src/core/colour_fitted.h", "src/scene/colour_basis.h", "tests/api/colour_spectra.h")]
SETS = ((450, 535, 610), (445, 520, 570, 630), (440, 520, 600, 680), (440, 550, 680))
TARGETS = {(450, 535, 610): (1.0, 2.5, 12.0), (445, 520, 570, 630): (0.3, 0.8, 2.5)}  # mean, 95 %, most: the check's limits


def rgb_rows(matrix):
    """XYZ rows to RGB rows, (1,1,1) = WHITE_LUMINANCE."""
    return m.XYZ_TO_RGB @ matrix / m.WHITE_LUMINANCE


def values(row):
    return "{" + ", ".join(f"{x:.7g}" + ("f" if re.search("[.e]", f"{x:.7g}") else ".0f") for x in row) + "}"


def rows(table, indent="    "):
    return ",\n".join(indent + values(row) for row in table)


def core_header(train):
    blocks = []
    for nm in SETS:
        table = np.zeros((3, 4))
        table[:, :len(nm)] = rgb_rows(m.fit(train, nm))
        wide = tuple(nm) + (0,) * (4 - len(nm))
        blocks.append(f"    {{{len(nm)}, {values(wide)}, {{\n{rows(table, ' ' * 8)}}}}},\n")
    return f"""// Made by tools/fit/colour.py from skies of 48 wavelengths; Delta E: `colour.py --report`. `make fit-check` compares.
// clang-format off
#ifndef SKV_CORE_COLOUR_FITTED_H
#define SKV_CORE_COLOUR_FITTED_H

// Luminance of linear BT.709 red, green and blue.
static const float skv_luma[3] = {values(m.LUMA)};

// Bands; wavelengths, nm; rows R, G, B per W m^-2 sr^-1 nm^-1.
static const skv_colour_set skv_colour_sets[{len(SETS)}] = {{
{"".join(blocks)}}};

#endif
"""


def scene_header(train):
    basis = m.Basis(train)
    solar = [p.solar(nm) for nm in basis.nm]
    lines = [solar[i:i + 7] for i in range(0, len(solar), 7)]
    return f"""// Made by tools/fit/colour.py: shapes of sky spectra, for bands that have no fitted matrix. `make fit-check` compares.
// clang-format off
#ifndef SKV_SCENE_COLOUR_BASIS_H
#define SKV_SCENE_COLOUR_BASIS_H

#define SKV_BASIS_FIRST_NM {basis.FIRST}.0f
#define SKV_BASIS_STEP_NM {basis.STEP}.0f
#define SKV_BASIS_NODES {basis.NODES}
#define SKV_BASIS_SHAPES {basis.SHAPES}
// Added to the diagonal of the normal equations, times its mean.
#define SKV_BASIS_RIDGE {basis.RIDGE:g}f
// Luminance of linear BT.709 red, green and blue.
#define SKV_BASIS_LUMA {values(m.LUMA)}

// Radiance over solar irradiance at the nodes, per shape; the shapes are scaled by how much they vary.
static const float skv_basis_shape[SKV_BASIS_NODES][SKV_BASIS_SHAPES] = {{
{rows(basis.shapes)}}};

// R, G, B of one of each shape under the sun at 1 au.
static const float skv_basis_rgb[3][SKV_BASIS_SHAPES] = {{
{rows(rgb_rows(basis.xyz))}}};

// Solar irradiance at the nodes, W m^-2 nm^-1 at 1 au.
static const float skv_basis_solar[SKV_BASIS_NODES] = {{
{",".join(chr(10) + "    " + values(line)[1:-1] for line in lines).lstrip(chr(10))}}};

#endif
"""


# Skies of the test: name, air, altitude km, sun zenith, view zenith and azimuth from the sun, degrees.
CLEAR, HAZY = (0.026, 1.3, 0.97, 0.64, 310, None, 2.4), (0.12, 1.2, 0.92, 0.64, 280, 0.1, 1.5)
TEST_SKIES = (("noon, zenith", CLEAR, 0.0, 20.0, 0.0, 0.0), ("noon, zenith, hazy", HAZY, 0.0, 20.0, 0.0, 0.0),
              ("sun 30 deg, horizon", CLEAR, 0.5, 60.0, 87.0, 120.0), ("sun 3 deg, toward it", HAZY, 0.5, 87.0, 84.0, 12.0),
              ("sun -3 deg, zenith", CLEAR, 0.0, 93.0, 0.0, 0.0), ("12 km, sun 10 deg, below the horizon", CLEAR, 12.0, 80.0, 100.0, 70.0))


def test_header():
    spectra = []
    for _, air, h, sun, zenith, azimuth in TEST_SKIES:
        air = sky.Air(*air)
        ratio = sky.sky(air, sky.Diffuse(air), h, sun, np.array([zenith]), np.array([azimuth]))
        spectra.append(ratio[0] * m.SOLAR)
    names = "".join(f'    "{s[0]}",\n' for s in TEST_SKIES)
    wrap = lambda row: "{" + ",\n     ".join(values(row[i:i + 8])[1:-1] for i in range(0, 48, 8)) + "}"
    return f"""// Made by tools/fit/colour.py: spectra of six skies, not among those the matrices were fitted to. `make fit-check`
// compares.
// clang-format off
#ifndef TESTS_API_COLOUR_SPECTRA_H
#define TESTS_API_COLOUR_SPECTRA_H

#define SPECTRA {len(TEST_SKIES)}
#define BINS {m.NM.size}
#define FIRST_NM {m.NM[0]:g}

static const char *const spectrum_name[SPECTRA] = {{
{names}}};
// W m^-2 sr^-1 nm^-1, bins of 10 nm centred on FIRST_NM + 10 i.
static const float spectrum[SPECTRA][BINS] = {{
    {",{}    ".format(chr(10)).join(wrap(s) for s in spectra)}}};
// Solar irradiance at 1 au, W m^-2 nm^-1.
static const float sun_spectrum[BINS] =
    {wrap(m.SOLAR)};
// CIE 1931 x, y, z, mean over the bin.
static const float observer[3][BINS] = {{
    {",{}    ".format(chr(10)).join(wrap(o / 6830.0) for o in m.OBSERVER)}}};

#endif
"""


NUMBER = re.compile(r"-?\d+\.?\d*(?:e[-+]?\d+)?(?=f?\b)")


def same(text, other):
    """Text equal, numbers within 3 units of the seventh digit (linear algebra libraries differ in the last digits)."""
    if NUMBER.sub("#", text) != NUMBER.sub("#", other):
        return False
    pairs = zip(NUMBER.findall(text), NUMBER.findall(other))
    return all(abs(float(a) - float(b)) <= 3e-6 * max(abs(float(a)), 1e-4) for a, b in pairs)


def prove(text):
    """The comparison sees a change of 1e-4 of any number that is not tiny, and of a word."""
    for found in NUMBER.finditer(text):
        x = float(found.group())
        if abs(x) > 1e-5 and same(text, text[:found.start()] + f"{x * 1.0001:.7g}" + text[found.end():]):
            raise SystemExit(f"colour.py: a changed number was not seen: {found.group()}")
    if same(text, text.replace("static", "extern", 1)):
        raise SystemExit("colour.py: a changed word was not seen")


def headers(train):
    return core_header(train), scene_header(train), test_header()


def check(paths):
    bad = 0
    train = m.Samples(sky.training())
    for path, text in zip(paths, headers(train)):
        prove(text if len(text) < 4000 else text[:2000])
        with open(path, encoding="utf-8") as f:
            good = same(f.read(), text)
        print(f"{os.path.relpath(path)}: {'as generated' if good else 'differs from what tools/fit/colour.py makes'}",
              file=sys.stdout if good else sys.stderr)
        bad += not good
    return int(bad > 0)


def three(e):
    return f"{e.mean():.2f} / {np.percentile(e, 95):.2f} / {e.max():.2f}"


def mars_scenes():
    """Dust that absorbs blue, over a ground of its kind, in the presets' figures."""
    from presets import mars
    planet = mars()
    air = sky.Air(0.0, 0.0, 1.0, 0.7, 0, 0.2, planet["height"])
    air.rayleigh = np.array([planet["rayleigh"](nm) for nm in m.NM])
    air.extinction = np.array([planet["aerosol"]["extinction"](nm) for nm in m.NM])
    air.aerosol = air.extinction * np.array([planet["aerosol"]["albedo"](nm) for nm in m.NM])
    air.heights = planet["height"], planet["height"]
    d = sky.Diffuse(air)
    zenith, azimuth = sky.views((0, 40, 70, 85), (15, 60, 120, 180))
    return [sky.sky(air, d, 0.0, sun, zenith, azimuth) for sun in (20, 60, 80, 88, 92)]


def lit_scenes():
    """Views of the sunlit ground from the air, and the sun itself at 0 to 88 degrees zenith angle."""
    ground, disc = [], []
    for parameters in (CLEAR, HAZY):
        air = sky.Air(*parameters)
        d = sky.Diffuse(air)
        zenith, azimuth = sky.views((100, 120, 150), (30, 90, 180))
        ground += [sky.sky(air, d, 3.0, sun, zenith, azimuth, lit=True) for sun in (20, 60, 80)]
        disc += [sky.sunlight(air, 0.0, [z]) for z in (0, 60, 75, 82, 86, 88)]
    return ground, disc


def report():
    train, unseen = m.Samples(sky.training()), m.Samples(sky.holdout())
    print(f"figure: colour: {len(train.ratio)} training spectra, {len(unseen.ratio)} unseen ones; Delta E 1976 mean / 95 % / most")
    basis = m.Basis(train)
    ground, disc = lit_scenes()
    sun = m.Samples(disc)
    others = ("Mars dust", m.Samples(mars_scenes())), ("lit ground", m.Samples(ground)), ("sun's disc", sun)
    worst = []
    for nm in SETS:
        matrix = m.fit(train, nm)
        e = unseen.difference(matrix, nm)
        name = "/".join(str(x) for x in nm)
        print(f"figure: colour {name}: {three(e)}; any-bands matrix {three(unseen.difference(basis.matrix(nm), nm))}; least squares "
              f"in XYZ {three(unseen.difference(m.start(train, nm), nm))}")
        print(f"figure: colour {name} beyond skies: " + "; ".join(f"{n} {three(s.difference(matrix, nm))}" for n, s in others))
        if nm in TARGETS:
            limits = TARGETS[nm]
            worst += [f"{name}: {three(e)}, allowed {limits}"] if e.mean() > limits[0] or np.percentile(e, 95) > limits[1] or e.max() > limits[2] else []
    print(f"figure: colour 680/550/440 taken as RGB: {three(m.as_rgb(unseen, (680, 550, 440)))}")
    alone = m.Samples([row[None] for row in unseen.ratio])  # every view exposed for itself: stricter
    for nm in SETS[:2]:
        print(f"figure: colour {'/'.join(str(x) for x in nm)}, every view against itself: {three(alone.difference(m.fit(train, nm), nm))}")
    print(f"figure: colour 680/550/440 taken as RGB, every view against itself: {three(m.as_rgb(alone, (680, 550, 440)))}")
    for nm in ((430, 550, 680), (412, 443, 555, 670), (450, 550, 650)):
        print(f"figure: colour any bands, {'/'.join(str(x) for x in nm)}: {three(unseen.difference(basis.matrix(nm), nm))}")
    for line in worst:
        print(f"colour.py: too large: {line}", file=sys.stderr)
    return int(bool(worst))


def search():
    """Coordinate descent over a grid of 5 nm from several starts, on the training skies by their mean square of Delta E."""
    train, unseen = m.Samples(sky.training()[::3]), m.Samples(sky.holdout())
    cost = {}

    def score(nm):
        if nm not in cost:
            cost[nm] = np.sqrt((train.difference(m.start(train, nm), nm) ** 2).mean())
        return cost[nm]

    def descend(nm):
        while True:
            near = [tuple(sorted(nm[:i] + (nm[i] + d,) + nm[i + 1:])) for i in range(len(nm)) for d in (-15, -10, -5, 5, 10, 15)]
            best = min([nm] + [x for x in near if len(set(x)) == len(x)], key=score)
            if best == nm:
                return nm
            nm = best

    for starts in (((450, 535, 610), (440, 550, 680), (430, 520, 600)), ((445, 520, 570, 630), (440, 520, 600, 680), (420, 500, 560, 620))):
        found = sorted({descend(s) for s in starts}, key=score)
        for nm in found + [s for s in SETS if len(s) == len(starts[0]) and s not in found]:
            tag = "found" if nm in found else "set"
            print(f"figure: search {tag} {'/'.join(str(x) for x in nm)}: training root mean square {score(nm):.2f}; unseen "
                  f"{three(unseen.difference(m.fit(train, nm), nm))}")
    return 0


def write():
    for path, text in zip(FILES, headers(m.Samples(sky.training()))):
        write_or_check([], path, text)
    return 0


def main(arguments):
    p.check_sources()
    if not arguments:
        return write()
    if arguments[0] == "--check" and len(arguments) in (1, 1 + len(FILES)):
        return check(arguments[1:] or FILES)
    if arguments == ["--report"]:
        return report()
    if arguments == ["--search"]:
        return search()
    print("usage: colour.py [--check [CORE_HEADER SCENE_HEADER TEST_HEADER] | --report | --search]", file=sys.stderr)
    return 2


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
