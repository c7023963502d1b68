from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest

from elbowroom._own_planners import OWN


def run(*arguments: str | Path) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "elbowroom", *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, timeout=120)


def test_help_names_the_commands_and_exit_codes() -> None:
    shown = run("--help")
    assert shown.returncode == 0
    for word in ("plan", "map", "check", "paper", "Exit codes"):
        assert word in shown.stdout
    assert run("--version").stdout.startswith("elbowroom 0.")


def test_map_counts_and_draws(scenes: Path, tmp_path: Path) -> None:
    done = run("map", scenes / "paper-standin.yaml", "--out", tmp_path, "--json")
    assert done.returncode == 0
    report = json.loads(done.stdout)
    assert report["points"] == 101 * 101 == sum(report["cases"].values()) == sum(report["elbow_up"].values())
    assert len(report["written"]) == 3
    assert all(Path(path).stat().st_size > 1000 for path in report["written"])
    table = run("map", scenes / "paper-standin.yaml")
    assert "elbow-down" in table.stdout
    assert table.stderr == ""


def test_plan_hands_out_a_motion_that_check_calls_safe(scenes: Path, tmp_path: Path) -> None:
    scene = scenes / "paper-standin.yaml"
    done = run("plan", scene, "--task", "first", "--out", tmp_path, "--animate")
    assert done.returncode == 0
    assert "SAFE: proved" in done.stdout
    names = ["tip_path", "smoothed_path", "arm_tracking", "configuration_space", "joints", "clearance"]
    for name in [*(f"{name}.png" for name in names), "plan.json", "trajectory.csv", "motion.gif"]:
        assert (tmp_path / name).stat().st_size > 1000, name
    checked = run("check", scene, tmp_path / "trajectory.csv")
    assert checked.returncode == 0
    assert "SAFE: proved" in checked.stdout
    printed = json.loads(run("plan", scene, "--task", "first", "--json", "--objective", "joint").stdout)
    assert printed["verified"] is True
    assert printed["objective"] == "joint"
    assert printed["verdict"]["least_clearance"]["distance"] > 0
    few = json.loads(run("plan", scene, "--task", "first", "--json", "--planner", "dstar-pso:candidates=4").stdout)
    assert (few["planner"], few["settings"]["candidates"]) == ("dstar-pso", 4)
    slow = json.loads(run("plan", scene, "--task", "second", "--json", "--duration", "12.5").stdout)
    assert slow["pieces"][-1]["start"] + slow["pieces"][-1]["duration"] == pytest.approx(12.5, abs=1e-9)


def test_check_says_what_is_wrong_and_exits_with_4(scenes: Path, tmp_path: Path) -> None:
    table = tmp_path / "straight.csv"
    table.write_text("time_s,q1_rad,q2_rad\n0,0.0,0.0\n5,1.5,0.0\n")
    failed = run("check", scenes / "paper-standin.yaml", table)
    assert failed.returncode == 4
    assert "NOT SAFE" in failed.stdout
    assert "link 2" in failed.stdout
    as_data = run("check", scenes / "paper-standin.yaml", table, "--json")
    assert as_data.returncode == 4
    verdict = json.loads(as_data.stdout)
    assert verdict["safe"] is False
    assert {"time", "link", "obstacle", "depth"} <= set(verdict["violations"][0])


@pytest.mark.parametrize(
    ("arguments", "code", "words"),
    [
        (("plan", "missing.yaml"), 2, "missing.yaml: cannot be read"),
        (("plan", "SCENES/paper-standin.yaml"), 2, "first, second"),
        (("plan", "SCENES/paper-standin.yaml", "--task", "x"), 2, "no task is called 'x'"),
        (
            ("plan", "SCENES/paper-standin.yaml", "--task", "first", "--planner", "rrt"),
            2,
            f"no planner is called 'rrt'; known: {', '.join(OWN)}",
        ),
        (
            ("plan", "SCENES/paper-standin.yaml", "--task", "first", "--planner", "dstar-pso:speed=2"),
            2,
            "planner dstar-pso has no option 'speed'; known: candidates",
        ),
        (("plan", "SCENES/paper-standin.yaml", "--planner", "dstar-pso:speed"), 2, "'speed' is not option=value"),
        (("plan", "SCENES/paper-table1.yaml", "--task", "first"), 3, "not found at this resolution"),
        (("plan", "SCENES/paper-standin.yaml", "--task", "first", "--timeout", "0"), 3, "timeout"),
        (("plan", "SCENES/paper-standin.yaml", "--task", "first", "--duration", "nan"), 2, "duration"),
        (("plan", "SCENES/paper-standin.yaml", "--task", "first", "--duration", "soon"), 2, "or fastest"),
        (("plan", "SCENES/paper-standin.yaml", "--task", "first", "--objective", "fun"), 2, "tip, joint, time"),
        (("plan", "SCENES/paper-standin.yaml", "--task", "first", "--animate"), 2, "needs --out"),
        (("check", "SCENES/paper-standin.yaml", "missing.csv"), 2, "missing.csv: cannot be read"),
        (("check", "SCENES/paper-standin.yaml", "missing.csv", "--joints", "a"), 2, "names 1; the arm has"),
    ],
)
def test_failures_are_short_and_have_their_exit_code(
    scenes: Path, arguments: tuple[str, ...], code: int, words: str
) -> None:
    failed = run(*(argument.replace("SCENES", str(scenes)) for argument in arguments))
    assert failed.returncode == code
    assert words in failed.stderr
    assert 1 <= len(failed.stderr.splitlines()) <= 3
    assert failed.stdout == ""


def test_a_wrong_scene_is_refused_with_its_place(tmp_path: Path) -> None:
    wrong = tmp_path / "wrong.yaml"
    wrong.write_text("elbowroom: 1\nunits: {length: inch, angle: deg}\narm: 1\ngrid: 1\n")
    for command in ("map", "plan"):
        failed = run(command, wrong)
        assert failed.returncode == 2
        assert f"{wrong}:2:17: units.length" in failed.stderr
