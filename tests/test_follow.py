from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from typer.testing import CliRunner

import elbowroom as er
from elbowroom._cli.main import app
from elbowroom.follow import follow
from elbowroom.follow._animation import END, animate
from elbowroom.follow._clearances import clearances
from elbowroom.follow._files import record

SCENES = ("moving-one", "moving-three", "door", "goal-blocked", "chase", "late")


@pytest.fixture
def elsewhere(tmp_path: Path) -> Path:
    """A scene whose goal is never free: the disc comes to stand on it and stays."""
    text = (Path(__file__).parent.parent / "scenes" / "goal-blocked.yaml").read_text()
    file = tmp_path / "blocked.yaml"
    file.write_text(text.replace("{time: 11, shift: [-5, 10]}", "{time: 11, shift: [17, 0.1]}"))
    return file


@pytest.mark.parametrize("name", SCENES)
def test_the_goal_is_reached_without_contact_in_every_scene(name: str) -> None:
    for seed in range(3):
        followed = follow(er.Scene.example(name), seed=seed)
        assert followed.outcome == "reached", seed
        assert followed.check.safe
        assert all(step.safe for step in followed.steps)
        samples = followed.samples
        goal = followed.scene.tasks[followed.task].goal
        np.testing.assert_allclose(samples.tip[-1], goal, atol=1e-6)
        np.testing.assert_allclose([samples.v[-1], samples.a[-1]], 0.0, atol=1e-6)
        # Another way to the same clearances: sampled, obstacle by obstacle.
        least = followed.check.verdict.least_clearance
        assert least is not None
        sampled = min(float(values.min()) for values in clearances(followed).values())
        assert least.distance == pytest.approx(sampled, abs=2e-3)
        assert sampled > 0.0


def test_nothing_jumps_in_what_is_followed() -> None:
    followed = follow(er.Scene.example("late"))
    assert sum(step.decision == "new" for step in followed.steps) > 1
    samples = followed.samples
    joint = followed.scene.arm.joints[0]
    assert joint.velocity is not None
    assert joint.acceleration is not None
    assert joint.jerk is not None
    for values, rate in ((samples.q, joint.velocity), (samples.v, joint.acceleration), (samples.a, joint.jerk)):
        steps = np.abs(np.diff(values, axis=0)) / np.diff(samples.t)[:, np.newaxis]
        assert steps.max() <= rate * (1.0 + 1e-6)
    # The arm is where the motions that it was given have it: planned and followed do not drift apart.
    for step in followed.steps:
        row = round(step.time / 0.01)
        q, v, a, _ = step.motion.sample(np.array([step.time]))
        np.testing.assert_allclose([q[0], v[0], a[0]], [samples.q[row], samples.v[row], samples.a[row]], atol=1e-9)


@pytest.mark.parametrize("name", ["chase", "late"])
def test_same_seed_same_run(name: str) -> None:
    scene = er.Scene.example(name)
    runs = [follow(scene, seed=5) for _ in range(2)]
    lines = [[{**record(run, step), "update_s": 0.0} for step in run.steps] for run in runs]
    assert lines[0] == lines[1]
    assert runs[0].samples.q.tobytes() == runs[1].samples.q.tobytes()


def test_waiting_is_the_better_way_at_a_shut_door() -> None:
    followed = follow(er.Scene.example("door"))
    moving = np.abs(followed.samples.v).max(axis=1) > 1e-9
    t = followed.samples.t
    assert not moving[(t > 1.3) & (t < 3.0)].any()
    assert moving[(t > 4.5) & (t < 7.0)].all()


def test_who_chases_is_checked_on_the_way_that_it_took() -> None:
    followed = follow(er.Scene.example("chase"))
    [motion] = [obstacle.motion for obstacle in followed.true_scene.obstacles if obstacle.motion is not None]
    assert motion.waypoints is not None
    times = np.array([time for time, _ in motion.waypoints])
    places = np.array([shift for _, shift in motion.waypoints])
    speeds = np.hypot(*np.diff(places, axis=0).T) / np.diff(times)
    assert 0.01 < speeds.max() <= 0.08 * (1.0 + 1e-9)
    assert times[-1] == followed.duration


