"""From a task to a plan."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from elbowroom import _core
from elbowroom.errors import BadSetting, NotFree, UnknownTask
from elbowroom.own_planners import OwnOption, all_options
from elbowroom.scene import Scene
from elbowroom.verdict import Verdict

PaperPlanner = Literal["dstar-pso", "dstar"]
Objective = Literal["tip", "joint", "time"]
Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Samples:
    """A motion at instants ``t`` (s): joint positions, velocities, accelerations and jerks (rad, rad/s, ...), shape
    ``(n, joints)`` each, and where the links end (m), base first, shape ``(n, links, 2)``.
    """

    t: Floats
    q: Floats
    v: Floats
    a: Floats
    j: Floats
    link_ends: Floats

    @property
    def tip(self) -> Floats:
        """Where the tip is, shape ``(n, 2)`` (m)."""
        return self.link_ends[:, -1]


@dataclass(frozen=True, eq=False, kw_only=True)
class Plan:
    """What a planner found for a task.

    Attributes:
        cost: What the motion costs in terms of the objective: tip travel (m), joint travel (rad) or time (s); in paper
            mode the length of ``tip_path``.
        path_cost: Tip travel along ``tip_path`` (m).
        lower_bound: No motion costs less; None where unknown.
        tip_path: Places of the tip, start and goal included, shape ``(n, 2)`` (m).
        equal_paths: All different paths of that cost that were drawn, ``tip_path`` first; in paper mode only.
        paths_to_choose_from: How many different paths the choice was among.
        configurations: One for each place of ``tip_path``, shape ``(n, joints)`` (rad).
        postures: ``elbow-up``, ``elbow-down``, or None with the links in line or more links than two, for each
            configuration.
        jumps: Steps of the path that no arm can carry out: the place each begins at, and what is impossible.
        vias: Places of ``tip_path`` that the motion was led through.
        stops: At how many of them, ends left out, the arm stops.
        assumed_limits: Motion limits that the scene does not state, and what was taken: joint, rate, value.
        motion: Polynomial pieces over time.
        verdict: What the verifier says of ``motion``; None if it was never asked: then the motion is not safe to run.
        timings: Seconds spent in each stage.
        evaluations: How many candidates the planner judged; None if it does not count them.
        convergence: Evaluations made, and the best cost by then, each time that fell; None likewise.
    """

    scene: Scene
    task: str
    planner: str
    settings: dict[str, Any]
    seed: int
    objective: str
    cost: float
    path_cost: float
    lower_bound: float | None
    tip_path: Floats
    equal_paths: list[Floats]
    paths_to_choose_from: int
    configurations: Floats
    postures: list[str | None]
    jumps: list[tuple[int, str]]
    vias: list[int]
    stops: int
    assumed_limits: list[tuple[int, str, float]]
    motion: _core.Motion
    verdict: Verdict | None
    timings: dict[str, float]
    evaluations: int | None = None
    convergence: Sequence[tuple[int, float]] | None = None

    @property
    def gap(self) -> float | None:
        """By which share of ``lower_bound`` the cost is above it: no motion is better by more; None where unknown."""
        if self.lower_bound is None:
            return None
        if self.cost <= self.lower_bound:
            return 0.0
        return self.cost / self.lower_bound - 1.0 if self.lower_bound > 0.0 else None

    def sample(self, *, period: float = 0.01) -> Samples:
        """Return the motion every ``period`` (s), both ends included."""
        if not (math.isfinite(period) and period > 0.0):
            raise BadSetting(f"period is {period} s, it must be finite and greater than 0", setting="period")
        duration = self.motion.duration
        count = math.ceil(duration / period - 1e-9)
        return self.at(np.minimum(period * np.arange(count + 1), duration))

    def at(self, t: Floats) -> Samples:
        """Return the motion at the instants ``t``, shape ``(n,)`` (s)."""
        q, v, a, j = self.motion.sample(t)
        return Samples(t, q, v, a, j, self.scene.core.link_ends(q))


def only_task(scene: Scene, task: str | None) -> str:
    """Return ``task``, or the scene's only one if None."""
    if task is not None:
        return task
    known = list(scene.tasks)
    if len(known) == 1:
        return known[0]
    listed = ", ".join(known) or "none"
    raise UnknownTask(f"name the task to plan; tasks of this scene: {listed}", name="", known=known)


