"""Spectra of skies for the colour fit, computed here in double by an integrator of its own (none of the core's code or formulas).

Single scattering by quadrature over spherical shells; later orders with an isotropic source that is iterated on a grid of
altitude and sun height. Everything is the ratio of radiance to solar irradiance, 1/sr, in the 48 bins of spectra/.
"""

import numpy as np

import colour_physics as p

NM = np.arange(365.0, 836.0, 10.0)
RADIUS, TOP = 6371.0, 60.0
GAUSS = {n: np.polynomial.legendre.leggauss(n) for n in (4, 6, 16, 24, 32)}


def unit_gauss(n):
    x, w = GAUSS[n]
    return 0.5 * (x + 1.0), 0.5 * w


class Air:
    """Coefficients per km at density 1 and the density profiles of air, aerosol and ozone."""

    def __init__(self, extinction_550, alpha, ssa, g, dobson, albedo, aerosol_height=2.0):
        self.extinction = extinction_550 * (NM / 550.0) ** -alpha
        self.aerosol = self.extinction * ssa
        self.rayleigh = np.array([p.rayleigh_air_per_km(nm) for nm in NM])
        self.ozone = np.array([p.ozone_m2(nm) for nm in NM]) * dobson * p.DOBSON / 15.0
        self.g = g
        self.albedo = np.array([p.grass(nm) for nm in NM]) if albedo is None else np.full(NM.size, albedo)
        self.heights = 8.43, aerosol_height

    def density(self, h):
        """[..., 3] at altitude h."""
        h = np.maximum(h, 0.0)
        inside = h <= TOP
        return np.stack([inside * np.exp(-h / self.heights[0]), inside * np.exp(-h / self.heights[1]),
                         np.maximum(0.0, 1.0 - np.abs(h - 25.0) / 15.0)], axis=-1)

    def depth(self, columns):
        """Optical depth [..., wavelength] of columns [..., 3] in km."""
        return columns @ np.stack([self.rayleigh, self.extinction, self.ozone])


def altitude(h, mu, s):
    return np.sqrt((RADIUS + h) ** 2 + 2 * (RADIUS + h) * mu * s + s * s) - RADIUS


def distance(h, mu, shell):
    """Along a ray out to the altitude `shell`, the far crossing."""
    r = RADIUS + h
    return -r * mu + np.sqrt(np.maximum(0.0, (RADIUS + shell) ** 2 - r * r * (1 - mu * mu)))


def to_ground(h, mu):
    """Length to the ground, infinite where the ray misses it."""
    r = RADIUS + h
    d = RADIUS**2 - r * r * (1 - mu * mu)
    hit = (mu < 0) & (d > 0)
    return np.where(hit, -r * mu - np.sqrt(np.maximum(d, 0.0)), np.inf)


def leg(air, h, mu, length):
    """Columns of a straight leg that starts at its densest point."""
    u, w = unit_gauss(24)
    s = length[..., None] * u**2
    return (air.density(altitude(h[..., None], mu[..., None], s)) * (2 * u * w * length[..., None])[..., None]).sum(-2)


def sun_columns(air, h, mu):
    """Columns to the top; infinite in the planet's shadow."""
    down = mu < 0
    r = RADIUS + h
    tangent = np.where(down, r * np.sqrt(1 - mu * mu) - RADIUS, h)
    zero = np.zeros_like(h)
    start = np.where(down, np.maximum(tangent, 0.0), h)
    columns = leg(air, start, np.where(down, zero, mu), distance(start, np.where(down, zero, mu), TOP))
    columns = columns + leg(air, start, zero, np.where(down, -r * mu, 0.0))
    columns[tangent < 0.0] = 1e9
    return columns


def phase_rayleigh(nu):
    return 3 / (16 * np.pi) * (1 + nu * nu)


def phase_aerosol(g, nu):
    """Cornette and Shanks."""
    return 3 / (8 * np.pi) * (1 - g * g) / (2 + g * g) * (1 + nu * nu) / (1 + g * g - 2 * g * nu) ** 1.5


