"""Turns measurements into text: aligned tables, medians over seeds, geometric means, growth."""

import math
import statistics
from typing import Callable, Iterable, Optional

from measure import Measurement

MEGABYTE = 1e6


def ratio(a: Optional[float], b: Optional[float]) -> Optional[float]:
    return a / b if a is not None and b else None


def pov_ratio(m: Measurement) -> Optional[float]:
    """POV-Ray's whole-process CPU over Graycube's."""
    return ratio(m.pov_cpu_s, m.graycube_cpu_s)


def plain_ratio(m: Measurement) -> Optional[float]:
    """The plain tracer's trace time over Graycube's."""
    return ratio(m.plain_trace_s, m.graycube_trace_s)


def rays_per_s(m: Measurement) -> Optional[float]:
    return ratio(m.rays, m.graycube_trace_s)


def percent_off(agreement) -> Optional[float]:
    return agreement.percent_off if agreement else None


# Heading, digits after the point, value.
COLUMNS: list = [
    ("POV s", 2, lambda m: m.pov_cpu_s),
    ("Graycube s", 3, lambda m: m.graycube_cpu_s),
    ("trace s", 3, lambda m: m.graycube_trace_s),
    ("plain trace s", 3, lambda m: m.plain_trace_s),
    ("Mrays/s", 2, lambda m: ratio(rays_per_s(m), 1e6)),
    ("POV/Graycube", 2, pov_ratio),
    ("plain/trace", 2, plain_ratio),
    ("POV MB", 0, lambda m: ratio(m.pov_peak_bytes, MEGABYTE)),
    ("Graycube MB", 0, lambda m: ratio(m.graycube_peak_bytes, MEGABYTE)),
    ("bytes/prim", 0, lambda m: m.bytes_per_primitive),
    ("off POV %", 4, lambda m: percent_off(m.pov_off)),
    ("off plain %", 4, lambda m: percent_off(m.plain_off)),
]
GROWTH_COLUMNS: list = [
    ("load s", 3, lambda m: m.graycube_load_s),
    ("build s", 3, lambda m: m.graycube_build_s),
    ("trace s", 3, lambda m: m.graycube_trace_s),
    ("whole s", 3, lambda m: m.graycube_cpu_s),
    ("Mrays/s", 2, lambda m: ratio(rays_per_s(m), 1e6)),
    ("bytes/prim", 0, lambda m: m.bytes_per_primitive),
    ("peak MB", 0, lambda m: ratio(m.graycube_peak_bytes, MEGABYTE)),
]


def cell(value: Optional[float], digits: int) -> str:
    return "-" if value is None else f"{value:.{digits}f}"


def aligned(rows: list) -> str:
    """The first column to the left, the others to the right."""
    widths = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))]
    return "\n".join("  ".join(text.ljust(w) if i == 0 else text.rjust(w)
                               for i, (text, w) in enumerate(zip(row, widths))).rstrip()
                     for row in rows)


def median(values: Iterable) -> Optional[float]:
    known = [v for v in values if v is not None]
    return statistics.median(known) if known else None


def grouped(measurements: list) -> list:
    """Lists of one family and size each, in order of appearance."""
    groups: dict = {}
    for m in measurements:
        groups.setdefault((m.name, m.side), []).append(m)
    return list(groups.values())


def medians(group: list, columns: list) -> list:
    return [cell(median(value(m) for m in group), digits) for _, digits, value in columns]


def table(measurements: list) -> str:
    rows = [["scene", "pixels", "seed"] + [heading for heading, _, _ in COLUMNS]]
    for group in grouped(measurements):
        for m in group:
            rows.append([m.name, f"{m.side}²", str(m.seed)] +
                        [cell(value(m), digits) for _, digits, value in COLUMNS])
        if len(group) > 1:
            rows.append([group[0].name, f"{group[0].side}²", "median"] + medians(group, COLUMNS))
    return aligned(rows)


def growth_table(measurements: list) -> str:
    rows = [["scene"] + [heading for heading, _, _ in GROWTH_COLUMNS]]
    rows += [[group[0].name] + medians(group, GROWTH_COLUMNS) for group in grouped(measurements)]
    return aligned(rows)


def exponent(points: list) -> Optional[float]:
    """The slope of log(cost) over log(size) by least squares; points are (size, cost)."""
    logs = [(math.log(s), math.log(c)) for s, c in points if c]
    if len({x for x, _ in logs}) < 2:
        return None
    mean_x = statistics.fmean(x for x, _ in logs)
    mean_y = statistics.fmean(y for _, y in logs)
    return (sum((x - mean_x) * (y - mean_y) for x, y in logs) /
            sum((x - mean_x) ** 2 for x, _ in logs))


def growth_of(measurements: list, family: str, cost: Callable) -> Optional[float]:
    groups = grouped([m for m in measurements if m.family == family])
    return exponent([(g[0].size, median(cost(m) for m in g)) for g in groups])


def growth_lines(measurements: list) -> list:
    lines = []
    for family in dict.fromkeys(m.family for m in measurements):
        sizes = [m.size for m in measurements if m.family == family]
        trace = growth_of(measurements, family, lambda m: m.graycube_trace_s)
        whole = growth_of(measurements, family, lambda m: m.graycube_cpu_s)
        if trace is None or whole is None:
            continue
        goal = " (goal: at most 0.40)" if family == "deepcsg" else ""
        lines.append(f"{family} {min(sizes)} to {max(sizes)}: trace time grows as "
                     f"size^{trace:.2f}{goal}, the whole process as size^{whole:.2f}")
    return lines


# What is asked of which scenes: name, families with sizes (None: any), value, goal of the geometric
# mean, goal of each.
GOALS: list = [
    ("POV-Ray / Graycube, csg and flake",
     {("csg", 1000), ("csg", 10000), ("csg", 100000), ("flake", 5)}, pov_ratio, 5.0, 4.0),
    ("POV-Ray / Graycube, deepcsg and menger",
     {("deepcsg", 2000), ("menger", 3)}, pov_ratio, 100.0, 100.0),
    ("POV-Ray / Graycube, glasslens", {("glasslens", 9)}, pov_ratio, 2.5, 2.5),
    ("plain tracer / Graycube, trace", None, plain_ratio, 1.6, 0.0),
]


def goal_lines(measurements: list) -> list:
    """One line a goal: geometric mean and least of the medians over seeds."""
    lines = []
    for name, scenes, value, mean_goal, each_goal in GOALS:
        known = {}
        for group in grouped(measurements):
            found = median(value(m) for m in group)
            if found is not None and (scenes is None or (group[0].family, group[0].size) in scenes):
                known[group[0].name] = found
        if not known:
            continue
        least = min(known, key=known.get)
        mean = statistics.geometric_mean(known.values())
        line = (f"{name}: geometric mean {mean:.2f} of {len(known)} scenes (goal {mean_goal:g}), "
                f"least {known[least]:.2f} at {least}")
        lines.append(line + (f" (goal {each_goal:g})" if each_goal else ""))
    return lines


def embree_lines(rates: dict) -> list:
    return [f"{kind} rays alone, {rates['spheres']} spheres: Graycube "
            f"{r['graycube_per_s'] / 1e6:.2f}, Embree {r['embree_per_s'] / 1e6:.2f} million rays/s, "
            f"ratio {r['ratio']:.2f} (goal 0.5)"
            for kind in ("primary", "shadow") if (r := rates.get(kind))]
