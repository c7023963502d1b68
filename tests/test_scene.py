from __future__ import annotations

import copy
import pickle
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import elbowroom as er

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
    assert loaded.arm == replace(standin.arm, links=loaded.arm.links)
    assert tuple(loaded.arm.links) == (0.25, 0.25)
    assert (loaded.grid, loaded.obstacles, loaded.tasks) == (standin.grid, standin.obstacles, standin.tasks)
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
    assert replace(standin, obstacles=walls).obstacles == pickle.loads(pickle.dumps(scene)).obstacles
    assert walls[0].shifted((1.0, -1.0)) == replace(walls[0], start=(0.9, -0.995), end=(1.2, -0.985))
    assert walls[0].outline == (((-0.1, 0.005), (0.2, 0.015)), 0.025)
    # Upright but for 0.1 rad the second link crosses the thin wall; upright to the left of it stays 5 cm away.
    crossing, beside = np.array([np.pi / 2 - 0.1, 0.0]), np.array([np.arccos(-0.05 / 0.25), 0.0])
    beside[1] = np.pi / 2 - beside[0]
    clearances = scene.core.link_clearances(np.array([crossing, beside]))[:, 1]
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
    binary = tmp_path / "binary.yaml"
    binary.write_bytes(b"elbowroom: \xff\xfe")
    with pytest.raises(er.SceneError, match="UTF-8"):
        er.Scene.load(binary)
    huge = tmp_path / "huge.yaml"
    huge.write_bytes(b"#" * (4 * 1024 * 1024 + 1))
    with pytest.raises(er.SceneError, match="4 MiB"):
        er.Scene.load(huge)


@pytest.mark.parametrize(
    ("change", "key"),
    [
        ({"grid": er.Grid(x=(1.0, 0.0), y=(0.0, 1.0), step=0.1)}, "grid"),
        ({"arm": er.Arm(links=(0.1, 0.2, 0.3), joints=(er.Joint(continuous=True),) * 2)}, "arm"),
        ({"arm": er.Arm(links=(0.1, 0.2), joints=(er.Joint(),) * 2)}, "arm.joints[0]"),
        ({"obstacles": [er.Circle(center=(0.0, 0.0), radius=-1.0)]}, "obstacles[0]"),
        ({"obstacles": [er.Segment(start=(0.0, 0.0), end=(0.0, 0.0), radius=0.1)]}, "obstacles[0]"),
        ({"obstacles": [er.Segment(start=(0.0, 0.0), end=(0.1, 0.0), radius=-0.1)]}, "obstacles[0]"),
        ({"obstacles": [er.Polygon(vertices=[(0.0, 0.0), (1.0, 1.0), (1.0, 0.0), (0.0, 1.0)])]}, "obstacles[0]"),
    ],
)
def test_a_scene_built_in_code_is_checked_too(standin: er.Scene, change: dict[str, object], key: str) -> None:
    with pytest.raises(er.SceneError) as caught:
        replace(standin, **change)
    assert (caught.value.key, caught.value.line) == (key, None)


def test_a_scene_changed_in_code_forgets_its_file(scenes: Path) -> None:
    scene = er.Scene.load(scenes / "paper-standin.yaml")
    moved = replace(scene, tasks={"first": er.Task(start=(0.22, 0.23), goal=(-0.45, -0.15))})
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
    assert replace(scene, obstacles=list(scene.obstacles)).sha256 == scene.sha256
    finer = replace(scene, grid=replace(scene.grid, step=0.005))
    other_name = replace(scene, obstacles=[replace(scene.obstacles[0], name="other"), *scene.obstacles[1:]])
    assert len({scene.sha256, finer.sha256, other_name.sha256, replace(scene, obstacles=()).sha256}) == 4
    assert len({er.Scene.load(file).sha256 for file in scenes.glob("*.yaml")}) == len(list(scenes.glob("*.yaml")))
