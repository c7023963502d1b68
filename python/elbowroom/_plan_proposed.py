"""Plans by planners written in Python: asked, then verified as all are."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from time import perf_counter
from typing import Any

from elbowroom import _core, _plugins
from elbowroom._core import Plan
from elbowroom._errors import BadSetting, ElbowroomError, PlannerFault, TrajectoryError
from elbowroom._objectives import Objective
from elbowroom._plugins import Option, PlannerPlugin, Proposal, rows_of
from elbowroom._scene import Scene


def plan_proposed(
    scene: Scene,
    task: str,
    *,
    name: str,
    planner: PlannerPlugin,
    options: Mapping[str, Option],
    objective: Objective,
    seed: int,
    duration: float | None,
    slack: float | None,
    clearance: float | None,
    timeout: float | None,
    on_stage: Callable[[str], None] | None,
) -> Plan:
    """Return the plan that the answer of ``planner``, called ``name``, makes.

    Raises:
        PlannerFault: It failed, or its answer is no trajectory, not safe, or not for this task.
        Others: As ``elbowroom.plan`` says.
    """
    defaults = _plugins.options_of(planner)
    if unknown := next((option for option in options if option not in defaults), None):
        listed = ", ".join(defaults) or "it has none"
        raise BadSetting(f"planner {name} has no option '{unknown}'; known: {listed}", setting=unknown)
    for option, value in options.items():
        if not _fits(value, defaults[option]):
            wanted = type(defaults[option]).__name__
            message = f"option {option} of planner {name} is {value!r}, it must be of type {wanted}"
            raise BadSetting(message, setting=option)
    if on_stage is not None:
        on_stage("search")
    kept = scene.tasks[task].clearance if clearance is None else clearance
    seen = scene.with_clearance(kept) if kept != 0.0 else scene
    begun = perf_counter()
    try:
        answer = planner(seen, task, seed=seed, timeout=timeout, budget=None, objective=objective, **options)
    except ElbowroomError:
        raise
    # A plug-in may call sys.exit.
    except (Exception, SystemExit) as error:
        words = " ".join(str(error).split())
        raise PlannerFault(f"planner {name} failed: {type(error).__name__}: {words}", planner=name) from error
    spent = perf_counter() - begun
    return _core.plan_proposed(
        scene,
        task,
        planner=name,
        settings=list({**defaults, **options}.items()),
        objective=objective,
        seed=seed,
        **_candidate(name, answer),
        timings=[("search", spent)],
        duration=duration,
        slack=slack,
        clearance=clearance,
        timeout=None if timeout is None else max(timeout - spent, 0.0),
        on_stage=on_stage,
    )


def _count(value: Any) -> int:
    count = int(value)
    if count < 0:
        raise ValueError(f"{count} evaluations")
    return count


def _fits(value: object, default: Option) -> bool:
    """Whether ``value`` is of the type of ``default``; whole numbers are numbers, True and False are none."""
    if isinstance(default, bool) or isinstance(value, bool):
        return isinstance(default, bool) and isinstance(value, bool)
    return isinstance(value, (int, float) if isinstance(default, float) else type(default))


def _candidate(name: str, answer: Any) -> dict[str, Any]:
    """``answer`` as the core takes it: a motion where all of its derivatives are known, else a path."""
    if not isinstance(answer, Plan | Proposal):
        message = f"planner {name} returned {type(answer).__name__}, not a Proposal"
        raise PlannerFault(message, planner=name)
    try:
        told: dict[str, Any] = {
            "evaluations": None if answer.evaluations is None else _count(answer.evaluations),
            "convergence": [(_count(made), float(cost)) for made, cost in answer.convergence or ()],
        }
        if isinstance(answer, Plan):
            return {"motion": answer.motion, **told}
        t, q, v, a = rows_of(answer)
        # Times have to make sense, though they are not kept to without velocities and accelerations.
        motion, curve, _ = _core.interpolated(t, q, v, a)
    except (TrajectoryError, TypeError, ValueError) as error:
        raise PlannerFault(f"planner {name}: {error}", planner=name) from error
    return {"motion": motion, **told} if curve == "quintic" else {"configurations": q, **told}
