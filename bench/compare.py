#!/usr/bin/env python3
"""Measures Graycube beside POV-Ray and a plain tracer on Embree, on generated scenes.

Every scene is rendered by each, one after the other, one thread each; the pictures must agree.
Times are CPU seconds: of whole processes for POV-Ray and Graycube, of tracing alone where it says
"trace". So they mean something on a busy machine too, but less than on an idle one. Needs the
programs that deploy/bench.sh builds. Status: 0 done, 1 something failed, took too long, or pictures
differ, 2 bad usage.
"""

import argparse
import dataclasses
import json
import os
import platform
import sys
import tempfile
from pathlib import Path

sys.dont_write_bytecode = True  # nothing is left in the source folder

import report
from measure import Bench, Failure, Measurement

PROGRAMS = Path(__file__).resolve().parent.parent / "build/bench/bin"
FAMILIES = "csg:1000,csg:10000,csg:100000,flake:5,menger:3,deepcsg:250,deepcsg:2000,glasslens:9"
QUICK_FAMILIES = "csg:1000,flake:3,menger:2,deepcsg:250,glasslens:4"
GROWTH = ("spheres:1000,spheres:10000,spheres:100000,spheres:1000000,"
          "csg:1000,csg:10000,csg:100000,csg:1000000,"
          "deepcsg:250,deepcsg:500,deepcsg:1000,deepcsg:2000")
QUICK_GROWTH = "spheres:1000,spheres:10000,deepcsg:250,deepcsg:500"
# POV-Ray takes minutes at 512² for one solid with thousands of holes.
SLOW_FAMILIES = {"menger", "deepcsg"}
SLOW_SIDE = 256


def scene_list(text: str) -> list:
    """"csg:1000,flake:5" as [("csg", 1000), ("flake", 5)]; "" as []."""
    scenes = []
    for item in filter(None, text.split(",")):
        family, colon, size = item.partition(":")
        if not colon or not size.isdigit():
            raise argparse.ArgumentTypeError(f"not FAMILY:SIZE: {item!r}")
        scenes.append((family, int(size)))
    return scenes


def number_list(text: str) -> list:
    try:
        return [int(n) for n in text.split(",")]
    except ValueError as e:
        raise argparse.ArgumentTypeError(f"not numbers with commas: {text!r}") from e


def parse_arguments() -> argparse.Namespace:
    p = argparse.ArgumentParser(description=__doc__,
                                formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("--bin", type=Path, default=PROGRAMS,
                   help="folder of the programs (default: build/bench/bin)")
    p.add_argument("--seeds", type=number_list, help="seeds (default 11,12,13)")
    slow = " and ".join(sorted(SLOW_FAMILIES))
    p.add_argument("--size", type=int, help=f"pictures are SIZE² (default 512); {slow} at most "
                   f"{SLOW_SIDE}², for POV-Ray's sake")
    p.add_argument("--families", type=scene_list, help=f"FAMILY:SIZE,… (default {FAMILIES})")
    p.add_argument("--growth", type=scene_list,
                   help="scenes to show how Graycube's cost grows; '' for none")
    p.add_argument("--quick", action="store_true",
                   help="small scenes and pictures, one seed: a trial run")
    p.add_argument("--no-pov", action="store_true", help="leave out POV-Ray")
    p.add_argument("--no-plain", action="store_true", help="leave out the plain tracer")
    p.add_argument("--timeout", type=float, default=600,
                   help="seconds of wall time a run may take (default 600)")
    p.add_argument("--json", type=Path, help="also write all measurements to this file")
    a = p.parse_args()
    if a.seeds is None:
        a.seeds = [11] if a.quick else [11, 12, 13]
    if a.size is None:
        a.size = 128 if a.quick else 512
    if a.families is None:
        a.families = scene_list(QUICK_FAMILIES if a.quick else FAMILIES)
    if a.growth is None:
        a.growth = scene_list(QUICK_GROWTH if a.quick else GROWTH)
    if not 1 <= a.size <= 16384:
        p.error("--size: from 1 to 16384")
    if not (a.bin / "graycube").exists():
        p.error(f"no graycube in {a.bin}: run deploy/bench.sh, or give --bin")
    return a


def progress(text: str) -> None:
    print(f"... {text}", file=sys.stderr, flush=True)


def compare_all(bench: Bench, a: argparse.Namespace) -> list:
    measurements = []
    for family, size in a.families:
        side = min(a.size, SLOW_SIDE) if family in SLOW_FAMILIES else a.size
        for seed in a.seeds:
            m = Measurement(family, size, seed, side)
            progress(f"{m.name}, seed {seed}, {side}²")
            bench.generate(m, for_pov=not a.no_pov)
            bench.graycube(m)
            if m.graycube_cpu_s is not None:
                if not a.no_plain:
                    bench.plain(m)
                if not a.no_pov:
                    bench.pov(m)
            measurements.append(m)
    return measurements


def measure_growth(bench: Bench, a: argparse.Namespace) -> list:
    measurements = []
    for family, size in a.growth:
        for seed in a.seeds:
            m = Measurement(family, size, seed, a.size)
            progress(f"{m.name}, seed {seed}, Graycube alone")
            bench.generate(m, for_pov=False)
            bench.trace_time(m)
            measurements.append(m)
    return measurements


def complaints(measurements: list) -> list:
    found = []
    for m in measurements:
        for program in m.timeouts:
            found.append(f"{m.name}, seed {m.seed}: {program} took too long and was ended")
        for other, agreement in (("POV-Ray", m.pov_off), ("the plain tracer", m.plain_off)):
            if agreement and not agreement.holds:
                found.append(f"{m.name}, seed {m.seed}: {agreement.percent_off} % of the pixels "
                             f"differ from {other}'s, by up to {agreement.largest}/65535")
    return found


def print_section(title: str, text: str) -> None:
    if text:
        print(f"\n{title}\n\n{text}")


def main() -> int:
    a = parse_arguments()
    with tempfile.TemporaryDirectory(prefix="graycube-bench-") as folder:
        bench = Bench(a.bin.resolve(), Path(folder), a.timeout)
        try:
            measurements = compare_all(bench, a)
            growth = measure_growth(bench, a)
            progress("single rays against Embree")
            rates = bench.rays_vs_embree(["--depth", 3, "--size", 256] if a.quick else [])
        except Failure as e:
            print(f"compare: {e}", file=sys.stderr)
            return 1
    machine, processors, load = platform.machine(), os.cpu_count(), os.getloadavg()[0]
    print(f"{machine}, {processors} processors, load {load:.1f}; one thread, CPU seconds")
    if measurements:
        print_section("Beside POV-Ray and a plain tracer", report.table(measurements))
    print_section("Medians over seeds", "\n".join(report.goal_lines(measurements)))
    if growth:
        print_section(f"Graycube alone at {a.size}², medians", report.growth_table(growth))
    print_section("Growth", "\n".join(report.growth_lines(growth)))
    print_section("Single rays", "\n".join(report.embree_lines(rates)))
    wrong = complaints(measurements + growth)
    print_section("Not as it should be", "\n".join(wrong))
    if a.json:
        a.json.write_text(json.dumps({
            "machine": machine, "processors": processors, "load": load,
            "compared": [dataclasses.asdict(m) for m in measurements],
            "growth": [dataclasses.asdict(m) for m in growth],
            "single_rays": rates}, indent=1) + "\n")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
