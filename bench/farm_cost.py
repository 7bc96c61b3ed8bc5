#!/usr/bin/env python3
"""Measures what a farm costs beside serial: CPU time, of which the start of its processes, and balance.

For each scene and number of nodes, in turns: `render --algorithm serial`, `render --algorithm macro`, which starts a farm of its
own, and jobs on a farm that is up. Medians of `cpu_s` (docs/statistics.md), so ratios mean something on a busy machine,
too. A first turn isn't counted. Pictures must be the same to the byte. Status: 0 done, 1 something failed, 2 bad usage.
"""

import argparse
import json
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.dont_write_bytecode = True  # nothing is left in the source folder

from measure import Failure, run

GRAYCUBE = Path(__file__).resolve().parent.parent / "build/bench/bin/graycube"
LONGEST_S = 600


class Turns:
    """The renders of one scene, and what their statistics said."""

    def __init__(self, graycube: Path, scene: Path, size: str, folder: Path):
        self.graycube, self.scene, self.size, self.folder = graycube, scene, size, folder
        self.picture = None

    def stats(self, command: list) -> dict:
        """Of one render, whose picture must be that of all others."""
        picture, stats = self.folder / "picture.exr", self.folder / "stats.json"
        whole = [self.graycube, *command, self.scene, "--size", self.size, "-o", picture, "--stats", stats, "--quiet"]
        if run(whole, LONGEST_S, self.folder) is None:
            raise Failure(f"{self.scene}: longer than {LONGEST_S} s")
        pixels = picture.read_bytes()
        if self.picture is None:
            self.picture = pixels
        if pixels != self.picture:
            raise Failure(f"{self.scene}: the picture of {' '.join(map(str, command))} is another")
        return json.loads(stats.read_text())


class Farm:
    """A farm that is up while this is entered."""

    def __init__(self, graycube: Path, nodes: int, folder: Path):
        self.graycube, self.nodes, self.endpoint = graycube, nodes, f"ipc://{folder}/farm"

    def __enter__(self):
        try:
            self.process = subprocess.Popen([self.graycube, "up", "-n", str(self.nodes), "--listen", self.endpoint],
                                            stdout=subprocess.DEVNULL)
        except OSError as e:
            raise Failure(f"cannot run {self.graycube}: {e.strerror}") from e
        for _ in range(100):
            if subprocess.run([self.graycube, "nodes", "--connect", self.endpoint], capture_output=True).returncode == 0:
                return self
            time.sleep(0.1)
        self.__exit__()
        raise Failure("the farm doesn't answer")

    def __exit__(self, *_):
        subprocess.run([self.graycube, "down", "--connect", self.endpoint], capture_output=True)
        self.process.terminate()
        self.process.wait()


def measured(turns: Turns, nodes: int, renders: int, folder: Path) -> list:
    """The cells of a row."""
    macro = ["--algorithm", "macro", "-n", str(nodes)]
    serial, render, job = [], [], []
    with Farm(turns.graycube, nodes, folder) as farm:
        for turn in range(renders + 1):
            one = (turns.stats(["render", "--algorithm", "serial", "--threads", "1"]), turns.stats(["render", *macro]),
                   turns.stats(["submit", *macro, "--wait", "--connect", farm.endpoint]))
            if turn > 0:
                for of, stats in zip((serial, render, job), one):
                    of.append(stats)

    def cpu(of, part="cpu_s"):
        return statistics.median(s[part] for s in of)

    balance = sorted(s["balance"]["efficiency"] for s in render + job)
    blocked = max(s["balance"]["blocked_fraction"] for s in render + job)
    rounds = max(s["token"]["rounds"] for s in render + job)
    return [turns.scene.stem, str(nodes), f"{cpu(serial):.3f}", f"{cpu(render) / cpu(serial):.2f}",
            f"{cpu(render, 'start_cpu_s') / cpu(serial):.2f}", f"{cpu(job) / cpu(serial):.2f}",
            f"{statistics.median(balance):.2f} ({balance[0]:.2f} to {balance[-1]:.2f})", f"{blocked:.3f}", str(rounds)]


def numbers(text: str) -> list:
    return [int(n) for n in text.split(",")]


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("scenes", nargs="+", type=Path, help="scene files")
    parser.add_argument("-n", "--nodes", default="16,64", type=numbers,
                        help="numbers of nodes (default 16,64)")
    parser.add_argument("--size", default="1024x1024")
    parser.add_argument("--renders", type=int, default=5, help="turns (default 5)")
    parser.add_argument("--graycube", type=Path, default=GRAYCUBE, help="the command (default: that of build/bench)")
    arguments = parser.parse_args()
    rows = [["SCENE", "NODES", "SERIAL s", "RENDER", "OF IT START", "FARM IS UP", "EFFICIENCY", "BLOCKED", "ROUNDS"]]
    try:
        for scene in arguments.scenes:
            for nodes in arguments.nodes:
                with tempfile.TemporaryDirectory(prefix="gc-") as folder:
                    turns = Turns(arguments.graycube.resolve(), scene.resolve(), arguments.size, Path(folder))
                    rows.append(measured(turns, nodes, arguments.renders, Path(folder)))
    except Failure as e:
        print(f"farm_cost.py: {e}", file=sys.stderr)
        return 1
    widths = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))]
    for row in rows:
        print("  ".join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip())
    print("RENDER, START and FARM IS UP: CPU over serial's.")
    return 0


if __name__ == "__main__":
    sys.exit(main())
