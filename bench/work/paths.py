"""Paths within 1 % of the best known joint length: OMPL, in C++ and in Python, beside ``optimal``."""

from __future__ import annotations

import importlib.util
import json
import math
import shutil
import statistics
import subprocess
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from importlib.metadata import version
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

import elbowroom as er
from bench.clock import OUT, ROOT, TooLong, run
from bench.entries import Goal, Section, Table
from bench.objectives import BEST_KNOWN, Case, cases

Floats = NDArray[np.float64]

WITHIN = 1.01
STEP = math.radians(0.5)
"""Distance between the states that OMPL checks, where it does not check the whole motion (rad)."""

SEEDS = 10
PYTHON_SEEDS = 5
LIMIT = 1.0
"""How long OMPL may take in C++ for one path (s)."""

PYTHON_LIMIT = 2.0
TURN = math.tau


def best_cases() -> Iterator[tuple[Case, str, float]]:
    """Yield the cases whose best joint length is known, the task, and that length (rad)."""
    for case in cases():
        for task in case.scene.tasks:
            best = BEST_KNOWN.get((case.name, task, case.kind))
            if best is not None:
                yield case, task, best


def configurations(scene: er.Scene, tip: tuple[float, float]) -> list[tuple[float, float]]:
    """Return the free configurations that put the tip there, joint 1 from 0 to a turn."""
    first, second = scene.arm.links
    distance = math.hypot(*tip)
    bend = math.acos((distance**2 - first**2 - second**2) / (2 * first * second))
    found = []
    for q2 in (bend, -bend):
        q1 = math.atan2(tip[1], tip[0]) - math.atan2(second * math.sin(q2), first + second * math.cos(q2))
        q = (q1 % TURN, q2)
        if scene.core.link_clearances(np.array([q])).min() > 0.0:
            found.append(q)
    return found


def problem(case: Case, task: str) -> str:
    """Return the task as lines of text: either posture at both ends.

    A continuous joint 1 is unrolled over three turns, with a copy of each goal in each: on OMPL's circle lengths
    would be sums over the joints, not those of the plane.
    """
    scene = case.scene
    asked = scene.tasks[task]
    turns = (-TURN, 0.0, TURN) if scene.arm.joints[0].continuous else (0.0,)
    starts, goals = (configurations(scene, end) for end in (asked.start, asked.goal))  # type: ignore[arg-type]
    lines: list[tuple[object, ...]] = [
        ("links", *scene.arm.links),
        ("joint1", turns[0], turns[-1] + TURN),
        ("joint2", scene.arm.joints[1].min, scene.arm.joints[1].max),
        *(("start", *q) for q in starts),
        *(("goal", q[0] + turn, q[1]) for q in goals for turn in turns),
    ]
    for shape in scene.obstacles:
        if isinstance(shape, er.Circle):
            lines.append(("circle", *shape.center, shape.radius))
        else:
            lines.append(("polygon", *(value for corner in shape.vertices for value in corner)))
    return "\n".join(" ".join(map(str, line)) for line in lines)


@dataclass
class Runs:
    """What became of the seeds of one planner in one case."""

    tried: int = 0
    ms: list[float] = field(default_factory=list)
    """Times of the runs that are safe and within 1 %."""
    lengths: list[float] = field(default_factory=list)
    """Lengths of the safe paths, as shares of the best known."""
    unsafe: int = 0
    overrun: int = 0

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
        return said + (f", {self.overrun} stopped" if self.overrun else "")


@dataclass(frozen=True)
class Peer:
    """A planner of OMPL, how it checks motions, and the program that runs it."""

    who: str
    command: Sequence[str | Path]
    planner: str
    check: str
    seeds: int
    limit: float

    def runs(self, case: Case, task: str, best: float) -> Runs:
        """Return what became of its seeds."""
        given, found = problem(case, task), Runs()
        for seed in range(1, self.seeds + 1):
            settings = [self.planner, self.check, str(self.limit), str(seed), str(WITHIN * best)]
            try:
                answer = json.loads(run([*self.command, *settings], limit=3 * self.limit + 2.0, given=given))
            except TooLong:
                found.tried, found.overrun = found.tried + 1, found.overrun + 1
                continue
            found.add(case.scene, answer["seconds"], np.array(answer["path"]), best)
        return found


PLANNERS = {"RRTConnect": "RRTConnect, simplified", "InformedRRTstar": "InformedRRT*", "BITstar": "BIT*"}


