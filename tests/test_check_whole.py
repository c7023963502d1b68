"""What was not judged never reads as safe: ends of trajectories, several messages, joints by name, odd arrays."""

from __future__ import annotations

import pickle
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import elbowroom as er

CELL = """\
elbowroom: 1
units: {length: m, angle: deg}
arm:
  links: [0.3, 0.25]
  joints: [{min: -143, max: 143, velocity: 172}, {min: -149, max: 149, velocity: 172}]
  half_width: 0.03
grid: {x: [-0.55, 0.55], y: [-0.55, 0.55], step: 0.01}
obstacles: [{circle: {center: [0.45, 0.3], radius: 0.05}, name: post}]
"""

Written = Callable[[str], Path]


@pytest.fixture
def cell() -> er.Scene:
    return er.Scene.parse(CELL)


@pytest.fixture
def written(tmp_path: Path) -> Written:
    def write(text: str) -> Path:
        path = tmp_path / "t.yaml"
        path.write_text(text)
        return path

    return write


def message(*points: str, names: str = "joint1, joint2") -> str:
    return f"joint_names: [{names}]\npoints:\n" + "".join(f"  - {{{point}}}\n" for point in points)


def point(q: str, seconds: int, nanoseconds: int = 0, *, v: str | None = None) -> str:
    rates = "" if v is None else f", velocities: [{v}]"
    return f"positions: [{q}]{rates}, time_from_start: {{sec: {seconds}, nanosec: {nanoseconds}}}"


def kinds(check: er.Check) -> set[str]:
    return {violation.kind for violation in check.verdict.violations}


def test_one_point_is_no_motion(cell: er.Scene, written: Written) -> None:
    alone = written(message(point("0.0, 1.5", 2)))
    with pytest.raises(er.TrajectoryError, match="one point is no motion: nothing says how the arm gets there"):
        er.check_file(cell, alone)
    for t in (0.0, 2.0):
        with pytest.raises(er.TrajectoryError, match="one point is no motion"):
            er.check(cell, t=[t], q=[[0.0, 1.5]], v=[[0.0, 1000.0]])
        with pytest.raises(er.TrajectoryError, match="one point is no motion"):
            er.check(cell, t=[t], q=[[0.0, 1.5]], open_end=True)
    from_there = er.check_file(cell, alone, start=[-0.5, 0.5])
    assert from_there.safe
    assert from_there.motion.duration == 2.0
    np.testing.assert_array_equal(from_there.motion.sample(np.zeros(1))[0], [[-0.5, 0.5]])
    # The way there is judged too: past the post.
    assert kinds(er.check_file(cell, written(message(point("1.5, 0.5", 2))), start=[-0.5, 0.5])) == {"contact"}
    with pytest.raises(er.TrajectoryError, match="one point is no motion"):
        er.check(cell, t=[0.0], q=[[0.0, 1.5]], start=[0.0, 1.5])


def test_what_is_before_the_first_row_is_not_judged(cell: er.Scene, written: Written) -> None:
    rows: dict[str, Any] = {"t": [2.0, 4.0], "q": [[-1.2, 0.4], [-2.0, 0.4]]}
    file = written(message(point("-1.2, 0.4", 2), point("-2.0, 0.4", 4)))
    for late in (er.check(cell, **rows), er.check_file(cell, file)):
        [unknown] = late.verdict.violations
        assert not late
        assert (unknown.kind, unknown.value) == ("not_judged", 2.0)
        assert unknown.message == "how the arm gets to the first row in the 2.000 s before it was not judged"
        assert pickle.loads(pickle.dumps(late)) == late
    for judged in (er.check(cell, start=[-0.5, 0.4], **rows), er.check_file(cell, file, start=[-0.5, 0.4])):
        assert judged.safe
        assert judged.motion.duration == 4.0
    assert kinds(er.check(cell, start=[1.5, 0.4], **rows)) == {"contact"}
    with pytest.raises(er.TrajectoryError, match="the first row is at 0 s and not where the arm starts"):
        er.check(cell, t=[0.0, 2.0], q=rows["q"], start=[0.5, 0.5])
    with pytest.raises(er.TrajectoryError, match="the start has 3 joints, the rows have 2"):
        er.check(cell, start=[0.0, 0.0, 0.0], **rows)
    assert er.check(cell, t=[0.0, 2.0], q=rows["q"], start=rows["q"][0]).safe


