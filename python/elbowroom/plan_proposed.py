"""Plans by planners written in Python: asked, then judged as all are."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from time import perf_counter
from typing import Any

import numpy as np

from elbowroom import _core, plugins
from elbowroom._core import Plan
from elbowroom.errors import BadSetting, ElbowroomError, PlannerFault, TrajectoryError
from elbowroom.objectives import Objective
from elbowroom.plugins import Option, PlannerPlugin, Proposal
from elbowroom.scene import Scene


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
    timeout: float | None,
    on_stage: Callable[[str], None] | None,
) -> Plan:
    """Return the plan that the answer of ``planner``, called ``name``, makes.

    Raises:
        PlannerFault: It failed, or its answer is no trajectory, not safe, or not for this task.
        Others: As ``elbowroom.plan`` says.
    """
    defaults = plugins.options_of(planner)
    if unknown := next((option for option in options if option not in defaults), None):
        listed = ", ".join(defaults) or "it has none"
        raise BadSetting(f"planner {name} has no option '{unknown}'; known: {listed}", setting=unknown)
    if on_stage is not None:
        on_stage("search")
    begun = perf_counter()
    try:
        answer = planner(scene, task, seed=seed, timeout=timeout, budget=None, objective=objective, **options)
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
        timeout=None if timeout is None else max(timeout - spent, 0.0),
        on_stage=on_stage,
    )


def _candidate(name: str, answer: Any) -> dict[str, Any]:
    """``answer`` as the core takes it: a motion where all of its derivatives are known, else a path."""
    if not isinstance(answer, Plan | Proposal):
        message = f"planner {name} returned {type(answer).__name__}, not a Proposal"
        raise PlannerFault(message, planner=name)
    told: dict[str, Any] = {"evaluations": answer.evaluations, "convergence": answer.convergence}
    if isinstance(answer, Plan):
        return {"motion": answer.motion, **told}
    try:
        t, q, v, a = (
            None if x is None else np.ascontiguousarray(x, dtype=np.float64)
            for x in (answer.t, answer.q, answer.v, answer.a)
        )
        assert t is not None
        assert q is not None
        # Times have to make sense, though they are not kept to without velocities and accelerations.
        motion, curve = _core.interpolated(t, q, v, a)
    except (TrajectoryError, TypeError, ValueError) as error:
        raise PlannerFault(f"planner {name}: {error}", planner=name) from error
    return {"motion": motion, **told} if curve == "quintic" else {"configurations": q, **told}
