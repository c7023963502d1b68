"""Lower bounds, gaps and proofs that there is no path, as a user meets them."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import elbowroom as er
from elbowroom._plan_files import as_json

BEST_KNOWN = {
    ("paper-standin", "first"): 3.1415,
    ("paper-standin", "second"): 3.4454,
    ("narrow", "first"): 4.1906,
    ("narrow", "second"): 3.5240,
}


@pytest.mark.parametrize(("name", "task"), BEST_KNOWN)
def test_optimal_is_near_the_best_known_and_says_how_near_to_the_best(name: str, task: str) -> None:
    plan = er.plan(er.Scene.example(name), task=task, planner="optimal", objective="joint", slack=0.0)
    assert plan.cost <= 1.01 * BEST_KNOWN[name, task]
    assert plan.lower_bound is not None
    assert plan.gap is not None
    assert plan.lower_bound <= plan.cost
    assert 0.0 <= plan.gap <= 0.01
    assert as_json(plan)["gap"] == plan.gap


def test_a_smaller_gap_can_be_asked_for(standin: er.Scene) -> None:
    plan = er.plan(standin, task="first", planner="optimal", objective="joint", gap=0.001)
    assert plan.gap is not None
    assert plan.gap <= 0.001
    with pytest.raises(er.BadSetting, match="must be 0 or greater"):
        er.plan(standin, task="first", planner="optimal", gap=-1.0)
    with pytest.raises(er.BadSetting, match="gap is for planners that search in rounds"):
        er.plan(standin, task="first", planner="dstar", gap=0.1)


def narrow_within(degrees: int, folder: Path) -> Path:
    text = (Path(er.__file__).parent / "scenes" / "narrow.yaml").read_text()
    path = folder / "narrow.yaml"
    path.write_text(text.replace("min: -150, max: 150", f"min: -{degrees}, max: {degrees}"))
    return path


@pytest.mark.parametrize("planner", ["dstar-pso", "optimal"])
def test_no_path_is_proved_and_drawn(tmp_path: Path, planner: str) -> None:
    path = narrow_within(90, tmp_path)
    with pytest.raises(er.NoPath, match="proved") as caught:
        er.plan(er.Scene.load(path), task="first", planner=planner)  # type: ignore[arg-type]
    proof = caught.value
    assert len(proof.reachable) > 10
    assert all(abs(q2) <= 1.58 for cell in proof.reachable for _, q2 in cell)
    command = [
        sys.executable,
        "-c",
        "from elbowroom._cli import main; main()",
        "plan",
        str(path),
        "--task",
        "second",
        "--planner",
        planner,
    ]
    done = subprocess.run([*command, "--out", str(tmp_path)], capture_output=True, text=True, timeout=120, check=False)
    assert done.returncode == 1
    assert "no path: proved" in done.stderr
    assert (tmp_path / "no_path.png").stat().st_size > 5000


def test_a_wall_between_two_places_parts_them(standin: er.Scene) -> None:
    post = er.Circle(center=(0.3, 0.0), radius=0.02, name="post")
    joint = er.Joint(min=-1.0, max=1.0)
    arm = standin.arm.replace(joints=(joint, joint))
    tasks = {"across": er.Task(start=er.Configuration((-0.9, 0.0)), goal=er.Configuration((0.9, 0.0)))}
    scene = er.Scene(arm=arm, grid=standin.grid, obstacles=[post], tasks=tasks)
    with pytest.raises(er.NoPath):
        er.plan(scene)


@pytest.mark.parametrize("planner", ["dstar", "optimal"])
def test_the_bound_of_time_heeds_only_what_binds_the_motion(standin: er.Scene, planner: str) -> None:
    plan = er.plan(standin, task="first", planner=planner, objective="time", duration=0.5)  # type: ignore[arg-type]
    assert plan.lower_bound is not None
    assert plan.lower_bound <= plan.cost == pytest.approx(0.5)


def test_a_locked_joint_is_no_proof(standin: er.Scene) -> None:
    locked = er.Joint(min=1.0, max=1.0)
    arm = standin.arm.replace(joints=(er.Joint(continuous=True), locked))
    task = er.Task(start=er.Configuration((0.0, 1.0)), goal=er.Configuration((0.4, 1.0)), posture="keep")
    scene = er.Scene(arm=arm, grid=standin.grid, tasks={"turn": task})
    with pytest.raises(er.NotFound):
        er.plan(scene, planner="optimal", objective="joint")


def test_without_obstacles_the_bound_of_time_is_what_ruckig_needs() -> None:
    ruckig = pytest.importorskip("ruckig")
    draw = np.random.default_rng(7)
    grid = er.Grid(x=(-1.0, 1.0), y=(-1.0, 1.0), step=0.5)
    for links in (2, 3, 4):
        for _ in range(12):
            limits = 10.0 ** draw.uniform(-0.5, 1.5, (3, links))
            start, goal = draw.uniform(-2.0, 2.0, (2, links))
            joints = [er.Joint(min=-3.0, max=3.0, velocity=v, acceleration=a, jerk=j) for v, a, j in limits.T]
            arm = er.Arm(links=[0.5 / links] * links, joints=joints)
            task = er.Task(start=er.Configuration(tuple(start)), goal=er.Configuration(tuple(goal)))
            bound = er.plan(er.Scene(arm=arm, grid=grid, tasks={"go": task}), objective="time").lower_bound
            asked = ruckig.InputParameter(links)
            asked.current_position, asked.target_position = list(start), list(goal)
            asked.max_velocity, asked.max_acceleration, asked.max_jerk = (list(row) for row in limits)
            found = ruckig.Trajectory(links)
            ruckig.Ruckig(links).calculate(asked, found)
            assert bound == pytest.approx(found.duration, rel=1e-4)
            assert bound <= found.duration
