from __future__ import annotations

import copy
import doctest
import math
import pickle
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import elbowroom as er
from elbowroom._scene import Obstacle

SOUND = """\
elbowroom: 1
units: {length: cm, angle: deg}
arm:
  links: [25, 25]
  joints: [{continuous: true}, {min: -150, max: 150}]
grid: {x: [-50, 50], y: [-50, 50], step: 1}
obstacles:
  - circle: {center: [22, 22], radius: 5}
    name: post
tasks:
  first: {start: [40, 10], goal: [-45, -15]}
"""


def test_a_file_and_code_give_the_same_scene(scenes: Path, standin: er.Scene) -> None:
    loaded = er.Scene.load(scenes / "paper-standin.yaml")
    assert (loaded.arm, loaded.grid) == (standin.arm, standin.grid)
    assert (loaded.obstacles, loaded.tasks) == (standin.obstacles, standin.tasks)
    assert (loaded, loaded.sha256) == (standin, standin.sha256)
    assert loaded.locations["first", "start"][0] > loaded.locations["first", "start"][1] // 100


def test_every_scene_of_the_repository_loads(scenes: Path) -> None:
    files = sorted(scenes.glob("*.yaml"))
    assert len(files) >= 4
    for file in files:
        assert er.Scene.load(file).tasks


def test_a_segment_in_a_file_and_in_code_is_the_same(standin: er.Scene) -> None:
    written = "segment: {from: [-10, 0.5], to: [20, 1.5], radius: 2.5}\n  - segment: {from: [0, 30], to: [5, 30]}"
    scene = er.Scene.parse(SOUND.replace("circle: {center: [22, 22], radius: 5}\n    name: post", written))
    walls = (
        er.Segment(start=(-0.1, 0.005), end=(0.2, 0.015), radius=0.025),
        er.Segment(start=(0.0, 0.3), end=(0.05, 0.3)),
    )
    assert scene.obstacles == walls
    assert standin.replace(obstacles=walls).obstacles == pickle.loads(pickle.dumps(scene)).obstacles
    assert walls[0].shifted((1.0, -1.0)) == walls[0].replace(start=(0.9, -0.995), end=(1.2, -0.985))
    assert walls[0].outline == (((-0.1, 0.005), (0.2, 0.015)), 0.025)
    # Upright but for 0.1 rad the second link crosses the thin wall; upright to the left of it stays 5 cm away.
    crossing, beside = np.array([np.pi / 2 - 0.1, 0.0]), np.array([np.arccos(-0.05 / 0.25), 0.0])
    beside[1] = np.pi / 2 - beside[0]
    clearances = scene.link_clearances(np.array([crossing, beside]))[:, 1]
    assert clearances == pytest.approx([0.0, 0.05], abs=1e-12)
    assert er.Scene.parse(SOUND).sha256 != scene.sha256


def test_configurations_and_units_come_through() -> None:
    text = SOUND.replace("[40, 10]", "{q: [10, 20]}")
    scene = er.Scene.parse(text)
    start = scene.tasks["first"].start
    assert isinstance(start, er.Configuration)
    assert start.q == pytest.approx((0.17453292519943295, 0.3490658503988659), rel=1e-15)


@pytest.mark.parametrize(
    ("old", "new", "line", "key"),
    [
        ("links: [25, 25]", "links: [25, -25]", 4, "arm.links[1]"),
        ("step: 1", "stepp: 1", 6, "grid.stepp"),
        ("radius: 5", "radius: .nan", 8, "obstacles[0].circle.radius"),
        ("circle: {center: [22, 22], radius: 5}", "segment: {from: [2, 2], to: [2, 2]}", 8, "obstacles[0].segment"),
        ("min: -150", "min: 151", 5, "arm.joints[1]"),
        ("goal: [-45, -15]", "goal: [-45]", 11, "tasks.first.goal"),
    ],
)
def test_a_file_that_is_wrong_is_refused_with_its_place(old: str, new: str, line: int, key: str) -> None:
    with pytest.raises(er.SceneError) as caught:
        er.Scene.parse(SOUND.replace(old, new), file="a.yaml")
    error = caught.value
    assert (error.file, error.line, error.key) == ("a.yaml", line, key)
    assert str(error).startswith(f"a.yaml:{line}:{error.column}: {key}")
    assert isinstance(error, ValueError)
    assert pickle.loads(pickle.dumps(error)).line == line


