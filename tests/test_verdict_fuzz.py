"""What is called safe, an independent judge of dense samples does not deny: some cases of ``fuzz.verdicts``."""

from __future__ import annotations

from collections import Counter
from pathlib import Path

import numpy as np
import pytest

from fuzz import judge, verdicts

CASES = {"trajectories": 150, "scenes": 60}


@pytest.mark.parametrize("kind", verdicts.KINDS)
def test_nothing_called_safe_is_denied(kind: str, tmp_path: Path) -> None:
    answers: Counter[str] = Counter()
    for number in range(CASES[kind]):
        case = verdicts.run(kind, number, tmp_path)
        # How long a case took depends on the machine.
        assert [found for found in case.findings if not found.startswith("it took")] == [], (number, case.arguments)
        answers[case.answer] += 1
    assert answers["safe" if kind == "trajectories" else "planned"] > CASES[kind] / 10
    assert answers["not safe, the judge agrees"] > (30 if kind == "trajectories" else -1)


SCENE = """\
elbowroom: 1
units: {length: cm, angle: deg}
arm:
  links: [30, 20]
  joints: [{min: -170, max: 170, velocity: 60, acceleration: 200, jerk: 2000}, {min: -150, max: 150, velocity: 60}]
  half_width: 1
grid: {x: [-50, 50], y: [-50, 50], step: 1}
obstacles:
  - circle: {center: [0, 45], radius: 3}
  - polygon: [[-46, 1], [-40, 1], [-40, 5], [-46, 5]]
  - segment: {from: [20, -60], to: [20, -30], radius: 1}
    motion: {waypoints: [{time: 0, shift: [0, 0]}, {time: 2, shift: [0, 15]}]}
"""
MARGIN = {"open_end": False, "message": None, "margin": 0.0, "names": None, "start": None}


@pytest.mark.parametrize(
    ("rows", "said"),
    [
        ("0,0,0,0,0,0,0\n2,1,0,0,0,0,0\n", ""),
        ("0,0,0,0,0,0,0\n3,2,0,0,0,0,0\n", "clearance"),
        ("0,3,-0.5,0,0,0,0\n2,2.9,0.5,0,0,0,0\n", "clearance"),
        ("0,-0.5,-0.5,0,0,0,0\n3,-0.6,-1,0,0,0,0\n", "clearance"),
        ("0,0,0,0,0,0,0\n2,0,2.65,0,0,0,0\n", "joint 2 between"),
        ("0,0,0,0,0,0,0\n1,1,0,0,0,0,0\n", "velocity of joint 1"),
        ("0,0,0,0,0,0,0\n0.9,0.5,0,0,0,0,0\n", "acceleration of joint 1"),
        ("0,0,0,0,0,0,0\n0.55,0.15,0,0,0,0,0\n", "jerk of joint 1"),
        ("0,0,0,0.2,0,0,0\n2,0.5,0,0,0,0,0\n", "joint 1 begins at"),
        ("0,0,0,0,0,0,0\n2,0.5,0,0,0.2,0,0\n", "joint 2 ends at"),
    ],
)
def test_the_judge_sees_what_is_wrong(rows: str, said: str) -> None:
    text = "time_s,q1_rad,q2_rad,v1_rad_s,v2_rad_s,a1_rad_s2,a2_rad_s2\n" + rows
    found = judge.of_file(judge.World.read(SCENE), text, kind="csv", **MARGIN)  # type: ignore[arg-type]
    assert any(said in line for line in found) if said else found == []


def test_the_judge_sees_jumps_of_a_motion() -> None:
    pieces = judge.Pieces(
        starts=[0.0, 1.0],
        durations=[1.0, 1.0],
        coefficients=[np.array([[0.0, 0.0, 0.1], [0.0, 0.0, 0.0]]), np.array([[0.1, -0.1, 0.0], [0.01, 0.0, 0.0]])],
    )
    found = judge.against(judge.World.read(SCENE), pieces, open_end=True)
    assert any("derivative 0 of joint 2 jumps" in line for line in found)
    assert any("derivative 1 of joint 1 jumps" in line for line in found)
