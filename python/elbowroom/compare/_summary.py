"""What the rows say: by scene and task, over all tasks, and planner against planner."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import combinations
from pathlib import Path

import numpy as np

from elbowroom.compare._row import Row
from elbowroom.compare._statistics import (
    Interval,
    a12,
    cliffs_delta,
    holm,
    mann_whitney,
    median_interval,
    signed_rank,
    wilson_interval,
)

SEED = 0
"""Of the bootstrap: the same rows give the same report."""

DIGITS = 9
"""Costs are compared to so many digits: what differs beyond is rounding, not planning."""

COMPARED = ("cost", "time_s")
"""What planner is tested against planner for."""


@dataclass(frozen=True)
class Metric:
    """A column that tables and pictures show: ``scale`` takes it to ``unit``."""

    column: str
    title: str
    unit: str
    scale: float = 1.0

    def of(self, rows: Sequence[Row]) -> list[float]:
        """Return its values in ``rows``, those without one left out."""
        found = (getattr(row, self.column) for row in rows)
        return [float(value) * self.scale for value in found if value is not None]


METRICS = (
    Metric("tip_length_m", "tip travel", "cm", 100.0),
    Metric("joint_travel_rad", "joint travel", "rad"),
    Metric("duration_s", "duration", "s"),
    Metric("least_clearance_m", "clearance", "mm", 1000.0),
    Metric("evaluations", "evaluations", ""),
    Metric("gap", "gap", "%", 100.0),
    Metric("time_s", "time", "ms", 1000.0),
)


@dataclass(frozen=True)
class Cell:
    """A planner on a task: its runs, and their medians over those with success.

    Attributes:
        planner: Its label.
        rows: The runs that it could be asked for; none where it does not serve the arm or task.
        refused: The runs that do not apply to it.
        success: Share of ``rows``; None if there are none.
        medians: By column.
    """

    planner: str
    rows: Sequence[Row]
    refused: Sequence[Row]
    success: Interval | None
    medians: dict[str, Interval | None]

    @property
    def good(self) -> list[Row]:
        """The runs with success."""
        return [row for row in self.rows if row.success]

    @property
    def unsafe(self) -> int:
        """How many motions that it handed out the verifier does not call safe."""
        return sum(row.safe is False for row in self.rows)

    @property
    def failures(self) -> Counter[str]:
        """How often it failed in which way."""
        return Counter(row.failure for row in (*self.rows, *self.refused) if row.failure is not None)


@dataclass(frozen=True)
class TaskSummary:
    """All planners on a task."""

    scene: str
    task: str
    cells: Sequence[Cell]
    pairs: Sequence[Pair]

    def best(self, column: str) -> float | None:
        """Return the least median of ``column`` among the planners."""
        found = [interval.value for cell in self.cells if (interval := cell.medians[column]) is not None]
        return min(found, default=None)


@dataclass(frozen=True)
class Pair:
    """One planner against another.

    Attributes:
        metric: ``cost`` or ``time_s``; runs without success rank behind all others.
        scene: None over all tasks.
        task: Likewise.
        test: Mann-Whitney over the seeds of a task, or signed-rank over the medians of the tasks.
        less: How many pairs of values have the first planner's smaller.
        equal: In how many they are equal.
        greater: In how many it is greater.
        p: Of the test.
        p_holm: Adjusted for all pairs of the task, or of the whole.
        delta: Cliff's delta: the share of ``greater`` minus that of ``less``.
    """

    metric: str
    scene: str | None
    task: str | None
    first: str
    second: str
    test: str
    less: int
    equal: int
    greater: int
    p: float
    p_holm: float
    delta: float

    @property
    def a12(self) -> float:
        """Vargha and Delaney's A: the chance that the first planner's value is greater, equal ones counting half."""
        return a12(self.delta)


@dataclass(frozen=True)
class Overall:
    """A planner over all tasks.

    Attributes:
        tasks: How many tasks it serves.
        success: Share of its runs on those; None if it serves none.
        unsafe: Motions that the verifier does not call safe.
        ratio: Median over the tasks of its cost over the best planner's on the same task; None if it solved none.
        ratios: The same task by task, where it solved one.
        best_on: On how many tasks no other planner has a smaller median cost.
        time: Median over the tasks of the median time (ms).
    """

    planner: str
    tasks: int
    success: Interval | None
    unsafe: int
    ratio: Interval | None
    ratios: Sequence[float]
    best_on: int
    time: Interval | None


@dataclass(frozen=True)
class Summary:
    """All that the report shows."""

    tasks: Sequence[TaskSummary]
    overall: Sequence[Overall]
    pairs: Sequence[Pair]


def summarised(rows: Sequence[Row], planners: Sequence[str]) -> Summary:
    """Return the summary of ``rows``, in the order of ``planners``."""
    names = _scene_names(rows)
    groups: dict[tuple[str, str], list[Row]] = {}
    for row in rows:
        groups.setdefault((names[row.scene_sha256], row.task), []).append(row)
    tasks = [_of_task(scene, task, planners, group) for (scene, task), group in groups.items()]
    overall = [_overall(planner, tasks) for planner in planners]
    return Summary(tasks, overall, _over_tasks(planners, tasks) if len(tasks) > 1 else [])


def _scene_names(rows: Sequence[Row]) -> dict[str, str]:
    """A short name for each scene: its file's name, or the whole path where two are called the same."""
    paths = {row.scene_sha256: row.scene for row in rows}
    stems = Counter(Path(path).stem for path in paths.values())
    return {digest: Path(path).stem if stems[Path(path).stem] == 1 else path for digest, path in paths.items()}


