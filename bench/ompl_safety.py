"""Plans with OMPL and with elbowroom among thin posts, and has elbowroom's verifier judge both.

Needs the package ``ompl``; ``make ompl`` sets up an environment of its own and runs this.
"""

from __future__ import annotations

import argparse
import math
import platform
import re
import statistics
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, field
from functools import cached_property
from importlib.metadata import version
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from ompl import base as ob
from ompl import geometric as og
from ompl import util as ou

import elbowroom as er

Floats = NDArray[np.float64]
LINK = 0.25
BEND = math.radians(150)
CLEAR_ENDS = 0.005
AFTER = np.logspace(-9, -1, 81)
"""Instants after a first contact (s) at which states are looked at: one is inside, however short the contact."""
TABLES = re.compile(r"(<!-- tables -->\n).*(<!-- end of tables -->)", re.DOTALL)


@dataclass(frozen=True)
class Kind:
    """A kind of world: how many posts of which radius (m), how far from the base, half the links' width (m), and how
    long OMPL may search (s).
    """

    title: str
    posts: int
    radius: float
    half_width: float
    nearest: float
    longest: float = 10.0


KINDS = {
    "thin": Kind("posts of radius 0.5 mm, links of no width", 40, 0.0005, 0.0, 0.26),
    "thicker": Kind("posts of radius 2 mm, links of no width", 40, 0.002, 0.0, 0.26),
    "wide": Kind("posts of radius 0.5 mm, links 20 mm wide", 40, 0.0005, 0.01, 0.26),
    "everywhere": Kind(
        "posts of radius 0.5 mm also where link 1 reaches, links of no width", 40, 0.0005, 0.0, 0.02, 1.0
    ),
}


@dataclass(frozen=True)
class World:
    """Posts (m), and where the arm starts and has to go (rad)."""

    kind: Kind
    centers: Floats
    start: Floats
    goal: Floats

    @cached_property
    def made(self) -> Any:
        """The scene as elbowroom has it, which computes clearances ten times as fast as NumPy does here."""
        return self.scene(0.01)

    def free(self, q: Floats) -> bool:
        """Return whether a state is valid: what OMPL is given, exact too."""
        return bool(self.made.link_clearances(q[None]).min() > 0.0)

    def clearance(self, q: Floats) -> float:
        """Return the clearance between the arm and the nearest post (m), in closed form and apart from elbowroom."""
        first = LINK * np.array([math.cos(q[0]), math.sin(q[0])])
        second = LINK * np.array([math.cos(q[0] + q[1]), math.sin(q[0] + q[1])])
        nearest = min(_distance(self.centers, first), _distance(self.centers - first, second))
        return nearest - self.kind.radius - self.kind.half_width

    @property
    def impossible(self) -> bool:
        """Whether posts that link 1 cannot pass lie on both sides between start and goal: then there is no path."""
        walls = self.centers[np.linalg.norm(self.centers, axis=1) < LINK]
        turned = np.mod(np.arctan2(walls[:, 1], walls[:, 0]) - self.start[0], math.tau)
        between = turned < np.mod(self.goal[0] - self.start[0], math.tau)
        return bool(between.any() and not between.all())

    def scene(self, step: float) -> er.Scene:
        """Return the world as elbowroom's scene with a grid of ``step`` (m)."""
        return er.Scene(
            arm=er.Arm(
                links=(LINK, LINK),
                joints=(er.Joint(continuous=True), er.Joint(min=-BEND, max=BEND)),
                half_width=self.kind.half_width,
            ),
            grid=er.Grid(x=(-0.5, 0.5), y=(-0.5, 0.5), step=step),
            obstacles=[er.Circle(center=(x, y), radius=self.kind.radius) for x, y in self.centers.tolist()],
            tasks={"go": er.Task(start=_configuration(self.start), goal=_configuration(self.goal))},
        )


def _distance(points: Floats, segment: Floats) -> float:
    along = np.clip(points @ segment / (LINK * LINK), 0.0, 1.0)
    away = points - along[:, None] * segment
    return math.sqrt(np.einsum("ij,ij->i", away, away).min())