class Paths:
    """Nodes, weights and transmittances along rays from altitude h, direction mu (arrays [rays])."""

    def __init__(self, air, h, mu, n):
        u, w = unit_gauss(n)
        ground = to_ground(h, mu)
        self.hits = np.isfinite(ground)
        length = np.where(self.hits, ground, distance(h, mu, TOP))[:, None]
        self.s = length * u**3
        self.weight = 3 * u * u * w * length
        self.h = np.maximum(altitude(h[:, None], mu[:, None], self.s), 0.0)
        density = air.density(self.h)
        self.density = density
        # Running columns: the part of each node's weight on this side of it is taken as one half.
        parts = density * self.weight[..., None]
        columns = np.cumsum(parts, axis=1) - 0.5 * parts
        self.transmittance = np.exp(-air.depth(columns))
        self.end_transmittance = np.exp(-air.depth(parts.sum(1)))
        self.end = length[:, 0]

    def sun_cosine(self, h, mu_s, nu):
        """At the nodes, of a sun at mu_s at the ray's start."""
        r = RADIUS + h[:, None]
        return np.clip((r * mu_s[:, None] + self.s * nu[:, None]) / (RADIUS + self.h), -1, 1)


def single(air, path, h, mu_s, nu):
    """Single scattering [rays, wavelengths] and the cosines at the nodes."""
    mu_at = path.sun_cosine(h, mu_s, nu)
    sun = np.exp(-air.depth(sun_columns(air, path.h, mu_at)))
    rayleigh = path.density[..., 0] * path.weight * phase_rayleigh(nu)[:, None]
    aerosol = path.density[..., 1] * path.weight * phase_aerosol(air.g, nu)[:, None]
    light = path.transmittance * sun
    return (light * (rayleigh[..., None] * air.rayleigh + aerosol[..., None] * air.aerosol)).sum(1), mu_at


def ground_light(air, path, h, mu_s, nu, diffuse):
    """Radiance of the lit ground through the air, 0 for rays that miss it; diffuse [rays, wavelengths] mean radiance."""
    mu_end = np.clip(((RADIUS + h) * mu_s + np.where(path.hits, path.end, 0.0) * nu) / RADIUS, -1, 1)
    direct = np.exp(-air.depth(sun_columns(air, np.zeros_like(h), mu_end))) * np.maximum(mu_end, 0.0)[:, None]
    return np.where(path.hits[:, None], path.end_transmittance * air.albedo / np.pi * (direct + np.pi * diffuse), 0.0)


class Diffuse:
    """Mean radiance of the orders from the second on's source, on a grid of altitude and sun cosine."""

    H = TOP * (np.arange(9) / 8.0) ** 2
    MU = np.concatenate([-0.22 + 0.02 * np.arange(12), [0.05, 0.1, 0.18, 0.3, 0.5, 0.75, 1.0]])

    def __init__(self, air, orders=5):
        hh, mm = (a.ravel() for a in np.meshgrid(self.H, self.MU, indexing="ij"))
        x, wx = GAUSS[6]
        azimuth = (np.arange(3) + 0.5) * np.pi / 3
        mu = np.repeat(x, 3)
        weight = np.repeat(wx, 3) / 6.0
        az = np.tile(azimuth, 6)
        cells, rays = hh.size, mu.size
        h, mu_s, mu = np.repeat(hh, rays), np.repeat(mm, rays), np.tile(mu, cells)
        nu = mu * mu_s + np.sqrt((1 - mu * mu) * (1 - mu_s * mu_s)) * np.cos(np.tile(az, cells))
        path = Paths(air, h, mu, 16)
        first, mu_at = single(air, path, h, mu_s, nu)
        first += ground_light(air, path, h, mu_s, nu, 0.0)
        gather = lambda rays_in: (rays_in.reshape(cells, rays, -1) * weight[:, None]).sum(1).reshape(len(self.H), len(self.MU), -1)
        term = gather(first)
        self.mean = term.copy()
        scatter = path.transmittance * path.weight[..., None] * (
            path.density[..., 0, None] * air.rayleigh + path.density[..., 1, None] * air.aerosol)
        mu_end = np.clip(((RADIUS + h) * mu_s + np.where(path.hits, path.end, 0.0) * nu) / RADIUS, -1, 1)
        for _ in range(orders):
            light = (scatter * self.at(path.h, mu_at, term)).sum(1)
            light += np.where(path.hits[:, None], path.end_transmittance * air.albedo * self.at(np.zeros_like(h), mu_end, term), 0.0)
            term = gather(light)
            self.mean += term

    def at(self, h, mu, table=None):
        """Bilinear in sqrt(h) and mu."""
        table = self.mean if table is None else table
        x = np.clip(np.sqrt(np.maximum(h, 0.0) / TOP) * 8, 0, 7.9999)
        i = x.astype(int)
        j = np.clip(np.searchsorted(self.MU, mu) - 1, 0, len(self.MU) - 2)
        y = np.clip((mu - self.MU[j]) / (self.MU[j + 1] - self.MU[j]), 0.0, 1.0)[..., None]
        x = (x - i)[..., None]
        return (1 - x) * ((1 - y) * table[i, j] + y * table[i, j + 1]) + x * ((1 - y) * table[i + 1, j] + y * table[i + 1, j + 1])