def test_a_file_that_cannot_be_read_is_refused(tmp_path: Path) -> None:
    with pytest.raises(er.SceneError, match="cannot be read"):
        er.Scene.load(tmp_path / "missing.yaml")
    with pytest.raises(er.SceneError, match="not from standard input"):
        er.Scene.load("-")
    with pytest.raises(er.SceneError, match="the scene comes first, then the trajectory"):
        er.Scene.load("trajectory.csv")
    binary = tmp_path / "binary.yaml"
    binary.write_bytes(b"elbowroom: \xff\xfe")
    with pytest.raises(er.SceneError, match="UTF-8"):
        er.Scene.load(binary)
    huge = tmp_path / "huge.yaml"
    huge.write_bytes(b"#" * (4 * 1024 * 1024 + 1))
    with pytest.raises(er.SceneError, match="4 MiB"):
        er.Scene.load(huge)


BEND = er.Joint(min=-1.0, max=1.0)
TURNING = er.Joint(continuous=True)


@pytest.mark.parametrize(
    ("make", "key", "message"),
    [
        (lambda: er.Grid(x=(1.0, 0.0), y=(0.0, 1.0), step=0.1), "grid", "range x is 1 m to 0 m"),
        (lambda: er.Joint(), "joint", "either continuous=True, or min and max"),
        (lambda: er.Joint(min=2.0, max=1.0), "joint", "lower limit 2 rad is above upper limit 1 rad"),
        (lambda: BEND.replace(continuous=True), "joint", "either continuous=True, or min and max"),
        (
            lambda: TURNING.replace(jerk=0.0),
            "joint.jerk",
            "limit on jerk is 0.0, it must be finite and greater than 0: from 1e-6 to 1e12",
        ),
        (lambda: TURNING.replace(velocity=math.nan), "joint.velocity", "limit on velocity is NaN, it must be finite"),
        (lambda: er.Arm(links=(0.1, 0.2, 0.3), joints=(TURNING,) * 2), "arm", "2 joints for 3 links"),
        (lambda: er.Circle(center=(0.0, 0.0), radius=-1.0), "circle", "radius -1 m"),
        (lambda: er.Circle(center=(0.0, 0.0), radius=1.0).shifted((math.nan, 0.0)), "circle", "NaN m"),
        (lambda: er.Segment(start=(0.0, 0.0), end=(0.0, 0.0), radius=0.1), "segment", "both ends are at"),
        (lambda: er.Segment(start=(0.0, 0.0), end=(0.1, 0.0), radius=-0.1), "segment", "radius -0.1 m"),
        (lambda: er.Polygon(vertices=[(0.0, 0.0), (1.0, 1.0), (1.0, 0.0), (0.0, 1.0)]), "polygon", "from corner 1"),
        (lambda: er.ObstacleMotion(), "motion", "one of waypoints, velocity, chases"),
        (lambda: er.ObstacleMotion(chases=True), "motion", "greatest_speed is needed beside chases"),
        (lambda: er.ObstacleMotion(chases=True, greatest_speed=1.0, start=2.0), "motion", "start is for what moves"),
        (lambda: er.ObstacleMotion(velocity=(1.0, 0.0), keep_off=0.1), "motion", "keep_off is for what chases"),
        (lambda: er.ObstacleMotion(velocity=(1.0, 0.0), greatest_speed=0.5), "motion", "moves at up to 1 m/s"),
        (lambda: er.Task(start=(0.0, 0.1), goal=(0.1, 0.0), posture="left"), "task.posture", "'left'; up, down, any"),
    ],
)
def test_a_part_that_makes_no_sense_is_refused_where_it_is_made(
    make: Callable[[], object], key: str, message: str
) -> None:
    with pytest.raises(er.SceneError) as caught:
        make()
    assert (caught.value.key, caught.value.line) == (key, None)
    assert str(caught.value).startswith(f"{key}: ")
    assert message in str(caught.value)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"obstacles": [er.Circle(center=(0.0, 0.1), radius=0.1, name="post")] * 2}, "two obstacles are called 'post'"),
        ({"tasks": {"go": er.Task(start=er.Configuration((0.0,)), goal=(0.1, 0.0))}}, "task 'go': 1 joint angles"),
        ({"tasks": {"go": er.Task(start=(math.nan, 0.0), goal=(0.1, 0.0))}}, "task 'go': start and goal must be"),
    ],
)
def test_parts_that_do_not_fit_are_refused_by_the_scene(
    standin: er.Scene, change: dict[str, Any], message: str
) -> None:
    with pytest.raises(er.SceneError, match=message) as caught:
        standin.replace(**change)
    assert caught.value.key == "scene"


