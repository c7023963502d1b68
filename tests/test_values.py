"""Plans, checks, verdicts and motions as values: compared, copied, pickled and shown."""

from __future__ import annotations

import copy
import json
import pickle
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import elbowroom as er

Chain = Callable[..., er.Scene]


@pytest.fixture
def plan(standin: er.Scene) -> er.Plan:
    return er.plan(standin, task="first", objective="time", seed=1)


def again(value: Any) -> list[Any]:
    kept = [pickle.loads(pickle.dumps(value, protocol)) for protocol in (2, pickle.HIGHEST_PROTOCOL)]
    return [*kept, copy.copy(value), copy.deepcopy(value)]


def test_they_survive_copies_and_pickles(standin: er.Scene, plan: er.Plan) -> None:
    samples = plan.sample()
    check = er.check(standin, t=samples.t, q=samples.q, v=samples.v, a=samples.a, margin=1e-4)
    touching = er.check(standin, t=[0.0, 10.0], q=[[0.0, 0.5], [3.0, 0.5]])
    assert check.safe
    assert not touching.safe
    for value in (plan, plan.verdict, plan.motion, check, check.verdict, touching, standin):
        for other in again(value):
            assert type(other) is type(value)
            assert other == value
    kept = pickle.loads(pickle.dumps(plan))
    assert kept.timings == plan.timings
    for name in (
        "settings",
        "cost",
        "lower_bound",
        "gap",
        "vias",
        "stops",
        "postures",
        "assumed_limits",
        "convergence",
    ):
        assert getattr(kept, name) == getattr(plan, name)
    np.testing.assert_array_equal(kept.tip_path, plan.tip_path)
    np.testing.assert_array_equal(kept.sample().q, samples.q)


@pytest.mark.parametrize("planner", ["dstar", "pso"])
def test_plans_of_every_arm_survive(chain: Chain, planner: str) -> None:
    scene = chain(2 if planner == "dstar" else 4)
    plan = er.plan(scene, planner=planner, objective="joint")
    assert pickle.loads(pickle.dumps(plan)) == plan


def test_equal_is_what_says_the_same(standin: er.Scene, plan: er.Plan) -> None:
    assert er.plan(standin, task="first", objective="time", seed=1) == plan
    assert er.plan(standin, task="second", objective="time", seed=1) != plan
    assert er.plan(standin.replace(obstacles=standin.obstacles[:4]), task="first", objective="time", seed=1) != plan
    linear, quintic = (er.check(standin, t=[0.0, 1.0], q=np.zeros((2, 2)), v=v, a=v) for v in (None, np.zeros((2, 2))))
    assert linear.verdict == quintic.verdict
    assert linear != quintic
    assert plan.verdict.least_clearance == plan.verdict.least_clearance
    assert plan.verdict != linear.verdict


def test_no_claim_is_taken_from_a_pickle(standin: er.Scene, plan: er.Plan) -> None:
    """Whatever is put together by hand is judged, and what does not hold raises."""
    restore, (scene, motion, kept) = plan.__reduce__()
    assert restore(scene, motion, kept) == plan
    starts, durations, coefficients = motion.starts, motion.durations, motion.coefficients.copy()
    coefficients[:, :, 1:] = 0.0
    stops_and_jumps = er.Motion(starts, durations, coefficients)
    with pytest.raises(
        er.Refuted, match=r"the plan was kept as safe; judged again, it is not: the position of"
    ) as caught:
        restore(scene, stops_and_jumps, kept)
    assert caught.value.verdict is not None
    assert not caught.value.verdict.safe
    blocked = standin.replace(obstacles=(*standin.obstacles, er.Circle(center=(0.4, 0.1), radius=0.03)))
    with pytest.raises(er.Refuted, match="touches"):
        restore(blocked, motion, kept)
    with pytest.raises(er.Refuted, match="kept with a cost of 1"):
        restore(scene, motion, {**kept, "cost": 1.0})
    with pytest.raises(er.Refuted, match="lower bound above"):
        restore(scene, motion, {**kept, "lower_bound": 2.0 * plan.cost})
    with pytest.raises(er.UnknownTask):
        restore(scene, motion, {**kept, "task": "third"})
    with pytest.raises(er.BadSetting):
        restore(scene, motion, {**kept, "configurations": [[0.0]]})

    restore, (_, motion, terms, safe) = plan.verdict.__reduce__()
    assert safe
    with pytest.raises(er.Refuted, match="touches"):
        restore(blocked, motion, terms, safe)
    assert not restore(blocked, motion, terms, False).safe
    for kind in (er.Plan, er.Check, er.Verdict, er.Violation, er.Clearance, er.PaperPlan):
        with pytest.raises(TypeError):
            kind()
    for value, name in ((plan, "cost"), (plan.verdict, "safe"), (plan.motion, "duration")):
        with pytest.raises(AttributeError):
            setattr(value, name, 0)
    for array in (plan.tip_path, plan.configurations, plan.motion.coefficients):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0.0


