from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest


def run(*arguments: str | Path) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-c", "from elbowroom.cli import main; main()", *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, timeout=120)


def test_help_names_the_commands_and_exit_codes() -> None:
    shown = run("--help")
    assert shown.returncode == 0
    for word in ("plan", "map", "paper", "Exit codes"):
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


def test_plan_says_that_it_is_not_verified(scenes: Path, tmp_path: Path) -> None:
    done = run("plan", scenes / "paper-standin.yaml", "--task", "first", "--out", tmp_path)
    assert done.returncode == 0
    assert "NOT VERIFIED" in done.stdout
    assert (tmp_path / "plan.json").exists()
    assert (tmp_path / "trajectory.csv").exists()
    printed = json.loads(run("plan", scenes / "paper-standin.yaml", "--task", "first", "--json").stdout)
    assert printed["verified"] is False
    assert printed["cost"] == pytest.approx(0.953553, abs=1e-6)


@pytest.mark.parametrize(
    ("arguments", "code", "words"),
    [
        (("plan", "missing.yaml"), 2, "missing.yaml: cannot be read"),
        (("plan", "SCENES/paper-standin.yaml"), 2, "first, second"),
        (("plan", "SCENES/paper-standin.yaml", "--task", "x"), 2, "no task is called 'x'"),
        (("plan", "SCENES/paper-standin.yaml", "--task", "first", "--planner", "rrt"), 2, "dstar-pso or dstar"),
        (("plan", "SCENES/paper-table1.yaml", "--task", "first"), 3, "not found at this resolution"),
        (("plan", "SCENES/paper-standin.yaml", "--task", "first", "--timeout", "0"), 3, "timeout"),
        (("plan", "SCENES/paper-standin.yaml", "--task", "first", "--duration", "nan"), 2, "duration"),
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