@pytest.mark.parametrize(
    "make",
    [
        lambda: er.Circle(center=(0.0, 0.0), radius="wide"),
        lambda: er.Circle(center=0.0, radius=0.1),
        lambda: er.Circle(center=(0.0, 0.0), radius=0.1, wide=True),
        lambda: er.Circle(center=(0.0, 0.0), radius=0.1).replace(wide=True),
        lambda: er.Arm(links=(0.1, 0.1), joints=("turning", "turning")),
        lambda: er.Task(start="here", goal=(0.1, 0.0)),
        lambda: er.Scene.parse(SOUND).replace(obstacles=["post"]),
        lambda: er.Scene.parse(SOUND).replace(tasks={"first": "go"}),
        lambda: er.Scene.parse(SOUND).replace(tasks=["first"]),
        lambda: er.Scene.load(3),
        lambda: type(TURNING).__base__(),
        lambda: er.Circle.__base__(),
    ],
)
def test_what_is_of_another_type_is_a_type_error(make: Callable[[], object]) -> None:
    with pytest.raises(TypeError):
        make()


MOVING = er.ObstacleMotion(waypoints=[(0.0, (0.0, 0.0)), (1.5, (0.1, -0.2))], greatest_speed=1.0, seen_from=0.5)
PARTS = (
    TURNING,
    er.Joint(min=-1, max=0, velocity=2.0, acceleration=3.0, jerk=4.0),
    er.Arm(links=[0.25, 1], joints=[TURNING, BEND], half_width=0.01, base=(0.1, 0.0), self_collision=True),
    er.Grid(x=(0.0, 0.7), y=(-0.5, 0.5), step=0.1),
    MOVING,
    er.ObstacleMotion(velocity=(0.1, 0.0), start=2.0, sensing_radius=0.3),
    er.ObstacleMotion(chases=True, greatest_speed=0.1, keep_off=0.02),
    er.Circle(center=(0.22, 0.22), radius=0.05, name="post", motion=MOVING),
    er.Segment(start=(-0.1, 0.0), end=(0.2, 0.3)),
    er.Polygon(vertices=[(0.1, 0.1), (0.3, 0.1), (0.2, 0.4)]),
    er.Configuration((0.3, 0.9)),
    er.Task(start=(0.4, 0.1), goal=er.Configuration([0.1, 0.2]), posture="down"),
)


def test_parts_are_values() -> None:
    for number, part in enumerate(PARTS):
        made = type(part)(**part.__getnewargs_ex__()[1])
        same = [pickle.loads(pickle.dumps(part, protocol)) for protocol in range(2, pickle.HIGHEST_PROTOCOL + 1)]
        for other in (made, *same, copy.copy(part), copy.deepcopy(part), part.replace(), part.__replace__()):
            assert type(other) is type(part)
            assert (other, hash(other), repr(other)) == (part, hash(part), repr(part))
        assert eval(repr(part), vars(er)) == part
        assert [part == other for other in PARTS].index(True) == number
        assert part != "post"
        with pytest.raises(AttributeError):
            part.name = "other"  # type: ignore[attr-defined]
    assert len(set(PARTS)) == len(PARTS)


def test_attributes_are_as_they_were_given() -> None:
    turning, bending, arm, grid, by_points, drifting, chasing, circle, wall, wedge, configuration, task = PARTS
    assert (turning.continuous, turning.min, turning.max, turning.velocity) == (True, None, None, None)
    assert (bending.continuous, bending.min, bending.max) == (False, -1.0, 0.0)
    assert (bending.velocity, bending.acceleration, bending.jerk) == (2.0, 3.0, 4.0)
    assert (arm.links, arm.joints, arm.half_width) == ((0.25, 1.0), (TURNING, BEND), 0.01)
    assert (arm.base, arm.self_collision) == ((0.1, 0.0), True)
    assert (grid.x, grid.y, grid.step) == ((0.0, 0.7), (-0.5, 0.5), 0.1)
    assert by_points.waypoints == ((0.0, (0.0, 0.0)), (1.5, (0.1, -0.2)))
    assert (by_points.velocity, by_points.start, by_points.chases, by_points.keep_off) == (None, 0.0, False, 0.0)
    assert (by_points.greatest_speed, by_points.seen_from, by_points.sensing_radius) == (1.0, 0.5, None)
    assert (drifting.waypoints, drifting.velocity, drifting.start) == (None, (0.1, 0.0), 2.0)
    assert (drifting.greatest_speed, drifting.sensing_radius) == (None, 0.3)
    assert drifting.replace(velocity=(3.0, 0.0)).velocity == (3.0, 0.0)
    assert (chasing.chases, chasing.keep_off) == (True, 0.02)
    assert (circle.center, circle.radius, circle.name, circle.motion) == ((0.22, 0.22), 0.05, "post", MOVING)
    assert circle.outline == (((0.22, 0.22),), 0.05)
    assert circle.shifted((1.0, 0.0)) == circle.replace(center=(1.22, 0.22))
    assert (wall.start, wall.end, wall.radius, wall.name, wall.motion) == ((-0.1, 0.0), (0.2, 0.3), 0.0, None, None)
    assert wedge.outline == (wedge.vertices, 0.0) == (((0.1, 0.1), (0.3, 0.1), (0.2, 0.4)), 0.0)
    assert wedge.shifted((0.5, 0.5)).vertices == ((0.6, 0.6), (0.8, 0.6), (0.7, 0.9))
    assert all(isinstance(obstacle, Obstacle) for obstacle in (circle, wall, wedge))
    assert configuration.q == (0.3, 0.9)
    assert (task.start, task.goal, task.posture) == ((0.4, 0.1), er.Configuration((0.1, 0.2)), "down")


