"""Texts are in the units of the scene, with digits that mean something, and obstacles count from 1."""

from __future__ import annotations

import json
import math
import pickle
import re
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

import elbowroom as er
from elbowroom._cli.length import metres
from elbowroom._cli.main import app
from elbowroom._cli.plan_text import in_words, verdict_lines

CELL = """elbowroom: 1
units: {length: mm, angle: deg}
arm:
  links: [300, 250]
  joints:
    - {min: -130, max: 130}
    - {min: -145, max: 145}
grid: {x: [-600, 600], y: [-600, 600], step: 20}
obstacles:
  - circle: {center: [300, 200], radius: 40}
  - {polygon: [[-150, -300], [-100, -300], [-100, -250]], name: feeder}
tasks:
  pick: {start: [400, -100], goal: [100, 400]}
"""

TOO_EXACT = re.compile(r"\d\.\d{5,}|\d{8,}")
LENGTH_IN_METRES = re.compile(r"\d m\b|\brad\b")


@pytest.fixture
def cell() -> er.Scene:
    return er.Scene.parse(CELL, file="cell.yaml")


def swing(scene: er.Scene, *, until: float, margin: float = 0.0) -> er.Verdict:
    """Joint 1 at an even pace from 0 to ``until`` (rad) in 5 s, joint 2 straight."""
    return er.check(scene, t=np.array([0.0, 5.0]), q=np.array([[0.0, 0.0], [until, 0.0]]), margin=margin).verdict


def test_a_contact_is_told_in_the_scene_s_unit_with_the_obstacle_from_1(cell: er.Scene) -> None:
    verdict = swing(cell, until=1.0)
    [contact] = [violation for violation in verdict.violations if violation.kind == "contact"]
    assert contact.message == "link 2 touches obstacle 1 from 2.384 s on and penetrates it by 40.0 mm"
    assert (contact.obstacle, contact.against) == (0, "obstacle 1")
    assert contact.as_dict()["obstacle"] == 0
    named = swing(cell, until=-2.2)
    assert any("touches obstacle 2 (feeder)" in violation.message for violation in named.violations)


def test_a_clearance_that_is_missed_is_told_beside_the_one_asked_for(cell: er.Scene) -> None:
    near = swing(cell, until=0.4, margin=0.05)
    [missed] = [violation for violation in near.violations if violation.link == 2]
    assert re.match(
        r"link 2 comes within \d+(\.\d+)? mm of obstacle 1; a clearance of 50 mm is asked for, and missed",
        missed.message,
    )
    with pytest.raises(er.BadSetting, match="margin is -50 mm"):
        swing(cell, until=0.4, margin=-0.05)


def test_a_limit_is_told_in_degrees_so_that_it_differs_from_what_breaks_it(cell: er.Scene) -> None:
    [beyond] = [v for v in swing(cell, until=math.radians(130.001)).violations if v.kind == "joint_limit"]
    assert beyond.message == "joint 1 moves to 130.001 deg at 5.000 s, beyond its limit of 130 deg"
    arm = cell.arm.replace(joints=[joint.replace(velocity=math.radians(10.0)) for joint in cell.arm.joints])
    [fast] = [v for v in swing(cell.replace(arm=arm), until=0.9).violations if v.kind == "velocity_limit"]
    assert fast.message == "the velocity of joint 1 reaches 10.31 deg/s at 0.000 s, 10 deg/s are allowed"


def test_a_goal_that_is_not_free_says_why_in_the_file_s_units() -> None:
    def refused(goal: str) -> str:
        with pytest.raises(er.NotFree) as caught:
            er.plan(er.Scene.parse(CELL.replace("goal: [100, 400]", f"goal: {goal}")))
        return str(caught.value)

    far = "out of reach: 560 mm from the base, the arm reaches 50 mm to 550 mm"
    assert refused("[0, 560]").startswith(f"scene:13:36: tasks.pick.goal: (0 mm, 560 mm) is not free: {far}")
    assert "(550 mm, 0 mm) is not free: out of reach: 550.0001 mm from the base" in refused("[550.0001, 0]")
    assert "joint 1 would have to be at 131 deg, its limits are -130 deg to 130 deg" in refused("{q: [131, 0]}")
    assert "would penetrate obstacle 2 (feeder) by" in refused("[-110, -280]")
    assert "\nnearest free grid point: (" in refused("[-110, -280]")


def test_a_plan_in_words_has_no_needless_digit_and_no_other_unit(cell: er.Scene) -> None:
    plan = er.plan(cell)
    said = in_words(plan)
    assert " mm of tip travel" in said
    assert "deg/s³" in said
    assert "proven lower bound" in said
    verdicts = [swing(cell, until=end, margin=m) for end in (1.0, -2.2, 2.5, 0.4) for m in (0.0, 0.07)]
    for text in [said, *("\n".join(verdict_lines(verdict, cell)) for verdict in verdicts)]:
        assert not TOO_EXACT.search(text), text
        assert not LENGTH_IN_METRES.search(text), text
    # Exact for machines.
    assert json.loads(json.dumps(plan.verdict.as_dict()))["least_clearance"]["distance"] > 0.0


