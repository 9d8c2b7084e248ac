#!/usr/bin/env python3
"""Minimax coefficients of src/core/elementary.h, by Remez exchange.

    elementary.py          writes src/core/elementary_coefficients.h
    elementary.py --check  computes it again and compares (exit status 1 where it differs)
    elementary.py --scan-erfcx DEGREE FROM TO STEP   relative error by c, in thousandths

Each polynomial is fitted in relative error. Its coefficients are rounded to float from the lowest power up, the ones
not yet rounded being fitted again each time, so rounding costs little of the minimax error.
"""
import os
import struct
import sys

import mpmath as mp

from generated import write_or_check

mp.mp.dps = 30
GRID = 800
HEADER = os.path.join(os.path.dirname(__file__), "../../src/core/elementary_coefficients.h")


def to_float(x):
    return struct.unpack("f", struct.pack("f", float(x)))[0]


def grid(lo, hi):
    """Chebyshev points: dense at the ends, where the error of a polynomial moves fastest."""
    return [mp.mpf(lo + hi) / 2 - mp.mpf(hi - lo) / 2 * mp.cos(mp.pi * (i + mp.mpf(1) / 2) / GRID) for i in range(GRID)]


def extremes(error):
    """Index of the largest error between two sign changes, one for each."""
    best = []
    for i, e in enumerate(error):
        if best and (e > 0) == (error[best[-1]] > 0):
            if abs(e) > abs(error[best[-1]]):
                best[-1] = i
        else:
            best.append(i)
    return best


def drop_least(found, error, excess):
    """Takes the smallest extreme out, with its smaller neighbour, so that the signs go on alternating."""
    size = [abs(error[i]) for i in found]
    k = size.index(min(size))
    if excess == 1 or k in (0, len(found) - 1):
        found.pop(0 if size[0] < size[-1] else -1)
    else:
        found.pop(k)
        found.pop(k - 1 if size[k - 1] < size[k + 1] else k)


