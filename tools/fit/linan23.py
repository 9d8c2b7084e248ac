#!/usr/bin/env python3
"""The constants of the logistic of [Linan23], Eq. 5.7, fitted to our path tracer.

    linan23.py           writes tools/baselines/linan23_fit.h
    linan23.py --check   computes it again and compares (exit status 1 where it differs)
    linan23.py --report  prints what is left of each ray

The light of the orders after the first along a ray is, in that model, the integral of T sigma_s (L_ms + L_ground):
L_ms = level_band/(1 + offset exp(-slope mu_s)) and the ground's bounce of Eq. 5.5. Level, offset and slope minimise the sum
of squares over rays and bands of the relative error of all light, the sun between 0 and 92 deg from the zenith as in the
thesis's pictures. The truth, tools/fit/linan23_truth.csv,
is made by linan23_truth.sh; the air is tools/bench/br17o.ini. Integrals here are fine midpoint sums, apart from the C code.
"""
import configparser
import csv
import os
import sys

import numpy as np

from generated import write_or_check

HERE = os.path.dirname(os.path.abspath(__file__))
HEADER = os.path.join(HERE, "../baselines/linan23_fit.h")
TRUTH = os.path.join(HERE, "linan23_truth.csv")
AIR = os.path.join(HERE, "../bench/br17o.ini")
STEPS = 600


class Air:
    """Exponential gas and aerosol, a tent of ozone."""

    def __init__(self, name):
        ini = configparser.ConfigParser(comment_prefixes=(";", "#"))
        ini.read(name)
        row = lambda section, key: np.array([float(x) for x in ini[section][key].split(",")])
        self.radius, self.top = float(ini["planet"]["radius_km"]), float(ini["planet"]["top_km"])
        self.albedo, self.nm = row("planet", "albedo"), row("bands", "wavelength_nm")
        self.gas, self.haze = row("rayleigh", "scattering_per_km"), row("aerosol", "scattering_per_km")
        self.haze_out = row("aerosol", "extinction_per_km")
        self.ozone = row("ozone", "absorption_per_km")
        self.heights = float(ini["rayleigh"]["scale_height_km"]), float(ini["aerosol"]["scale_height_km"])
        self.tent = float(ini["ozone"]["peak_km"]), float(ini["ozone"]["half_width_km"])

    def at(self, h):
        """Scattering and extinction, [..., bands]."""
        gas, haze = (np.exp(-h / x)[..., None] for x in self.heights)
        ozone = np.maximum(0, 1 - np.abs(h - self.tent[0]) / self.tent[1])[..., None]
        return gas * self.gas + haze * self.haze, gas * self.gas + haze * self.haze_out + ozone * self.ozone

    def line(self, h, mu):
        """Midpoints of steps growing quadratically from the start: way, step, altitude."""
        r = self.radius + h
        c = (self.top - h) * (2 * self.radius + self.top + h)
        length = -r * mu + np.sqrt(r * r * mu * mu + c)
        edge = length * np.linspace(0, 1, STEPS + 1)**2
        s, ds = (edge[1:] + edge[:-1]) / 2, np.diff(edge)
        return s, ds, np.sqrt(r * r + s * (2 * r * mu + s)) - self.radius

    def through(self, h, mu):
        """Transmittance to the top."""
        _, ds, y = self.line(h, mu)
        return np.exp(-(self.at(y)[1] * ds[:, None]).sum(0))


def read_truth():
    with open(TRUTH) as f:
        rows = list(csv.DictReader(line for line in f if not line.startswith("#")))
    number = lambda r, keys: [float(r[k]) for k in keys]
    where = np.array([number(r, ("altitude_km", "sun_zenith_deg", "view_zenith_deg", "rel_azimuth_deg")) for r in rows])
    late = np.array([number(r, [k for k in r if k.startswith("D_")]) for r in rows])
    whole = np.array([number(r, [k for k in r if k.startswith("L_")]) for r in rows])
    return where, late, whole