def plan(
    scene: Scene,
    *,
    task: str | None = None,
    planner: str = "dstar-pso",
    options: Mapping[str, OwnOption] | None = None,
    objective: Objective = "tip",
    seed: int = 0,
    duration: float | None = None,
    gap: float | None = None,
    timeout: float | None = None,
    on_stage: Callable[[str], None] | None = None,
) -> Plan:
    """Return a plan whose motion is proved to be safe.

    The motion exists only because the verifier has accepted its polynomials. With two links the path is over
    (place, posture): every step is certified free of contact, and the posture changes only through full stretch or
    fold.

    Args:
        scene: Arm and obstacles.
        task: Which one; may be left out if there is only one.
        planner: One of ``elbowroom.own_planners.OWN``.
        options: Those of the planner that shall differ from its defaults, such as ``{"candidates": 100}``.
        objective: What the choice goes by: ``tip`` travel, ``joint`` travel or ``time``.
        seed: Of the swarm.
        duration: How long the motion takes (s); None for as fast as the motion limits allow along the path.
        gap: For ``optimal``: go on until the cost is no more than this share above the lower bound, or the timeout, or
            nothing finer is left to try; the plan says what was reached.
        timeout: When to give up (s).
        on_stage: Called with the name of each stage as it begins.

    Raises:
        UnknownTask: The scene has no such task.
        NotFree: Start or goal is not free.
        NoPath: It is proved that no motion does the task.
        NotFound: No path was found, at this resolution or in this budget; there may be one.
        TimedOut: The timeout came first.
        BadSetting: A setting makes no sense, the planner does not serve this arm, or the duration is too short for the
            motion limits.
    """
    _check_counts(seed=seed)
    chosen_options = all_options(planner, options or {})
    if gap is not None and planner != "optimal":
        raise BadSetting(f"gap is for the planner optimal, not for {planner}", setting="gap")
    task = only_task(scene, task)
    try:
        found = _core.plan(
            scene.core,
            task,
            planner=planner,
            objective=objective,
            seed=seed,
            options=list(chosen_options.items()),
            duration=duration,
            gap=gap,
            timeout=timeout,
            on_stage=on_stage,
        )
    except NotFree as error:
        raise located(scene, error) from None
    settings: dict[str, Any] = {"mode": "verified", "duration": "fastest" if duration is None else duration}
    if gap is not None:
        settings["gap"] = gap
    evaluations, convergence = found.effort or (None, None)
    return Plan(
        scene=scene,
        task=task,
        planner=planner,
        settings={**settings, **chosen_options},
        seed=seed,
        objective=objective,
        cost=found.cost,
        path_cost=found.path_cost,
        lower_bound=found.lower_bound,
        tip_path=found.tip_path,
        equal_paths=[found.tip_path],
        paths_to_choose_from=found.paths_to_choose_from,
        configurations=found.configurations,
        postures=found.postures,
        jumps=[],
        vias=found.vias,
        stops=found.stops,
        assumed_limits=found.assumed_limits,
        motion=found.motion,
        verdict=found.verdict(scene.core),
        timings=dict(found.timings),
        evaluations=evaluations,
        convergence=convergence,
    )


def _check_counts(**counts: int) -> None:
    for name, number in counts.items():
        least = 1 if name == "candidates" else 0
        if not least <= number < 2**63:
            raise BadSetting(f"{name} is {number}, it must be a whole number from {least} on", setting=name)


def plan_as_in_paper(
    scene: Scene,
    *,
    task: str | None = None,
    planner: PaperPlanner = "dstar-pso",
    seed: int = 0,
    vias: int = 5,
    duration: float = 10.0,
    candidates: int = 300,
    timeout: float | None = None,
    on_stage: Callable[[str], None] | None = None,
) -> Plan:
    """Return what the paper's system finds: a path over the union of both postures, smoothed through random vias.

    Nothing checks the motion between grid points or after smoothing, and its steps may jump between postures: it is
    here to be compared with, not to be run.

    Args:
        scene: Arm and obstacles.
        task: Which one; may be left out if there is only one.
        planner: ``dstar-pso``, the paper's modified lbest swarm, or ``dstar``, the pointers alone.
        seed: Of the swarm and of the choice of via points.
        vias: How many via points are chosen between start and goal.
        duration: How long the motion takes (s).
        candidates: Paths the swarm draws; the paper's 300 iterations.
        timeout: When to give up (s).
        on_stage: Called with the name of each stage as it begins.

    Raises:
        UnknownTask: The scene has no such task.
        NotFree: Start or goal is not free.
        NotFound: The grid does not connect them; a finer one may.
        TimedOut: The timeout came first.
        BadSetting: A setting makes no sense.
    """
    if planner not in ("dstar-pso", "dstar"):
        raise BadSetting(f"no planner is called '{planner}'; dstar-pso or dstar", setting="planner")
    _check_counts(seed=seed, vias=vias, candidates=candidates)
    task = only_task(scene, task)
    try:
        found = _core.plan_as_in_paper(
            scene.core,
            task,
            swarm=planner == "dstar-pso",
            seed=seed,
            vias=vias,
            duration=duration,
            candidates=candidates,
            timeout=timeout,
            on_stage=on_stage,
        )
    except NotFree as error:
        raise located(scene, error) from None
    settings: dict[str, Any] = {"mode": "paper", "vias": vias, "duration": duration}
    if planner == "dstar-pso":
        settings["candidates"] = candidates
    return Plan(
        scene=scene,
        task=task,
        planner=planner,
        settings=settings,
        seed=seed,
        objective="tip",
        cost=found.cost,
        path_cost=found.cost,
        lower_bound=None,
        tip_path=found.tip_path,
        equal_paths=found.equal_paths,
        paths_to_choose_from=len(found.equal_paths),
        configurations=found.configurations,
        postures=found.postures,
        jumps=found.jumps,
        vias=found.vias,
        stops=0,
        assumed_limits=[],
        motion=found.motion,
        verdict=None,
        timings=dict(found.timings),
    )


def located(scene: Scene, error: NotFree) -> NotFree:
    """Return ``error`` with the place in the scene's file in front, where there is one."""
    at = scene.locations.get((error.task, error.end))
    if scene.file is None or at is None:
        return error
    line, column = at
    message = f"{scene.file}:{line}:{column}: tasks.{error.task}.{error}"
    return NotFree(
        message,
        task=error.task,
        end=error.end,
        reasons=error.reasons,
        nearest_free=error.nearest_free,
        tip=error.tip,
        configuration=error.configuration,
    )