def _of_task(scene: str, task: str, planners: Sequence[str], rows: Sequence[Row]) -> TaskSummary:
    cells = []
    for planner in planners:
        asked = [row for row in rows if row.planner == planner]
        if not asked:
            continue
        own = [row for row in asked if row.applicable]
        refused = [row for row in asked if not row.applicable]
        good = [row for row in own if row.success]
        medians = {
            metric.column: median_interval(values, seed=SEED) if (values := metric.of(good)) else None
            for metric in METRICS
        }
        cells.append(Cell(planner, own, refused, wilson_interval(len(good), len(own)) if own else None, medians))
    pairs: list[Pair] = []
    for metric in COMPARED:
        samples = {cell.planner: _ranked(cell.rows, metric) for cell in cells if cell.rows}
        matches = [(first, second, samples[first], samples[second]) for first, second in combinations(samples, 2)]
        pairs += _pairs(metric, scene, task, matches, "Mann-Whitney", mann_whitney, cliffs_delta)
    return TaskSummary(scene, task, cells, pairs)


def _ranked(rows: Sequence[Row], metric: str) -> list[float]:
    """The values to rank: a run without success is worse than any other."""
    return [float(f"{getattr(row, metric):.{DIGITS}g}") if row.success else math.inf for row in rows]


def _over_tasks(planners: Sequence[str], tasks: Sequence[TaskSummary]) -> list[Pair]:
    pairs: list[Pair] = []
    for metric in COMPARED:
        medians = {planner: _medians(planner, tasks, metric) for planner in planners}
        matches: list[Match] = []
        for first, second in combinations(planners, 2):
            a, b = medians[first], medians[second]
            if shared := [place for place in a if place in b]:
                matches.append((first, second, [a[place] for place in shared], [b[place] for place in shared]))
        pairs += _pairs(metric, None, None, matches, "signed-rank", signed_rank, _paired_delta)
    return pairs


def _medians(planner: str, tasks: Sequence[TaskSummary], metric: str) -> dict[int, float]:
    """Of each task that ``planner`` serves, by its place among ``tasks``."""
    found = {}
    for place, task in enumerate(tasks):
        for cell in task.cells:
            if cell.planner == planner and cell.rows:
                median = float(np.median(_ranked(cell.rows, metric)))
                # Differences of logarithms: a metre more on a long task is less than on a short one.
                found[place] = math.log(median) if median > 0 else -math.inf
    return found


def _paired_delta(first: Sequence[float], second: Sequence[float]) -> float:
    return float(np.mean([np.sign(_difference(a, b)) for a, b in zip(first, second, strict=True)]))


def _difference(a: float, b: float) -> float:
    return 0.0 if a == b else a - b


Match = tuple[str, str, Sequence[float], Sequence[float]]
"""Two planners and the values that are compared."""


def _pairs(
    metric: str,
    scene: str | None,
    task: str | None,
    matches: Sequence[Match],
    test: str,
    p_value: Callable[[Sequence[float], Sequence[float]], float],
    effect: Callable[[Sequence[float], Sequence[float]], float],
) -> list[Pair]:
    found = []
    for first, second, a, b in matches:
        couples = list(zip(a, b, strict=True)) if scene is None else [(x, y) for x in a for y in b]
        less, greater = sum(x < y for x, y in couples), sum(x > y for x, y in couples)
        counts = (less, len(couples) - less - greater, greater)
        found.append((first, second, counts, p_value(a, b), effect(a, b)))
    adjusted = holm([p for _, _, _, p, _ in found])
    return [
        Pair(metric, scene, task, first, second, test, *counts, p, p_holm, delta)
        for (first, second, counts, p, delta), p_holm in zip(found, adjusted, strict=True)
    ]


def _overall(planner: str, tasks: Sequence[TaskSummary]) -> Overall:
    cells = [(task, cell) for task in tasks for cell in task.cells if cell.planner == planner and cell.rows]
    runs = sum(len(cell.rows) for _, cell in cells)
    ratios, best_on = [], 0
    for task, cell in cells:
        own = _median_cost(cell)
        best = min((cost for other in task.cells if (cost := _median_cost(other)) is not None), default=None)
        if own is None or best is None:
            continue
        ratios.append(own / best if best > 0.0 else 1.0)
        best_on += own <= best
    times = [interval.value for _, cell in cells if (interval := cell.medians["time_s"]) is not None]
    return Overall(
        planner,
        len(cells),
        wilson_interval(sum(len(cell.good) for _, cell in cells), runs) if runs else None,
        sum(cell.unsafe for _, cell in cells),
        median_interval(ratios, seed=SEED) if ratios else None,
        ratios,
        best_on,
        median_interval(times, seed=SEED) if times else None,
    )


def _median_cost(cell: Cell) -> float | None:
    costs = [float(f"{row.cost:.{DIGITS}g}") for row in cell.good if row.cost is not None]
    return float(np.median(costs)) if costs else None
