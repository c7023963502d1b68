"""The cost-to-go of every point of a grid: scipy, scikit-image, scikit-fmm and roboticstoolbox beside the core."""

from __future__ import annotations

import statistics
import sys
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import elbowroom as er
from bench.clock import OUT, ROOT, TooLong, core, median_ms, run
from bench.entries import Comparison, Entry, Goal, Section, attempt
from bench.work.free_space import core_map

Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]

SCENES = ("paper-table1", "narrow")
LIMIT = 60.0
"""How long roboticstoolbox may take for one field (s)."""

OFFSETS = ((0, 1), (1, 0), (1, 1), (1, -1))
"""Half of the eight neighbours: the graph has every edge in both directions."""


def union(scene: str, points: int) -> tuple[Path, Mask]:
    """Return a file with a byte a point, and where the tip may stand in some posture."""
    _, maps = core_map(ROOT / "scenes" / f"{scene}.yaml", points, 1, None)
    file = OUT / f"{scene}_{points}.mask"
    free = np.asarray(maps.any(axis=0))
    free.tofile(file)
    return file, free


def cell_of(scene: str, points: int, end: str) -> tuple[int, int]:
    """Return row and column of the start or goal of a scene's first task."""
    loaded = er.Scene.load(ROOT / "scenes" / f"{scene}.yaml")
    x, y = getattr(loaded.tasks["first"], end)
    low, high = loaded.grid.x
    column, row = (round((value - low) / (high - low) * (points - 1)) for value in (x, y))
    return row, column


def graph_of(free: Mask) -> Any:
    """Return the grid as scipy's sparse matrix: eight neighbours, corners cut, costs in steps."""
    from scipy.sparse import csr_matrix

    rows, columns = free.shape
    cells = np.arange(free.size, dtype=np.int32).reshape(free.shape)
    parts = []
    for down, right in OFFSETS:
        here = np.s_[: rows - down, max(0, -right) : columns - max(0, right)]
        there = np.s_[down:, max(0, right) : columns + min(0, right)]
        joined = free[here] & free[there]
        parts.append((cells[here][joined], cells[there][joined], np.hypot(down, right)))
    one = np.concatenate([a for a, _, _ in parts] + [b for _, b, _ in parts])
    other = np.concatenate([b for _, b, _ in parts] + [a for a, _, _ in parts])
    costs = np.concatenate([np.full(len(a), cost) for a, _, cost in parts] * 2)
    return csr_matrix((costs, (one, other)), shape=(free.size, free.size))


def compared(ours: Floats, theirs: Floats) -> str:
    """Return in words whether two fields are equal."""
    theirs = theirs.reshape(ours.shape)
    reached = np.isfinite(ours)
    if (reached != np.isfinite(theirs)).any():
        return f"**{int((reached != np.isfinite(theirs)).sum())} points reached by one only**"
    if (ours[reached] == theirs[reached]).all():
        return "equal to the last bit"
    difference = np.abs(ours[reached] - theirs[reached]) / np.maximum(ours[reached], 1.0)
    return (
        f"equal to {difference.max():.0e}"
        if difference.max() < 1e-9
        else f"**differs by up to {difference.max():.1e}**"
    )


def by_scipy(free: Mask, goal: tuple[int, int], ours: Floats, runs: int) -> Entry:
    """Dijkstra with a binary heap over a graph that is there already."""
    from scipy.sparse.csgraph import dijkstra

    build, graph = median_ms(lambda: graph_of(free), min(runs, 3))
    index = goal[0] * free.shape[1] + goal[1]
    ms, found = median_ms(lambda: dijkstra(graph, indices=index), runs)
    return Entry("scipy csgraph.dijkstra", ms, f"{compared(ours, found)}; building its graph, {build:.1f} ms, left out")


