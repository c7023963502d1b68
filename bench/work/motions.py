"""Least time for whole tasks: collocation with CasADi and IPOPT, ruckig and toppra beside ``er.plan``."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

import elbowroom as er
from bench import time_peers
from bench.clock import median_ms
from bench.entries import MS_CLASS, Comparison, Entry, Goal, Section, Table, attempt
from bench.motion_limits import RATES, limits_of, with_limits
from bench.motions import TASKS
from bench.waypoints import waypoints

if TYPE_CHECKING:
    from bench.collocation import Rows

Floats = NDArray[np.float64]

RUNS = 9
PERIOD = 0.001
"""Between samples that answers are judged by (s)."""

LOOKED_AT = ((3, 2e-4), (6, 5e-4), (12, 5e-4), (12, 1.5e-3))
"""Places of a piece that collocation looks at, and the margin kept there (m): the next ones where an answer touches."""

SLOWER = (1.0, 1.0001, 1.001, 1.002, 1.004, 1.007, 1.01)
"""By how much a collocation's answer may be stretched to keep limits that it grazes."""

BEYOND = 1e-3
"""By what share of a limit a sample has to be beyond it to be counted."""

OURS = "elbowroom.plan, dstar-pso"
FROM_PATH, FROM_OURS = "CasADi + IPOPT, from the waypoints", "CasADi + IPOPT, from ours"
RUCKIG, TOPPRA = "ruckig, a stop at every via", "toppra"
TOPPRA_DEFAULT = "toppra, its default parametrizer"
PEERS = (FROM_PATH, FROM_OURS, RUCKIG, TOPPRA, TOPPRA_DEFAULT)


@dataclass
class Case:
    """A task, our plan, and what everybody's motion takes (s) with whether it is proved to be safe."""

    scene: er.Scene
    task: str
    plan: er.Plan
    found: dict[str, tuple[float, bool]]

    def judged(self, who: str, ms: float, rows: tuple[Floats, Floats, Floats, Floats], more: str = "") -> Entry:
        """Return the entry of rows, judged by our verifier under all limits."""
        t, q, v, a = rows
        check = er.check(with_limits(self.scene), t=t, q=q, v=v, a=a, limit_tolerance=1e-6)
        self.found[who] = float(t[-1]), bool(check)
        kinds = sorted({violation.kind for violation in check.verdict.violations})
        said = "safe" if check else f"**not safe**: {', '.join(kinds)}"
        return Entry(who, ms, f"{t[-1]:.3f} s, {said}{more}")

    def best(self) -> tuple[float, str] | None:
        """Return the shortest duration of a peer whose motion is safe, and whose it is."""
        return min(((self.found[who][0], who) for who in PEERS if self.found.get(who, (0.0, False))[1]), default=None)


def path_start(path: Floats, limits: Floats) -> Rows:
    """Return a start for collocation: along a path from rest to rest, quintic, about as slow as the limits ask."""
    from bench.collocation import Rows

    along = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(path, axis=0), axis=1))])
    velocity, acceleration, jerk = limits.min(axis=1)
    length = along[-1]
    duration = max(1.875 * length / velocity, (5.77 * length / acceleration) ** 0.5, (60.0 * length / jerk) ** (1 / 3))
    u = np.linspace(0.0, 1.0, 201)
    at = length * u**3 * (10.0 - 15.0 * u + 6.0 * u**2)
    q = np.column_stack([np.interp(at, along, joint) for joint in path.T])
    v = np.gradient(q, duration * u, axis=0)
    a = np.gradient(v, duration * u, axis=0)
    return Rows(duration * u, q, v, a)


def by_collocation(case: Case, who: str, start: Rows) -> Entry:
    """The first answer that holds, with ever more places looked at; the time is of that solve alone."""
    from bench.collocation import Collocation

    told = ""
    for places, margin in LOOKED_AT:
        program = Collocation(case.scene, start, places, margin)
        try:
            ms, found = median_ms(program.solved, 1)
        except Exception as error:
            told = str(error)
            continue
        for times in SLOWER:
            rows = found.slower(times)
            entry = case.judged(who, ms, (rows.t, rows.q, rows.v, rows.a), f"; {places} places a piece; one run")
            if case.found[who][1]:
                return entry
            if "contact" in entry.answer:
                break
        told = entry.answer
    return Entry(who, None, f"no answer that holds: {told}")


def from_ours(case: Case) -> Rows:
    """Return our motion itself as the start."""
    from bench.collocation import Rows

    s = case.plan.sample(period=PERIOD)
    return Rows(s.t, s.q, s.v, s.a)


def by_ruckig(case: Case, vias: Floats) -> Entry:
    """Straight turns from stop to stop."""
    ms, pieces = median_ms(time_peers.by_ruckig(vias, limits_of(case.scene)), RUNS)
    return case.judged(RUCKIG, ms, time_peers.ruckig_knots(pieces))


def by_toppra(case: Case, vias: Floats, who: str, parametrizer: str) -> Entry:
    """A cubic spline through the vias; what it exceeds is counted."""
    limits = limits_of(case.scene)
    ms, found = median_ms(time_peers.by_toppra(vias, limits, parametrizer), RUNS)
    rows = time_peers.toppra_rows(found, PERIOD)
    return case.judged(who, ms, rows, f"; beyond limits: {exceeded(rows, limits)}")


