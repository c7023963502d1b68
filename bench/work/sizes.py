"""Time and memory against the size of the grid: map, field and whole plan."""

from __future__ import annotations

import math
import statistics
from collections.abc import Sequence

from bench.clock import OUT, ROOT, TooLong, core
from bench.entries import Section, Table
from bench.work.field import cell_of, union

SCENE = "paper-standin"
SIZES = (101, 201, 401, 1001, 2001, 4001)
LIMIT = 60.0
"""How long one process may take (s)."""


def commands(points: int, runs: int) -> dict[str, list[str]]:
    """Return what to run for one size; a process each, so that its memory is its own."""
    scene = str(ROOT / "scenes" / f"{SCENE}.yaml")
    mask, _ = union(SCENE, points)
    row, column = cell_of(SCENE, points, "goal")
    return {
        "map": ["map", scene, str(points), str(runs), "-"],
        "field": ["field", str(mask), str(points), str(row * points + column), str(runs), "-"],
        "plan": ["plan", scene, "first", str(points), "dstar-pso", "tip", str(runs)],
    }


def slope(points: Sequence[int], ms: Sequence[float]) -> float:
    """Return the slope of a line through the times over the number of grid points, both as logarithms."""
    x, y = ([math.log(value) for value in values] for values in ([p * p for p in points], ms))
    return statistics.linear_regression(x, y).slope


def measure() -> Section:
    """Return the section."""
    rows, plots = [], []
    times: dict[str, list[tuple[int, float]]] = {}
    for points in SIZES:
        cells = [f"{points} x {points}"]
        for what, command in commands(points, 5 if points <= 401 else 1).items():
            try:
                # One core: the times are comparable with those above, and the slope is that of the work.
                found = core(*command, threads=1, limit=LIMIT)
            except TooLong:
                cells += [f"over {LIMIT:g} s", "-"]
                continue
            ms = statistics.median(found["times_ms"])
            times.setdefault(what, []).append((points, ms))
            plots.append({"what": what, "points": points, "ms": ms, "mib": found["peak_mib"]})
            cells += [f"{ms:,.1f}" if ms < 100 else f"{ms:,.0f}", f"{found['peak_mib']:,.0f}"]
        rows.append(cells)
    slopes = {what: slope(*zip(*known, strict=True)) for what, known in times.items() if len(known) > 1}
    said = ", ".join(f"{what} {value:.2f}" for what, value in slopes.items())
    words = f"""
`{SCENE}.yaml` on ever finer grids, one core: both maps, the field of the first task over their union, and the whole
plan of `dstar-pso` for it. Every cell is a process of its own; the memory (MiB) is the most it ever held, input
included. Slopes of log time over log of the number of points: {said}. 1 means that every point costs the same.
"""
    header = ["points", *(f"{what} ({unit})" for what in ("map", "field", "plan") for unit in ("ms", "MiB"))]
    for file in OUT.glob(f"{SCENE}_*.mask"):
        file.unlink()
    return Section(
        "sizes", "Time against size", words.strip(), (), [Table("Sizes", header, rows)], (), {"sizes": plots}
    )
