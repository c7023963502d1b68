"""From a task to a plan."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Literal

from elbowroom import _core, _plugins
from elbowroom._core import PaperPlan, Plan
from elbowroom._errors import BadSetting, NotFree
from elbowroom._objectives import Objective
from elbowroom._own_planners import OWN, all_options
from elbowroom._plan_proposed import plan_proposed
from elbowroom._plugins import Option, PlannerPlugin
from elbowroom._scene import Scene
from elbowroom._whole import check_whole

PaperPlanner = Literal["dstar-pso", "dstar"]
AnyPlan = Plan | PaperPlan
"""What can be drawn and written to files, verified or not."""


def plan(
    scene: Scene,
    *,
    task: str | None = None,
    planner: str | PlannerPlugin | None = None,
    options: Mapping[str, Option] | None = None,
    objective: Objective = "tip",
    seed: int = 0,
    duration: float | None = None,
    gap: float | None = None,
    slack: float | None = None,
    clearance: float | None = None,
    timeout: float | None = None,
    on_stage: Callable[[str], None] | None = None,
) -> Plan:
    """Return a plan whose motion is proved to be safe.

    The motion exists only because the verifier has accepted its polynomials, whoever planned it. elbowroom's own
    planners for two links use paths over (tip position, posture): every step is certified collision-free, and
    the posture changes only through full stretch or fold.

    Args:
        scene: Arm and obstacles.
        task: Which one; may be omitted if there is only one.
        planner: One of the names that ``elbowroom.planners.known()`` lists, or a callable like
            ``elbowroom.planners.PlannerPlugin``; None for ``dstar-pso`` with two links and
            ``guided-rrt-connect`` with more. Where a callable or plug-in proposes positions, velocities and
            accelerations the motion is taken as it is; else its rows are a path, and the motion along it is
            elbowroom's.
        options: Those of the planner that differ from its defaults, such as ``{"candidates": 100}``.
        objective: Quantity to minimise: ``tip`` travel, ``joint`` travel or ``time``.
        seed: Random seed.
        duration: Of the motion (s), the smoothest; None for the fastest that is found within the motion limits.
        gap: For ``optimal``: refine until the proven optimality gap is below this share, or the timeout, or nothing
            finer is left to try; the plan says what was reached.
        slack: For ``tip`` and ``joint``: by which share a motion may be longer than the shortest that is found to be
            faster; None for 0.005.
        clearance: What the motion keeps (m) between links and what they must not touch, proved; None for that of the
            task. Start and goal have to keep it too.
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
        PlannerFault: A callable or plug-in failed, or what it proposed is not safe or does not do the task.
    """
    check_whole("seed", seed)
    task = _core.only_task(scene, task)
    asked = _core.default_planner(scene) if planner is None else planner
    try:
        if not isinstance(asked, str) or asked not in OWN:
            name, call = (asked, _plugin(asked)) if isinstance(asked, str) else (_plugins.name_of(asked), asked)
            if gap is not None:
                message = f"gap is for planners that search in rounds, such as optimal, not for {name}"
                raise BadSetting(message, setting="gap")
            return plan_proposed(
                scene,
                task,
                name=name,
                planner=call,
                options=options or {},
                objective=objective,
                seed=seed,
                duration=duration,
                slack=slack,
                clearance=clearance,
                timeout=timeout,
                on_stage=on_stage,
            )
        return _core.plan(
            scene,
            task,
            planner=asked,
            objective=objective,
            seed=seed,
            options=list(all_options(asked, options or {}).items()),
            duration=duration,
            gap=gap,
            slack=slack,
            clearance=clearance,
            timeout=timeout,
            on_stage=on_stage,
        )
    except NotFree as error:
        raise located(scene, error) from None


def _plugin(name: str) -> PlannerPlugin:
    point = _plugins.entry_point(name)
    assert point is not None
    try:
        return _plugins.loaded(point)
    except _plugins.BrokenPlugin as error:
        raise BadSetting(f"planner {name} {error}", setting="planner") from error


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
) -> PaperPlan:
    """Return what the paper's system finds: a path over the union of both postures, smoothed through random vias.

    Nothing checks the motion between grid points or after smoothing, and its steps may jump between postures: it is
    here to be compared with, not to be run.

    Args:
        scene: Arm and obstacles.
        task: Which one; may be omitted if there is only one.
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
    check_whole("seed", seed)
    check_whole("vias", vias)
    check_whole("candidates", candidates, least=1)
    task = _core.only_task(scene, task)
    try:
        return _core.plan_as_in_paper(
            scene,
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


def located(scene: Scene, error: NotFree) -> NotFree:
    """Return ``error`` with the place in the scene's file in front, where there is one."""
    at = scene.locations.get((error.task, error.end))
    if scene.file is None or at is None:
        return error
    line, column = at
    return replace(error, message=f"{scene.file}:{line}:{column}: tasks.{error.task}.{error}")
