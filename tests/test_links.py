"""Arms of any number of links: scenes, files, what is refused."""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from typer.testing import CliRunner
from yaml import safe_dump

import elbowroom as er
from elbowroom._cli.main import app
from elbowroom._cli.plan_text import in_words, verdict_lines
from elbowroom._plan_files import as_json, columns, write_plan
from elbowroom.compare._generate import write_scenes
from elbowroom.figures import configuration_space

Chain = Callable[..., er.Scene]
Planned = Callable[[er.Scene], er.Plan]

SERVING = "; those that serve it: guided-rrt-connect, pso, cbpso, nsc-pso, ik-pso"


def as_yaml(scene: er.Scene) -> str:
    """``scene`` as a file, in metres and radians."""
    arm = scene.arm
    keys = ("continuous", "min", "max", "velocity", "acceleration", "jerk")
    joints = [{k: v for k in keys if (v := getattr(joint, k)) not in (None, False)} for joint in arm.joints]
    obstacles = [
        {"circle": {"center": list(o.center), "radius": o.radius}, **({"name": o.name} if o.name else {})}
        if isinstance(o, er.Circle)
        else {"polygon": [list(corner) for corner in o.vertices]}
        for o in scene.obstacles
    ]
    tasks = {
        name: {"start": {"q": list(task.start.q)}, "goal": {"q": list(task.goal.q)}}
        for name, task in scene.tasks.items()
        if isinstance(task.start, er.Configuration) and isinstance(task.goal, er.Configuration)
    }
    grid = {"x": list(scene.grid.x), "y": list(scene.grid.y), "step": scene.grid.step}
    body = {"links": list(arm.links), "joints": joints, "half_width": arm.half_width, "base": list(arm.base)}
    body["self_collision"] = arm.self_collision
    whole = {"elbowroom": 1, "units": {"length": "m", "angle": "rad"}, "arm": body, "grid": grid}
    return safe_dump({**whole, "obstacles": obstacles, "tasks": tasks})


@pytest.mark.parametrize("links", [2, 3, 10, 30])
def test_a_file_and_code_give_the_same_scene(chain: Chain, links: int) -> None:
    built = chain(links)
    read = er.Scene.parse(as_yaml(built))
    assert (read, read.sha256) == (built, built.sha256)
    q = np.random.default_rng(links).uniform(-2.0, 2.0, (50, links))
    np.testing.assert_array_equal(read.link_clearances(q), built.link_clearances(q))
    np.testing.assert_array_equal(read.self_clearances(q), built.self_clearances(q))


@pytest.mark.parametrize("links", [2, 3, 10])
def test_samples_hold_where_each_link_ends(chain: Chain, planned: Planned, links: int) -> None:
    plan = planned(chain(links))
    samples = plan.sample(period=0.05)
    turned = np.cumsum(samples.q, axis=1)
    steps = 0.5 / links * np.stack([np.cos(turned), np.sin(turned)], axis=-1)
    ends = np.array([0.02, -0.03]) + np.cumsum(steps, axis=1)
    np.testing.assert_allclose(samples.link_ends, ends, atol=1e-12)
    np.testing.assert_array_equal(samples.tip, samples.link_ends[:, -1])


@pytest.mark.parametrize("links", [2, 3, 10])
def test_a_motion_survives_the_way_through_its_files(
    chain: Chain, planned: Planned, tmp_path: Path, links: int
) -> None:
    plan = planned(chain(links))
    assert plan.verdict is not None
    assert plan.verdict.safe
    document, table = write_plan(plan, tmp_path)
    read = json.loads(document.read_text())
    assert read == json.loads(json.dumps(as_json(plan)))
    assert {len(piece["coefficients"]) for piece in read["pieces"]} == {links}
    assert read["evaluations"] == plan.evaluations
    header, *rows = table.read_text().splitlines()
    assert header.split(",") == columns(links)
    assert len(columns(links)) == 3 * links + 3
    assert columns(3)[:5] == ["time_s", "q1_rad", "q2_rad", "q3_rad", "v1_rad_s"]
    values = np.array([[float(cell) for cell in row.split(",")] for row in rows])
    np.testing.assert_array_equal(values[:, 1 : links + 1], plan.at(values[:, 0]).q)
    assert np.abs(values[:, :1] - plan.motion.starts).min(axis=0).max() < 1e-9, "a row wherever pieces meet"
    again = er.check_file(plan.scene, table)
    assert (again.curve, again.safe) == ("quintic", True)
    mine, theirs = plan.verdict.least_clearance, again.verdict.least_clearance
    assert mine is not None
    assert theirs is not None
    assert theirs.distance == pytest.approx(mine.distance, rel=0.01)
    scene = tmp_path / "scene.yaml"
    scene.write_text(as_yaml(plan.scene))
    shown = CliRunner().invoke(app, ["check", str(scene), str(table)])
    assert shown.exit_code == 0, shown.output
    assert "SAFE: proved" in shown.stdout