def test_a_controller_knows_that_the_arm_stands_at_the_start(cell: er.Scene) -> None:
    rest = [[0.0, 0.0]] * 2
    q = [[-1.2, 0.4], [-2.0, 0.4]]
    for v, a, curve in ((None, None, "linear"), (rest, None, "cubic"), (rest, rest, "quintic")):
        judged = er.check(cell, t=[2.0, 4.0], q=q, v=v, a=a, start=[-0.5, 0.4])
        assert (judged.safe, judged.curve) == (True, curve)


@pytest.mark.parametrize("end", ["start", "end"])
def test_a_motion_that_goes_on_is_not_safe_unless_asked_for(cell: er.Scene, end: str) -> None:
    v = [[-0.5, 0.0], [0.0, 0.0]] if end == "start" else [[0.0, 0.0], [-0.5, 0.0]]
    rows: dict[str, Any] = {"t": [0.0, 1.0], "q": [[-0.5, 0.5], [-1.0, 0.5]], "v": v}
    for a in (None, [[0.0, 0.0]] * 2):
        judged = er.check(cell, a=a, **rows)
        [moving] = judged.verdict.violations
        assert not judged
        assert (moving.kind, moving.joint) == (f"moving_{end}", 1)
        assert moving.value == pytest.approx(-0.5)
        words = {
            "start": "joint 1 is not at rest where the motion begins",
            "end": "joint 1 does not come to rest where",
        }
        assert words[end] in moving.message
        assert pickle.loads(pickle.dumps(judged)) == judged
        assert er.check(cell, a=a, open_end=True, **rows).safe


def test_rounding_of_files_is_rest(cell: er.Scene) -> None:
    rows: dict[str, Any] = {"t": [0.0, 1.0], "q": [[-0.5, 0.5], [-1.0, 0.5]]}
    assert er.check(cell, v=[[0.0, 1e-6], [0.0, 0.0]], **rows).safe
    assert not er.check(cell, v=[[0.0, 2e-6], [0.0, 0.0]], **rows).safe


def test_acceleration_at_an_end_counts_where_jerk_is_limited(cell: er.Scene) -> None:
    rows: dict[str, Any] = {"t": [0.0, 1.0], "q": [[-0.5, 0.5], [-0.6, 0.5]], "v": np.zeros((2, 2))}
    a = [[-0.6, 0.0], [0.6, 0.0]]
    assert er.check(cell, a=a, **rows).safe
    joints = tuple(joint.replace(jerk=100.0) for joint in cell.arm.joints)
    limited = cell.replace(arm=cell.arm.replace(joints=joints))
    assert kinds(er.check(limited, a=a, **rows)) == {"moving_start", "moving_end"}


def test_each_message_of_a_file_is_judged(cell: er.Scene, written: Written) -> None:
    good = message(point("-0.5, 0.5", 0), point("-0.9, 0.5", 1))
    bad = message(point("-0.9, 0.5", 0), point("1.5, 0.5", 3))
    file = written(f"{good}---\n{bad}---\n")
    answers = er.check_messages(cell, file)
    assert [(answer.number, answer.count, answer.safe, bool(answer)) for answer in answers] == [
        (1, 2, True, True),
        (2, 2, False, False),
    ]
    with pytest.raises(er.TrajectoryError, match="2 messages, of which one alone would be judged: name it, message=1"):
        er.check_file(cell, file)
    assert er.check_file(cell, file, message=1).safe
    assert not er.check_file(cell, file, message=2).safe
    assert [answer.number for answer in er.check_messages(cell, file, message=2)] == [2]
    for wrong in (0, 3, True):
        with pytest.raises(er.BadSetting, match="holds 2, counted from 1"):
            er.check_messages(cell, file, message=wrong)
    with pytest.raises(er.TrajectoryError, match="message 2: no JointTrajectory"):
        er.check_messages(cell, written(f"{good}---\n[1]\n"))


