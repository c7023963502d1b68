"""A verdict in words names what was judged and what was not; a plan claims no limits that it does not keep."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

import elbowroom as er
from elbowroom._cli.plan_text import in_words, verdict_lines


def limited(scene: er.Scene, *limits: dict[str, float]) -> er.Scene:
    joints = tuple(joint.replace(**of) for joint, of in zip(scene.arm.joints, limits, strict=True))
    return scene.replace(arm=scene.arm.replace(joints=joints))


def said_of(scene: er.Scene, *, open_end: bool = False) -> list[str]:
    q = np.zeros((2, len(scene.arm.joints)))
    q[:, 0] = 2.5, 2.6
    rest = np.zeros_like(q)
    judged = er.check(scene.replace(obstacles=()), t=[0.0, 1.0], q=q, v=rest, a=rest, open_end=open_end)
    assert judged.safe
    return verdict_lines(judged.verdict, scene, open_end=open_end)


def test_limits_that_are_not_stated_are_said_not_to_be_judged(standin: er.Scene) -> None:
    said = said_of(standin)
    assert said[0] == "SAFE: proved for the whole motion, in all that was judged"
    assert said[-2] == "  judged: contact with obstacles, joint limits"
    # 0.1 rad in a second as a quintic from rest to rest: 15/8, 10/sqrt(3) and 60 times that.
    assert said[-1] == (
        "  NOT judged, as the scene states no limits: velocity (up to 0.188 rad/s), acceleration (up to 0.577 rad/s²), "
        "jerk (up to 6.00 rad/s³)"
    )
    one = said_of(limited(standin, {"velocity": 3.0, "jerk": 90.0}, {"jerk": 90.0}))
    assert one[-2] == "  judged: contact with obstacles, joint limits, velocity of joint 1, jerk"
    assert "no limits: velocity of joint 2, acceleration (up to" in one[-1]
    every = {"velocity": 3.0, "acceleration": 12.0, "jerk": 90.0}
    whole = said_of(limited(standin, every, every))
    assert whole[-2] == (
        "  greatest rates, against their limits: velocity 0.188 of 3 rad/s (joint 1), acceleration 0.577 of 12 rad/s² "
        "(joint 1), jerk 6.00 of 90 rad/s³ (joint 1)"
    )
    assert whole[0] == "SAFE: proved for the whole motion"
    assert whole[-1] == "  judged: contact with obstacles, joint limits, velocity, acceleration, jerk"


def test_what_open_ends_leave_open_is_said(standin: er.Scene) -> None:
    assert said_of(standin, open_end=True)[0] == (
        "SAFE: proved from the first row to the last; what comes before and after was not judged"
    )


@pytest.mark.parametrize("asked", [True, False])
def test_links_that_are_not_kept_apart_are_said(chain: Callable[..., er.Scene], asked: bool) -> None:
    said = "\n".join(said_of(chain(3, self_collision=asked)))
    assert ("NOT judged, as the scene does not ask for it (arm.self_collision): contact between links" in said) != asked
    assert ("joint limits, contact between links" in said) == asked


def test_a_late_first_row_is_said_in_the_first_line(standin: er.Scene) -> None:
    late = er.check(standin, t=[2.0, 4.0], q=[[2.5, 0.0], [2.6, 0.0]])
    first = verdict_lines(late.verdict, standin)[0]
    assert first.startswith(
        "NOT SAFE: how the arm gets to the first row in the 2.000 s before it was not judged; say where"
    )


def test_assumed_limits_are_claimed_only_where_they_are_kept(standin: er.Scene) -> None:
    fastest = er.plan(standin, task="first")
    assert {rate for _, rate, _ in fastest.assumed_limits} == {"velocity", "acceleration", "jerk"}
    assert "planned within assumed limits, as the scene states none: velocity 1.5708 rad/s" in in_words(fastest)
    hurried = er.plan(standin, task="first", duration=0.5)
    margins = hurried.verdict.motion_margins
    assert min(margin.jerk.largest for margin in margins) > 4.0 * np.pi
    assert hurried.assumed_limits == []
    said = in_words(hurried)
    assert "assumed" not in said
    assert "NOT judged, as the scene states no limits: velocity (up to " in said
    # Some are kept and some are not.
    brisk = er.plan(standin, task="first", duration=0.8 * fastest.motion.duration)
    for joint, rate, value in brisk.assumed_limits:
        assert getattr(brisk.verdict.motion_margins[joint - 1], rate).largest <= value * (1 + 1e-9)
    assert len(brisk.assumed_limits) < 6