def peers() -> tuple[list[Peer], list[str]]:
    """Return the peers that are there, and what is not, in words."""
    found, missing = [], []
    program, why = built()
    if program is None:
        missing.append(f"OMPL in C++: {why}")
    else:
        for planner, who in PLANNERS.items():
            for check in ("whole", str(STEP)) if planner == "RRTConnect" else ("whole",):
                name = f"{who} (C++, {'whole motions' if check == 'whole' else 'states 0.5° apart'})"
                found.append(Peer(name, [program], planner, check, SEEDS, LIMIT))
    if importlib.util.find_spec("ompl") is None:
        missing.append("OMPL's Python package: not installed")
    else:
        command = [sys.executable, "-m", "bench.ompl_paths"]
        for planner, who in PLANNERS.items():
            found.append(Peer(f"{who} (Python)", command, planner, str(STEP), PYTHON_SEEDS, PYTHON_LIMIT))
    return found, missing


def built() -> tuple[Path | None, str]:
    """Return the C++ program, built if OMPL's headers are there, or None and why."""
    if shutil.which("cmake") is None:
        return None, "not built, cmake is not installed"
    folder = OUT / "ompl_cpp"
    configure = ["cmake", "-S", ROOT / "bench" / "ompl_cpp", "-B", folder, "-DCMAKE_BUILD_TYPE=Release"]
    for step, why in (
        (configure, "not installed (Debian's libompl-dev)"),
        (["cmake", "--build", folder], "does not build"),
    ):
        if subprocess.run(step, capture_output=True).returncode != 0:
            return None, why
    return folder / "ompl_paths", ""


def ompl_versions() -> dict[str, str]:
    """Return the versions of OMPL that are there."""
    program, _ = built()
    found = {} if program is None else {"OMPL in C++": run([program, "version"], limit=10.0).strip()}
    return found | ({"ompl (Python)": version("ompl")} if importlib.util.find_spec("ompl") else {})


def ours(case: Case, task: str, best: float) -> Runs:
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
    return found


def measure(say: Callable[[str], None] = lambda _: None) -> Section:
    """Return the section."""
    there, missing = peers()
    titles: list[tuple[str, str]] = []
    rows: dict[str, list[str]] = {}
    points: list[dict[str, object]] = []
    own: list[Runs] = []
    for case, task, best in best_cases():
        name = f"{case.name}, {case.kind}, {task}"
        titles.append((case.name, f"{task}, joint 1 {case.kind}: {best:.4f} rad"))
        own.append(ours(case, task, best))
        runs = {"elbowroom optimal": own[-1]} | {peer.who: peer.runs(case, task, best) for peer in there}
        say(f"{name}: elbowroom {own[-1].cell()}")
        for who, found in runs.items():
            rows.setdefault(who, []).append(found.cell())
            points.append(
                {"who": who, "case": name, "ms": statistics.median(found.ms) if found.ms else None}
                | {"share": len(found.ms) / found.tried}
            )
    every = all(len(runs.ms) == runs.tried for runs in own)
    slowest = max(statistics.median(runs.ms) if runs.ms else math.inf for runs in own)
    goal = Goal(
        "within 1 % of the best known joint length on scenes/",
        "every run, <= 20 ms-class",
        f"{sum(len(r.ms) for r in own)} of {sum(r.tried for r in own)} runs, {slowest:.0f} ms on the slowest scene",
        every and slowest <= 30.0,
    )
    words = f"""
Cells say in how many runs a safe path came within 1 % of the best known length, in what time (median of those),
else how much longer the safe paths were (median) and how many paths were not safe by our verifier. Ours is a whole
plan, from scene to verified trajectory, and the length that of its motion. OMPL's times leave out setting up; its
planners get both postures at both ends, three turns of a continuous joint with a copy of each goal, and stop as
soon as their path is short enough. RRTConnect is begun again until then, every path simplified. Nobody knows the
best length beforehand; that OMPL is told when to stop is in its favour. Time limit {LIMIT:g} s in C++ ({SEEDS}
seeds), {PYTHON_LIMIT:g} s in Python ({PYTHON_SEEDS} seeds), where the checker is plain Python; a run that goes far
over its limit is stopped. The C++ checker is exact and allocates nothing; with `whole motions` it also proves the
way between states, by bisection with the clearance. { " ".join(f"**{what}.**" for what in missing) }
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
    return Section("paths", "Paths within 1 % of the best known", words.strip(), (), tables, [goal], {"paths": points})
