#!/usr/bin/env python3
"""Where rays cross a lathe and a sweep, computed in exact fractions from docs/scene.md alone.

    python3 tests/golden/outline_roots.py

prints a line "KIND RAY T T …" for each ray, with 20 digits. It shares nothing with the engine:
tests/outline/golden_roots_test.cpp holds what it printed, and compares. Every segment's polynomial
is looked at in 2¹⁰ steps, each sign change is halved to 2⁻¹⁰⁰ of the segment.
"""
from decimal import Decimal, getcontext
from fractions import Fraction as F
from math import comb, isqrt

getcontext().prec = 40

# r or x, z or y in sixteenths: three points a segment, the last ends where the first begins.
OUTLINE = [(0, -14), (5, -14), (9, -13), (10, -9), (16, 1), (3, 6), (8, 14), (7, 14), (6, 15),
           (6, 14), (1, 6), (13, 1), (8, -8), (6, -11), (2, -11), (0, -11), (0, -12), (0, -13)]
# Origin and direction in sixteenths. The first two are level and upright.
RAYS = [((-48, 3, 1), (16, 0, 0)), ((4, 1, 32), (0, 0, -1)), ((-40, 3, 20), (40, 1, -21)),
        ((30, -31, -40), (-29, 33, 41)), ((7, 48, 9), (1, -40, -1)), ((2, 1, 0), (3, 5, 7)),
        ((-33, 2, -9), (33, 1, 1))]
STEPS = 1 << 10
HALVINGS = 90


def at(points, u):
    return sum(comb(3, i) * (1 - u) ** (3 - i) * u ** i * p for i, p in enumerate(points))


def root(value):
    """The square root of a fraction, to 60 digits."""
    scale = 10 ** 60
    return F(isqrt(value.numerator * scale * scale // value.denominator), scale)


def sign_changes(f):
    """The points of (0, 1) where f changes its sign."""
    for i in range(STEPS):
        lo, hi = F(i, STEPS), F(i + 1, STEPS)
        if (f(lo) < 0) == (f(hi) < 0):
            continue
        begins = f(lo) < 0
        for _ in range(HALVINGS):
            middle = (lo + hi) / 2
            lo, hi = (middle, hi) if (f(middle) < 0) == begins else (lo, middle)
        yield lo


def segments():
    for i in range(0, len(OUTLINE), 3):
        points = [OUTLINE[(i + k) % len(OUTLINE)] for k in range(4)]
        yield [F(x, 16) for x, _ in points], [F(y, 16) for _, y in points]


def lathe_cuts(o, d):
    square = d[0] ** 2 + d[1] ** 2
    along = o[0] * d[0] + o[1] * d[1]
    for r, z in segments():
        if d[2] == 0:
            # At the height of the ray: |o + t d| = r, twice.
            for u in sign_changes(lambda u: at(z, u) - o[2]):
                half = (along / square) ** 2 - (o[0] ** 2 + o[1] ** 2 - at(r, u) ** 2) / square
                if half > 0:
                    yield -along / square - root(half)
                    yield -along / square + root(half)
            continue

        def off(u):
            t = (at(z, u) - o[2]) / d[2]
            return (o[0] + t * d[0]) ** 2 + (o[1] + t * d[1]) ** 2 - at(r, u) ** 2

        for u in sign_changes(off):
            yield (at(z, u) - o[2]) / d[2]


def sweep_cuts(o, d):
    square = d[0] ** 2 + d[1] ** 2
    if square == 0:
        return
    for x, y in segments():
        for u in sign_changes(lambda u: d[0] * (at(y, u) - o[1]) - d[1] * (at(x, u) - o[0])):
            yield (d[0] * (at(x, u) - o[0]) + d[1] * (at(y, u) - o[1])) / square


def main():
    for kind, cuts in (("lathe", lathe_cuts), ("sweep", sweep_cuts)):
        for number, (origin, direction) in enumerate(RAYS):
            o, d = [F(v, 16) for v in origin], [F(v, 16) for v in direction]
            found = sorted(Decimal(t.numerator) / Decimal(t.denominator) for t in cuts(o, d))
            print(kind, number, *(f"{t:.20f}" for t in found))


if __name__ == "__main__":
    main()