def test_joint_trajectories_of_many_joints_are_put_in_order(chain: Chain, tmp_path: Path) -> None:
    scene = chain(10)
    names = [f"arm_joint_{number:02}" for number in range(1, 11)]
    order = np.random.default_rng(1).permutation(10)
    end = np.linspace(0.0, 0.3, 10)
    points = [
        {"positions": [float(at * end[j]) for j in order], "time_from_start": {"sec": int(at * 3), "nanosec": 0}}
        for at in (0.0, 1.0)
    ]
    file = tmp_path / "t.json"
    file.write_text(json.dumps({"joint_names": [names[j] for j in order], "points": points}))
    last = er.check_file(scene, file).motion.sample(np.array([3.0]))[0]
    np.testing.assert_allclose(last, [end], atol=1e-15)
    words = dict(zip(names, "abcdefghij", strict=True))
    file.write_text(json.dumps({"joint_names": [words[names[j]] for j in order], "points": points}))
    named = er.check_file(scene, file, joints=list("abcdefghij")).motion.sample(np.array([3.0]))[0]
    np.testing.assert_array_equal(named, last)
    with pytest.raises(er.TrajectoryError, match="which is at the base"):
        er.check_file(scene, file)


@pytest.mark.parametrize(
    ("name", "content", "message"),
    [
        (
            "a.csv",
            "time_s,q1_rad,q2_rad\n0,0,0\n",
            "column q3_rad is missing, the arm has 3 joints; found time_s, q1_rad, q2_rad",
        ),
        (
            "a.csv",
            "time_s,q1_rad,q2_rad,q3_rad,q4_rad\n0,0,0,0,0\n",
            "column q4_rad is of a joint too many: the arm has 3 joints",
        ),
        (
            "a.csv",
            "time_s,q1_rad,q2_rad,q3_rad,v1_rad_s,v2_rad_s\n0,0,0,0,0,0\n",
            "column v3_rad_s is missing beside v1_rad_s",
        ),
        (
            "a.csv",
            "time_s,q1_rad,q2_rad,q3_rad,speed\n0,0,0,0,0\n",
            "no such column: speed; known for an arm of 3 joints are time_s, q1_rad to q3_rad, v1_rad_s to v3_rad_s, "
            "a1_rad_s2 to a3_rad_s2, x_m, y_m",
        ),
        ("a.json", '{"joint_names": ["j1", "j2"], "points": []}', "2 joint names; the arm has 3 joints"),
        (
            "a.json",
            '{"joint_names": ["j1", "j2", "j4"], "points": []}',
            "joint names are j1, j2, j4: which is at the base? Name them, base first: --joints FIRST,SECOND,...",
        ),
        (
            "a.json",
            '{"joint_names": ["j1", "j2", "j3"], "points": [{"positions": [0, 0], "time_from_start": 0}]}',
            "point 1 has 2 positions for 3 joints",
        ),
    ],
)
def test_files_for_another_arm_are_refused(chain: Chain, tmp_path: Path, name: str, content: str, message: str) -> None:
    file = tmp_path / name
    file.write_text(content)
    with pytest.raises(er.TrajectoryError) as caught:
        er.check_file(chain(3), file)
    assert str(caught.value) == f"{file}: {message}"


def test_samples_for_another_arm_are_refused(chain: Chain) -> None:
    with pytest.raises(er.TrajectoryError, match=r"^it moves 2 joints; the arm of the scene has 5$"):
        er.check(chain(5), t=[0.0, 1.0], q=[[0.0, 0.0], [1.0, 0.0]])


def test_links_that_touch_each_other_are_named(chain: Chain) -> None:
    # The last of three links folds back over the first.
    for self_collision in (True, False):
        scene = chain(3, self_collision=self_collision).replace(obstacles=(), tasks={})
        judged = er.check(scene, t=[0.0, 5.0], q=[[0.0, 2.0, 0.0], [0.0, 2.0, 2.4]], v=np.zeros((2, 3)))
        assert judged.safe != self_collision
    scene = chain(3).replace(obstacles=(), tasks={})
    judged = er.check(scene, t=[0.0, 5.0], q=[[0.0, 2.0, 0.0], [0.0, 2.0, 2.4]], v=np.zeros((2, 3)))
    [contact] = judged.verdict.violations
    assert (contact.kind, {contact.link, contact.other_link}) == ("contact", {1, 3})
    assert contact.obstacle is None
    nearest = judged.verdict.least_clearance
    assert nearest is not None
    assert nearest.obstacle is None
    said = "\n".join(verdict_lines(judged.verdict, scene))
    assert "NOT SAFE" in said
    assert "link 1" in said
    assert "link 3" in said
    start = er.Configuration((0.0, 2.0, 2.4))
    crossed = scene.replace(tasks={"go": er.Task(start=start, goal=start)})
    q = np.array([start.q])
    assert scene.self_clearances(q)[0] < 0.0 < math.inf == scene.link_clearances(q).min()
    assert crossed.tasks


