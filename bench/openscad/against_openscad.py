#!/usr/bin/env python3
"""Holds every OpenSCAD model below some folders to OpenSCAD itself: bench/openscad/against_openscad.py DIR...

A line a model: what became of it, the ratio of its volume with --facets to that of the STL file that
OpenSCAD exports, and which part of the rays that meet either meets one of them alone (the silhouettes'
difference). Then totals. The programs graycube and solid_volume are looked for in --bin.

Outcomes: alike; differs (volume by more than 0.1 %, or silhouettes by more than 0.5 %); refused, with the
first line that says why; slow, by Graycube, within --seconds; flat or empty, where OpenSCAD exports
nothing, whatever Graycube does; failed, where Graycube ends by a signal or a status other than 0 and 2.
Status: 0, or 1 where a model failed or less than 98 % of those that OpenSCAD exports are alike.
"""

import argparse
import collections
import concurrent.futures
import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path

MOST_VOLUME_PERCENT = 0.1
MOST_SILHOUETTE_PERCENT = 0.5
LEAST_ALIKE_PERCENT = 98


def run(command, seconds):
    """The status (None when the time was up) and the text on both outputs."""
    try:
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=seconds,
                              stdin=subprocess.DEVNULL, check=False)
    except subprocess.TimeoutExpired:
        return None, ""
    return done.returncode, done.stdout.decode(errors="replace")


def why(text):
    """The last line that tells of an error."""
    lines = [line for line in text.splitlines() if line.startswith("graycube: ") and "warning" not in line]
    return lines[-1] if lines else text.strip().splitlines()[-1] if text.strip() else ""


def exported(model, stl, seconds):
    """Whether OpenSCAD makes an STL file of the model."""
    status, _ = run(["openscad", "-o", str(stl), "--export-format", "binstl", str(model)], seconds)
    return status == 0 and stl.exists() and stl.stat().st_size > 84


def compared(tools, ours, stl, work, grid):
    """The ratio of volumes and the silhouettes' difference in percent, or why there is none."""
    theirs = work / "theirs.json"
    status, text = run([tools / "graycube", "convert", stl, theirs], 600)
    if status != 0:
        return None, "OpenSCAD's STL file: " + why(text)
    status, text = run([tools / "solid_volume", ours, theirs, "--grid", str(grid)], 600)
    if status != 0:
        return None, why(text)
    found = json.loads(text)
    if found["other_volume"] == 0:
        return None, "no volume"
    return (found["volume"] / found["other_volume"], found["hit_by_one_percent"]), ""


def outcome_of(model, arguments):
    """(outcome, details) of one model."""
    with tempfile.TemporaryDirectory() as folder:
        work = Path(folder)
        stl, ours = work / "theirs.stl", work / "ours.json"
        begin = time.monotonic()
        status, text = run([arguments.bin / "graycube", "convert", model, ours, "--facets"], arguments.seconds)
        took = f"{time.monotonic() - begin:.1f} s"
        is_exported = exported(model, stl, arguments.openscad_seconds)
        if status not in (0, 2, None):
            return "failed", f"{took}; status {status}: {why(text)}"
        if not is_exported:
            return "flat or empty", f"{took}; status {status}: {why(text) if status else ''}"
        if status is None:
            return "slow", took
        if status == 2:
            return "refused", f"{took}; {why(text)}"
        figures, trouble = compared(arguments.bin, ours, stl, work, arguments.grid)
        if figures is None:
            return "differs", f"{took}; not compared: {trouble}"
        ratio, silhouette = figures
        is_alike = abs(ratio - 1) <= MOST_VOLUME_PERCENT / 100 and silhouette <= MOST_SILHOUETTE_PERCENT
        return ("alike" if is_alike else "differs"), f"{took}; volume x {ratio:.6f}, silhouette {silhouette:.3f} %"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="+", type=Path)
    parser.add_argument("--bin", type=Path, default=Path("build/release/bin"))
    parser.add_argument("--seconds", type=float, default=150, help="that Graycube may take for a model")
    parser.add_argument("--openscad-seconds", type=float, default=300)
    parser.add_argument("--grid", type=int, default=200, help="rays along a side, for each axis")
    parser.add_argument("--jobs", type=int, default=1)
    arguments = parser.parse_args()
    arguments.bin = arguments.bin.resolve()
    for program in ("graycube", "solid_volume"):
        if not (arguments.bin / program).exists():
            parser.error(f"{program} is not in {arguments.bin}; --bin says where it is")
    models = sorted(path for folder in arguments.folders for path in folder.rglob("*.scad"))
    totals = collections.Counter()
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        for model, (outcome, details) in zip(models, pool.map(lambda m: outcome_of(m, arguments), models)):
            totals[outcome] += 1
            print(f"{outcome:14} {model}: {details}", flush=True)
    print(f"{len(models)} models:", ", ".join(f"{count} {outcome}" for outcome, count in totals.most_common()))
    solid = len(models) - totals["flat or empty"]
    share = 100 * totals["alike"] / solid if solid else 100
    print(f"{share:.1f} % of the {solid} that OpenSCAD exports are alike")
    return 1 if totals["failed"] or share < LEAST_ALIKE_PERCENT else 0


if __name__ == "__main__":
    sys.exit(main())
