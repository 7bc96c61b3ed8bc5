#!/usr/bin/env python3
"""Compares the ways to find crossings on one thread: a table for each scene, of which each row is a way.

For each scene and way, in turns: `trace_time SCENE --subdivision WAY`. CPU times are the least of all turns, since other
work on the machine only adds to them; counts are the same in each turn. `gain` is Roth's time over the way's. Pictures
must be the same to the byte. Status: 0 done, 1 something failed, 2 bad usage.
"""

import argparse
import json
import sys
import tempfile
from pathlib import Path

sys.dont_write_bytecode = True  # nothing is left in the source folder

from measure import Failure, run

TRACE_TIME = Path(__file__).resolve().parent.parent / "build/bench/bin/trace_time"
LONGEST_S = 600
WAYS = {
    "roth": ["roth"],
    "kaplan": ["kaplan"],
    "octree": ["octree"],
    "arnaldi": ["arnaldi", "--entry", "extremal"],
    "arnaldi, descent": ["arnaldi", "--entry", "descent"],
    "linked, extremal": ["linked", "--entry", "extremal"],
    "linked": ["linked", "--entry", "descent"],
    "surfaces": ["surfaces"],
}
COLUMNS = ["way", "cells", "MB", "build s", "trace s", "µs/ray", "gain", "cells/ray", "tests/ray", "saved/ray",
           "spheres/ray", "boxes/ray", "planes/ray", "links/ray", "not shot"]


def measured(trace_time: Path, scene: Path, size: str, way: list, folder: Path) -> tuple:
    """What one run says, and its picture."""
    picture = folder / "picture.exr"
    finished = run([trace_time, scene, "--size", size, "--exr", picture, "--subdivision", *way], LONGEST_S, folder)
    if finished is None:
        raise Failure(f"{scene}: longer than {LONGEST_S} s")
    return json.loads(finished.output), picture.read_bytes()


def fastest(turns: list) -> dict:
    best = dict(turns[0])
    for key in ("build_s", "trace_cpu_s"):
        best[key] = min(t[key] for t in turns)
    return best


def row(name: str, m: dict, roth_s: float) -> list:
    rays = sum(m["rays"].values())
    per_ray = [m[f"{count}_per_ray"] for count in
               ("cells", "primitives", "saved", "spheres", "boxes", "nodes", "entry_links")]
    return [name, m["cells"], f"{m['held_bytes'] / 1e6:.2f}", f"{m['build_s']:.3f}", f"{m['trace_cpu_s']:.3f}",
            f"{m['trace_cpu_s'] / rays * 1e6:.2f}", f"{roth_s / m['trace_cpu_s']:.1f}",
            *(f"{value:.1f}" for value in per_ray), m["not_shot"]]


def table(trace_time: Path, scene: Path, size: str, turns: int, folder: Path) -> None:
    runs = {name: [] for name in WAYS}
    pictures = set()
    for _ in range(turns):
        for name, way in WAYS.items():
            result, picture = measured(trace_time, scene, size, way, folder)
            runs[name].append(result)
            pictures.add(picture)
    if len(pictures) != 1:
        raise Failure(f"{scene}: the ways' pictures differ")
    best = {name: fastest(results) for name, results in runs.items()}
    print(f"\n{scene.stem}, {size}², {best['roth']['primitives']} primitives, "
          f"{sum(best['roth']['rays'].values())} rays\n")
    print("| " + " | ".join(COLUMNS) + " |")
    print("|---" * len(COLUMNS) + "|")
    for name in WAYS:
        print("| " + " | ".join(map(str, row(name, best[name], best["roth"]["trace_cpu_s"]))) + " |")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="+", type=Path, metavar="SCENE")
    parser.add_argument("--trace-time", type=Path, default=TRACE_TIME, help="the program (%(default)s)")
    parser.add_argument("--size", default="256", help="pictures are SIZE × SIZE (%(default)s)")
    parser.add_argument("--turns", type=int, default=3, help="runs of each way (%(default)s)")
    arguments = parser.parse_args()
    try:
        with tempfile.TemporaryDirectory() as folder:
            for scene in arguments.scenes:
                table(arguments.trace_time, scene.resolve(), arguments.size, arguments.turns, Path(folder))
    except Failure as failure:
        print(f"subdivisions.py: {failure}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