def test_words_for_many_joints_are_few(chain: Chain, planned: Planned) -> None:
    said = in_words(planned(chain(10)))
    assert said.count("is closest to its limit") == 1
    assert ", the 8 others have more)" in said
    assert "planned within assumed limits, as the scene states none: acceleration 3.14159 rad/s² (joint 1)" in said
    assert "jerk 12.5664 rad/s³ (joints 1 to 10)" in said
    assert in_words(planned(chain(3))).count("is closest to its limit") == 2


# What only arms of two links can do


def test_what_needs_two_links_says_so(chain: Chain, planned: Planned) -> None:
    scene = chain(5)
    for what, message in (
        (lambda: er.free_space(scene), "a map per posture needs an arm of 2 links; the arm of this scene has 5"),
        (lambda: er.plan_as_in_paper(scene), "the paper's system needs an arm of 2 links; the arm of this scene has 5"),
        (lambda: er.plan(scene, planner="optimal"), f"planner optimal is for arms of 2 links; this one has 5{SERVING}"),
        (
            lambda: configuration_space(planned(scene)),
            "the configuration space is drawn of arms of 2 links; this one has 5",
        ),
    ):
        with pytest.raises(er.BadSetting) as caught:
            what()
        assert str(caught.value) == message


def test_the_command_line_refuses_with_one_line(chain: Chain, tmp_path: Path) -> None:
    file = tmp_path / "five.yaml"
    file.write_text(as_yaml(chain(5)))
    for arguments, message in (
        (
            ("map", file),
            f"{file}: maps are per posture, which only arms of 2 links have; this one has 5: plan, check and compare "
            "take it",
        ),
        (("plan", file, "--planner", "optimal"), f"planner optimal is for arms of 2 links; this one has 5{SERVING}"),
        (("check", file, "t.json", "--joints", "a,b"), "joints names 2; the arm has 5 joints"),
    ):
        failed = CliRunner().invoke(app, [str(argument) for argument in arguments])
        assert (failed.exit_code, failed.stdout) == (2, "")
        assert failed.stderr == f"error: {message}\n"


def test_the_command_says_which_pictures_are_left_out(chain: Chain, tmp_path: Path) -> None:
    file = tmp_path / "three.yaml"
    file.write_text(as_yaml(chain(3)))
    done = CliRunner().invoke(app, ["plan", str(file), "--out", str(tmp_path / "out"), "--animate"])
    assert done.exit_code == 0, done.output
    assert done.stdout.splitlines()[-1] == (
        "no picture of the configuration space and no free grid points: they are for arms of 2 links, this has 3"
    )
    names = {"tip_path.png", "smoothed_path.png", "arm_tracking.png", "joints.png", "clearance.png", "motion.gif"}
    assert {path.name for path in (tmp_path / "out").iterdir()} == {*names, "plan.json", "trajectory.csv"}
    as_data = CliRunner().invoke(app, ["plan", str(file), "--out", str(tmp_path / "out"), "--json"])
    assert json.loads(as_data.stdout)["planner"] == "guided-rrt-connect"


# Random scenes


@pytest.mark.parametrize("links", [3, 10, 30])
def test_generated_arms_are_free_at_both_ends(tmp_path: Path, links: int) -> None:
    paths = write_scenes(4, tmp_path / "a", seed=2, links=links)
    assert paths[0].name == f"links{links}-seed2-1.yaml"
    again = write_scenes(4, tmp_path / "b", seed=2, links=links)
    assert [path.read_bytes() for path in paths] == [path.read_bytes() for path in again]
    assert len({path.read_bytes() for path in paths}) == 4
    for path in paths:
        scene = er.Scene.load(path)
        assert len(scene.arm.links) == links
        assert scene.arm.self_collision
        assert sum(scene.arm.links) == pytest.approx(0.5, rel=0.16)
        for task in scene.tasks.values():
            ends: list[Any] = [task.start, task.goal]
            q = np.array([end.q for end in ends])
            assert scene.link_clearances(q).min() > 0.005
            assert scene.self_clearances(q).min() > 0.005
            start, goal = scene.link_ends(q)[:, -1]
            assert math.dist(start, goal) >= 0.3


def test_arms_that_cannot_be_drawn_are_refused(tmp_path: Path) -> None:
    for links in (1, 31):
        with pytest.raises(er.BadSetting, match=f"^links is {links}, it must be a whole number from 2 to 30$"):
            write_scenes(1, tmp_path, seed=0, links=links)
    done = CliRunner().invoke(app, ["generate", "--count", "2", "--links", "4", "--out", str(tmp_path)])
    assert done.stdout.startswith("wrote 2 scenes, links4-seed0-1.yaml to links4-seed0-2.yaml")
