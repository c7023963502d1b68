"""D* repaired after an obstacle moved by a cell, against fields from scratch; roboticstoolbox's D* repairs too."""

from __future__ import annotations

import json
import statistics
import sys
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

import elbowroom as er
from bench.clock import OUT, ROOT, TooLong, core, run
from bench.entries import Comparison, Entry, Goal, Section, attempt
from bench.work.field import by_scipy, by_skimage, cell_of, union
from bench.work.free_space import with_points

SCENE = "narrow"
LIMIT = 60.0


def moved(scene: er.Scene, obstacle: int) -> er.Scene:
    """Return the scene with one obstacle a grid step to the right."""
    shapes = list(scene.obstacles)
    shapes[obstacle] = shapes[obstacle].shifted((scene.grid.step, 0.0))
    return scene.replace(obstacles=tuple(shapes))


def by_toolbox(points: int, after_costs: dict[int, float]) -> Entry:
    """Roboticstoolbox's D*, told of the same changes."""
    import roboticstoolbox  # noqa: F401 (is it there?)

    who = "roboticstoolbox D*, repaired as far as the start"
    scene = with_points(er.Scene.load(ROOT / "scenes" / f"{SCENE}.yaml"), points)
    after = [er.free_space(moved(scene, obstacle)).union for obstacle in after_costs]
    given = OUT / "repair.npz"
    start, goal = (cell_of(SCENE, points, end) for end in ("start", "goal"))
    np.savez(given, before=er.free_space(scene).union, after=np.array(after), start=start, goal=goal)
    try:
        found = json.loads(run([sys.executable, "-m", "bench.toolbox", "repair", str(given)], limit=LIMIT))
    except TooLong:
        return Entry(who, None, f"not done within {LIMIT:g} s")
    right = sum(abs(cost - known) < 1e-6 for (_, cost), known in zip(found, after_costs.values(), strict=True))
    return Entry(who, statistics.median(ms for ms, _ in found), f"{right} of {len(found)} equal at the start")


def spread(obstacles: list[dict[str, Any]], key: str) -> tuple[float, str]:
    """Return the median over obstacles of the median times (ms), and the range in words."""
    times = [statistics.median(obstacle[key]) for obstacle in obstacles]
    return statistics.median(times), f"{min(times):.3g} to {max(times):.3g} ms"


def measure() -> Section:
    """Return the section."""
    comparisons, gains = [], []
    for points in (101, 1001):
        runs = 3 if points > 101 else 9
        obstacles = core("repair", ROOT / "scenes" / f"{SCENE}.yaml", points, runs)["obstacles"]
        equal = sum(obstacle["equal"] for obstacle in obstacles)
        goal = cell_of(SCENE, points, "goal")
        _, free = union(SCENE, points)
        whole, settled, scratch = (spread(obstacles, key) for key in ("whole_ms", "settled_ms", "scratch_ms"))
        gains = [statistics.median(o["scratch_ms"]) / statistics.median(o["whole_ms"]) for o in obstacles]
        unchecked: NDArray[np.float64] = np.full(free.shape, np.inf)
        entries = [
            Entry("elbowroom D*, whole field repaired", whole[0], f"{equal} of {len(obstacles)} equal; {whole[1]}"),
            Entry("elbowroom D*, repaired as far as the start", settled[0], settled[1]),
            Entry("elbowroom D*, from scratch", scratch[0], scratch[1]),
        ]
        for by in (by_scipy, by_skimage):
            entry = attempt(by.__name__[3:], partial(by, free, goal, unchecked, runs))
            answer = entry.answer if entry.ms is None else "checked under Cost-to-go field"
            entries.append(Entry(f"{entry.who}, from scratch", entry.ms, answer))
        if points == 101:
            costs = {obstacle["obstacle"]: obstacle["cost"] for obstacle in obstacles}
            entries.append(attempt("roboticstoolbox D*", partial(by_toolbox, points, costs)))
        comparisons.append(Comparison(f"{points} x {points} points, {SCENE}.yaml", entries))
    goal_row = Goal(
        "D* repair after one obstacle moves by a cell, 1001 x 1001",
        ">= 10 x faster than from scratch",
        f"{statistics.median(gains):.0f} x in the median of {len(gains)} obstacles, {min(gains):.1f} x for the worst",
        statistics.median(gains) >= 10.0,
    )
    words = """
Each of the obstacles in turn moves by one grid step, which changes what the arm can reach at many points. The two
maps are given; what is timed is the cost-to-go over their union. Medians over the obstacles, the range beside them.
scipy and scikit-image cannot repair, so they start again.
"""
    return Section("repair", "D* repair against a new field", words.strip(), comparisons, goals=[goal_row])
