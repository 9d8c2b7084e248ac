"""Colour of spectra, and the matrices from a few bands to it.

All spectra are [samples, 48] ratios of radiance to solar irradiance (1/sr) in the bins of spectra/; XYZ is in cd/m2
(683 lm/W) under the sun at 1 au. Colour difference: CIE 1976 L*a*b* [CIE15], white D65, the white's luminance that of the
brightest view of the scene.
"""

import numpy as np

import colour_physics as p
from colour_sky import NM

SOLAR = np.array([p.solar(nm) for nm in NM])
# ITU-R BT.709 primaries and white [BT709].
PRIMARIES = np.array([[0.64, 0.33], [0.30, 0.60], [0.15, 0.06]])
WHITE = np.array([0.3127, 0.3290])
WHITE_LUMINANCE = 1000.0


def xyz_of(xy):
    return np.array([xy[0] / xy[1], 1.0, (1 - xy[0] - xy[1]) / xy[1]])


D65 = xyz_of(WHITE)


def rgb_to_xyz():
    columns = np.array([xyz_of(xy) for xy in PRIMARIES]).T
    return columns * np.linalg.solve(columns, D65)


XYZ_TO_RGB = np.linalg.inv(rgb_to_xyz())
LUMA = rgb_to_xyz()[1]


def observer():
    """[3, 48]: CIE 1931 functions, mean over each bin by the trapezoid rule, times 10 nm times 683 lm/W."""
    nm, *functions = (np.array(c) for c in p.read_table("cie1931.txt"))
    at = lambda x: np.array([np.interp(x, nm, f, right=0.0) for f in functions])
    return (0.25 * at(NM - 5) + 0.5 * at(NM) + 0.25 * at(NM + 5)) * 10 * 683.0


OBSERVER = observer()


def xyz(ratio):
    return (ratio * SOLAR) @ OBSERVER.T


def lab(x, white):
    """x [n, 3]; white [n], its luminance."""
    t = x / (D65 * white[:, None])
    d = 6 / 29
    f = np.where(t > d**3, np.cbrt(np.maximum(t, 0.0)), t / (3 * d * d) + 4 / 29)
    return np.stack([116 * f[:, 1] - 16, 500 * (f[:, 0] - f[:, 1]), 200 * (f[:, 1] - f[:, 2])], axis=1)


def lab_slope(x, white):
    """[n, 3, 3]: d lab / d x."""
    t = x / (D65 * white[:, None])
    d = 6 / 29
    f = np.where(t > d**3, 1 / (3 * np.cbrt(np.maximum(t, 1e-12)) ** 2), 1 / (3 * d * d)) / (D65 * white[:, None])
    j = np.zeros((len(x), 3, 3))
    j[:, 0, 1] = 116 * f[:, 1]
    j[:, 1, 0], j[:, 1, 1] = 500 * f[:, 0], -500 * f[:, 1]
    j[:, 2, 1], j[:, 2, 2] = 200 * f[:, 1], -200 * f[:, 2]
    return j


class Samples:
    """Scenes side by side: ratios, their XYZ, the white's luminance of each one's scene."""

    def __init__(self, scenes):
        self.ratio = np.concatenate(scenes)
        self.xyz = xyz(self.ratio)
        brightest = [xyz(s)[:, 1].max() for s in scenes]
        self.white = np.repeat(brightest, [len(s) for s in scenes])

    def bands(self, nm):
        """Radiance [n, bands] at wavelengths: linear between bins of the ratio, times the sun there."""
        return np.stack([at_wavelength(self.ratio, b) * p.solar(b) for b in nm], axis=1)

    def difference(self, matrix, nm):
        """Delta E of the matrix (bands to XYZ) on every sample."""
        return self.difference_of(self.bands(nm) @ matrix.T)

    def difference_of(self, x):
        return np.linalg.norm(lab(x, self.white) - lab(self.xyz, self.white), axis=1)

    def weight(self):
        """What makes a squared error of XYZ follow Delta E: the slope of the cube root, limited in the dark."""
        return np.maximum(self.xyz[:, 1] / self.white, 0.02) ** (-2 / 3) / self.white


def at_wavelength(ratio, nm):
    i = min(max(int((nm - NM[0]) // 10), 0), NM.size - 2)
    t = (nm - NM[i]) / 10
    return (1 - t) * ratio[:, i] + t * ratio[:, i + 1]


def start(samples, nm):
    """Weighted least squares in XYZ: [3, bands]."""
    w = samples.weight()[:, None]
    return np.linalg.lstsq(samples.bands(nm) * w, samples.xyz * w, rcond=None)[0].T


def fit(samples, nm):
    """The matrix [3, bands] to XYZ that makes the mean square of Delta E least (Gauss and Newton, undamped: the start is
    close)."""
    bands = samples.bands(nm)
    matrix = start(samples, nm)
    want = lab(samples.xyz, samples.white)
    for _ in range(40):
        got = bands @ matrix.T
        slope = lab_slope(got, samples.white)[:, :, :, None] * bands[:, None, None, :]
        step = np.linalg.lstsq(slope.reshape(3 * len(bands), -1), (want - lab(got, samples.white)).ravel(), rcond=None)[0]
        matrix = matrix + step.reshape(matrix.shape)
        if np.abs(step).max() < 1e-11 * np.abs(matrix).max():
            break
    return matrix


class Basis:
    """The few shapes that skies are made of, for any bands: singular vectors of the weighted training ratios. The guess
    from given bands is the one of least squares under the training's own statistics (a ridge keeps bands that lie close
    together harmless)."""

    FIRST, STEP, NODES, SHAPES, RIDGE = 375, 10, 42, 7, 1e-4

    def __init__(self, samples):
        i = int((self.FIRST - NM[0]) // self.STEP)
        w = samples.weight()[:, None] / np.sqrt(len(samples.ratio))
        ratio = samples.ratio[:, i:i + self.NODES] * w
        _, size, shapes = np.linalg.svd(ratio, full_matrices=False)
        shapes, size = shapes[:self.SHAPES], size[:self.SHAPES] / size[0]
        shapes = shapes * np.where(shapes[:, :1] < 0, -1.0, 1.0)
        self.nm = self.FIRST + self.STEP * np.arange(self.NODES, dtype=float)
        self.shapes = (shapes * size[:, None]).T
        amounts = ratio @ shapes.T / size
        self.xyz = np.linalg.lstsq(amounts, samples.xyz * w, rcond=None)[0].T

    def matrix(self, nm):
        b = np.array([[np.interp(x, self.nm, s) for s in self.shapes.T] for x in nm])
        r = b @ b.T
        r += self.RIDGE * np.trace(r) / len(nm) * np.eye(len(nm))
        return self.xyz @ b.T @ np.linalg.inv(r) / np.array([p.solar(x) for x in nm])


def as_rgb(samples, nm):
    """Bands (red, green, blue) taken for BT.709 as they are, at the one exposure that fits best."""
    x = samples.bands(nm) @ rgb_to_xyz().T
    k = (x[:, 1] * samples.xyz[:, 1] / samples.white**2).sum() / ((x[:, 1] / samples.white) ** 2).sum()
    return samples.difference_of(k * x)
