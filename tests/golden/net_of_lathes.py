#!/usr/bin/env python3
"""Rewrites a scene's lathes as nets of Bézier patches, four quarters around, to compare the two.

    python3 tests/golden/net_of_lathes.py SCENE TOLERANCE > OUT.json

The nets are meshes to the tolerance; their quarters are round to 2.7e-4 of the radius, as cubics
are.
"""
import json
import sys

K = 0.5522847498307936
# Control points of a quarter turn, and its image under turns by 90°.
QUARTER = [(1, 0), (1, K), (K, 1), (0, 1)]


def turned(point, quarters):
    x, y = point
    for _ in range(quarters):
        x, y = -y, x
    return x, y


def net_of(loop, tolerance):
    loop = [tuple(p) for p in loop]
    if len(loop) % 3 == 0:
        loop.append(loop[0])
    points, numbers, patches = [], {}, []

    def number(point):
        return numbers.setdefault(point, len(numbers))

    for first in range(0, len(loop) - 1, 3):
        segment = loop[first:first + 4]
        if all(r == 0 for r, _ in segment):
            continue
        for quarter in range(4):
            rows = [[number((r * x + 0.0, r * y + 0.0, z))
                     for x, y in (turned(p, quarter) for p in QUARTER)] for r, z in segment]
            patches.append([n for row in rows for n in row])
    points = list(numbers)
    return {"type": "bezier", "tolerance": tolerance, "points": points, "patches": patches}


def rewritten(value, tolerance):
    if isinstance(value, list):
        return [rewritten(v, tolerance) for v in value]
    if not isinstance(value, dict):
        return value
    if value.get("type") == "lathe" and len(value["outline"]) == 1:
        rest = {k: v for k, v in value.items() if k not in ("type", "outline")}
        return {**net_of(value["outline"][0], tolerance), **rest}
    return {k: rewritten(v, tolerance) for k, v in value.items()}


def main():
    with open(sys.argv[1]) as file:
        scene = json.load(file)
    json.dump(rewritten(scene, float(sys.argv[2])), sys.stdout)


if __name__ == "__main__":
    main()
