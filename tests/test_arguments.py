"""Arguments of the wrong type: one line with the argument, what was given and what is needed."""

from __future__ import annotations

import pickle
import traceback
from collections.abc import Callable
from typing import Any

import pytest

import elbowroom as er

Call = Callable[[Any], object]

SCENE = er.Scene.example("moving-one")

WRONG: dict[str, tuple[Call, object]] = {
    "scene is 'x'; Scene is needed": (lambda scene: er.plan(scene, task="first"), "x"),
    "scene is 1; Scene is needed": (er.free_space, 1),
    "scene is 2; Scene is needed": (er.Replanner, 2),
    "scene is 3; Scene is needed": (er.World, 3),
    "scene is 4; Scene is needed": (lambda scene: er.check(scene, t=[0, 1], q=[[0, 0], [1, 1]]), 4),
    "scene is 5; Scene is needed": (lambda scene: er.check_file(scene, "none.csv"), 5),
    "scene is None; Scene is needed": (lambda scene: er.check_messages(scene, "none.csv"), None),
    "task is 3; a str or None is needed": (lambda task: er.plan(SCENE, task=task), 3),
    "timeout is 'soon'; a number or None is needed": (lambda timeout: er.plan(SCENE, timeout=timeout), "soon"),
    "timeout is '9'; a number or None is needed": (lambda timeout: er.free_space(SCENE, timeout=timeout), "9"),
    "text is b'x'; a str is needed": (er.Scene.parse, b"x"),
    "name is 7; a str is needed": (er.Scene.example, 7),
    "radius is [1]; a number is needed": (lambda radius: er.Circle(center=(0, 0), radius=radius), [1]),
    "center is (0, 0, 0); a pair of numbers is needed": (lambda center: er.Circle(center=center, radius=1), (0, 0, 0)),
    "motion is 1; ObstacleMotion or None is needed": (
        lambda motion: er.Segment(start=(0, 0), end=(1, 0), motion=motion),
        1,
    ),
    "vertices is [1]; a list of (x, y) is needed": (lambda vertices: er.Polygon(vertices=vertices), [1]),
    "min is '1'; a number or None is needed": (lambda least: er.Joint(min=least), "1"),
    "continuous is 1; True or False is needed": (lambda continuous: er.Joint(continuous=continuous), 1),
    "q is 0.5; a list of numbers is needed": (er.Configuration, 0.5),
    "step is None; a number is needed": (lambda step: er.Grid(x=(0, 1), y=(0, 1), step=step), None),
    "length is 1; a str is needed": (lambda length: er.Units(length=length), 1),
    "waypoints is [1]; a list of (time, (x, y)) or None is needed": (
        lambda waypoints: er.ObstacleMotion(waypoints=waypoints),
        [1],
    ),
    "radius is of type list; a number is needed": (lambda radius: er.Circle(center=(0, 0), radius=radius), [0] * 99),
}


@pytest.mark.parametrize("words", WRONG)
def test_the_argument_is_named_in_one_line(words: str) -> None:
    call, value = WRONG[words]
    with pytest.raises(TypeError) as raised:
        call(value)
    assert traceback.format_exception_only(raised.value) == [f"TypeError: {words}\n"]


def test_a_wrong_type_is_pickled_as_a_type_error_and_takes_notes() -> None:
    with pytest.raises(TypeError) as raised:
        er.Circle(center=(0, 0), radius="x")  # type: ignore[arg-type]
    again = pickle.loads(pickle.dumps(raised.value))
    assert type(again) is TypeError
    assert str(again) == "radius is 'x'; a number is needed"
    raised.value.add_note("of the first obstacle")
    assert raised.value.__notes__ == ["of the first obstacle"]
    assert str(raised.value) == "radius is 'x'; a number is needed"


def test_what_fails_in_a_value_itself_comes_through() -> None:
    class Broken:
        def __float__(self) -> float:
            raise RuntimeError("no sensor")

    with pytest.raises(RuntimeError, match=r"^no sensor"):
        er.Circle(center=(0, 0), radius=Broken())  # type: ignore[arg-type]