def test_a_motion_is_made_of_pieces_that_join() -> None:
    still = np.zeros((2, 3, 6))
    motion = er.Motion(np.array([0.0, 1.0]), np.array([1.0, 0.5]), still)
    assert (motion.duration, motion.end) == (1.5, 1.5)
    for starts, durations, coefficients, words in (
        ([0.0, 2.0], [1.0, 0.5], still, "piece 1 begins at 2 s"),
        ([0.0, 1.0], [1.0, -1.0], still, "lasts -1 s"),
        ([0.0, 1.0], [1.0, 0.5], still * np.nan, "not finite"),
        ([0.0], [1.0, 0.5], still, "1 starts, 2 durations"),
        ([0.0, 1.0], [1.0, 0.5], still[:, :, :5], r"\(pieces, joints, 6\)"),
        ([], [], still[:0], "at least one piece"),
    ):
        with pytest.raises(er.TrajectoryError, match=words):
            er.Motion(np.array(starts), np.array(durations), coefficients)


def test_a_replanners_verdict_is_not_pickled() -> None:
    replanner = er.Replanner(er.Scene.example("moving-one"))
    update = replanner.update(now=0.0, q=replanner.start)
    assert update.verdict
    assert copy.deepcopy(update.verdict) == update.verdict
    with pytest.raises(TypeError, match="cannot pickle a replanner's verdict"):
        pickle.dumps(update.verdict)


def test_they_are_shown_in_a_line(standin: er.Scene, plan: er.Plan) -> None:
    least = plan.verdict.least_clearance
    assert least is not None
    assert repr(plan.verdict) == f"<Verdict safe, least clearance {least.distance * 1e3:.4g} mm>"
    assert repr(plan).startswith(f"<Plan of task 'first' by dstar-pso: cost {plan.cost:.4g} s, gap ")
    touching = er.check(standin, t=[0.0, 10.0], q=[[0.0, 0.5], [3.0, 0.5]])
    assert repr(touching).startswith("<Check of a linear trajectory: not safe: contact at ")
    paper = er.plan_as_in_paper(standin, task="first")
    for value in (
        plan,
        paper,
        touching,
        plan.motion,
        least,
        touching.verdict.violations[0],
        *plan.verdict.motion_margins,
    ):
        assert len(repr(value)) < 200
        assert "\n" not in repr(value)


def test_verdicts_answer_and_turn_into_data(standin: er.Scene, plan: er.Plan) -> None:
    touching = er.check(standin, t=[0.0, 10.0], q=[[0.0, 0.5], [3.0, 0.5]])
    assert plan.verdict
    assert not touching
    assert not touching.verdict
    told = json.loads(json.dumps(touching.verdict.as_dict()))
    assert list(told) == [
        "safe",
        "violations",
        "floor",
        "least_clearance",
        "joint_margins",
        "motion_margins",
        "posture_changes",
        "unjudged",
        "allowed",
    ]
    first = touching.verdict.violations[0]
    assert told["violations"][0] == {
        "time": first.time,
        "message": first.message,
        "kind": "contact",
        "link": first.link,
        "obstacle": first.obstacle,
        "name": None,
        "depth": first.depth,
    }
    assert (first.joint, first.other_link, first.value, first.limit) == (None, None, None, None)


@pytest.mark.parametrize(("objective", "unit"), [("tip", "m"), ("joint", "rad"), ("time", "s")])
def test_costs_say_their_unit(standin: er.Scene, objective: Any, unit: str) -> None:
    plan = er.plan(standin, task="first", planner="dstar", objective=objective)
    assert plan.cost_unit == unit
    if unit == "s":
        assert plan.cost == plan.motion.duration


def test_not_found_says_at_which_resolution(scenes: Any) -> None:
    scene = er.Scene.load(scenes / "paper-table1.yaml")
    with pytest.raises(er.NotFound) as caught:
        er.plan(scene, task="first", planner="dstar")
    assert (caught.value.resolution, caught.value.unit) == (pytest.approx(0.01), "m")
    kept = pickle.loads(pickle.dumps(caught.value))
    assert (str(kept), kept.resolution, kept.unit) == (str(caught.value), caught.value.resolution, "m")


def test_the_papers_plan_is_no_plan(standin: er.Scene) -> None:
    paper = er.plan_as_in_paper(standin, task="first", seed=3)
    assert not isinstance(paper, er.Plan)
    assert (paper.planner, paper.task, paper.seed, paper.objective, paper.cost_unit) == (
        "dstar-pso",
        "first",
        3,
        "tip",
        "m",
    )
    assert paper.settings == {"mode": "paper", "vias": 5, "duration": 10.0, "candidates": 300}
    assert paper.scene is standin