def test_files_and_pictures_are_written(tmp_path: Path, scenes: Path) -> None:
    out = tmp_path / "out"
    arguments = ["follow", str(scenes / "moving-one.yaml"), "--rate", "20", "--out", str(out), "--json"]
    result = CliRunner().invoke(app, arguments)
    assert result.exit_code == 0, result.output
    found = json.loads(result.stdout)
    assert found == json.loads((out / "follow.json").read_text())
    assert (found["outcome"], found["verdict"]["safe"]) == ("reached", True)
    lines = [json.loads(line) for line in (out / "decisions.jsonl").read_text().splitlines()]
    assert len(lines) == found["updates"] == sum(found["decisions"].values())
    assert lines[0]["decision"] == "new"
    assert lines[0]["known"] == {"shuttle": "course"}
    assert [line["time_s"] for line in lines[:3]] == [0.0, 0.05, 0.1]
    for name in ("latency.png", "clearance.png"):
        with Image.open(out / name) as picture:
            assert picture.size[0] > 600
    # What was really followed, from its file, before the judge of anybody's trajectories.
    judged = CliRunner().invoke(app, ["check", str(scenes / "moving-one.yaml"), str(out / "trajectory.csv"), "--json"])
    assert judged.exit_code == 0
    verdict = json.loads(judged.stdout)
    assert verdict["least_clearance"]["distance"] == pytest.approx(
        found["verdict"]["least_clearance"]["distance"], abs=1e-9
    )


def test_exit_codes_say_how_it_ended(tmp_path: Path, scenes: Path, elsewhere: Path) -> None:
    def code(*arguments: str) -> int:
        return CliRunner().invoke(app, ["follow", *arguments]).exit_code

    assert code(str(scenes / "moving-one.yaml"), "--rate", "20") == 0
    assert code(str(scenes / "moving-one.yaml"), "--rate", "20", "--horizon", "2") == 3
    assert code(str(scenes / "moving-one.yaml"), "--rate", "20", "--timeout", "0") == 3
    assert code(str(elsewhere), "--rate", "20", "--horizon", "12") == 3
    # Nobody told the arm, and it cannot get out of the way any more.
    bolt = (
        (scenes / "moving-one.yaml")
        .read_text()
        .replace("name: shuttle", "name: bolt\n    seen: false\n    seen_from: 9")
    )
    unseen = tmp_path / "unseen.yaml"
    unseen.write_text(bolt.replace("[0, 36]", "[0, 44]"))
    assert code(str(unseen), "--rate", "20") == 4


@pytest.mark.parametrize("name", ["late", "door"])
def test_the_animation_has_a_picture_every_twentieth_of_a_second(tmp_path: Path, name: str) -> None:
    followed = follow(er.Scene.example(name), horizon=0.2)
    assert followed.outcome == "not reached"
    with Image.open(animate(followed, tmp_path / "follow.gif")) as animation:
        # Start, four more, and the last one for a while; equal pictures may be one of longer duration.
        total = 0
        for i in range(animation.n_frames):  # type: ignore[attr-defined]
            animation.seek(i)
            total += animation.info["duration"]
        assert total == 50 * (5 + END)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["three-links.yaml"], "needs an arm of 2 links; the arm of this scene has 3"),
        (["moving-one.yaml", "--rate", "30"], "try 29.4118 or 30.303 Hz"),
        (["moving-one.yaml", "--rate", "0"], "it must be from 1 to 1000 Hz"),
        (["moving-one.yaml", "--horizon", "nan"], "horizon is nan s"),
        (["chase.yaml", "--horizon", "1000"], "at most 9999 are simulated with an obstacle that chases"),
        (["moving-one.yaml", "--task", "second"], "no task is called 'second'"),
        (["moving-one.yaml", "--deadline", "-1"], "deadline is -1.0 s"),
        (["moving-one.yaml", "--animate"], "--animate needs --out"),
        (["moving-two.yaml"], "cannot be read"),
    ],
)
def test_bad_input_is_one_clear_line(scenes: Path, arguments: list[str], words: str) -> None:
    name, *options = arguments
    result = CliRunner().invoke(app, ["follow", str(scenes / name), *options])
    assert result.exit_code == 2
    assert words in result.stderr
    assert len(result.stderr.splitlines()) <= 3


def test_obstacles_that_stand_still_are_followed_too(standin: er.Scene) -> None:
    followed = follow(standin, task="first")
    assert followed.outcome == "reached"
    assert list(clearances(followed)) == ["static obstacles"]
    empty = follow(standin.replace(obstacles=()), task="first")
    assert empty.outcome == "reached"
    assert clearances(empty) == {}


def test_obstacles_are_called_as_the_verdict_calls_them() -> None:
    followed = follow(er.Scene.example("late"))
    least = followed.check.verdict.least_clearance
    assert least is not None
    assert list(clearances(followed)) == ["obstacle 2 (late)", "obstacle 3 (hidden)", "static obstacles"]
    assert least.against == "obstacle 3 (hidden)"