def by_skimage(free: Mask, goal: tuple[int, int], ours: Floats, runs: int) -> Entry:
    """The best ready-made interface."""
    from skimage.graph import MCP_Geometric

    costs = np.where(free, 1.0, -1.0)
    ms, found = median_ms(lambda: MCP_Geometric(costs, fully_connected=True).find_costs([goal])[0], runs)
    return Entry("scikit-image MCP_Geometric", ms, compared(ours, found))


def by_skfmm(free: Mask, goal: tuple[int, int], ours: Floats, runs: int) -> Entry:
    """Fast marching: another question, the Eikonal equation, asked of the same grid."""
    import skfmm

    around = np.ones(free.shape)
    around[goal] = -1.0
    level = np.ma.MaskedArray(around, ~free)
    ms, found = median_ms(lambda: skfmm.distance(level), runs)
    found = np.ma.filled(np.abs(found), np.inf)
    both = np.isfinite(found) & np.isfinite(ours) & (ours > 20.0)
    share = float(np.median(found[both] / ours[both]))
    return Entry("scikit-fmm distance", ms, f"Eikonal, not the grid's lengths: {share:.3f} of them in the median")


def by_toolbox(file: Path, points: int, goal: tuple[int, int], ours: Floats) -> Entry:
    """Roboticstoolbox's D*, in a process of its own that can be stopped."""
    import roboticstoolbox  # noqa: F401 (is it there?)

    who, out = "roboticstoolbox D*", OUT / "toolbox.f64"
    command = [sys.executable, "-m", "bench.toolbox", "field", str(file), str(points), *map(str, goal), str(out)]
    try:
        # The limit holds for planning; what goes before it takes a few seconds.
        ms = float(run(command, limit=LIMIT + 10.0))
    except TooLong:
        return Entry(who, None, f"not done within {LIMIT:g} s")
    return Entry(who, ms, f"{compared(ours, np.fromfile(out))}; one run")


def measure() -> Section:
    """Return the section."""
    comparisons = []
    for points in (101, 1001):
        for scene in SCENES:
            file, free = union(scene, points)
            goal = cell_of(scene, points, "goal")
            runs = 5 if points > 101 else 15
            out = OUT / f"{scene}_{points}.f64"
            times = core("field", file, points, goal[0] * points + goal[1], runs, out)["times_ms"]
            ours = np.fromfile(out).reshape(points, points)
            arguments = (free, goal, ours, runs)
            entries = [
                Entry("elbowroom D*, one core", statistics.median(times), f"{int(np.isfinite(ours).sum()):,} points"),
                attempt("scipy csgraph.dijkstra", partial(by_scipy, *arguments)),
                attempt("scikit-image MCP_Geometric", partial(by_skimage, *arguments)),
                attempt("scikit-fmm distance", partial(by_skfmm, *arguments)),
            ]
            # A minute for the smaller of the two large grids says enough.
            if points == 101 or scene == "paper-table1":
                toolbox = (file, points, goal, ours)
                entries.append(attempt("roboticstoolbox D*", partial(by_toolbox, *toolbox)))
            comparisons.append(Comparison(f"{points} x {points} points, {scene}.yaml", entries))
    large = [comparison for comparison in comparisons if comparison.title.startswith("1001")]
    ratios = [comparison.ratio(comparison.of("scipy")) for comparison in large]
    known = [ratio for ratio in ratios if ratio is not None]
    goal_row = Goal(
        "cost-to-go field, 1001 x 1001",
        ">= 5 x scipy's Dijkstra without its build",
        ", ".join(f"{ratio:.1f} x" for ratio in known) + f" ({' and '.join(SCENES)})" if known else "no scipy",
        min(known) >= 5.0 if known else None,
    )
    words = """
The cost-to-go from the goal of the first task to every point where the tip may stand in some posture: eight
neighbours, corners may be cut. Ours is D* from scratch, which planners run, and which can repair what it finds. All
get the same mask; making a graph or an array of costs of it is left out for all. Fields are compared point by point.
"""
    return Section("field", "Cost-to-go field", words.strip(), comparisons, goals=[goal_row])