def _configuration(q: Floats) -> er.Configuration:
    return er.Configuration((float(q[0]), float(q[1])))


def world(kind: Kind, seed: int, number: int) -> World:
    """Return a random world: ends at least 5 mm clear of the posts and at least 1 rad apart."""
    random = np.random.default_rng([seed, number])
    distances = np.sqrt(random.uniform(kind.nearest**2, 0.49**2, kind.posts))
    angles = random.uniform(-math.pi, math.pi, kind.posts)
    centers = distances[:, None] * np.column_stack([np.cos(angles), np.sin(angles)])
    while True:
        start, goal = random.uniform([-math.pi, -BEND], [math.pi, BEND], (2, 2))
        turn = math.remainder(goal[0] - start[0], math.tau)
        drawn = World(kind, centers, start, goal)
        if math.hypot(turn, goal[1] - start[1]) >= 1.0 and min(map(drawn.clearance, (start, goal))) >= CLEAR_ENDS:
            return drawn


class ContinuousValidator(ob.MotionValidator):  # type: ignore[misc]
    """Checks a whole motion: steps no farther than the clearance allows, and refuses what comes within a micrometre."""

    def __init__(self, information: ob.SpaceInformation, world: World) -> None:
        super().__init__(information)
        self.world = world

    def checkMotion(self, first: ob.State, last: ob.State) -> bool:  # noqa: N802 (OMPL's name)
        """Return whether the straight motion between two states is free."""
        q = _angles(first)
        turn = np.array([math.remainder(last[0].value - q[0], math.tau), last[1][0] - q[1]])
        # No point of the arm moves farther than this over the whole motion.
        reach = 2 * LINK * abs(turn[0]) + LINK * abs(turn[1])
        at = 0.0
        while (clearance := self.world.made.link_clearances((q + at * turn)[None]).min()) > 1e-6:
            if at == 1.0:
                return True
            at = min(at + clearance / reach, 1.0) if reach > 0.0 else 1.0
        return False


def _angles(state: ob.State) -> Floats:
    return np.array([state[0].value, state[1][0]])


@dataclass(frozen=True)
class Setting:
    """An OMPL planner, its longest time (s), and how motions are checked: at a resolution, or whole if None."""

    planner: str
    resolution: float | None
    time: float
    kinds: tuple[str, ...] = tuple(KINDS)

    @property
    def title(self) -> str:
        """How the table calls it."""
        if self.resolution is None:
            return f"OMPL {self.planner}, continuous motion validator"
        return f"OMPL {self.planner}, resolution {self.resolution:g}{' (default)' if self.resolution == 0.01 else ''}"


SETTINGS = [
    Setting("RRTConnect", 0.01, 10.0),
    Setting("RRTConnect", 0.001, 10.0),
    Setting("RRTConnect", None, 10.0),
    Setting("PRM", 0.01, 1.0, ("thin",)),
    Setting("PRM", 0.001, 1.0, ("thin",)),
    Setting("RRTstar", 0.01, 1.0, ("thin",)),
    Setting("RRTstar", 0.001, 1.0, ("thin",)),
]


def ompl_setup(world: World, resolution: float | None) -> og.SimpleSetup:
    """Return OMPL's side of a world: joint 1 on the circle, joint 2 on an interval, the exact clearance as validity."""
    bend = ob.RealVectorStateSpace(1)
    bounds = ob.RealVectorBounds(1)
    bounds.setLow(-BEND)
    bounds.setHigh(BEND)
    bend.setBounds(bounds)
    space = ob.CompoundStateSpace()
    space.addSubspace(ob.SO2StateSpace(), 1.0)
    space.addSubspace(bend, 1.0)
    setup = og.SimpleSetup(space)
    setup.setStateValidityChecker(lambda state: world.free(_angles(state)))
    information = setup.getSpaceInformation()
    if resolution is None:
        information.setMotionValidator(ContinuousValidator(information, world))
    else:
        information.setStateValidityCheckingResolution(resolution)
    setup.setStartAndGoalStates(state(space, world.start), state(space, world.goal))
    return setup