def exceeded(rows: tuple[Floats, Floats, Floats, Floats], limits: Floats) -> str:
    """Return in words how many samples are beyond each limit, and up to how far; jerk by differences."""
    t, _, v, a = rows
    jerk = np.diff(a, axis=0) / np.diff(t)[:, None]
    said = []
    for rate, values, limit in zip(RATES, (v, a, jerk), limits, strict=True):
        shares = (np.abs(values) / limit).max(axis=1)
        count = int((shares > 1.0 + BEYOND).sum())
        said.append(f"{rate} {count} of {len(shares)}" + (f", up to {shares.max():.3g} x" if count else ""))
    return "; ".join(said)


def compared(name: str, task: str) -> tuple[Case, Comparison]:
    """Return one task by all."""
    scene = er.Scene.example(name)
    ms, plan = median_ms(partial(er.plan, scene, task=task, planner="dstar-pso", objective="time"), RUNS)
    case = Case(scene, task, plan, {})
    s = plan.sample(period=PERIOD)
    ours = case.judged(OURS, ms, (s.t, s.q, s.v, s.a))
    vias = waypoints(scene, task, otherwise=plan)
    entries = [
        ours,
        attempt(FROM_PATH, lambda: by_collocation(case, FROM_PATH, path_start(vias, limits_of(scene)))),
        attempt(FROM_OURS, lambda: by_collocation(case, FROM_OURS, from_ours(case))),
        attempt(RUCKIG, lambda: by_ruckig(case, vias)),
        attempt(TOPPRA, lambda: by_toppra(case, vias, TOPPRA, "ParametrizeConstAccel")),
        attempt(TOPPRA_DEFAULT, lambda: by_toppra(case, vias, TOPPRA_DEFAULT, "ParametrizeSpline")),
    ]
    return case, Comparison(f"{name}.yaml, task {task}: {len(vias)} waypoints", entries)


def goals_of(cases: list[Case], comparisons: list[Comparison]) -> list[Goal]:
    """Return what was to be reached."""
    shares = [(case.found[OURS][0] / best[0], case, best[1]) for case in cases if (best := case.best())]
    worst = max(shares, key=lambda share: share[0], default=None)
    gains = [
        ratio
        for one in comparisons
        for entry in one.entries
        if entry.who in (FROM_PATH, FROM_OURS) and (ratio := one.ratio(entry)) is not None
    ]
    unsafe = sum(not case.found[OURS][1] for case in cases)
    slowest = max(
        one.ours.ms or 0.0 for case, one in zip(cases, comparisons, strict=True) if case.scene.grid.step >= 0.0099
    )
    return [
        Goal(
            "least time, eight tasks: duration",
            "<= 1.01 x the best peer whose motion is safe",
            "no peer" if worst is None else f"{worst[0]:.3f} x at most ({worst[1].task}, {worst[2]})",
            None if worst is None else worst[0] <= 1.01,
        ),
        Goal(
            "least time, eight tasks: violations",
            "0",
            f"{unsafe} of {len(cases)} of our motions not safe",
            unsafe == 0,
        ),
        Goal(
            "least time, eight tasks: whole plan",
            ">= 50 x faster than solving the collocation",
            f"{min(gains):.0f} to {max(gains):.0f} x, median {np.median(gains):.0f} x" if gains else "no collocation",
            min(gains) >= 50.0 if gains else None,
        ),
        Goal(
            "whole `dstar-pso` at 1 cm, `--objective time`",
            "<= 50 ms-class",
            f"{slowest:.0f} ms on the slowest of six tasks",
            slowest <= 50.0 * MS_CLASS,
        ),
    ]


def durations(cases: list[Case]) -> Table:
    """Return what all motions take, and ours over the best of the peers'."""
    rows = []
    for (name, task, _), case in zip(TASKS, cases, strict=True):
        cells = [name, task]
        for who in (OURS, *PEERS):
            duration, safe = case.found.get(who, (None, False))
            cells.append("-" if duration is None else f"{duration:.3f}{'' if safe else ' (not safe)'}")
        best = case.best()
        rows.append([*cells, "-" if best is None else f"{case.found[OURS][0] / best[0]:.3f}"])
    header = ["scene", "task", OURS, *PEERS, "ours / best that is safe"]
    return Table("Durations (s)", header, rows)


def measure(say: Callable[[str], None]) -> Section:
    """Return the section; ``say`` is told how far it is."""
    found = []
    for name, task, _ in TASKS:
        found.append(compared(name, task))
        say(f"motions: {name} {task}: " + "; ".join(f"{e.who}: {e.answer}" for e in found[-1][1].entries))
    cases, comparisons = [case for case, _ in found], [comparison for _, comparison in found]
    words = """
Whole tasks, `objective="time"`; limits that a scene does not state are the assumed ones for all: 90 deg/s, 180
deg/s², 720 deg/s³. Ours is the whole plan, map to verified motion, on all cores. Collocation is direct transcription
with CasADi and IPOPT: 48 pieces of constant jerk in 8 phases of free duration, between the ends of its start, clear
of the circles and convex polygons about its start at 3 places of every piece, or 6, or 12 where the verifier refuses
the answer with fewer; the time is that of the solve that held, making its program left out. It starts from a slow
motion along the waypoints, or from our motion, and may take 60 s of CPU time. Its answer may be stretched by up to 1
% where it grazes a limit. The waypoints are a motion of ours that keeps up to 10 mm from all obstacles, simplified to
a polyline that is free; ruckig stops at each, toppra has a cubic spline through them and knows no jerk. All are
judged by `er.check` outside the timed part, limits to a millionth: on rows every 1 ms, or, of collocation and ruckig,
wherever jerk changes. Violations of toppra are samples beyond a limit by more than 0.1 %.
"""
    goals = goals_of(cases, comparisons)
    return Section("motions", "Motions in least time", words.strip(), comparisons, [durations(cases)], goals)