def test_a_grid_keeps_its_ends_but_is_its_points() -> None:
    coarse = er.Grid(x=(0.0, 1.0), y=(0.0, 1.0), step=0.3)
    assert coarse == er.Grid(x=(0.0, 0.95), y=(-0.0, 0.9), step=0.3)
    assert hash(coarse) == hash(er.Grid(x=(0.0, 0.95), y=(-0.0, 0.9), step=0.3))
    assert coarse.replace(step=0.25) == er.Grid(x=(0.0, 1.0), y=(0.0, 1.0), step=0.25)
    scene = er.Scene.parse(SOUND).replace(grid=coarse)
    assert scene.grid.replace(step=0.25).x == (0.0, 1.0)
    other = scene.replace(grid=er.Grid(x=(0.0, 0.95), y=(-0.0, 0.9), step=0.3))
    assert (other, other.sha256) == (scene, scene.sha256)


def test_scenes_and_parts_are_shown_in_a_line(scenes: Path, standin: er.Scene) -> None:
    loaded = er.Scene.load(scenes / "paper-standin.yaml")
    assert repr(loaded) == "<Scene paper-standin.yaml: 2 links, 5 obstacles, tasks first, second>"
    assert repr(standin) == "<Scene: 2 links, 5 obstacles, tasks first, second>"
    assert repr(standin.replace(obstacles=standin.obstacles[:1], tasks={})) == "<Scene: 2 links, 1 obstacle, no tasks>"
    go = standin.tasks["first"]
    assert repr(standin.replace(tasks={str(i): go for i in range(9)})).endswith("obstacles, 9 tasks>")
    assert repr(standin.obstacles[0]) == "Circle(center=(0.22, 0.22), radius=0.05)"
    round_ = er.Polygon(vertices=[(math.cos(i / 10), math.sin(i / 10)) for i in range(60)], name="round")
    assert repr(round_).endswith(", ... 60 in all), name='round')")
    assert len(repr(round_)) < 250


def test_tasks_are_a_mapping_that_cannot_be_written_to(standin: er.Scene) -> None:
    first, second = standin.tasks.items()
    assert standin.replace(tasks=dict([second, first])) == standin
    assert standin.replace(tasks=standin.tasks).sha256 == standin.sha256
    with pytest.raises(TypeError):
        standin.tasks["third"] = first[1]  # type: ignore[index]
    standin.__getnewargs_ex__()[1]["tasks"].clear()
    assert list(standin.tasks) == ["first", "second"]
    assert standin.obstacles is standin.obstacles
    assert er.Scene(arm=standin.arm, grid=standin.grid).tasks == {}


def test_examples_of_the_extension_run() -> None:
    ran = doctest.testmod(er, raise_on_error=True)
    assert ran.attempted > 5


def test_a_scene_changed_in_code_forgets_its_file(scenes: Path) -> None:
    scene = er.Scene.load(scenes / "paper-standin.yaml")
    moved = scene.replace(tasks={"first": er.Task(start=(0.22, 0.23), goal=(-0.45, -0.15))})
    assert scene.file is not None
    assert (moved.file, moved.locations) == (None, {})
    with pytest.raises(er.NotFree) as caught:
        er.plan(moved, task="first")
    assert "yaml" not in str(caught.value)
    for same in (pickle.loads(pickle.dumps(scene)), copy.deepcopy(scene)):
        assert (same, same.file, same.locations) == (scene, scene.file, scene.locations)


def test_the_hash_is_of_what_the_scene_says(scenes: Path) -> None:
    scene = er.Scene.load(scenes / "paper-standin.yaml")
    again = er.Scene.parse((scenes / "paper-standin.yaml").read_text() + "\n# the same\n", file="other.yaml")
    assert scene.sha256 == again.sha256
    assert scene.replace(obstacles=list(scene.obstacles)).sha256 == scene.sha256
    finer = scene.replace(grid=scene.grid.replace(step=0.005))
    other_name = scene.replace(obstacles=[scene.obstacles[0].replace(name="other"), *scene.obstacles[1:]])
    assert len({scene.sha256, finer.sha256, other_name.sha256, scene.replace(obstacles=()).sha256}) == 4
    assert len({er.Scene.load(file).sha256 for file in scenes.glob("*.yaml")}) == len(list(scenes.glob("*.yaml")))