def state(space: ob.StateSpace, q: Floats) -> ob.State:
    """Return a configuration as a state of OMPL."""
    state = space.allocState()
    state[0].value = math.remainder(q[0], math.tau)
    state[1][0] = float(q[1])
    return state


def ompl_path(world: World, setting: Setting) -> Floats | None:
    """Return the corners of OMPL's simplified path, joint 1 without jumps, or None if it reports no exact solution."""
    setup = ompl_setup(world, setting.resolution)
    setup.setPlanner(getattr(og, setting.planner)(setup.getSpaceInformation()))
    setup.solve(min(setting.time, world.kind.longest))
    if not setup.haveExactSolutionPath():
        return None
    setup.simplifySolution()
    corners = np.array([_angles(state) for state in setup.getSolutionPath().getStates()])
    corners[:, 0] = np.unwrap(corners[:, 0])
    return corners


def ompl_accepts(world: World, corners: Floats, resolution: float) -> bool:
    """Return whether OMPL's own check of a path passes."""
    setup = ompl_setup(world, resolution)
    setup.setup()
    path = og.PathGeometric(setup.getSpaceInformation())
    for q in corners:
        path.append(state(setup.getStateSpace(), q))
    return bool(path.check())


@dataclass
class Row:
    """What became of the worlds with one planner."""

    title: str
    safe: set[int] = field(default_factory=set)
    unsafe: set[int] = field(default_factory=set)
    undecided: set[int] = field(default_factory=set)
    other: set[int] = field(default_factory=set)
    posts_met: list[int] = field(default_factory=list)
    worst_depth: float = 0.0
    unconfirmed: int = 0

    def add(self, number: int, world: World, check: er.Check) -> None:
        """Take in a verdict; a contact is confirmed by a state that both OMPL's function and NumPy refuse."""
        contacts = [v for v in check.verdict.violations if v.kind == "contact"]
        kinds = {v.kind for v in check.verdict.violations}
        if contacts:
            self.unsafe.add(number)
            self.posts_met.append(len({v.obstacle for v in contacts}))
            self.worst_depth = max(self.worst_depth, *(v.depth for v in contacts))
            touched = np.add.outer([v.time for v in contacts], AFTER).ravel()
            within = check.motion.sample(np.minimum(touched, check.motion.duration))[0]
            self.unconfirmed += not any(world.clearance(q) <= 0.0 and not world.free(q) for q in within)
        else:
            (self.safe if check.safe else self.undecided if kinds == {"undecided"} else self.other).add(number)

    @property
    def solved(self) -> int:
        """How many worlds have a path."""
        return sum(map(len, (self.safe, self.unsafe, self.undecided, self.other)))

    def cells(self) -> list[str]:
        """Return the row of the table."""
        share = f" ({100 * len(self.unsafe) / self.solved:.0f} %)" if self.solved else ""
        met = f"{statistics.median(self.posts_met):g} / {max(self.posts_met)}" if self.posts_met else "-"
        depth = f"{1000 * self.worst_depth:.2f}" if self.posts_met else "-"
        return [self.title, str(self.solved), f"{len(self.unsafe)}{share}", str(len(self.undecided)), met, depth]


HEADER = [
    "planner",
    "solved",
    "of them unsafe",
    "undecided",
    "posts met by an unsafe path, median / most",
    "deepest (mm)",
]


OWN_HEADER = [
    "elbowroom's grid",
    "found nothing",
    "of these, OMPL has a safe path",
    "motions that OMPL's check accepts at 0.01 and 0.001",
    "motions safe also as straight lines between samples",
]


def polyline(world: World, corners: Floats) -> er.Check:
    """Return the verdict on straight joint-space motions from corner to corner."""
    return er.check(world.scene(0.01), t=np.arange(len(corners), dtype=np.float64), q=corners)


