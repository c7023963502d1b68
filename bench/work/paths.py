"""Paths within 1 % of the best known joint length: OMPL, in C++ and in Python, beside ``optimal``."""

from __future__ import annotations

import math
import statistics
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

import elbowroom as er
from bench.bounds import BEST_KNOWN
from bench.clock import TooLong
from bench.entries import MS_CLASS, Goal, Section, Table
from bench.objectives import Case, cases
from bench.ompl_peers import LIMIT, PYTHON_LIMIT, PYTHON_SEEDS, SEEDS, Peer, peers, problem
from bench.work.plan import profile

Floats = NDArray[np.float64]

WITHIN = 1.01


def best_cases() -> Iterator[tuple[Case, str, float]]:
    """Yield the cases whose best joint length is known, the task, and that length (rad)."""
    for case in cases():
        for task in case.scene.tasks:
            best = BEST_KNOWN.get((case.name, task, case.kind))
            if best is not None:
                yield case, task, best


@dataclass
class Runs:
    """What became of the seeds of one planner in one case."""

    tried: int = 0
    ms: list[float] = field(default_factory=list)
    """Times of the runs that are safe and within 1 %."""
    lengths: list[float] = field(default_factory=list)
    """Lengths of the safe paths, as shares of the best known."""
    unsafe: int = 0
    stopped: int = 0

    def add(self, scene: er.Scene, seconds: float, path: Floats, best: float) -> None:
        """Take in the corners of a path; our verifier judges the straight turns between them."""
        self.tried += 1
        if len(path) == 0:
            return
        if not er.check(scene, t=np.arange(len(path), dtype=np.float64), q=path).safe:
            self.unsafe += 1
            return
        self.lengths.append(float(np.linalg.norm(np.diff(path, axis=0), axis=1).sum()) / best)
        if self.lengths[-1] <= WITHIN:
            self.ms.append(seconds * 1e3)

    def cell(self) -> str:
        """Return it in words for a table."""
        if not self.tried:
            return "-"
        said = f"{len(self.ms)}/{self.tried}"
        said += f", {statistics.median(self.ms):.0f} ms" if self.ms else ""
        if len(self.ms) < self.tried and self.lengths:
            said += f", {(statistics.median(self.lengths) - 1) * 100:+.0f} %"
        said += f", {self.unsafe} unsafe" if self.unsafe else ""
        return said + (f", {self.stopped} stopped" if self.stopped else "")


def theirs(peer: Peer, case: Case, task: str, best: float) -> Runs:
    """Return what became of a peer's seeds."""
    given, found = problem(case.scene, task), Runs()
    for seed in range(1, peer.seeds + 1):
        try:
            seconds, path = peer.path(given, seed, WITHIN * best)
        except (TooLong, RuntimeError):
            found.tried, found.stopped = found.tried + 1, found.stopped + 1
            continue
        found.add(case.scene, seconds, path, best)
    return found


def ours(case: Case, task: str, best: float) -> tuple[Runs, er.Plan]:
    """Return what became of ``optimal``: whole plans, the verified motion's joint travel as the length."""
    found = Runs()
    for seed in range(SEEDS):
        begun = time.perf_counter()
        plan = er.plan(case.scene, task=task, planner="optimal", objective="joint", seed=seed)
        seconds = time.perf_counter() - begun
        s = plan.sample()
        found.tried += 1
        if not er.check(case.scene, t=s.t, q=s.q, v=s.v, a=s.a).safe:
            found.unsafe += 1
            continue
        found.lengths.append(plan.cost / best)
        if plan.cost <= WITHIN * best:
            found.ms.append(seconds * 1e3)
    return found, plan


def measure(say: Callable[[str], None] = lambda _: None) -> Section:
    """Return the section."""
    there, missing = peers()
    titles: list[tuple[str, str]] = []
    rows: dict[str, list[str]] = {}
    points: list[dict[str, object]] = []
    own: list[Runs] = []
    stages: list[tuple[str, ...]] = []
    for case, task, best in best_cases():
        name = f"{case.name}, {case.kind}, {task}"
        titles.append((case.name, f"{task}, joint 1 {case.kind}: {best:.4f} rad"))
        judged, plan = ours(case, task, best)
        own.append(judged)
        stages.append((f"{case.name}, joint 1 {case.kind}, {task}", *profile(plan)))
        runs = {"elbowroom optimal": own[-1]} | {peer.who: theirs(peer, case, task, best) for peer in there}
        say(f"{name}: elbowroom {own[-1].cell()}")
        for who, found in runs.items():
            rows.setdefault(who, []).append(found.cell())
            ms = statistics.median(found.ms) if found.ms else None
            points.append({"who": who, "case": name, "ms": ms, "share": len(found.ms) / found.tried})
    every = all(len(runs.ms) == runs.tried for runs in own)
    slowest = max(statistics.median(runs.ms) if runs.ms else math.inf for runs in own)
    goal = Goal(
        "within 1 % of the best known joint length on scenes/",
        "every run, <= 20 ms-class",
        f"{sum(len(r.ms) for r in own)} of {sum(r.tried for r in own)} runs, {slowest:.0f} ms on the slowest scene",
        every and slowest <= 20.0 * MS_CLASS,
    )
    words = f"""
Cells say in how many runs a safe path came within 1 % of the best known length, in what time (median of those),
else how much longer the safe paths were (median) and how many paths were not safe by our verifier. Ours is a whole
plan, from scene to verified trajectory, and the length that of its motion. OMPL's times leave out setting up; its
planners get both postures at both ends, three revolutions of a continuous joint with a copy of each goal, and stop as
soon as their path is short enough. RRTConnect is begun again until then, every path simplified. Nobody knows the
best length beforehand; that OMPL is told when to stop is in its favour. Time limit {LIMIT:g} s in C++ ({SEEDS}
seeds), {PYTHON_LIMIT:g} s in Python ({PYTHON_SEEDS} seeds), where the checker is plain Python; a run that fails or
goes far over its limit is counted as stopped. The C++ checker is exact and allocates nothing; with `whole motions`
it also proves the motion between states, by bisection with the clearance.
{" ".join(f"**{what}.**" for what in missing)}
"""
    tables = [
        Table(
            f"{scene}.yaml: runs within 1 %",
            ["planner", *(title for name, title in titles if name == scene)],
            [
                [who, *(cell for (name, _), cell in zip(titles, cells, strict=True) if name == scene)]
                for who, cells in rows.items()
            ],
        )
        for scene in dict.fromkeys(name for name, _ in titles)
    ]
    tables.append(Table("Where the time of `optimal` goes", ["case", "ms", "stages"], stages))
    return Section("paths", "Paths within 1 % of the best known", words.strip(), (), tables, [goal], {"paths": points})
