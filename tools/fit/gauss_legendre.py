#!/usr/bin/env python3
"""Nodes and weights of Gauss-Legendre quadrature on [0, 1], N = 2..16.

    gauss_legendre.py          writes src/core/gauss_legendre.h
    gauss_legendre.py --check  computes it again and compares (exit status 1 where it differs)

Newton's method on the Legendre polynomial from Tricomi's estimate of its roots, in 40 digits.
"""
import os
import sys

import mpmath as mp

from generated import write_or_check

mp.mp.dps = 40
HEADER = os.path.join(os.path.dirname(__file__), "../../src/core/gauss_legendre.h")
FIRST, LAST = 2, 16


def legendre(n, x):
    """P_n(x) and its derivative by the three-term recurrence."""
    before, p = mp.mpf(1), x
    for k in range(2, n + 1):
        before, p = p, ((2 * k - 1) * x * p - (k - 1) * before) / k
    return p, n * (x * p - before) / (x * x - 1)


def rule(n):
    """[(node, weight)] on [0, 1], ascending."""
    out = []
    for i in range(n, 0, -1):
        x = (1 - mp.mpf(1) / (8 * n * n) + mp.mpf(1) / (8 * n**3)) * mp.cos(mp.pi * (4 * i - 1) / (4 * n + 2))
        for _ in range(20):
            p, d = legendre(n, x)
            x -= p / d
        d = legendre(n, x)[1]
        out.append(((1 + x) / 2, 1 / ((1 - x * x) * d * d)))
    return out


def table(name, column, comment):
    lines = ["/// %s" % comment, "static const float %s[SKV_GAUSS_COUNT] = {" % name]
    for n in range(FIRST, LAST + 1):
        row = ["%.9gf" % float(r[column]) for r in rule(n)]
        for i in range(0, n, 8):
            lines.append("    " + ", ".join(row[i:i + 8]) + ",")
    return lines + ["};"]


def header():
    out = """// Made by tools/fit/gauss_legendre.py: Gauss-Legendre quadrature on [0, 1]. `make fit-check` compares.
#ifndef SKV_CORE_GAUSS_LEGENDRE_H
#define SKV_CORE_GAUSS_LEGENDRE_H

#define SKV_GAUSS_MIN   %d
#define SKV_GAUSS_MAX   %d
#define SKV_GAUSS_COUNT %d

/// Where the N entries of the rule with N points begin, N in [SKV_GAUSS_MIN, SKV_GAUSS_MAX]: rules follow one another.
static inline int skv_gauss_offset(int n) {
    return n * (n - 1) / 2 - 1;
}

// clang-format off""" % (FIRST, LAST, sum(range(FIRST, LAST + 1)))
    lines = out.split("\n")
    lines += table("skv_gauss_node", 0, "Ascending within a rule.")
    lines += [""] + table("skv_gauss_weight", 1, "They add up to 1.")
    return "\n".join(lines + ["// clang-format on", "", "#endif", ""])


if __name__ == "__main__":
    sys.exit(write_or_check(sys.argv[1:], HEADER, header()))