def remez(target, weight, n, xs):
    """Coefficients of sum c_k x^k closest to target in weighted maximum error, and that error."""
    heavy = [i for i in range(GRID) if weight[i] > max(weight) / 5] # not where the weight vanishes
    ref = [heavy[i * (len(heavy) - 1) // n] for i in range(n + 1)]
    basis = [[mp.mpf(x) ** k for k in range(n)] for x in xs]
    for _ in range(60):
        a = mp.matrix(n + 1, n + 1)
        b = mp.matrix(n + 1, 1)
        for row, i in enumerate(ref):
            for col in range(n):
                a[row, col] = basis[i][col] * weight[i]
            a[row, n] = (-1) ** row
            b[row] = target[i] * weight[i]
        c = mp.lu_solve(a, b)
        error = [(target[i] - sum(basis[i][k] * c[k] for k in range(n))) * weight[i] for i in range(GRID)]
        found = extremes(error)
        while len(found) > n + 1:
            drop_least(found, error, len(found) - n - 1)
        worst = max(abs(e) for e in error)
        if len(found) < n + 1 or found == ref or worst < abs(c[n]) * (1 + mp.mpf("1e-4")):
            break
        ref = found
    return [c[k] for k in range(n)], worst


def fit(f, weight, count, lo, hi):
    """Floats c_0 .. c_(count-1) of a polynomial close to f; weight(x) > 0 turns its error into the one to be minimised.

    With c_0 a float, what is left is a polynomial close to (f - c_0)/x under the weight |x|, and so on.
    """
    xs = grid(lo, hi)
    target = [f(x) for x in xs]
    w = [weight(x) for x in xs]
    fixed = []
    for k in range(count):
        c, _ = remez(target, w, count - k, xs)
        fixed.append(to_float(c[0]))
        target = [(t - mp.mpf(fixed[-1])) / x for t, x in zip(target, xs)]
        w = [v * abs(x) for v, x in zip(w, xs)]
    return fixed, max(abs(t * v) for t, v in zip(target, w))


def exp2_terms(degree):
    """2^f = 1 + f q(f): exactly 1 at 0."""
    return fit(lambda f: (2**f - 1) / f, lambda f: abs(f) * 2**-f, degree, -0.5, 0.5)


def log_terms(scale, count):
    """log(m) = s (a0 + s^2 a1 + ..), s = (m-1)/(m+1), in z = s^2; the leading 2 is kept where scale is 1."""
    top = (3 - 2 * mp.sqrt(2)) ** 2
    g = lambda z: scale * 2 * mp.atanh(mp.sqrt(z)) / mp.sqrt(z)
    if scale != 1:
        return fit(g, lambda z: 1 / g(z), count, 0, top)
    c, e = fit(lambda z: (g(z) - 2) / z, lambda z: z / g(z), count - 1, 0, top)
    return [2.0] + c, e


def odd_terms(f, count, hi):
    """f(x) = x + x^3 p(x^2), in z = x^2; without the leading 1."""
    x = mp.sqrt
    return fit(lambda z: (f(x(z)) - x(z)) / (z * x(z)), lambda z: z * x(z) / f(x(z)), count, 0, mp.mpf(hi) ** 2)


def cos_terms(count):
    """cos(x) = 1 - z/2 + z^2 p(z), z = x^2."""
    x = mp.sqrt
    return fit(lambda z: (mp.cos(x(z)) - 1 + z / 2) / z**2, lambda z: z**2 / mp.cos(x(z)), count, 0,
               (mp.pi / 4) ** 2)


def erfcx(y):
    if y > 20:
        return tail(y)
    return mp.exp(y * y) * mp.erfc(y)


def tail(y):
    """Asymptotic series; at y > 20 thirty terms are below 1e-40."""
    term, total = mp.mpf(1), mp.mpf(1)
    for k in range(1, 31):
        term *= -(2 * k - 1) / (2 * y * y)
        total += term
    return total / (y * mp.sqrt(mp.pi))


def erfcx_terms(c, degree, rounded=True):
    """erfcx(y) = t p(t), t = 1/(1+c y), y from 0 to infinity; constant sqrt(1/pi) c at t = 0."""
    c = mp.mpf(c)
    f = lambda t: erfcx((1 / t - 1) / c) / t
    if rounded:
        return fit(f, lambda t: 1 / f(t), degree + 1, 0, 1)
    xs = grid(0, 1)
    target = [f(x) for x in xs]
    return remez(target, [1 / t for t in target], degree + 1, xs)


# c of erfcx_terms() by degree: the best on a scan of [.3, .8] in steps of .002 (--scan-erfcx DEGREE).
ERFCX_C = {4: 0.563, 6: 0.395, 8: 0.4}


def blocks():
    """(prefix, comment, coefficients, error) of each polynomial."""
    for d in (3, 4, 5, 6):
        yield "SKV_EXP2_D%d_" % d, "2^f = 1 + f(c0 + f(c1 + ..)), |f| <= 1/2", *exp2_terms(d)
    yield "SKV_LOG2_", "log2(m) = s(c0 + z(c1 + ..)), s = (m-1)/(m+1), z = s^2", *log_terms(1 / mp.log(2), 4)
    yield "SKV_LOG_", "ln(m), the same form", *log_terms(1, 4)
    for d, c in ERFCX_C.items():
        yield "SKV_ERFCX%d_" % d, "erfcx(y) = t(c0 + t(c1 + ..)), t = 1/(1 + %gy)" % c, *erfcx_terms(to_float(c), d)
    yield "SKV_SIN_", "sin(x) = x + xz(c0 + z(c1 + ..)), z = x^2, |x| <= pi/4", *odd_terms(mp.sin, 3, mp.pi / 4)
    yield "SKV_COS_", "cos(x) = 1 - z/2 + z^2(c0 + z(c1 + ..))", *cos_terms(3)
    yield "SKV_ASIN_", "asin(x) = x + xz(c0 + z(c1 + ..)), |x| <= 1/2", *odd_terms(mp.asin, 5, 0.5)
    yield "SKV_ATAN_", "atan(x) = x + xz(c0 + z(c1 + ..)), |x| <= tan(pi/8)", *odd_terms(mp.atan, 4, mp.sqrt(2) - 1)


def header():
    out = ["// Made by tools/fit/elementary.py: minimax polynomials of elementary.h. `make fit-check` compares.",
           "#ifndef SKV_CORE_ELEMENTARY_COEFFICIENTS_H", "#define SKV_CORE_ELEMENTARY_COEFFICIENTS_H"]
    for prefix, comment, c, error in blocks():
        out += ["", "// %s; relative error %.2g before rounding of the steps." % (comment, float(error))]
        out += ["#define %s%d %sf" % (prefix, i, literal(v)) for i, v in enumerate(c)]
    out += ["", "// c of t = 1/(1 + c y)."]
    for d, c in ERFCX_C.items():
        out.append("#define SKV_ERFCX%d_T %sf" % (d, literal(c)))
    return "\n".join(out + ["", "#endif", ""])


def literal(x):
    s = "%.9g" % x
    return s if "." in s or "e" in s else s + ".0"


def main(args):
    if len(args) == 5 and args[0] == "--scan-erfcx":
        for i in range(*map(int, args[2:])):
            print(i / 1000, mp.nstr(erfcx_terms(i / 1000, int(args[1]), False)[1], 4), flush=True)
        return 0
    return write_or_check(args, HEADER, header())


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
