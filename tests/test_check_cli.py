"""``elbowroom check``: what it says of trajectories that are not whole, and its exit codes."""

from __future__ import annotations

import json
import math
from pathlib import Path

import pytest
from typer.testing import CliRunner, Result

from elbowroom._cli.main import app

CELL = """\
elbowroom: 1
units: {length: m, angle: UNIT}
arm:
  links: [0.3, 0.25]
  joints: [{min: -LIMIT, max: LIMIT}, {min: -LIMIT, max: LIMIT}]
  half_width: 0.03
grid: {x: [-0.55, 0.55], y: [-0.55, 0.55], step: 0.01}
obstacles: [{circle: {center: [0.45, 0.3], radius: 0.05}, name: post}]
"""
ONE = "joint_names: [j1, j2]\npoints: [{positions: [-1.0, 0.5], time_from_start: {sec: 2}}]\n"
GOOD = """\
joint_names: [j1, j2]
points:
  - {positions: [-0.5, 0.5], time_from_start: {sec: 0}}
  - {positions: [-0.9, 0.5], time_from_start: {sec: 1}}
"""
BAD = GOOD.replace("-0.9", "1.5")
MOVING = GOOD.replace("[-0.5, 0.5]", "[-0.5, 0.5], velocities: [0, 0]").replace(
    "[-0.9, 0.5]", "[-0.9, 0.5], velocities: [-1, 0]"
)


def check(folder: Path, text: str, *options: str, unit: str = "rad") -> Result:
    scene, file = folder / "cell.yaml", folder / "t.yaml"
    scene.write_text(CELL.replace("UNIT", unit).replace("LIMIT", "2.5" if unit == "rad" else "143"))
    file.write_text(text)
    return CliRunner().invoke(app, ["check", str(scene), str(file), *options])


def test_one_point_needs_a_start(tmp_path: Path) -> None:
    alone = check(tmp_path, ONE)
    assert alone.exit_code == 2
    assert "one point is no motion" in alone.stderr
    assert "--from Q1,Q2" in alone.stderr
    assert check(tmp_path, ONE, "--from", "-0.5,0.5").exit_code == 0
    assert check(tmp_path, ONE, "--from", "1.5,0.5").exit_code == 4


@pytest.mark.parametrize("unit", ["rad", "deg"])
def test_the_start_is_in_the_unit_of_the_scene(tmp_path: Path, unit: str) -> None:
    first = GOOD.replace("sec: 1", "sec: 2").replace("sec: 0", "sec: 1")
    values = (-0.25, 0.5) if unit == "rad" else (math.degrees(-0.25), math.degrees(0.5))
    judged = check(tmp_path, first, "--from", ",".join(map(repr, values)), "--json", unit=unit)
    assert judged.exit_code == 0
    # A quarter of a radian in the first second.
    assert json.loads(judged.stdout)["motion_margins"][0]["velocity"]["largest"] == pytest.approx(0.4)
    assert check(tmp_path, GOOD, "--from", ",".join(map(repr, values)), unit=unit).exit_code == 2


@pytest.mark.parametrize("start", ["", "1", "1,2,3", "1_0,2", "nan,0", "a,b", "0x1,0"])
def test_a_start_that_is_none_is_refused(tmp_path: Path, start: str) -> None:
    refused = check(tmp_path, ONE, "--from", start)
    assert refused.exit_code == 2
    assert f"--from is '{start}'; 2 numbers are needed, Q1,Q2,... base first" in refused.stderr


def test_a_late_first_row_is_not_safe(tmp_path: Path) -> None:
    late = check(tmp_path, GOOD.replace("sec: 1", "sec: 3").replace("sec: 0", "sec: 2"))
    assert late.exit_code == 4
    assert late.stdout.splitlines()[1].startswith(
        "NOT SAFE: how the arm gets to the first row in the 2.000 s before it"
    )


def test_a_motion_that_goes_on_is_not_safe_unless_asked_for(tmp_path: Path) -> None:
    moving = check(tmp_path, MOVING)
    assert moving.exit_code == 4
    assert "joint 1 does not come to rest where the motion ends" in moving.stdout
    asked = check(tmp_path, MOVING, "--open-end")
    assert asked.exit_code == 0
    assert "what comes before and after was not judged" in asked.stdout


def test_all_messages_are_judged(tmp_path: Path) -> None:
    both = check(tmp_path, f"{GOOD}---\n{BAD}")
    assert both.exit_code == 4
    assert ", message 1 of 2: " in both.stdout
    assert ", message 2 of 2: " in both.stdout
    assert both.stdout.splitlines()[-1] == "how the arm gets from one message to the next was not judged"
    told = json.loads(check(tmp_path, f"{GOOD}---\n{BAD}", "--json").stdout)
    assert told["safe"] is False
    assert [(message["message"], message["safe"]) for message in told["messages"]] == [(1, True), (2, False)]
    assert check(tmp_path, f"{GOOD}---\n{BAD}", "--message", "1").exit_code == 0
    assert check(tmp_path, f"{GOOD}---\n{BAD}", "--message", "2").exit_code == 4
    missing = check(tmp_path, GOOD, "--message", "2")
    assert (missing.exit_code, "holds 1, counted from 1" in missing.stderr) == (2, True)


def test_joints_are_named_once(tmp_path: Path) -> None:
    twice = check(tmp_path, GOOD, "--joints", "j1,j1")
    assert (twice.exit_code, "joints names 'j1' twice" in twice.stderr) == (2, True)
    three = GOOD.replace("[j1, j2]", "[lift, j1, j2]").replace("positions: [", "positions: [0.1, ")
    named = check(tmp_path, three, "--joints", "j1,j2")
    assert named.exit_code == 0
    assert "  joints of the file that are not the arm's, left out: lift" in named.stdout.splitlines()
    assert json.loads(check(tmp_path, three, "--joints", "j1,j2", "--json").stdout)["notes"] == [
        "joints of the file that are not the arm's, left out: lift"
    ]


def test_a_table_has_its_joints_by_number(tmp_path: Path) -> None:
    check(tmp_path, GOOD)
    table = tmp_path / "t.csv"
    table.write_text("time_s,q1_rad,q2_rad\n0,-0.5,0.5\n1,-0.9,0.5\n")
    refused = CliRunner().invoke(app, ["check", str(tmp_path / "cell.yaml"), str(table), "--joints", "q1,q2"])
    assert (refused.exit_code, "a CSV has its joints by number" in refused.stderr) == (2, True)