def test_a_goal_outside_the_grid_is_said_at_once_by_planners_that_need_it() -> None:
    small = er.Scene.parse(CELL.replace("y: [-600, 600]", "y: [-600, 300]"))
    for planner in ("dstar", "dstar-pso"):
        with pytest.raises(er.BadSetting, match="goal") as caught:
            er.plan(small, planner=planner)
        assert str(caught.value) == (
            "goal (100 mm, 400 mm) lies outside the grid, x [-600, 600], y [-600, 300] mm; "
            "extend the grid, or use planner optimal, which needs none"
        )
        assert caught.value.setting == "grid"
    for objective in ("tip", "joint", "time"):
        assert er.plan(small, planner="optimal", objective=objective).verdict.safe


def test_units_are_part_of_a_scene_that_changes_nothing_it_says(cell: er.Scene) -> None:
    assert (cell.units.length, cell.units.angle) == ("mm", "deg")
    assert cell.units == er.Units(length="mm", angle="deg")
    metric = cell.replace(units=er.Units())
    assert metric == cell
    assert metric.sha256 == cell.sha256
    assert cell.replace(tasks={}).units == cell.units
    assert pickle.loads(pickle.dumps(cell)).units == cell.units
    assert "0.0400 m" in swing(metric, until=1.0).violations[0].message
    assert repr(cell.units) == "Units(length='mm', angle='deg')"
    with pytest.raises(er.SceneError, match="found inch; allowed: m, cm, mm"):
        er.Units(length="inch")  # type: ignore[arg-type]
    with pytest.raises(er.SceneError, match="found grad; allowed: rad, deg"):
        er.Units(angle="grad")  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("elbowroom: 1\n", "", "cell.yaml:1:1: missing: elbowroom; add the version of the format as the first line"),
        ("links: [300", "links [300", "a key without its ':', in this line or the one before"),
        ("[300, 250]", "[300, 250", "a '[' or '{' in the lines before is not closed"),
        ("  joints:", " joints:", "this line is not indented like the others of its mapping or list"),
        ("radius: 40}", "radius: 40", "is not closed, or a ',' is missing"),
        ("  pick:", "\tpick:", "found a tab; indent with spaces"),
        ("step: 20", "step: -20", "step is -20 mm"),
    ],
)
def test_a_slip_in_a_file_is_told_so_that_it_helps(old: str, new: str, message: str) -> None:
    with pytest.raises(er.SceneError) as caught:
        er.Scene.parse(CELL.replace(old, new, 1), file="cell.yaml")
    assert message in str(caught.value)


def test_the_map_and_its_picture_count_the_same(scenes: Path) -> None:
    from elbowroom import figures

    scene = er.Scene.load(scenes / "abb-irb-910sc-065.yaml")
    space = er.free_space(scene)
    assert np.count_nonzero(space.configurations == 2) == space.cases["two"]
    # At full stretch both postures are one configuration.
    both = space.elbow_up.free & space.elbow_down.free
    assert np.count_nonzero(both) > space.cases["two"]
    legend = figures.union_map(scene, space).axes[0].get_legend()
    assert legend is not None
    labels = [text.get_text() for text in legend.get_texts()]
    assert f"two configurations ({space.cases['two']})" in labels
    assert f"one configuration ({space.cases['one']})" in labels


def test_a_margin_is_in_the_unit_of_the_scene_or_states_its_own(cell: er.Scene) -> None:
    for text, asked in (
        ("5", 0.005),
        ("5mm", 0.005),
        ("0.5 cm", 0.005),
        ("0.005m", 0.005),
        ("1e-2", 1e-5),
        ("-1", -0.001),
    ):
        assert metres(text, cell.units, setting="margin") == pytest.approx(asked, rel=1e-12)
    for text in ("", "wide", "5 inch", "mm", "5m5"):
        with pytest.raises(
            er.BadSetting, match=f"margin is '{text}'; a length in mm, or one with its unit, such as 5mm"
        ):
            metres(text, cell.units, setting="margin")


def test_check_takes_a_margin_in_the_unit_of_the_scene(tmp_path: Path) -> None:
    scene, table = tmp_path / "cell.yaml", tmp_path / "t.csv"
    scene.write_text(CELL)
    table.write_text("time_s,q1_rad,q2_rad\n0,0.0,0.0\n5,0.4,0.0\n")
    told = CliRunner().invoke(app, ["check", str(scene), str(table), "--margin", "50"])
    assert told.exit_code == 4
    assert "a clearance of 50 mm is asked for" in told.stdout
    assert CliRunner().invoke(app, ["check", str(scene), str(table), "--margin", "5mm"]).exit_code == 0
    assert CliRunner().invoke(app, ["check", "-h"]).exit_code == 0
