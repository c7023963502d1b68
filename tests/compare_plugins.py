"""Planners for the tests of ``elbowroom compare``, each bad in its own way but the first."""

from __future__ import annotations

import os
import sys
import time
from typing import Any

import numpy as np

import elbowroom as er
from elbowroom.compare import straight_turns
from elbowroom.planners import Proposal


def detour(
    scene: er.Scene,
    task: str,
    *,
    seed: int,
    timeout: float | None,  # noqa: ARG001
    budget: int | None,
    objective: str,
    stops: bool = True,
    by: float = 0.0,
    name: str = "x",  # noqa: ARG001
    tries: int = 3,
) -> Proposal:
    """Follows dstar's motion, and says that it counted."""
    found = er.plan(scene, task=task, planner="dstar", objective=objective, seed=seed)  # type: ignore[arg-type]
    samples = found.sample()
    curve = [(10, found.cost * (2.0 + seed)), (100, found.cost * 1.5), (budget or 300, found.cost)]
    told: dict[str, Any] = {"evaluations": tries * (budget or 100), "lower_bound": 0.5, "convergence": curve}
    if stops:
        return straight_turns(scene, found.configurations + by, timings={"search": 0.5}, **told)
    return Proposal(t=samples.t, q=samples.q + by, v=samples.v, a=samples.a, **told)


detour.version = "detour 7"  # type: ignore[attr-defined]


def raises(*_: object, **__: object) -> Proposal:
    raise RuntimeError("two\nlines | and a bar")


def leaves(*_: object, **__: object) -> Proposal:
    sys.exit(3)


def crashes(_scene: er.Scene, _task: str, *, seed: int, **__: object) -> Proposal:
    if seed == 1:
        os._exit(11)
    raise er.NotFound("nothing here")


def answers_text(*_: object, **__: object) -> str:
    print("planners may print")
    return "go left"


def answers_nonsense(_scene: er.Scene, _task: str, *, seed: int, **__: object) -> Proposal:
    t = [np.array([0.0, np.nan]), np.array([1.0, 0.0]), np.array([])][seed % 3]
    return Proposal(t=t, q=np.zeros((len(t), 2)))


def straight_through(scene: er.Scene, task: str, **_: object) -> Proposal:
    path = er.plan(scene, task=task, planner="dstar").configurations
    return straight_turns(scene, path[[0, -1]])


def plans_elsewhere(scene: er.Scene, task: str, *, seed: int, **_: object) -> er.Plan:
    """Returns a plan that is safe in its own scene: of another task, or of a scene without obstacles."""
    if seed == 0:
        return er.plan(scene, task=next(name for name in scene.tasks if name != task))
    return er.plan(scene.replace(obstacles=()), task=task)


def lies(scene: er.Scene, task: str, *, seed: int, **_: object) -> Proposal:
    """Says of itself what only the verifier can say, or claims a bound that its own motion is below."""
    plan = er.plan(scene, task=task, planner="dstar")
    if seed == 0:
        told = straight_turns(scene, plan.configurations[[0, -1]])
        for name in ("verdict", "safe"):
            object.__setattr__(told, name, plan.verdict)
        return told
    return straight_turns(scene, plan.configurations, lower_bound=9.0)


def direct(scene: er.Scene, task: str, *, short: float = 0.0, **_: object) -> Proposal:
    """Turns every joint from start to goal at once, or stops short by so much; for any number of links."""
    start, goal = (np.array(getattr(scene.tasks[task], end).q) for end in ("start", "goal"))
    return straight_turns(scene, [start, goal - short], evaluations=1)


def goes_on(*_: object, **__: object) -> Proposal:
    while True:
        time.sleep(1.0)


def says_threads(*_: object, **__: object) -> Proposal:
    names = ("RAYON_NUM_THREADS", "OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
    raise er.NotFound(" ".join(os.environ[name] for name in names))


def refuses(*_: object, **__: object) -> Proposal:
    raise er.BadSetting("planner refuses serves no arm of 2 links", setting="planners")


not_callable = 5
