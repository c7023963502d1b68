from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest

import elbowroom as er
from elbowroom._plan_files import as_csv, write_plan


@pytest.fixture
def post() -> er.Scene:
    """An arm of 0.3 + 0.2 m with a post of 2 cm radius beside the tip at (0.5, 0)."""
    free = er.Joint(continuous=True)
    return er.Scene(
        arm=er.Arm(links=(0.3, 0.2), joints=(free, er.Joint(min=-2.0, max=2.0, velocity=3.0))),
        grid=er.Grid(x=(-0.5, 0.5), y=(-0.5, 0.5), step=0.02),
        obstacles=[er.Circle(center=(0.45, 0.1), radius=0.02, name="post")],
    )


def test_a_contact_is_named_with_its_time_link_obstacle_and_depth(post: er.Scene) -> None:
    # Stretched out, turning by 0.1 rad a second: the post is at atan2(0.1, 0.45) = 0.2187 rad, its half angle as seen
    # from the base asin(0.02 / 0.46098) = 0.0434 rad.
    result = er.check(post, t=[0.0, 10.0], q=[[0.0, 0.0], [1.0, 0.0]])
    assert (result.curve, result.safe) == ("linear", False)
    [contact] = result.verdict.violations
    assert (contact.kind, contact.link, contact.obstacle, contact.name) == ("contact", 2, 0, "post")
    assert contact.time == pytest.approx(
        (math.atan2(0.1, 0.45) - math.asin(0.02 / math.hypot(0.45, 0.1))) * 10, abs=1e-6
    )
    assert contact.depth == pytest.approx(0.02, abs=1e-6)
    assert "link 2" in contact.message


def test_the_other_way_is_safe_with_its_clearance(post: er.Scene) -> None:
    result = er.check(post, t=[0.0, 10.0], q=[[0.0, 0.0], [-1.0, 0.0]])
    assert result.safe
    nearest = result.verdict.least_clearance
    assert nearest is not None
    assert nearest.time == 0.0
    assert nearest.distance == pytest.approx(0.08, abs=1e-9)
    assert not er.check(post, t=[0.0, 10.0], q=[[0.0, 0.0], [-1.0, 0.0]], margin=0.09).safe


def test_limits_are_judged_by_joint_and_time(post: er.Scene) -> None:
    beyond = er.check(post, t=[0.0, 10.0], q=[[2.0, 0.0], [2.0, 2.1]]).verdict.violations
    assert [(v.kind, v.joint) for v in beyond] == [("joint_limit", 2)]
    fast = er.check(post, t=[0.0, 0.1], q=[[2.0, 0.0], [2.0, 1.0]]).verdict.violations
    assert [(v.kind, v.joint, v.limit) for v in fast] == [("velocity_limit", 2, 3.0)]


def test_a_jump_that_its_curve_does_not_allow_is_found(post: er.Scene) -> None:
    t, q = [0.0, 1.0, 2.0], [[2.0, 0.0], [2.5, 0.0], [2.5, 0.5]]
    assert er.check(post, t=t, q=q).safe
    limited = post.replace(arm=post.arm.replace(joints=(er.Joint(continuous=True, acceleration=9.0),) * 2))
    kinds = {v.kind for v in er.check(limited, t=t, q=q).verdict.violations}
    # From rest to rest: the first row and the last jump as well.
    assert kinds == {"velocity_jump", "moving_start", "moving_end"}
    # Cubic with matching velocities: only the acceleration jumps, and nothing limits the jerk.
    cubic = er.check(limited, t=t, q=q, v=[[0.0, 0.0], [0.2, 0.2], [0.0, 0.0]])
    assert (cubic.curve, cubic.safe) == ("cubic", True)


@pytest.mark.parametrize("objective", ["tip", "joint", "time"])
def test_our_own_csv_is_safe_under_all_limits(standin: er.Scene, tmp_path: Path, objective: er.plan.Objective) -> None:
    joints = tuple(joint.replace(velocity=3.0, acceleration=12.0, jerk=90.0) for joint in standin.arm.joints)
    scene = standin.replace(arm=standin.arm.replace(joints=joints))
    for task in scene.tasks:
        plan = er.plan(scene, task=task, objective=objective)
        assert plan.verdict is not None
        assert plan.verdict.safe
        _, table = write_plan(plan, tmp_path)
        again = er.check_file(scene, table)
        assert again.curve == "quintic"
        assert again.verdict.violations == ()


def trajectory(**changes: object) -> dict[str, object]:
    def point(seconds: float, positions: list[float]) -> dict[str, object]:
        return {"positions": positions, "time_from_start": {"sec": int(seconds), "nanosec": int(seconds % 1 * 1e9)}}

    whole: dict[str, object] = {
        "joint_names": ["joint_2", "joint_1"],
        "points": [point(0.0, [0.0, 0.0]), point(10.5, [0.5, -1.0])],
    }
    return {**whole, **changes}


