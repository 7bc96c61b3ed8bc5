"""Runs programs and measures them: CPU time, memory, agreement of the pictures."""

import dataclasses
import json
import os
import re
import subprocess
import tempfile
import threading
from pathlib import Path
from typing import Optional

# A pixel is off when a channel differs by more, in 1/65535; so many percent may be off.
TOLERANCE = 4
MOST_PERCENT_OFF = 0.2


class Failure(Exception):
    """A program could not be run, or failed."""


@dataclasses.dataclass
class Finished:
    """A process that ended well. CPU seconds are user + system, threads and children included."""

    cpu_s: float
    peak_rss_bytes: int
    output: str


def run(command: list, timeout_s: float, folder: Path, accepted=(0,)) -> Optional[Finished]:
    """Runs a command; None when it was killed for taking longer than timeout_s of wall time."""
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
        try:
            process = subprocess.Popen([str(c) for c in command], stdout=out, stderr=err,
                                       stdin=subprocess.DEVNULL, cwd=folder)
        except OSError as e:
            raise Failure(f"cannot run {command[0]}: {e.strerror}") from e
        late = threading.Event()

        def give_up():
            late.set()
            process.kill()

        timer = threading.Timer(timeout_s, give_up)
        timer.start()
        try:
            _, status, usage = os.wait4(process.pid, 0)
        except BaseException:
            process.kill()
            raise
        finally:
            timer.cancel()
        process.returncode = os.waitstatus_to_exitcode(status)
        if late.is_set() and process.returncode < 0:
            return None
        out.seek(0)
        err.seek(0)
        if process.returncode not in accepted:
            reason = err.read().decode(errors="replace").strip().splitlines()
            raise Failure(f"{' '.join(str(c) for c in command)}: status {process.returncode}: "
                          f"{reason[-1] if reason else 'no message'}")
        return Finished(usage.ru_utime + usage.ru_stime, usage.ru_maxrss * 1024,
                        out.read().decode(errors="replace"))


@dataclasses.dataclass
class Agreement:
    """How far two pictures differ."""

    percent_off: float
    largest: int

    @property
    def holds(self) -> bool:
        return self.percent_off <= MOST_PERCENT_OFF


@dataclasses.dataclass
class Measurement:
    """One scene. What is None was not run, or took too long."""

    family: str
    size: int
    seed: int
    side: int
    primitives: int = 0
    pov_cpu_s: Optional[float] = None
    pov_peak_bytes: Optional[int] = None
    graycube_cpu_s: Optional[float] = None
    graycube_load_s: Optional[float] = None
    graycube_build_s: Optional[float] = None
    graycube_trace_s: Optional[float] = None
    graycube_peak_bytes: Optional[int] = None
    bytes_per_primitive: Optional[float] = None
    rays: int = 0
    plain_trace_s: Optional[float] = None
    plain_cpu_s: Optional[float] = None
    pov_off: Optional[Agreement] = None
    plain_off: Optional[Agreement] = None
    timeouts: list = dataclasses.field(default_factory=list)

    @property
    def name(self) -> str:
        return f"{self.family} {self.size}"


class Bench:
    """The programs under test, and a folder for their files."""

    def __init__(self, bin_folder: Path, folder: Path, timeout_s: float):
        self.bin = bin_folder
        self.folder = folder
        self.timeout_s = timeout_s

    def generate(self, m: Measurement, for_pov: bool) -> None:
        outs = ["scene.json"] + (["scene.pov"] if for_pov else [])
        self._run([self.bin / "scene_family", m.family, m.size, m.seed, *outs], "scene_family", m)

    def graycube(self, m: Measurement) -> None:
        done = self._run([self.bin / "graycube", "render", "scene.json", "-o", "graycube.exr",
                          "--algorithm", "serial", "--threads", "1", "--size", f"{m.side}x{m.side}",
                          "--stats", "stats.json", "--quiet"], "graycube", m)
        held = self._run([self.bin / "trace_time", "scene.json", "--build-only"], "trace_time", m)
        if done is None or held is None:
            return
        stats = json.loads((self.folder / "stats.json").read_text())
        m.primitives = stats["primitives"]
        m.graycube_cpu_s = done.cpu_s
        m.graycube_peak_bytes = done.peak_rss_bytes
        m.graycube_load_s = stats["phases"]["load_s"]
        m.graycube_build_s = stats["phases"]["build_s"]
        m.graycube_trace_s = stats["per_node"][0]["busy_s"]
        m.rays = sum(stats["rays"].values())
        m.bytes_per_primitive = json.loads(held.output)["bytes_per_primitive"]

    def pov(self, m: Measurement) -> None:
        done = self._run(["povray", "+Iscene.pov", "+Opov.png", "+FN16", "File_Gamma=1.0",
                          f"+W{m.side}", f"+H{m.side}", "-A", "-D", "-P", "-GA", "+WT1"],
                         "povray", m)
        if done is None:
            return
        m.pov_cpu_s = done.cpu_s
        m.pov_peak_bytes = done.peak_rss_bytes
        m.pov_off = self._compare("pov.png")

    def plain(self, m: Measurement) -> None:
        done = self._run([self.bin / "plain_tracer", "scene.json", "--size", m.side,
                          "--exr", "plain.exr"], "plain_tracer", m)
        if done is None:
            return
        m.plain_cpu_s = done.cpu_s
        m.plain_trace_s = json.loads(done.output)["trace_cpu_s"]
        m.plain_off = self._compare("plain.exr")

    def trace_time(self, m: Measurement) -> None:
        """Graycube alone, by parts, without a picture."""
        done = self._run([self.bin / "trace_time", "scene.json", "--size", m.side], "trace_time", m)
        if done is None:
            return
        parts = json.loads(done.output)
        m.primitives = parts["primitives"]
        m.graycube_cpu_s = done.cpu_s
        m.graycube_load_s = parts["load_s"]
        m.graycube_build_s = parts["build_s"]
        m.graycube_trace_s = parts["trace_cpu_s"]
        m.graycube_peak_bytes = done.peak_rss_bytes
        m.bytes_per_primitive = parts["bytes_per_primitive"]
        m.rays = sum(parts["rays"].values())

    def rays_vs_embree(self, options: list) -> dict:
        done = run([self.bin / "rays_vs_embree", *options], self.timeout_s, self.folder)
        return json.loads(done.output) if done else {}

    def _compare(self, other: str) -> Agreement:
        done = run([self.bin / "compare_pictures", other, "graycube.exr", "--tolerance", TOLERANCE],
                   self.timeout_s, self.folder, accepted=(0, 1))
        found = re.search(r"pixels off \(([\d.]+) %\), largest difference (\d+)",
                          done.output if done else "")
        if not found:
            raise Failure(f"compare_pictures said: {done.output.strip() if done else 'nothing'}")
        return Agreement(float(found[1]), int(found[2]))

    def _run(self, command: list, program: str, m: Measurement) -> Optional[Finished]:
        done = run(command, self.timeout_s, self.folder)
        if done is None:
            m.timeouts.append(program)
        return done