def views(zeniths, azimuths):
    """Directions as (zenith, azimuth) arrays in degrees; the zenith once."""
    pairs = [(z, a) for z in zeniths for a in azimuths if z > 0 or a == azimuths[0]]
    return np.array(pairs).T


def sky(air, diffuse, h, sun_zenith, zenith, azimuth, lit=False):
    """Radiance over solar irradiance [views, 48]; altitude in km, angles in degrees."""
    mu, mu_s = np.cos(np.radians(zenith)), np.cos(np.radians(sun_zenith))
    nu = mu * mu_s + np.sin(np.radians(zenith)) * np.sin(np.radians(sun_zenith)) * np.cos(np.radians(azimuth))
    h, mu_s = np.full_like(mu, h), np.full_like(mu, mu_s)
    path = Paths(air, h, mu, 32)
    light, mu_at = single(air, path, h, mu_s, nu)
    scatter = path.weight[..., None] * (path.density[..., 0, None] * air.rayleigh + path.density[..., 1, None] * air.aerosol)
    light += (path.transmittance * scatter * diffuse.at(path.h, mu_at)).sum(1)
    if lit:
        mu_end = np.clip(((RADIUS + h) * mu_s + np.where(path.hits, path.end, 0.0) * nu) / RADIUS, -1, 1)
        light += ground_light(air, path, h, mu_s, nu, diffuse.at(np.zeros_like(h), mu_end))
    return light


def sunlight(air, h, sun_zeniths):
    """Transmittance of the air toward the sun [suns, 48]."""
    mu = np.cos(np.radians(np.asarray(sun_zeniths, float)))
    return np.exp(-air.depth(sun_columns(air, np.full_like(mu, h), mu)))


def scenes(airs, heights, suns, zeniths, azimuths):
    """A list of arrays [views, 48], one for each sky; at altitude 0 no views below the horizon, none within 3 degrees of the sun."""
    zenith, azimuth = views(zeniths, azimuths)
    result = []
    for air in airs:
        diffuse = Diffuse(air)
        for h in heights:
            for sun in suns:
                near = np.hypot(zenith - sun, azimuth) > 3
                keep = near & (zenith < 90 + (0 if h == 0 else 89))
                result.append(sky(air, diffuse, h, sun, zenith[keep], azimuth[keep]))
    return result


def training():
    """The skies and the sun itself that the matrices are fitted to."""
    # Aerosols of the continental, polluted, urban, desert and clean kinds of [Hess98]; ozone 200 to 450 DU; grass, sea, snow.
    airs = [Air(0.0, 1.3, 1.0, 0.6, 300, None), Air(0.026, 1.3, 0.97, 0.64, 300, None, 2.4), Air(0.075, 1.3, 0.925, 0.64, 200, 0.06),
            Air(0.075, 0.3, 0.97, 0.66, 450, 0.06, 1.2), Air(0.175, 1.3, 0.89, 0.63, 300, None, 1.9),
            Air(0.35, 1.3, 0.82, 0.62, 350, 0.15, 1.8), Air(0.145, 0.2, 0.89, 0.66, 280, 0.3), Air(0.05, 1.8, 0.9, 0.6, 300, 0.8, 1.2)]
    discs = [sunlight(air, h, [zenith]) for air in (Air(0.0, 1.3, 1.0, 0.6, 300, None), *airs[4:7:2], airs[7])
             for h in (0.0, 3.0) for zenith in (0, 40, 65, 78, 84, 87, 89)]
    return discs + scenes(airs, (0.0, 2.0, 12.0), (0, 30, 60, 75, 83, 87, 90, 92, 94, 96), (0, 40, 65, 78, 85, 89, 91, 95, 120),
                          (0, 20, 60, 120, 180))


def holdout():
    """Skies between those of the training in every respect."""
    airs = [Air(0.01, 1.0, 0.98, 0.6, 320, 0.06, 3.0), Air(0.055, 1.4, 0.94, 0.65, 260, None, 1.5), Air(0.11, 0.8, 0.9, 0.63, 400, 0.2, 1.7),
            Air(0.25, 1.4, 0.86, 0.62, 300, None, 1.2)]
    return scenes(airs, (0.3, 5.0, 20.0), (15, 48, 70, 80, 85, 88.5, 91, 93, 95), (10, 50, 72, 82, 87.5, 93, 105), (10, 40, 90, 150))
