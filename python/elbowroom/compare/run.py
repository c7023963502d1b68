"""Runs one planner once, and makes a row of whatever becomes of it."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from time import perf_counter
from typing import Any

import numpy as np

from elbowroom._core import Motion
from elbowroom.check import check
from elbowroom.compare.measure import lengths, misses
from elbowroom.compare.row import Failure, Problem, Row
from elbowroom.errors import BadSetting, NoPath, NotFound, NotFree, TimedOut, TrajectoryError, UnknownTask
from elbowroom.plan import Plan
from elbowroom.planners import BrokenPlugin, PlannerPlugin, Proposal, load
from elbowroom.scene import Scene
from elbowroom.verdict import Verdict


def run(problem: Problem, scene: Scene) -> Row:
    """Return the row of ``problem``; ``scene`` is what its file holds. Nothing that a planner does raises here."""
    begun = perf_counter()

    def failed(failure: Failure, error: BaseException | str) -> Row:
        return Row.failed(problem, failure, str(error), time_s=perf_counter() - begun)

    try:
        planner = load(problem.name)
    except (BrokenPlugin, BadSetting) as error:
        return failed("broken", error)
    begun = perf_counter()
    try:
        return _judged(problem, scene, _asked(planner, problem, scene), begun)
    except NoPath as error:
        return failed("no_path", error)
    except NotFound as error:
        return failed("not_found", error)
    except TimedOut as error:
        return failed("timed_out", error)
    except NotFree as error:
        return failed("not_free", error)
    except (BadSetting, UnknownTask) as error:
        return failed("refused", error)
    except KeyboardInterrupt:
        raise
    # Not Exception alone: a plug-in may call sys.exit, and a panic in Rust is a BaseException.
    except BaseException as error:
        return failed("broken", f"{type(error).__name__}: {error}")


def _asked(planner: PlannerPlugin, problem: Problem, scene: Scene) -> Any:
    return planner(
        scene,
        problem.task,
        seed=problem.seed,
        timeout=problem.timeout_s,
        budget=problem.budget,
        objective=problem.objective,
        **problem.settings,
    )


def _judged(problem: Problem, scene: Scene, answer: Any, begun: float) -> Row:
    asked = perf_counter()
    if isinstance(answer, Plan) and answer.verdict is not None:
        motion, verdict, stages = answer.motion, answer.verdict, dict(answer.timings)
        evaluations, convergence = answer.evaluations, answer.convergence
    elif isinstance(answer, Proposal):
        stages = {str(stage): float(seconds) for stage, seconds in answer.timings.items()}
        evaluations, convergence = answer.evaluations, answer.convergence
        try:
            motion, verdict = _verified(scene, answer)
        except (TrajectoryError, TypeError, ValueError) as error:
            return Row.failed(problem, "no_motion", str(error), time_s=perf_counter() - begun)
        stages["verdict"] = perf_counter() - asked
    else:
        message = f"the planner returned {type(answer).__name__}, not a Proposal"
        return Row.failed(problem, "no_motion", message, time_s=perf_counter() - begun)
    spent = perf_counter() - begun
    measured = lengths(scene, motion)
    cost = measured.by(problem.objective)
    nearest = verdict["least_clearance"]
    bound = None if answer.lower_bound is None else _finite(answer.lower_bound, "lower_bound")
    known: dict[str, Any] = {
        "found": True,
        "safe": bool(verdict["safe"]),
        "cost": cost,
        "tip_length_m": measured.tip,
        "joint_travel_rad": measured.joint,
        "duration_s": measured.time,
        "least_clearance_m": None if nearest is None else nearest["distance"],
        "evaluations": None if evaluations is None else int(evaluations),
        "lower_bound": bound,
        "gap": None if bound is None else 0.0 if cost == 0.0 else cost / bound - 1.0 if bound > 0.0 else None,
        "stages_s": _finite_stages(stages),
        "convergence": _curve(convergence),
    }
    if not verdict["safe"]:
        reasons = "; ".join(violation["message"] for violation in verdict["violations"][:2])
        return Row.failed(problem, "unsafe", reasons, time_s=spent, **known)
    if missed := misses(scene, problem.task, motion, verdict):
        return Row.failed(problem, "wrong_end", missed, time_s=spent, **known)
    return Row.after(problem, success=True, time_s=spent, **known)


def _verified(scene: Scene, answer: Proposal) -> tuple[Motion, Verdict]:
    t, q, v, a = (
        None if x is None else np.asarray(x, dtype=np.float64) for x in (answer.t, answer.q, answer.v, answer.a)
    )
    assert t is not None
    assert q is not None
    judged = check(scene, t=t, q=q, v=v, a=a)
    return judged.motion, judged.verdict


def _finite(value: Any, name: str) -> float:
    number = float(value)
    if not math.isfinite(number):
        raise ValueError(f"{name} is {number}")
    return number


def _finite_stages(stages: Mapping[str, Any]) -> dict[str, float]:
    return {stage: _finite(seconds, f"time of stage {stage}") for stage, seconds in stages.items()}


def _curve(convergence: Sequence[tuple[int, float]] | None) -> list[list[float]] | None:
    if convergence is None:
        return None
    return [[int(evaluations), _finite(cost, "cost in convergence")] for evaluations, cost in convergence]