def prepare(air, where):
    """Per ray: the sun's cosine at the points, weights T sigma_s ds per band, the ground's part of the light."""
    grid = np.linspace(0, 1, 257)**2
    ground = np.array([air.through(0.0, mu) for mu in grid])
    straight = np.array([air.through(h, 1.0) for h in np.linspace(0, air.top, 121)])
    suns, weights, bounces = [], [], []
    for height, sun, view, turn in where:
        sun, view, turn = np.radians([sun, view, turn])
        mu, mu_s = np.cos(view), np.cos(sun)
        nu = mu * mu_s + np.sin(view) * np.sin(sun) * np.cos(turn)
        s, ds, y = air.line(height, mu)
        scattering, extinction = air.at(y)
        depth = np.cumsum(extinction * ds[:, None], 0) - 0.5 * extinction * ds[:, None]
        weight = np.exp(-depth) * scattering * ds[:, None]
        r = air.radius + y
        point = ((air.radius + height) * mu_s + s * nu) / r
        lit = np.stack([np.interp(point, grid, column) for column in ground.T], 1) * np.maximum(point, 0)[:, None]
        above = np.stack([np.interp(y, np.linspace(0, air.top, 121), column) for column in straight.T], 1)
        seen = 0.5 * (1 - np.sqrt(r * r - air.radius**2) / r)[:, None]
        bounce = seen * air.albedo / np.pi * lit * straight[0] / above
        suns.append(point)
        weights.append(weight)
        bounces.append((weight * bounce).sum(0))
    return np.array(suns), np.array(weights), np.array(bounces)


def late_light(p, suns, weights, bounces):
    """p: logarithms of the four levels, of the offset and the slope."""
    shape = 1 / (1 + np.exp(p[4] - np.exp(p[5]) * suns))
    return np.exp(p[:4]) * (weights * shape[..., None]).sum(1) + bounces


def fit(error):
    """Levenberg and Marquardt's method from the thesis's own constants."""
    p = np.log(np.array([0.02, 0.012, 0.008, 0.004, 5.0, 17.92]))
    damping, now = 1e-3, error(p)
    for _ in range(200):
        jacobian = np.stack([(error(p + 1e-5 * e) - error(p - 1e-5 * e)) / 2e-5 for e in np.eye(6)], 1)
        normal = jacobian.T @ jacobian
        move = np.linalg.solve(normal + damping * np.diag(np.diag(normal)), -jacobian.T @ now)
        then = error(p + move)
        if then @ then < now @ now:
            p, now, damping = p + move, then, damping / 5
        else:
            damping *= 5
        if np.abs(move).max() < 1e-10:
            break
    return p, now


def header(air, p, left):
    numbers = lambda values: ", ".join("%.4g" % v for v in values)
    return """/// Constants of the logistic of [Linan23], Eq. 5.7: radiance level/(1 + offset exp(-slope mu_s)) for a unit sun, 1/sr.
/// Made by tools/fit/linan23.py from tools/fit/linan23_truth.csv (our path tracer, clear Earth); do not edit.
/// What the fit leaves of all light in a band: %.1f %% (root mean square).
#ifndef TOOLS_BASELINES_LINAN23_FIT_H
#define TOOLS_BASELINES_LINAN23_FIT_H

#define LINAN23_FIT_BANDS  4
#define LINAN23_FIT_OFFSET %.4g
#define LINAN23_FIT_SLOPE  %.4g
static const double linan23_fit_nm[LINAN23_FIT_BANDS] = {%s};
static const double linan23_fit_level[LINAN23_FIT_BANDS] = {%s};

#endif
""" % (100 * np.sqrt((left * left).mean()), np.exp(p[4]), np.exp(p[5]), numbers(air.nm), numbers(np.exp(p[:4])))


def main(args):
    air = Air(AIR)
    where, late, whole = read_truth()
    parts = prepare(air, where)
    error = lambda p: ((late_light(p, *parts) - late) / whole).ravel()
    p, left = fit(error)
    if args == ["--report"]:
        for place, row in zip(where, left.reshape(late.shape)):
            print("%4g km, sun %3g, view %3g, azimuth %3g: " % tuple(place), "".join("%7.1f" % (100 * x) for x in row))
        print(header(air, p, left))
        return 0
    return write_or_check(args, HEADER, header(air, p, left))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
