"""A plan is asked for within its motion, and a check or verdict is as true as it is safe."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import elbowroom as er


@pytest.fixture(scope="module")
def plan() -> er.Plan:
    return er.plan(er.Scene.example("paper-standin"), task="first")


@pytest.mark.parametrize(
    ("t", "words"),
    [
        (math.nan, "t is nan s; the motion lasts from 0 to"),
        (-1.0, "t is -1.0 s; the motion lasts from 0 to"),
        (1e9, "t is 1000000000.0 s"),
        (-math.inf, "t is -inf s"),
        ([0.0, 1.0, math.nan], r"t\[2\] is nan s"),
        (np.array([0.0, -1e-6]), r"t\[1\] is -1e-06 s"),
        ([[0.0]], r"t has shape \(1, 1\)"),
        (1j, "t holds complex numbers"),
        (True, "t holds True and False"),
        ("0", "t holds text"),
        (None, "t holds objects"),
        (np.ma.masked_array([0.0, 1.0], mask=[0, 1]), "t is a masked array"),
    ],
)
def test_instants_that_are_none_of_the_motion_are_refused(plan: er.Plan, t: Any, words: str) -> None:
    for of in (plan, er.plan_as_in_paper(plan.scene, task="first")):
        with pytest.raises(ValueError, match=words) as caught:
            of.at(t)
        assert isinstance(caught.value, er.BadSetting)
        assert caught.value.setting == "t"


def test_instants_within_the_motion_are_answered(plan: er.Plan) -> None:
    end = plan.motion.duration
    assert plan.at(0).q.shape == (1, 2)
    np.testing.assert_array_equal(plan.at([0, end]).q, plan.sample(period=end).q)
    # Sums of steps are off by a last digit.
    np.testing.assert_array_equal(plan.at(end + 1e-12).q, plan.at(end).q)
    assert len(plan.at([]).t) == 0


def test_more_samples_than_fit_are_refused_before_any_is_taken(plan: er.Plan) -> None:
    with pytest.raises(er.BadSetting, match="would have more than 10000000 samples"):
        plan.sample(period=1e-12)


def test_a_check_is_as_true_as_it_is_safe() -> None:
    scene = er.Scene.example("paper-standin")
    for end, safe in ((0.01, True), (1.5, False)):
        judged = er.check(scene, t=[0.0, 5.0], q=[[0.0, 0.0], [end, 0.0]])
        assert bool(judged) is judged.safe is bool(judged.verdict) is judged.verdict.safe is safe
