"""The judge of times along a path, against closed forms."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest

import elbowroom as er
from bench.joint_path import Derivatives, Floats, along, of_motion
from bench.least_time import bound, timed
from bench.motion_limits import limits_of, with_limits

LIMITS = np.array([[1.5, 2.0], [3.0, 4.0], [12.0, 16.0]])
TRAVELS = (0.02, 0.5, 1.0, 3.0)
"""Of which jerk alone, acceleration, velocity for a moment, and velocity decide."""


def from_rest_to_rest(shape: Callable[[Floats], tuple[Floats, ...]]) -> Derivatives:
    """The derivatives of a curve by a parameter in which it is run through from rest to rest.

    ``shape`` has the curve's first three derivatives by s, which goes from 0 to 1 as a quintic does.
    """

    def derivatives(u: Floats) -> tuple[Floats, Floats, Floats]:
        u = u[:, None]
        s = u**3 * (10.0 - 15.0 * u + 6.0 * u**2)
        one, two, three = 30.0 * (u - u**2) ** 2, 60.0 * u - 180.0 * u**2 + 120.0 * u**3, 60.0 - 360.0 * (u - u**2)
        first, second, third = shape(s)
        return (
            first * one,
            second * one**2 + first * two,
            third * one**3 + 3.0 * second * one * two + first * three,
        )

    return derivatives


def line(*travels: float) -> Derivatives:
    zero = np.zeros(len(travels))
    return from_rest_to_rest(lambda s: (np.array(travels) + 0.0 * s, zero + 0.0 * s, zero + 0.0 * s))


def arc(radius: float, angle: float) -> Derivatives:
    def shape(s: Floats) -> tuple[Floats, ...]:
        cosine, sine = np.cos(angle * s), np.sin(angle * s)
        return (
            radius * angle * np.hstack([-sine, cosine]),
            -radius * angle**2 * np.hstack([cosine, sine]),
            radius * angle**3 * np.hstack([sine, -cosine]),
        )

    return from_rest_to_rest(shape)


def rest_to_rest(travel: float, velocity: float, acceleration: float, jerk: float) -> float:
    """The least time of one joint: jerk up, none, down, none, and the same back."""

    def speeding_up(speed: float) -> float:
        brief = speed <= acceleration**2 / jerk
        return 2.0 * math.sqrt(speed / jerk) if brief else speed / acceleration + acceleration / jerk

    low, high = 0.0, velocity
    if speeding_up(velocity) * velocity <= travel:
        return speeding_up(velocity) + travel / velocity
    for _ in range(100):
        speed = (low + high) / 2.0
        low, high = (speed, high) if speeding_up(speed) * speed < travel else (low, speed)
    return 2.0 * speeding_up(low)


@pytest.mark.parametrize("travel", TRAVELS)
def test_a_straight_line_takes_what_its_slowest_joint_does(travel: float) -> None:
    pytest.importorskip("casadi", reason="casadi is not installed")
    path = along(line(travel, 0.6 * travel), np.linspace(0.0, 1.0, 201))
    assert timed(path, LIMITS).duration == pytest.approx(rest_to_rest(travel, *LIMITS[:, 0]), rel=3e-3)


def test_a_finer_grid_is_nearer() -> None:
    pytest.importorskip("casadi", reason="casadi is not installed")
    exact = rest_to_rest(1.0, *LIMITS[:, 0])
    off = [abs(timed(along(line(1.0, 0.6), np.linspace(0.0, 1.0, n + 1)), LIMITS).duration - exact) for n in (50, 200)]
    assert off[1] < off[0] / 3.0


def test_the_parameter_of_a_path_does_not_matter() -> None:
    pytest.importorskip("casadi", reason="casadi is not installed")
    even = np.linspace(0.0, 1.0, 401)
    curve = arc(0.8, 2.0)

    def bent(u: Floats) -> tuple[Floats, Floats, Floats]:
        """The same by w, where u = w + w² (1 - w) / 2."""
        first, second, third = curve(u + u**2 * (1.0 - u) / 2.0)
        one, two, three = (1.0 + u - 1.5 * u**2)[:, None], (1.0 - 3.0 * u)[:, None], -3.0
        return (
            first * one,
            second * one**2 + first * two,
            third * one**3 + 3.0 * second * one * two + first * three,
        )

    times = [timed(along(of, even), LIMITS).duration for of in (curve, bent)]
    assert times[0] == pytest.approx(times[1], rel=2e-3)
    assert bound(along(curve, even), LIMITS) < times[0]


@pytest.mark.parametrize("travel", TRAVELS)
def test_the_bound_is_the_least_time_without_jerk_limits(travel: float) -> None:
    velocity, acceleration, _ = LIMITS[:, 0]
    path = along(line(travel, 0.6 * travel), np.linspace(0.0, 1.0, 201))
    reached = math.sqrt(acceleration * travel)
    exact = 2.0 * reached / acceleration if reached <= velocity else travel / velocity + velocity / acceleration
    assert bound(path, LIMITS) == pytest.approx(exact, rel=1e-3)


def test_the_bound_knows_that_bends_ask_for_acceleration() -> None:
    """Many turns of a small circle: an even speed is possible, and no speed takes more than both joints have."""
    acceleration, radius, turns = 4.0, 0.1, 200.0
    limits = np.array([[9.0, 9.0], [acceleration, acceleration], [1e9, 1e9]])
    path = along(arc(radius, math.tau * turns), np.linspace(0.0, 1.0, 40_001))
    even = math.tau * radius * turns / math.sqrt(radius * acceleration)
    assert even / 2.0**0.25 < bound(path, limits) < even


def test_a_path_that_does_not_come_to_rest_is_refused() -> None:
    pytest.importorskip("casadi", reason="casadi is not installed")
    straight = along(lambda u: (1.0 + 0.0 * u, 0.0 * u, 0.0 * u), np.linspace(0.0, 1.0, 11))
    with pytest.raises(ValueError, match="rest"):
        timed(straight, LIMITS[:, :1])


def test_the_path_of_a_motion_has_the_motion_s_own_derivatives(standin: er.Scene) -> None:
    motion = er.plan(standin, task="first", objective="joint").motion
    path = of_motion(motion, 3)
    middle = path.u[1::3]
    _, v, a, j = motion.sample(np.ascontiguousarray(middle))
    first, second = path.at_nodes
    assert first[1::3] == pytest.approx(v, abs=1e-9)
    assert second[1::3] == pytest.approx(a, abs=1e-8)
    assert path.third[1::3, 0] == pytest.approx(j, abs=1e-6)
    assert bound(path, limits_of(standin)) < motion.duration


def test_missing_limits_are_those_that_planners_assume(standin: er.Scene) -> None:
    assert limits_of(standin)[:, 0] == pytest.approx(np.radians([90.0, 180.0, 720.0]))
    plan = er.plan(standin, task="first", objective="time")
    assert len(plan.assumed_limits) == 6
    assert (limits_of(with_limits(standin)) == limits_of(standin)).all()
    assert all(joint.jerk is not None for joint in with_limits(standin).arm.joints)
