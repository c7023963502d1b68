from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path

import pytest

import elbowroom as er

ROOT = Path(__file__).parent.parent
CIRCLES = ((0.22, 0.22), (-0.08, 0.4), (-0.38, 0.18), (-0.2, -0.42), (0.38, -0.14))


@pytest.fixture
def scenes() -> Path:
    return ROOT / "scenes"


@pytest.fixture
def standin() -> er.Scene:
    """The scene of ``scenes/paper-standin.yaml``, built in code."""
    bend = math.radians(150)
    return er.Scene(
        arm=er.Arm(links=(0.25, 0.25), joints=(er.Joint(continuous=True), er.Joint(min=-bend, max=bend))),
        grid=er.Grid(x=(-0.5, 0.5), y=(-0.5, 0.5), step=0.01),
        obstacles=tuple(er.Circle(center=center, radius=0.05) for center in CIRCLES),
        tasks={
            "first": er.Task(start=(0.4, 0.1), goal=(-0.45, -0.15)),
            "second": er.Task(start=(0.3, -0.3), goal=(0.15, 0.45)),
        },
    )


@pytest.fixture
def chain() -> Callable[..., er.Scene]:
    """A scene whose arm has as many links as asked for, half a metre in all, swinging between two obstacles."""

    def made(links: int, *, half_width: float = 0.004, self_collision: bool = True) -> er.Scene:
        bend = math.radians(150)
        bending = er.Joint(min=-bend, max=bend, velocity=2.0, acceleration=6.0)
        arm = er.Arm(
            links=(0.5 / links,) * links,
            joints=(er.Joint(continuous=True, velocity=2.0), *(bending,) * (links - 1)),
            half_width=half_width,
            base=(0.02, -0.03),
            self_collision=self_collision,
        )
        start = er.Configuration((0.3, *(0.9 / links,) * (links - 1)))
        goal = er.Configuration((2.2, *(-1.6 / links,) * (links - 1)))
        return er.Scene(
            arm=arm,
            grid=er.Grid(x=(-0.55, 0.55), y=(-0.55, 0.55), step=0.01),
            obstacles=[
                er.Circle(center=(0.45, -0.15), radius=0.06, name="post"),
                er.Polygon(vertices=[(-0.4, 0.1), (-0.25, 0.15), (-0.35, 0.3)]),
            ],
            tasks={"go": er.Task(start=start, goal=goal)},
        )

    return made


@pytest.fixture
def planned() -> Callable[[er.Scene], er.Plan]:
    """The plan for the task ``go`` of a scene, for an arm of any number of links."""

    def made(scene: er.Scene) -> er.Plan:
        return er.plan(scene, task="go", objective="time")

    return made
