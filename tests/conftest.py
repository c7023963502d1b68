from __future__ import annotations

import math
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
