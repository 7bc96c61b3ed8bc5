#!/usr/bin/env python3
"""Holds OpenSCAD models to OpenSCAD itself: bench/openscad/against_openscad.py DIR_OR_FILE...

A line a model: what became of it, the ratio of its volume with --facets to that of the STL file that
OpenSCAD exports, and which part of the rays that meet either meets one of them alone (the silhouettes'
difference). Then totals. A flat model is compared one unit thick, by the .csg file that OpenSCAD writes
of it. The programs graycube and solid_volume are looked for in --bin.

Outcomes: alike; differs (volume by more than 0.1 %, or silhouettes by more than 0.5 %); refused, with the
last line that says why; slow, by Graycube, within --seconds; failed, where Graycube ends by a signal or a
status other than 0 and 2. Where OpenSCAD is no measure: nothing (it exports no file, or not in time), no
solid (what it exports is open or has no volume), incomplete (volumes differ, and OpenSCAD's own ERROR
says that it lost a part).
Status: 0, or 1 where a model failed or less than 98 % of those that OpenSCAD is a measure for are alike.
"""

import argparse
import collections
import concurrent.futures
import json
import math
import re
import struct
import subprocess
import sys
import tempfile
import time
from pathlib import Path

MOST_VOLUME_PERCENT = 0.1
MOST_SILHOUETTE_PERCENT = 0.5
LEAST_ALIKE_PERCENT = 98
SECONDS_TO_END = 5
STL_BYTES_WITHOUT_FACETS = 84
SINGLE_PRECISION = 1e-7
NO_MEASURE = ("nothing", "no solid", "incomplete")


def run(command, seconds):
    """The status (None when the time was up) and the text on both outputs."""
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          stdin=subprocess.DEVNULL) as process:
        try:
            text, _ = process.communicate(timeout=seconds)
            return process.returncode, text.decode(errors="replace")
        except subprocess.TimeoutExpired:
            # Asked first: graycube ends its openscad then, which a kill would leave behind.
            process.terminate()
        try:
            process.communicate(timeout=SECONDS_TO_END)
        except subprocess.TimeoutExpired:
            process.kill()
        return None, ""


def why(text):
    """The last line that tells of an error."""
    lines = [line for line in text.splitlines() if line.startswith("graycube: ") and "warning" not in line]
    return lines[-1] if lines else text.strip().splitlines()[-1] if text.strip() else ""


def exported(model, stl, seconds):
    """Whether OpenSCAD makes an STL file of the model, and what it says."""
    status, text = run(["openscad", "-o", str(stl), "--export-format", "binstl", str(model)], seconds)
    return status == 0 and stl.exists() and stl.stat().st_size > STL_BYTES_WITHOUT_FACETS, text


def why_nothing(said):
    """What OpenSCAD says of a model that it doesn't export."""
    telling = [line for line in said.splitlines() if "ERROR" in line or "top level object" in line]
    return "OpenSCAD: " + (telling[0] if telling else "not in time")


def extruded(model, work, seconds):
    """A model of the flat model, one unit thick; None where OpenSCAD doesn't read it."""
    tree = work / "flat.csg"
    status, _ = run(["openscad", "-o", str(tree), str(model)], seconds)
    if status != 0 or not tree.exists():
        return None
    folder = model.resolve().parent
    text = re.sub(r'file = "([^/"][^"]*)"', lambda m: f'file = "{folder / m.group(1)}"', tree.read_text())
    solid = work / "extruded.scad"
    solid.write_text(f"linear_extrude(height = 1) {{\n{text}}}\n")
    return solid


def converted(model, ours, arguments):
    """Graycube's status, why it wasn't 0, and the seconds that it took."""
    begin = time.monotonic()
    status, text = run([arguments.bin / "graycube", "convert", model, ours, "--facets"], arguments.seconds)
    return status, why(text) if status else "", f"{time.monotonic() - begin:.1f} s"


def dot(a, b):
    return sum(p * q for p, q in zip(a, b))


def cross(a, b):
    return [a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3] for i in range(3)]


def encloses_volume(stl):
    """Whether the facets of a binary STL file enclose more than rounding."""
    volume, area, size = 0.0, 0.0, 0.0
    for facet in struct.iter_unpack("<12x9fH", stl.read_bytes()[STL_BYTES_WITHOUT_FACETS:]):
        a, b, c = facet[0:3], facet[3:6], facet[6:9]
        volume += dot(a, cross(b, c)) / 6
        ab, ac = [[q - p for p, q in zip(a, corner)] for corner in (b, c)]
        area += 0.5 * math.hypot(*cross(ab, ac))
        size = max(size, *map(abs, facet[:9]))
    return abs(volume) > SINGLE_PRECISION * size * area