def test_joints_are_taken_by_name(cell: er.Scene, written: Written) -> None:
    four = message(point("0.1, -0.5, 0.0, 0.5", 0), point("0.1, 1.5, 1.0, 0.5", 3), names="z, shoulder, wrist, elbow")
    [answer] = er.check_messages(cell, written(four), joints=["shoulder", "elbow"])
    assert kinds(answer.check) == {"contact"}
    assert answer.notes == ("joints of the file that are not the arm's, left out: z, wrist",)
    with pytest.raises(er.TrajectoryError, match=r"4 joint names, .*; the arm has 2 joints\. Name those, base first"):
        er.check_file(cell, written(four))
    with pytest.raises(er.TrajectoryError, match="no 'knee'"):
        er.check_file(cell, written(four), joints=["shoulder", "knee"])
    two = message(point("-0.5, 0.5", 0), point("-0.9, 0.5", 1))
    with pytest.raises(er.BadSetting, match="joints names 'joint1' twice"):
        er.check_file(cell, written(two), joints=["joint1", "joint1"])
    with pytest.raises(er.TrajectoryError, match="joint_names has 'a' twice"):
        er.check_file(cell, written(message(point("0, 0", 0), names="a, a")), joints=["a", "b"])


def test_velocities_in_some_rows_make_linear_pieces(cell: er.Scene, written: Written) -> None:
    rows = [point("-0.5, 0.5", 0), point("-1.0, 0.9", 1)]
    [last] = er.check_messages(cell, written(message(*rows, point("-1.4, 1.2", 3, v="0, 0"))))
    assert (last.safe, last.check.curve) == (True, "linear")
    assert last.notes == ("linear where a row at either end states no velocities: pieces 1, 2 of 2",)
    with pytest.raises(
        er.TrajectoryError, match="row 3 states velocities that are not 0, the row beside it states none"
    ):
        er.check_file(cell, written(message(*rows, point("-1.4, 1.2", 3, v="0, 0.1"))))


def test_half_a_microsecond_is_odd(cell: er.Scene, written: Written) -> None:
    file = written(message(point("-0.5, 0.5", 0), point("-0.2, 0.9", 0, 500), point("0.0, 0.9", 2)))
    [answer] = er.check_messages(cell, file)
    assert "velocity_limit" in kinds(answer.check)
    assert "point 2 comes only 500 ns after the one before it: were seconds meant?" in answer.notes


def test_goals_of_actions_are_read(cell: er.Scene, written: Written) -> None:
    inner = message(point("-0.5, 0.5", 0), point("-0.9, 0.5", 1))
    indented = "".join(f"    {line}\n" for line in inner.splitlines())
    assert er.check_file(cell, written(f"goal_id: {{id: x}}\ngoal:\n  trajectory:\n{indented}")).safe


Q = np.array([[-0.5, 0.5], [-0.9, 0.5]])


@pytest.mark.parametrize(
    ("odd", "words"),
    [
        (np.ma.masked_array(Q, mask=[[0, 0], [0, 1]]), "masked array"),
        (Q + 0j, "complex numbers"),
        (Q > 0.0, "True and False"),
        (Q.astype(object), "objects"),
        (Q.astype(str), "text"),
        (Q[0], r"has shape \(2,\)"),
        (Q[None], r"has shape \(1, 2, 2\)"),
        ([[-0.5, 0.5], [-0.9]], "rows differ in length"),
    ],
)
def test_arrays_that_would_lose_something_are_refused(cell: er.Scene, odd: Any, words: str) -> None:
    with pytest.raises(er.TrajectoryError, match=f"q .*{words}"):
        er.check(cell, t=[0.0, 1.0], q=odd)
    with pytest.raises(er.TrajectoryError, match=f"v .*{words}"):
        er.check(cell, t=[0.0, 1.0], q=Q, v=odd)
    assert er.check(cell, t=[0, 1], q=Q.astype(np.float32)).safe