def test_joint_trajectories_are_read_as_json_and_yaml(post: er.Scene, tmp_path: Path) -> None:
    file = tmp_path / "t.json"
    file.write_text(json.dumps(trajectory()))
    from_json = er.check_file(post, file)
    assert from_json.safe
    assert from_json.motion.duration == 10.5
    last, *_ = from_json.motion.sample(np.array([10.5]))
    # The file has joint 2 first.
    np.testing.assert_allclose(last, [[-1.0, 0.5]])
    dump = tmp_path / "t.yaml"
    dump.write_text(json.dumps({"header": {}, "trajectory": trajectory()}) + "\n---\n")
    assert er.check_file(post, dump).verdict == from_json.verdict


@pytest.mark.parametrize(
    ("name", "content", "words"),
    [
        ("a.csv", "", "the file is empty"),
        ("a.csv", "time_s,q1_rad\n0,0\n", "q2_rad is missing"),
        ("a.csv", "time_s,q1_rad,q2_rad,speed\n0,0,0,0\n", "no such column: speed"),
        ("a.csv", "time_s,q1_rad,q2_rad\n", "0 rows"),
        ("a.csv", "time_s,q1_rad,q2_rad\n0,0\n", "row 1 has 2 cells for 3 columns"),
        ("a.csv", "time_s,q1_rad,q2_rad\n0,0,x\n", "row 1 has a cell that is no number"),
        ("a.csv", "time_s,q1_rad,q2_rad\n0,0,nan\n", "row 1 has a number that is not finite"),
        ("a.csv", "time_s,q1_rad,q2_rad\n0,0,inf\n", "row 1 has a number that is not finite"),
        ("a.csv", "time_s,q1_rad,q2_rad\n0,0,0\n0,1,1\n", "row 2 is at 0 s, which is not after the 0 s"),
        ("a.csv", "time_s,q1_rad,q2_rad\n1,0,0\n0.5,1,1\n", "row 2 is at 0.5 s, which is not after the 1 s"),
        ("a.csv", "time_s,q1_rad,q2_rad,v1_rad_s\n0,0,0,0\n", "v2_rad_s is missing"),
        ("a.csv", "time_s,q1_rad,q2_rad,a1_rad_s2,a2_rad_s2\n0,0,0,0,0\n", "without columns of velocities"),
        ("a.csv", "time_s,q1_rad,q2_rad,q2_rad\n0,0,0,0\n", "a column comes twice"),
        ("a.json", "{", "not JSON"),
        ("a.json", "[1]", "joint_names and points are needed"),
        ("a.yaml", "a: [", "not YAML"),
        ("a.json", json.dumps(trajectory(joint_names=["a", "b"])), "which is at the base"),
        ("a.json", json.dumps(trajectory(joint_names=["a1", "b2"])), "which is at the base"),
        ("a.json", json.dumps(trajectory(joint_names=["a", "b", "c"])), "3 joint names"),
        ("a.json", json.dumps(trajectory(points=[])), "points is not a list of at least one"),
        ("a.json", json.dumps(trajectory(points=[{"positions": [1.0]}])), "point 1 has no time_from_start"),
        ("a.json", json.dumps(trajectory(points=[{"positions": [1.0], "time_from_start": 0}])), "1 positions for 2"),
    ],
)
def test_files_that_are_no_trajectory_are_refused(
    post: er.Scene, tmp_path: Path, name: str, content: str, words: str
) -> None:
    file = tmp_path / name
    file.write_text(content)
    with pytest.raises(er.TrajectoryError) as caught:
        er.check_file(post, file)
    assert words in str(caught.value)
    assert str(file) in str(caught.value)
    assert len(str(caught.value).splitlines()) <= 3


def test_numbers_at_the_ends_of_what_a_float_holds_never_pass_or_panic(post: er.Scene) -> None:
    for number in (1e308, -1e308, 1e16):
        assert not er.check(post, t=[0.0, 1.0], q=[[2.0, 0.0], [number, 0.0]]).safe
    assert er.check(post, t=[0.0, 1.0], q=[[2.0, 0.0], [2.0, 5e-324]]).safe
    for times in ([0.0, 5e-324], [0.0, 1e-308], [-1e308, 1e308]):
        try:
            result = er.check(post, t=times, q=[[2.0, 0.0], [2.0, 1.0]])
        except er.TrajectoryError:
            continue
        assert not result.safe or times == [-1e308, 1e308]


def test_a_plan_survives_the_way_through_csv(standin: er.Scene) -> None:
    plan = er.plan(standin, task="first", planner="dstar", duration=12.0)
    rows = np.array([[float(cell) for cell in row.split(",")] for row in as_csv(plan).splitlines()[1:]])
    result = er.check(standin, t=rows[:, 0], q=rows[:, 1:3], v=rows[:, 3:5], a=rows[:, 5:7])
    assert result.safe
    assert plan.verdict is not None
    mine, theirs = plan.verdict.least_clearance, result.verdict.least_clearance
    assert mine is not None
    assert theirs is not None
    assert theirs.distance == pytest.approx(mine.distance, rel=0.01)