def compare(name: str, worlds: list[World], say: Callable[[str], None]) -> Iterator[str]:
    """Yield the lines of the report on one kind of world."""
    rows: list[Row] = []
    for setting in (s for s in SETTINGS if name in s.kinds):
        row = Row(setting.title)
        for number, world in enumerate(worlds):
            corners = ompl_path(world, setting)
            if corners is not None:
                row.add(number, world, polyline(world, corners))
        say(f"{name}: {row.cells()} other {len(row.other)} unconfirmed {row.unconfirmed}")
        rows.append(row)
    reached = set().union(*(row.safe for row in rows))
    own: list[list[str]] = []
    for step in (0.01, 0.005):
        row, straight, accepted = Row(f"elbowroom dstar-pso, grid {1000 * step:g} mm"), 0, 0
        for number, world in enumerate(worlds):
            scene = world.scene(step)
            try:
                plan = er.plan(scene)
            except (er.NoPath, er.NotFound):
                continue
            s = plan.sample()
            row.add(number, world, er.check(scene, t=s.t, q=s.q, v=s.v, a=s.a))
            straight += er.check(scene, t=s.t, q=s.q).safe
            accepted += all(ompl_accepts(world, s.q, resolution) for resolution in (0.01, 0.001))
        say(f"{name}: {row.cells()}")
        counts = [len(worlds) - row.solved, len(reached - row.safe), accepted, straight]
        own.append([f"{1000 * step:g} mm", *map(str, counts)])
        rows.append(row)
    yield f"### {worlds[0].kind.posts} {worlds[0].kind.title}\n"
    yield from _table(HEADER, [row.cells() for row in rows])
    yield from _table(OWN_HEADER, own)
    ompl_rows = rows[: -len(own)]
    contacts, open_ = sum(len(r.unsafe) for r in ompl_rows), sum(r.unconfirmed for r in ompl_rows)
    yield (
        f"Unsafe OMPL paths in which OMPL's validity function and NumPy's closed form both refuse a state:"
        f" {contacts - open_} of {contacts}. Paths refused for anything but contact: {sum(len(r.other) for r in rows)}."
        f" Worlds in which there is provably no path: {sum(w.impossible for w in worlds)}.\n"
    )


def _table(header: list[str], rows: list[list[str]]) -> Iterator[str]:
    for cells in (header, ["---"] + ["---:"] * (len(header) - 1), *rows):
        yield f"| {' | '.join(cells)} |"
    yield ""


def report(name: str, count: int, seed: int) -> list[str]:
    """Return the report on one kind of world; in a process of its own OMPL's seed holds from the first number on."""
    ou.setLogLevel(ou.LOG_NONE)
    ou.RNG.setSeed(seed + 1)
    worlds = [world(KINDS[name], seed, number) for number in range(count)]
    return list(compare(name, worlds, lambda line: print(line, flush=True)))


def main() -> None:
    """Run the comparison and write its tables."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--worlds", type=int, default=100)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--kinds", nargs="+", choices=list(KINDS), default=list(KINDS))
    parser.add_argument("--out", type=Path, help="Markdown file whose tables are replaced; else printed")
    chosen: Any = parser.parse_args()
    old = "" if chosen.out is None else chosen.out.read_text(encoding="utf-8")
    if chosen.out is not None and not TABLES.search(old):
        parser.error(f"{chosen.out} has no place for the tables: {TABLES.pattern}")
    lines = [
        f"{chosen.worlds} worlds of each kind, seed {chosen.seed}; OMPL {version('ompl')}, elbowroom"
        f" {version('elbowroom')}, NumPy {version('numpy')}, Python {platform.python_version()}.\n"
    ]
    for name in chosen.kinds:
        with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as fresh:
            lines += fresh.submit(report, name, chosen.worlds, chosen.seed).result()
    text = "\n".join(lines)
    if chosen.out is None:
        print(text)
    else:
        chosen.out.write_text(TABLES.sub(lambda m: f"{m[1]}\n{text}\n{m[2]}", old), encoding="utf-8")


if __name__ == "__main__":
    main()