@pytest.mark.parametrize("text", ["true", "1_0", "0x10", "١", "1:30", "yes", "0b1", "[0]", "2001-12-14"])
def test_what_is_no_number_is_none(cell: er.Scene, written: Written, text: str) -> None:
    with pytest.raises(er.TrajectoryError, match="point 2 has no list of numbers as positions"):
        er.check_file(cell, written(message(point("0, 0", 0), point(f"{text}, 0", 1))))
    table = written("").with_suffix(".csv")
    table.write_text(f"time_s,q1_rad,q2_rad\n0,0,0\n1,{text},0\n", encoding="utf-8")
    with pytest.raises(er.TrajectoryError, match="row 2 has a cell that is no number"):
        er.check_file(cell, table)
    table.with_suffix(".json").write_text(
        '{"joint_names": ["j1", "j2"], "points": [{"positions": [TEXT, 0], "time_from_start": 0}]}'.replace(
            "TEXT", text if text in ("true", "[0]") else f'"{text}"'
        ),
        encoding="utf-8",
    )
    with pytest.raises(er.TrajectoryError, match="point 1 has no list of numbers as positions"):
        er.check_file(cell, table.with_suffix(".json"))


def test_keys_that_come_twice_are_refused(cell: er.Scene, written: Written, tmp_path: Path) -> None:
    rows = message(point("-0.5, 0.5", 0), point("-0.9, 0.5", 1))
    with pytest.raises(er.TrajectoryError, match="the key 'joint_names' comes twice"):
        er.check_file(cell, written(rows + "joint_names: [joint2, joint1]\n"))
    with pytest.raises(er.TrajectoryError, match="the key 'positions' comes twice"):
        er.check_file(cell, written(rows.replace("positions: [-0.9", "positions: [0, 0], positions: [-0.9")))
    file = tmp_path / "t.json"
    file.write_text('{"joint_names": ["j1", "j2"], "points": [], "points": []}')
    with pytest.raises(er.TrajectoryError, match="the key 'points' comes twice"):
        er.check_file(cell, file)


def test_times_count_from_the_first_row(cell: er.Scene, tmp_path: Path) -> None:
    joints = tuple(joint.replace(acceleration=50.0) for joint in cell.arm.joints)
    limited = cell.replace(arm=cell.arm.replace(joints=joints))
    # An even motion between two rests: a velocity that jumps by the rounding of a clock since 1970 would be refused.
    even = [(0.01 * k, -0.5 - 0.002 * k) for k in range(1, 200)]
    text = "time_s,q1_rad,q2_rad\n" + "".join(f"17000000{t:05.2f},{q!r},0.5\n" for t, q in even)
    file = tmp_path / "log.csv"
    file.write_text(text)
    [answer] = er.check_messages(limited, file, open_end=True)
    assert answer.safe
    assert answer.notes == ("times count from the first row, which is at 1700000000.01 s in the file",)
    assert answer.check.motion.duration == 1.98
    dump = tmp_path / "log.yaml"
    dump.write_text(message(*(point(f"{q!r}, 0.5", 1_700_000_000, round(t * 1e9)) for t, q in even[:99])))
    assert kinds(er.check_file(limited, dump, open_end=True)) == {"not_judged"}


def test_obstacles_that_move_go_by_the_clock_of_the_file(cell: er.Scene, tmp_path: Path) -> None:
    away = er.ObstacleMotion(waypoints=[(2.0, (0.0, 0.0)), (3.0, (5.0, 5.0))])
    [post] = cell.obstacles
    moving = cell.replace(obstacles=[post.replace(motion=away)])
    file = tmp_path / "log.csv"
    sweep = "time_s,q1_rad,q2_rad\n{},-0.5,0.5\n{},1.5,0.5\n"
    file.write_text(sweep.format(0, 2))
    assert kinds(er.check_file(moving, file)) == {"contact"}
    file.write_text(sweep.format(3, 5))
    assert er.check_file(moving, file).safe
