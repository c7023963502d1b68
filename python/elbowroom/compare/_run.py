"""Runs one planner once, and makes a row of whatever becomes of it."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from time import perf_counter
from typing import Any

from elbowroom._core import Check, Plan, gap, interpolated, mismatch, verify
from elbowroom._errors import BadSetting, NoPath, NotFound, NotFree, TimedOut, TrajectoryError, UnknownTask
from elbowroom._plugins import BrokenPlugin, PlannerPlugin, Proposal, rows_of
from elbowroom._scene import Scene
from elbowroom.compare._measure import lengths
from elbowroom.compare._row import Failure, Problem, Row
from elbowroom.planners import OwnPlanner, load


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
        answer = _asked(planner, problem, scene)
        return _judged(problem, scene, answer, begun, own=isinstance(planner, OwnPlanner))
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


def _judged(problem: Problem, scene: Scene, answer: Any, begun: float, *, own: bool) -> Row:
    asked = perf_counter()
    if not isinstance(answer, Plan | Proposal):
        message = f"the planner returned {type(answer).__name__}, not a Proposal"
        return Row.failed(problem, "no_motion", message, time_s=perf_counter() - begun)
    stages = {str(stage): float(seconds) for stage, seconds in answer.timings.items()}
    if own and isinstance(answer, Plan):
        motion, verdict = answer.motion, answer.verdict
    else:
        try:
            judged = _verified(scene, answer, scene.tasks[problem.task].clearance)
        except (TrajectoryError, TypeError, ValueError) as error:
            return Row.failed(problem, "no_motion", str(error), time_s=perf_counter() - begun)
        motion, verdict = judged.motion, judged.verdict
        stages["verdict"] = perf_counter() - asked
    spent = perf_counter() - begun
    measured = lengths(scene, motion)
    cost = measured.by(problem.objective)
    nearest = verdict.least_clearance
    bound = None if answer.lower_bound is None else _finite(answer.lower_bound, "lower_bound")
    if isinstance(answer, Plan) and (answer.objective != problem.objective or answer.scene != scene):
        # A bound on something else.
        bound = None
    false_bound = bound is not None and bound > cost * (1.0 + ROUNDING)
    known: dict[str, Any] = {
        "found": True,
        "safe": verdict.safe,
        "cost": cost,
        "tip_length_m": measured.tip,
        "joint_travel_rad": measured.joint,
        "duration_s": measured.time,
        "least_clearance_m": None if nearest is None else nearest.distance,
        "evaluations": None if answer.evaluations is None else int(answer.evaluations),
        "lower_bound": bound,
        "gap": None if bound is None or false_bound else gap(cost, bound),
        "stages_s": _finite_stages(stages),
        "convergence": _curve(answer.convergence),
    }
    if not verdict.safe:
        reasons = "; ".join(violation.message for violation in verdict.violations[:2])
        return Row.failed(problem, "unsafe", reasons, time_s=spent, **known)
    if missed := mismatch(scene, problem.task, motion, verdict.posture_changes):
        return Row.failed(problem, "wrong_end", missed, time_s=spent, **known)
    if false_bound:
        message = f"the planner claims that no motion costs less than {bound:.9g}; its own costs {cost:.9g}"
        return Row.failed(problem, "broken", message, time_s=spent, **known)
    return Row.after(problem, success=True, time_s=spent, **known)


ROUNDING = 1e-6
"""By which share a bound may be above the cost as it is measured here, which is right to some digits only."""


def _verified(scene: Scene, answer: Plan | Proposal, margin: float) -> Check:
    """What the verifier says of ``answer`` in ``scene`` with ``margin`` (m) to keep, whatever it says of itself.

    A plan may be of another scene.
    """
    if isinstance(answer, Plan):
        return verify(scene, answer.motion, curve="quintic", margin=margin)
    t, q, v, a = rows_of(answer)
    motion, curve, _ = interpolated(t, q, v, a)
    # Whether it begins and ends where it should, at rest, is another question.
    return verify(scene, motion, curve=curve, margin=margin)


def _finite(value: Any, name: str) -> float:
    number = float(value)
    if not math.isfinite(number):
        raise ValueError(f"{name} is {number}")
    return number


def _finite_stages(stages: Mapping[str, Any]) -> dict[str, float]:
    return {stage: _finite(seconds, f"time of stage {stage}") for stage, seconds in stages.items()}


def _curve(convergence: Sequence[tuple[int, float]] | None) -> list[tuple[int, float]] | None:
    if convergence is None:
        return None
    return [(int(evaluations), _finite(cost, "cost in convergence")) for evaluations, cost in convergence]