def compared(ours, stl, said, work, arguments):
    """(outcome, details) of a model of which OpenSCAD made a file."""
    if not encloses_volume(stl):
        return "no solid", "OpenSCAD's STL file encloses no volume"
    theirs = work / "theirs.json"
    status, text = run([arguments.bin / "graycube", "convert", stl, theirs], 600)
    if status != 0:
        return "no solid", "OpenSCAD's STL file: " + why(text)
    status, text = run([arguments.bin / "solid_volume", ours, theirs, "--grid", str(arguments.grid)], 600)
    if status != 0:
        return "differs", "not compared: " + why(text)
    found = json.loads(text)
    ratio, silhouette = found["volume"] / found["other_volume"], found["hit_by_one_percent"]
    details = f"volume x {ratio:.6f}, silhouette {silhouette:.3f} %"
    if abs(ratio - 1) <= MOST_VOLUME_PERCENT / 100 and silhouette <= MOST_SILHOUETTE_PERCENT:
        return "alike", details
    errors = [line for line in said.splitlines() if line.startswith("ERROR:")]
    return ("incomplete", f"{details}; {errors[0]}") if errors else ("differs", details)


def outcome_of(model, arguments):
    """(outcome, details) of one model."""
    with tempfile.TemporaryDirectory() as folder:
        work = Path(folder)
        stl, ours = work / "theirs.stl", work / "ours.json"
        status, trouble, took = converted(model, ours, arguments)
        if status not in (0, 2, None):
            return "failed", f"{took}; status {status}: {trouble}"
        is_exported, said = exported(model, stl, arguments.openscad_seconds)
        flat = None
        if not is_exported and "not a 3D object" in said:
            flat = extruded(model, work, arguments.openscad_seconds)
        if flat:
            status, trouble, took = converted(flat, ours, arguments)
            is_exported, said = exported(flat, stl, arguments.openscad_seconds)
        if status not in (0, 2, None):
            return "failed", f"{took}; status {status}: {trouble}"
        if not is_exported:
            return "nothing", f"{took}; {trouble or why_nothing(said)}"
        if status is None:
            return "slow", took
        if status == 2:
            outcome, details = compared(stl, stl, said, work, arguments)
            return ("no solid" if outcome == "no solid" else "refused"), f"{took}; {trouble}"
        outcome, details = compared(ours, stl, said, work, arguments)
        return outcome, f"{took}; {details}{', one unit thick' if flat else ''}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("models", nargs="+", type=Path, help="files, or folders of .scad files")
    parser.add_argument("--bin", type=Path, default=Path("build/release/bin"))
    parser.add_argument("--seconds", type=float, default=150, help="that Graycube may take for a model")
    parser.add_argument("--openscad-seconds", type=float, default=300)
    parser.add_argument("--grid", type=int, default=200, help="rays along a side, for each axis")
    parser.add_argument("--every", type=int, default=1, help="only one model in so many")
    parser.add_argument("--jobs", type=int, default=1)
    arguments = parser.parse_args()
    arguments.bin = arguments.bin.resolve()
    for program in ("graycube", "solid_volume"):
        if not (arguments.bin / program).exists():
            parser.error(f"{program} is not in {arguments.bin}; --bin says where it is")
    found = (path.rglob("*.scad") if path.is_dir() else [path] for path in arguments.models)
    models = sorted(path for paths in found for path in paths)[:: arguments.every]
    totals = collections.Counter()
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        for model, (outcome, details) in zip(models, pool.map(lambda m: outcome_of(m, arguments), models)):
            totals[outcome] += 1
            print(f"{outcome:14} {model}: {details}", flush=True)
    print(f"{len(models)} models:", ", ".join(f"{count} {outcome}" for outcome, count in totals.most_common()))
    exported_count = len(models) - totals["nothing"]
    measured = sum(count for outcome, count in totals.items() if outcome not in NO_MEASURE)
    share = 100 * totals["alike"] / measured if measured else 100
    print(f"{exported_count} are exported by OpenSCAD; {share:.1f} % of the {measured} that are whole solids are alike")
    return 1 if totals["failed"] or share < LEAST_ALIKE_PERCENT else 0


if __name__ == "__main__":
    sys.exit(main())
